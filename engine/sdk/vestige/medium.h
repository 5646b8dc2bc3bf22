// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vestige/brdf.h>
#include <vestige/math.h>

#include <optional>

/// What fills a space: how far light flies before it is scattered or absorbed, and into which
/// direction it is scattered then.
///
/// Said once, true of every method:
///   * Both kinds are asked in world space, with unit directions that leave the point: toPrev is
///   the
///     known direction, toNext the sampled one. Light that flies straight on has
///     toNext = -toPrev.
///   * Distances are in scene units, coefficients in 1 per scene unit.
///   * Methods are const, thread-safe and noexcept; they allocate nothing.
namespace vestige {

/// A direction drawn at a point of a medium.
struct PhaseSample {
  Vec3 toNext;  ///< unit, world
  Rgb weight;   ///< phase function / pdf
  Real pdf;     ///< 1/sr, > 0
};

class PhaseFunction {
 public:
  virtual ~PhaseFunction() = default;

  /// The phase function, 1/sr, in fCos (no cosine belongs to it), and the density of sample(). It
  /// integrates over the sphere to 1 at most.
  virtual ScatterValue evaluate(Vec3 toPrev, Vec3 toNext) const noexcept = 0;
  virtual std::optional<PhaseSample> sample(Vec3 toPrev, Vec2 u) const noexcept = 0;
};

/// How far a ray flew.
struct FreeFlight {
  bool isScattered;  ///< false: it reached the end of the ray
  Real distance;     ///< to the point where it is scattered; scene units
  Rgb weight;        ///< transmittance times scattering coefficient / pdf; transmittance / chance
                     ///< where it reached the end
};

/// Numbers for one flight. A medium that varies draws more of them from `seed`.
struct FlightNumbers {
  Real distance, channel;  ///< [0,1)
  std::uint32_t seed;
};

class Medium {
 public:
  virtual ~Medium() = default;

  /// Draws where a ray is scattered, between its tMin and tMax (which may be infinite).
  virtual FreeFlight fly(const Ray& ray, FlightNumbers n) const noexcept = 0;

  /// Share of the light that gets from tMin to tMax; may be an unbiased estimate from n.
  virtual Rgb transmittance(const Ray& ray, FlightNumbers n) const noexcept = 0;

  /// Scatters at the points of fly(). Lives as long as the medium.
  virtual const PhaseFunction& phase() const noexcept = 0;

  /// Radiance given off per scene unit, W/(m^2 sr) per unit.
  virtual Rgb emission(Vec3 /*position*/) const noexcept { return {}; }
};

}  // namespace vestige
