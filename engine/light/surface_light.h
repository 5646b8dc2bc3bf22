// SPDX-License-Identifier: Apache-2.0
// Base of lights with an emitting surface. Points are uniform by area in some space of their own;
// the radiance does not depend on the direction.
//
// [MATH] docs/mathematics.md: 1.11 next-event estimation, 1.12 emission, 1.14 gradients.
#pragma once
#include <functional>

#include <vestige/light.h>

namespace vestige {

class SurfaceLight : public Light {
 public:
  using Radiance = std::function<Rgb(const SurfacePoint&)>;
  SurfaceLight(Radiance radiance, bool twoSided, Rgb meanRadiance)
      : radiance_(std::move(radiance)), mean_(meanRadiance), twoSided_(twoSided) {}

  LightTraits traits() const noexcept final { return {.isDrawn = isDrawn_}; }
  /// Excludes the light from next-event estimation and from the emission of particles.
  void hide() noexcept { isDrawn_ = false; }
  std::optional<LightSample> sample(const Receiver& r, Vec2 u) const noexcept override;
  Real pdf(const Receiver& r, const LightHit& hit) const noexcept override;
  Rgb eval(const LightHit& hit) const noexcept override;
  LightJacobian sampleDerivatives(const Receiver& r, Vec2 u) const noexcept override;
  LightLogGradient logGradient(const Receiver& r, Vec2 u) const noexcept override;
  std::optional<Particle> emit(EmissionNumbers u) const noexcept override;
  RayJacobian emissionDerivatives(EmissionNumbers u) const noexcept override;
  Rgb power() const noexcept override;
  LightExtent extent() const noexcept final;

 protected:
  /// A point by area, in world space; `pdf` per unit of world area. Nullopt: the light has no area.
  virtual std::optional<AreaSample> draw(Vec2 u) const noexcept = 0;
  /// Density of draw() at a point with this geometric normal, per unit of world area.
  virtual Real areaPdf(Vec3 normal) const noexcept = 0;
  /// World area.
  virtual Real area() const noexcept = 0;
  /// The extent of the light as if it emitted from one side only.
  virtual LightExtent oneSided() const noexcept = 0;

  bool shinesTo(Vec3 normal, Vec3 toLight) const noexcept {
    return twoSided_ || dot(normal, toLight) < 0;
  }
  /// A sample of this point as seen from somewhere; `pdf` by solid angle.
  LightSample seen(Vec3 from, const SurfacePoint& p, Vec3 toLight, Real distance, Real pdf) const;

  /// Relative change of the radiance as its point walks along dP on the surface: differences, as a
  /// pigment has no derivative of its own. 0 where it is even, or black.
  Real radianceSlope(const SurfacePoint& p, Vec3 dP) const noexcept;

  Real offset_ = 0;  ///< LightHit::offset of all samples

 private:
  /// The side from which a particle is emitted, and the rescaled random number that chose it.
  struct Side {
    Real sign;
    Vec2 u;
    Real stretch;  ///< d(u.x) by d(number)
  };
  Side side(Vec2 u) const noexcept;

  Radiance radiance_;
  Rgb mean_;
  bool twoSided_;
  bool isDrawn_ = true;
};

}  // namespace vestige
