// SPDX-License-Identifier: Apache-2.0
// The region that differential vectors (delta multiplied in) span: an ellipse, PD01's
// parallelogram, or the exact polygon.
//
// [PD01] Suykens, Willems. Path differentials and applications. EGWR 2001. Sec. 2.1, Fig. 3
#pragma once
#include <vestige/math.h>

#include <span>

namespace vestige {

/// Two vectors that represent all differential vectors, full length: axes of an ellipse, or sides
/// of a parallelogram.
struct Region {
  Vec2 a, b;
};

/// Symmetric 2 x 2: sum of v v^T.
struct Covariance {
  Real xx = 0, xy = 0, yy = 0;
  void add(Vec2 v) noexcept { xx += v.x * v.x, xy += v.x * v.y, yy += v.y * v.y; }
  /// Four vectors <x, y>, each times its delta.
  void add(const Four& delta, const Four& vx, const Four& vy) noexcept {
    const Four x = delta * vx, y = delta * vy, a = x * x, b = x * y, c = y * y;
    xx += (a[0] + a[1]) + (a[2] + a[3]);
    xy += (b[0] + b[1]) + (b[2] + b[3]);
    yy += (c[0] + c[1]) + (c[2] + c[3]);
  }
};

/// Principal axes, a the longer one: a a^T + b b^T = m. For two vectors the same ellipse as
/// theirs. Free of order, rotation and sign of the vectors [MATH 2.3].
inline Region ellipse(const Covariance& m) noexcept {
  const Real mean = Real(0.5) * (m.xx + m.yy), half = Real(0.5) * (m.xx - m.yy);
  const Real spread = std::sqrt(half * half + m.xy * m.xy);
  const Real major = mean + spread;
  if (!(major > 0)) return {};
  // The smaller eigenvalue by the determinant: a difference of large numbers would lose it.
  const Real minor = std::max((m.xx * m.yy - m.xy * m.xy) / major, Real(0));
  // Along (1, k) or (k, 1), |k| <= 1.
  const Real steep = spread + std::abs(half), k = steep > 0 ? m.xy / steep : Real(0);
  const Vec2 e = half < 0 ? Vec2{k, 1} : Vec2{1, k};
  const Real scale = 1 / (1 + k * k);
  return {std::sqrt(scale * major) * e, std::sqrt(scale * minor) * Vec2{-e.y, e.x}};
}

/// Exact area of the Minkowski sum of the vectors: a polygon of 2 K corners [MATH 2.1].
inline Real polygonArea(std::span<const Vec2> v) noexcept {
  Real area = 0;
  for (std::size_t i = 0; i < v.size(); ++i)
    for (std::size_t j = i + 1; j < v.size(); ++j) area += std::abs(cross(v[i], v[j]));
  return area;
}

/// The corners of that polygon, counter-clockwise, centred on 0: 2 K of them into `corners`.
inline void polygon(std::span<const Vec2> v, std::span<Vec2> corners) noexcept {
  const std::size_t k = v.size();
  // The sides in order of their angle, each turned into the upper half plane.
  Vec2 start;
  for (std::size_t i = 0; i < k; ++i) {
    const bool flip = v[i].y < 0 || (v[i].y == 0 && v[i].x < 0);
    corners[i] = flip ? Real(-1) * v[i] : v[i];
    start = start - Real(0.5) * corners[i];
  }
  std::sort(corners.begin(), corners.begin() + std::ptrdiff_t(k),
            [](Vec2 p, Vec2 q) { return cross(p, q) > 0; });
  for (std::size_t i = 0; i < k; ++i) {
    const Vec2 side = corners[i];
    corners[i] = start;
    start = start + side;
  }
  for (std::size_t i = 0; i < k; ++i) corners[k + i] = Real(-1) * corners[i];
}

/// PD01's representative vectors. The text leaves open how the arbitrary signs of the vectors are
/// chosen; turning all into the half plane around the minor axis of their ellipse keeps
/// |A x B| >= half the polygon's area [MATH 2.2]. `rescale` makes the two areas equal.
inline Region representative(std::span<const Vec2> v, bool rescale = true) noexcept {
  Covariance m;
  for (const Vec2 x : v) m.add(x);
  const Vec2 minor = [&] {
    const Region e = ellipse(m);
    return Vec2{-e.a.y, e.a.x};
  }();
  const auto turned = [&](Vec2 x) { return dot(x, minor) < 0 ? Real(-1) * x : x; };
  Vec2 total, a;
  for (const Vec2 x : v) total = total + turned(x);
  for (const Vec2 x : v)
    if (cross(total, turned(x)) > 0) a = a + turned(x);
  Region r{a, total - a};
  const Real area = std::abs(cross(r.a, r.b));
  if (!rescale || !(area > 0)) return r;
  const Real k = std::sqrt(polygonArea(v) / area);
  return {k * r.a, k * r.b};
}

}  // namespace vestige
