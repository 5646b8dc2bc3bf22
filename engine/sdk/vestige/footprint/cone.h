// SPDX-License-Identifier: Apache-2.0
// Heuristics of production renderers, for comparison: a cone around the path that starts as wide as
// the pixel's share and is opened at every scattering by a rule of thumb. It depends neither on the
// number of samples that share a scattering nor on the lobe's shape.
#pragma once
#include <vestige/footprint/deltas.h>
#include <vestige/integrator.h>

namespace vestige {

inline bool isCone(Bound b) noexcept { return b == Bound::roughness || b == Bound::density; }

struct Cone {
  Real width = 0;   ///< scene units, the whole of it
  Real spread = 0;  ///< rad

  void begin(const RayJacobian& ray, Real share) noexcept {
    const auto side = [&](const auto& d) { return share * (length(d[0]) + length(d[1])) / 2; };
    width = side(ray.dOrigin), spread = side(ray.dDirection);
  }
  void travel(Real distance) noexcept { width += spread * distance; }

  /// max(spread, width of the lobe), the lobe's roughness as that of a Lambertian is 1:
  /// 1/sqrt(pi density) at its middle; or max(spread, 1/(8 sqrt(density)) of what was drawn.
  [[gnu::noinline]] void scatter(Bound bound, const Interaction& x, const ScatterSample& drawn,
                                 ScatterNumbers numbers) noexcept {
    if (drawn.specular) return;
    Real own = 1 / (8 * std::sqrt(drawn.lobePdf));
    if (bound == Bound::roughness) {
      const auto middle = x.brdf->sample(x.point, {numbers.lobe, {Real(0.5), Real(0.5)}});
      own = 1 / std::sqrt(kPi * (middle ? middle->lobePdf : drawn.lobePdf));
    }
    spread = std::max(spread, std::min(own, Real(1)));
  }
};

}  // namespace vestige
