// SPDX-License-Identifier: Apache-2.0
// The gradient of the score F/p in place of the contribution F [PD01 Sec. 3.4]: changes that
// importance sampling compensates do not count. With perfect sampling the gradient is zero.
#pragma once
#include <vestige/brdf_differences.h>
#include <vestige/footprint/differentials.h>

namespace vestige {

/// Gradient of log(f cos / p), p the density of the whole BRDF, from differences of pdf():
/// expensive and rare, therefore not inlined.
[[gnu::noinline]] inline EventGradient scoreGradient(const ScatterEvent& e, const Brdf& brdf,
                                                     const ScatterPoint& p, Vec3 toNext) noexcept {
  const LogGradient density = differences::ofLogPdf(brdf, p, toNext);
  EventGradient g = contributionGradient(e, brdf.logGradient(p, toNext));
  g.byPrev -= density.dPrev, g.byNext -= density.dNext;
  return g;
}

}  // namespace vestige
