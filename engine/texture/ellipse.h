// SPDX-License-Identifier: Apache-2.0
// Weights of texels for a footprint, private to engine/texture.
//
// The filter is an elliptical weighted average [Hec89 3.5] over a level of the pyramid that is fine
// enough for the ellipse's minor axis. What a texel weighs is a bump of the quadratic form q of the
// ellipse, (1 - q / kRadius2)^2 inside q < kRadius2: near a Gaussian, but of bounded support.
//   [Hec89] P. Heckbert, Fundamentals of Texture Mapping and Image Warping, 1989.
#pragma once
#include <vestige/host.h>

#include <algorithm>
#include <cmath>

#include "engine/texture/pyramid.h"

namespace vestige {

/// Largest integer not above x, |x| < 2^31: std::floor is a call on baseline x86-64.
inline std::int32_t floorInt(Real x) noexcept {
  const auto i = std::int32_t(x);
  return i - (Real(i) > x);
}

/// A covariance in texels^2.
struct Moments {
  float xx = 0, xy = 0, yy = 0;

  /// Half the difference of the eigenvalues.
  float halfGap() const noexcept {
    const float d = (xx - yy) / 2;
    return std::sqrt(d * d + xy * xy);
  }
  float centre() const noexcept { return (xx + yy) / 2; }
};

/// A bilinear lookup spreads a texel over a tent of this variance, and so the filter must.
inline constexpr float kTent = 1 / 6.f;
/// Axes are clamped to this many times the picture, beyond which the average is constant.
inline constexpr float kMostPeriods = 16;
/// Longer ellipses are widened: this bounds what one lookup costs.
inline constexpr float kMostAspect = 32;
/// In texels of the level in use the minor axis has at least this variance: less, and the grid
/// would show; more, and the lookup would cost more.
inline constexpr float kLeastVariance = 0.2f;
/// Support of the bump for unit variance along each axis: that of (1 - r^2 / R^2)^2 is R^2 / 8.
inline constexpr float kRadius2 = 8;

/// a a^T + b b^T in texels of a picture of this size. Not finite where the footprint is not.
inline Moments outerProducts(const Vec2 d[2], std::int32_t width, std::int32_t height) noexcept {
  const float w = float(width), h = float(height);
  const float ax = w * float(d[0].x), ay = h * float(d[0].y);
  const float bx = w * float(d[1].x), by = h * float(d[1].y);
  return {ax * ax + bx * bx, ax * ay + bx * by, ay * ay + by * by};
}

/// The same, but every axis of uv bounded to kMostPeriods: infinities become that, and what is not
/// a number counts as 0. The correlation of x and y is kept.
inline Moments boundedProducts(const Vec2 d[2], std::int32_t width, std::int32_t height) noexcept {
  const auto within = [](Real x) {
    constexpr Real kLarge = Real(1e4);  // its square times that of a size is far from overflow
    return x != x ? Real(0) : std::clamp(x, -kLarge, kLarge);
  };
  const Vec2 e[2] = {{within(d[0].x), within(d[0].y)}, {within(d[1].x), within(d[1].y)}};
  Moments m = outerProducts(e, width, height);
  const auto shrink = [](float m, std::int32_t n) {
    const float most = kMostPeriods * float(n);
    return m > most * most ? most / std::sqrt(m) : 1.f;
  };
  const float sx = shrink(m.xx, width), sy = shrink(m.yy, height);
  return {m.xx * sx * sx, m.xy * sx * sy, m.yy * sy * sy};
}

/// The work of one lookup.
struct Wanted {
  float longest = 0;    ///< full length of the longest axis, texels
  Moments covariance;   ///< of the footprint, texels of the full resolution
  int level = 0;        ///< 0: full resolution; i: levels[i - 1]
  float levelPart = 1;  ///< the rest comes from the next finer level: no step shows between levels
};

/// `m`: a a^T + b b^T, `levels`: those of the picture, full resolution included.
inline Wanted wantedFilter(const Moments& m, int levels) noexcept {
  Wanted w;
  const float gap = m.halfGap(), centre = m.centre();
  w.longest = std::sqrt(centre + gap);
  w.covariance = {m.xx / 12, m.xy / 12, m.yy / 12};  // of a uniform segment: its length^2 / 12
  const float major = (centre + gap) / 12;
  float minor = std::max((centre - gap) / 12, 0.f);
  const float least = (major + kTent) / (kMostAspect * kMostAspect) - kTent;
  if (minor < least) {
    // (major I - C) / (major - minor) projects on the minor axis.
    const float more = (least - minor) / (major - minor);
    w.covariance.xx += more * (major - w.covariance.xx);
    w.covariance.xy -= more * w.covariance.xy;
    w.covariance.yy += more * (major - w.covariance.yy);
    minor = least;
  }
  // Level l averages 4^l texels of variance (4^l - 1) / 12 before it is filtered, so there the
  // minor axis has (minor + kTent + 1/12) / 4^l - 1/12 left.
  float ratio = (minor + kTent + 1 / 12.f) / (kLeastVariance + 1 / 12.f);
  for (; ratio >= 4 && w.level + 1 < levels; ratio /= 4) ++w.level;
  constexpr float kBand = 0.25f;
  if (w.level > 0) w.levelPart = std::min((ratio - 1) / kBand, 1.f);
  return w;
}

/// The bump on the texels of one level.
struct Bump {
  float reachY;  ///< rows within it of the centre count
  float slant;   ///< how the middle of a row moves with y
  float perY2;   ///< 1 - perY2 dy^2 is left of the form in the middle of a row
  float perX2;   ///< and perX2 dx^2 is taken from that beside it
  float reachX;  ///< 1 / sqrt(perX2)
};

inline Bump bumpOn(const Level& level, Moments c, bool anyX, bool anyY) noexcept {
  const float sx = 1 / level.scaleX, sy = 1 / level.scaleY;
  Moments m{(c.xx + kTent - level.spreadX) * sx * sx, c.xy * sx * sy,
            (c.yy + kTent - level.spreadY) * sy * sy};
  // Where all columns are the same the filter is its own marginal along the other axis.
  if (anyX) m.xx = kTent, m.xy = 0;
  if (anyY) m.yy = kTent, m.xy = 0;
  const float lack = kTent - (m.centre() - m.halfGap());
  if (lack > 0) m.xx += lack, m.yy += lack;
  const float det = m.xx * m.yy - m.xy * m.xy;
  Bump b;
  b.reachY = std::sqrt(kRadius2 * m.yy);
  b.slant = m.xy / m.yy;
  b.perY2 = 1 / (kRadius2 * m.yy);
  b.perX2 = m.yy / (kRadius2 * det);
  b.reachX = 1 / std::sqrt(b.perX2);
  return b;
}

/// Moves a coordinate near the picture without changing its texel; 0 for NaN.
inline Real broughtHome(Real t, Wrap wrap) noexcept {
  if (!(std::abs(t) < Real(1e9))) t = 0;
  if (wrap == Wrap::clamp) return std::clamp(t, Real(-kMostPeriods), Real(kMostPeriods + 1));
  return wrap == Wrap::repeat ? t - Real(floorInt(t)) : t - 2 * Real(floorInt(t / 2));
}

/// The texel that stands for texel i of an endless row; `border`: how many lie beyond each edge.
inline std::int32_t wrappedIndex(std::int32_t i, std::int32_t n, Wrap wrap, int border) noexcept {
  if (i >= 0 && i < n) return i;
  if (wrap == Wrap::clamp) return std::clamp(i, -border, n - 1 + border);
  const std::int32_t period = wrap == Wrap::repeat ? n : 2 * n;
  std::int32_t j = i % period;
  if (j < 0) j += period;
  return j < n ? j : period - 1 - j;
}

}  // namespace vestige
