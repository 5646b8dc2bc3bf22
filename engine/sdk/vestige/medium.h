// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vestige/brdf.h>
#include <vestige/math.h>

#include <optional>

/// Participating media: how far light flies before it is scattered or absorbed, and the direction
/// into which it is scattered.
///
/// Conventions of every method:
///   * Both kinds work in world space, with unit directions that leave the point: toPrev is the
///     known direction, toNext the sampled one. Unscattered light has toNext = -toPrev.
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

/// The end of a free flight.
struct FreeFlight {
  bool isScattered;  ///< false: it reached the end of the ray
  Real distance;     ///< to the point where it is scattered; scene units
  Rgb weight;        ///< transmittance times scattering coefficient / pdf; transmittance / chance
                     ///< where it reached the end
};

/// Random numbers for one flight. A heterogeneous medium draws more of them from `seed`.
struct FlightNumbers {
  Real distance, channel;  ///< [0,1)
  std::uint32_t seed;
};

class Medium {
 public:
  virtual ~Medium() = default;

  /// Draws the point where a ray is scattered, between its tMin and tMax (which may be infinite).
  virtual FreeFlight fly(const Ray& ray, FlightNumbers n) const noexcept = 0;

  /// Transmittance from tMin to tMax; may be an unbiased estimate that uses n.
  virtual Rgb transmittance(const Ray& ray, FlightNumbers n) const noexcept = 0;

  /// The phase function at the points of fly(). Lives as long as the medium.
  virtual const PhaseFunction& phase() const noexcept = 0;

  /// Emitted radiance per scene unit, W/(m^2 sr) per unit.
  virtual Rgb emission(Vec3 /*position*/) const noexcept { return {}; }
};

}  // namespace vestige
