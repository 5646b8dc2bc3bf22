// SPDX-License-Identifier: Apache-2.0
// The image filter of PD01 [PD01 Sec. 4.1], for `footprint paper`: lookups side by side along the
// footprint's longer axis, each round and as wide as the shorter one. The paper interpolates
// between levels of a box pyramid; here the texture's own filter makes round lookups of the same
// width.
//
// [PD01] Suykens, Willems. Path differentials and applications. EGWR 2001.
#pragma once
#include <vestige/footprint/footprints.h>
#include <vestige/host.h>

namespace vestige {

/// Largest number of lookups; a longer footprint gets wider ones.
inline constexpr int kMostBoxLookups = 32;

inline Rgba lookupAlongMajor(const Texture& texture, Vec2 uv, const Vec2 dUv[2]) noexcept {
  const Real w = Real(texture.width()), h = Real(texture.height());
  Covariance texels;
  for (const int i : {0, 1}) texels.add({w * dUv[i].x, h * dUv[i].y});
  const Region axes = ellipse(texels);
  const Real major = std::sqrt(dot(axes.a, axes.a)), minor = std::sqrt(dot(axes.b, axes.b));
  if (!(major > 1) || !std::isfinite(major)) return texture.lookup(uv, dUv);
  const Real wanted = std::ceil(major / std::max(minor, Real(1)));
  const int n = int(std::min(wanted, Real(kMostBoxLookups)));
  const Real width = std::max(minor, major / Real(n));
  const Vec2 round[2] = {{width / w, 0}, {0, width / h}};
  Rgba sum{{}, 0};
  for (int i = 0; i < n; ++i) {
    const Real at = (Real(i) + Real(0.5)) / Real(n) - Real(0.5);
    const Rgba one = texture.lookup(uv + at * Vec2{axes.a.x / w, axes.a.y / h}, round);
    sum.colour += one.colour, sum.alpha += one.alpha;
  }
  return {sum.colour / Real(n), sum.alpha / Real(n)};
}

}  // namespace vestige
