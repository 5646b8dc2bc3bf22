// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vestige/receiver.h>
#include <vestige/shape.h>
#include <optional>

/// Where radiance comes from.
///
/// Said once, true of every method:
///   * Everything is in world space; a light applies Values::toWorld() when it is created.
///   * `toLight` is a unit vector from the looking point to the light.
///   * Two kinds: lights with a density, which a ray may hit by chance, and delta lights (point,
///     spot, distant), which none can. For a delta light pdf is 1 and `radiance` is the irradiance
///     that arrives across toLight, W/m^2.
///   * Emission is looked up without footprint wherever two strategies of multiple importance
///     sampling must estimate the same integral.
///   * Methods are const, thread-safe and noexcept; they allocate nothing. "No sample" is an
///   ordinary
///     value.
namespace vestige {

/// Error of a ray's meeting with a surface per unit of its length, in float, whatever Real is:
/// sqrt(3)/2 epsilon from rounding its direction, the same from the vectors between its origin and
/// the surface, and two epsilon from their products.
inline constexpr Real kRayError = 4 * std::numeric_limits<float>::epsilon();

/// A point of a light as seen from somewhere.
struct LightHit {
  Vec3 from;
  Vec3 toLight;
  Real distance;  ///< scene units; infinite for lights at infinity
  Vec3 position;  ///< on the light; meaningless at infinity
  Vec3 normal;    ///< geometric normal there, unit; zero at infinity
  Vec2 uv;
  /// How toLight moves over the footprint of a path that nothing was drawn against: lights at
  /// infinity may average over it. Zero: a point.
  Vec3 spread[2] = {};
  /// How far off its surface a shadow ray ends at least, scene units: kRayError times the longest
  /// edge or radius of the surface. shadowRay() adds the part of the error that grows with the
  /// distance and with `position`, so 0 is safe for a light that is not much larger than both.
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
/// what turns its own measure into solid angle (cos / distance^2 where a point of the light was
/// drawn by area, nothing where a direction was).
struct LightLogGradient {
  Vec2 du;     ///< per unit of random number
  Vec3 dFrom;  ///< per scene unit of the receiver's position
};

struct EmissionNumbers {
  Vec2 point, direction;  ///< [0,1)^2
};

/// What a particle starts with.
struct Particle {
  Vec3 origin, direction;
  Vec3 normal;        ///< of the light there; zero where it has none
  Rgb power;          ///< W: radiance cos / pdf; its mean is the light's whole flux
  int variables = 4;  ///< how many of the numbers matter: 2 for point lights
};

/// Where a light is and where it shines, for choosing one of many lights at a point. Must be
/// conservative: it may overestimate, never underestimate.
struct LightExtent {
  Bounds box;            ///< world; empty: anywhere, then the light is chosen by its power alone
  Vec3 axis{0, 0, 1};    ///< unit, amid the normals (or axes) of its points
  Real spread = kPi;     ///< rad, from the axis to the farthest normal
  Real reach = kPi / 2;  ///< rad, from a normal to where nothing of its point arrives
};

/// What kind of light it is. The same for the whole life of the light.
struct LightTraits {
  bool isDelta = false;  ///< no ray meets it by chance
  /// Seen by rays that leave the scene.
  bool isInfinite = false;
  /// Rays are drawn towards it (next-event estimation). False: it is left to the rays that
  /// scattering draws, for light that comes evenly from all around. Delta lights are always drawn.
  bool isDrawn = true;
  /// eval() looks at LightHit::spread: paths then carry differentials for it.
  bool usesSpread = false;
};

/// Four methods have no default: sample(), pdf(), eval() and power(). Bases that write more of
/// them: PointSource and DistantSource (delta_light.h), AreaLight (area_light.h), DualLight
/// (dual_light.h).
class Light {
 public:
  virtual ~Light() = default;

  /// By default: finite, and with a density.
  virtual LightTraits traits() const noexcept { return {}; }

  /// The extent of the finite part of the scene, told once before rendering. [main thread]
  virtual void setScene(const Bounds&) {}

  /// A surface that shines, blocks and is seen; the engine adds it to the scene. Null: none.
  virtual const TriangleMesh* geometry() const noexcept { return nullptr; }

  /// A direction towards the light, for next-event estimation; nullopt where nothing arrives.
  virtual std::optional<LightSample> sample(const Receiver& r, Vec2 u) const noexcept = 0;

  /// Density of sample() for this direction, 1/sr; 0 for delta lights. hit.from is r.position.
  virtual Real pdf(const Receiver& r, const LightHit& hit) const noexcept = 0;

  /// What arrives at hit.from, W/(m^2 sr); black for delta lights.
  virtual Rgb eval(const LightHit& hit) const noexcept = 0;

  /// By default: finite differences of sample(), and a note to the user.
  virtual LightJacobian sampleDerivatives(const Receiver& r, Vec2 u) const noexcept;
  /// By default: finite differences of sample(), and a note to the user. They take the light for
  /// one whose points are drawn by area if it has a geometry().
  virtual LightLogGradient logGradient(const Receiver& r, Vec2 u) const noexcept;

  /// Starts a particle; nullopt: none for these numbers (nothing lost). By default the light sends
  /// none at all: integrators that start at lights leave it out, and say so.
  virtual std::optional<Particle> emit(EmissionNumbers) const noexcept { return std::nullopt; }
  /// By default: finite differences of emit(), and a note to the user.
  virtual RayJacobian emissionDerivatives(EmissionNumbers u) const noexcept;

  virtual LightExtent extent() const noexcept { return {}; }

  /// Estimate of the whole flux, W: how often the light is chosen.
  virtual Rgb power() const noexcept = 0;
};

}  // namespace vestige

#include <vestige/light_differences.h>  // the three defaults
