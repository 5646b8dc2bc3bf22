// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vestige/receiver.h>
#include <vestige/shape.h>
#include <optional>

/// Sources of radiance.
///
/// Conventions of every method:
///   * Everything is in world space; a light applies Values::toWorld() when it is created.
///   * `toLight` is a unit vector from the receiver to the light.
///   * There are lights with a density, which a ray may hit by chance, and delta lights (point,
///     spot, distant), which no ray can hit. For a delta light pdf is 1 and `radiance` is the
///     irradiance perpendicular to toLight, W/m^2.
///   * Emission is evaluated without a footprint wherever two strategies of multiple importance
///     sampling must estimate the same integral.
///   * Methods are const, thread-safe and noexcept; they allocate nothing. "No sample" is an
///     ordinary value.
namespace vestige {

/// Relative error of the point where a ray meets a surface, in float, whatever Real is: sqrt(3)/2
/// epsilon from rounding its direction, the same from the vectors between its origin and the
/// surface, and two epsilon from their products.
inline constexpr Real kRayError = 4 * std::numeric_limits<float>::epsilon();

/// A point of a light as seen from a receiver.
struct LightHit {
  Vec3 from;
  Vec3 toLight;
  Real distance;  ///< scene units; infinite for lights at infinity
  Vec3 position;  ///< on the light; meaningless at infinity
  Vec3 normal;    ///< geometric normal there, unit; zero at infinity
  Vec2 uv;
  /// Change of toLight over the footprint of a path that no light sampling competes with; lights at
  /// infinity may average over it. Zero: a single direction.
  Vec3 spread[2] = {};
  /// Least distance from the light's surface at which a shadow ray ends, scene units: kRayError
  /// times the longest edge or radius of the surface. shadowRay() adds the part of the error that
  /// grows with the distance and with `position`, so 0 is safe for a light that is not much larger
  /// than both.
  Real offset = 0;
};

struct LightSample {
  LightHit hit;
  Rgb radiance;  ///< W/(m^2 sr) towards hit.from; see above for delta lights
  Real pdf;      ///< 1/sr, > 0; 1 for delta lights
};

/// First derivatives of LightHit::toLight as sample() draws it.
struct LightJacobian {
  Mat3x2 du;   ///< per unit of random number; zero for delta lights; |du.c0 x du.c1| pdf = 1
  Mat3 dFrom;  ///< per scene unit of the receiver's position; zero at infinity
};

/// Relative change of the light's factor in the contribution [PD01 3.2, MATH 1.14]: radiance times
/// the conversion of its measure to solid angle (cos / distance^2 if a point was drawn by area, 1
/// if a direction was drawn).
struct LightLogGradient {
  Vec2 du;     ///< per unit of random number
  Vec3 dFrom;  ///< per scene unit of the receiver's position
};

struct EmissionNumbers {
  Vec2 point, direction;  ///< [0,1)^2
};

/// The initial state of a particle.
struct Particle {
  Vec3 origin, direction;
  Vec3 normal;        ///< normal of the light there; zero for delta lights
  Rgb power;          ///< W: radiance cos / pdf; its mean is the light's whole flux
  int variables = 4;  ///< how many of the random numbers have an effect: 2 for point lights
};

/// Bounds of a light's position and directions, for choosing one of many lights at a point. Must be
/// conservative: they may overestimate, never underestimate.
struct LightExtent {
  Bounds box;            ///< world; empty: unknown, the light is then chosen by its power alone
  Vec3 axis{0, 0, 1};    ///< unit, central direction of its normals (or axes)
  Real spread = kPi;     ///< rad, from the axis to the farthest normal
  Real reach = kPi / 2;  ///< rad, largest angle from a normal at which the point still emits
};

/// Traits of a light. Constant during its life.
struct LightTraits {
  bool isDelta = false;  ///< no ray can hit it by chance
  /// Seen by rays that leave the scene.
  bool isInfinite = false;
  /// Whether next-event estimation samples it. False: only scattered rays find it, which is best
  /// for even light from all around. Delta lights are always sampled.
  bool isDrawn = true;
  /// Whether eval() uses LightHit::spread: paths then carry differentials for it.
  bool usesSpread = false;
};

/// Four methods have no default: sample(), pdf(), eval() and power(). Base classes that implement
/// more: PointSource and DistantSource (delta_light.h), AreaLight (area_light.h), DualLight
/// (dual_light.h).
class Light {
 public:
  virtual ~Light() = default;

  /// By default: a light at finite distance with a density.
  virtual LightTraits traits() const noexcept { return {}; }

  /// Called once before rendering with the bounds of all finite objects. [main thread]
  virtual void setScene(const Bounds&) {}

  /// The light's visible surface, which the engine adds to the scene. Null: none.
  virtual const TriangleMesh* geometry() const noexcept { return nullptr; }

  /// Draws a direction towards the light, for next-event estimation; nullopt where no light
  /// arrives.
  virtual std::optional<LightSample> sample(const Receiver& r, Vec2 u) const noexcept = 0;

  /// Density of sample() for the direction hit.toLight, 1/sr; 0 for delta lights. hit.from is
  /// r.position.
  virtual Real pdf(const Receiver& r, const LightHit& hit) const noexcept = 0;

  /// Radiance arriving at hit.from, W/(m^2 sr); black for delta lights.
  virtual Rgb eval(const LightHit& hit) const noexcept = 0;

  /// By default: finite differences of sample(), and a note to the user.
  virtual LightJacobian sampleDerivatives(const Receiver& r, Vec2 u) const noexcept;
  /// By default: finite differences of sample(), and a note to the user. They assume that points
  /// are drawn by area if the light has a geometry().
  virtual LightLogGradient logGradient(const Receiver& r, Vec2 u) const noexcept;

  /// Emits a particle; nullopt: no particle for these random numbers, which loses no energy. By
  /// default the light emits none: integrators that start at lights omit it, with a warning.
  virtual std::optional<Particle> emit(EmissionNumbers) const noexcept { return std::nullopt; }
  /// By default: finite differences of emit(), and a note to the user.
  virtual RayJacobian emissionDerivatives(EmissionNumbers u) const noexcept;

  virtual LightExtent extent() const noexcept { return {}; }

  /// Estimate of the total flux, W: the light is chosen in proportion to it.
  virtual Rgb power() const noexcept = 0;
};

}  // namespace vestige

#include <vestige/light_differences.h>  // the three defaults
