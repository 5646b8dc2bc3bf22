// SPDX-License-Identifier: Apache-2.0
// Particles: from the lights through the scene, each with the region that it stands for, leaving
// flux wherever light is kept. A particle is a pure function of its index and the seed.
//
// [PD01] Suykens, Willems. Path differentials and applications. EGWR 2001. Sec. 4.2
#pragma once
#include <vestige/footprint.h>

#include "hierarchy.h"

namespace vestige::particle {

/// Where all flux went, in units of Flux:
///   emitted + gained = absorbed + escaped + lost
struct Booking {
  Flux emitted{}, absorbed{}, escaped{};
  Flux lost{}, gained{};  ///< by Russian roulette; their means are equal
  std::uint64_t particles = 0, hits = 0;

  void add(const Booking& b) noexcept;
};

enum class FootprintArea {
  covariance,  ///< of the ellipse with the vectors' second moments, as a square
  polygon,     ///< exact, of the polygon that they span
};

struct Shooting {
  const SceneView& scene;
  Hierarchy& hierarchy;
  FootprintSettings footprint;
  FootprintArea area = FootprintArea::covariance;
  std::uint64_t particles = 0;  ///< declared, of all parts together: N of MATH 3.2
  std::uint32_t seed = 0;
  double power = 1;  ///< W: what a Flux counts in (kFluxUnit)

  /// Sends out the particles [first, last) and books them; the same for any number of threads.
  void pass(std::uint64_t first, std::uint64_t last, int threads, Booking& booking) const;

 private:
  void shootOne(std::uint32_t index, Booking& booking) const;
  /// Rounded up with the chance of the rest: weak lights are not lost. `u` in [0,1).
  Flux inUnits(Rgb watt, Real u) const noexcept;
};

/// Particles between two looks at the clock, the user, memory, and where hits vary: few at first,
/// so that little flux is left on elements that are soon divided.
inline std::uint64_t passAfter(std::uint64_t sent) noexcept {
  return std::clamp<std::uint64_t>(sent / 4, 1024, 65536);
}

/// W, of all lights together, the brightest channel; 0: it is dark.
double totalPower(const SceneView& scene) noexcept;

}  // namespace vestige::particle
