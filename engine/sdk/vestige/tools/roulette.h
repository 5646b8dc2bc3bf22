// SPDX-License-Identifier: Apache-2.0
// Russian roulette for paths from the eye.
#pragma once
#include <vestige/math.h>

namespace vestige {

/// Roulette starts with this scattering: earlier vertices contribute too much to be ended at
/// random.
inline constexpr int kRouletteFrom = 4;
/// No path survives with certainty, so that paths end even in a closed room of white walls.
inline constexpr Real kMaxSurvival = Real(0.95);

/// Probability that a path goes on. `flux`: its throughput without the factors eta^2 of radiance.
/// The square root, because survivors of roulette by the flux itself weigh so much that the
/// variance of `examples/cornell.scene` times its render time is a fifth larger.
inline Real survivalProbability(Rgb flux) noexcept {
  // A glossy remainder of a BRDF may be negative.
  const Real left = std::max({std::abs(flux.r), std::abs(flux.g), std::abs(flux.b)});
  return std::min(kMaxSurvival, std::sqrt(left));
}

}  // namespace vestige
