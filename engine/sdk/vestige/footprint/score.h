// SPDX-License-Identifier: Apache-2.0
// The gradient of the score F/p in place of the contribution F [PD01 Sec. 3.4]: what importance
// sampling has already taken into account does not count as change. Perfect sampling leaves none.
#pragma once
#include <vestige/brdf_differences.h>
#include <vestige/footprint/differentials.h>

namespace vestige {

/// Of f cos / p, p the density of the whole BRDF, from differences of pdf(): dear, and rarely asked
/// for. Not inlined: in the way of what is not rare.
[[gnu::noinline]] inline EventGradient scoreGradient(const ScatterEvent& e, const Brdf& brdf,
                                                     const ScatterPoint& p, Vec3 toNext) noexcept {
  const LogGradient density = differences::ofLogPdf(brdf, p, toNext);
  EventGradient g = contributionGradient(e, brdf.logGradient(p, toNext));
  g.byPrev -= density.dPrev, g.byNext -= density.dNext;
  return g;
}

}  // namespace vestige
