// SPDX-License-Identifier: Apache-2.0
// Finite differences with a test of their validity, and lobes without their frame's spin.
#pragma once
#include <vestige/brdf.h>

#include <optional>

namespace vestige::judge {

inline double sizeOf(Real x) { return std::abs(double(x)); }
inline double sizeOf(Vec3 x) { return double(length(x)); }

/// Derivative at 0 of a map from a number to an optional Vec3 or Real, from five points
/// [error: h^4]. nullopt where the map has no value at one of them.
template <class Map>
auto fivePoints(const Map& map, double h) -> decltype(map(0.0)) {
  const auto a = map(-2 * h), b = map(-h), c = map(h), d = map(2 * h);
  if (!a || !b || !c || !d) return std::nullopt;
  return Real(1 / (12 * h)) * (*a - *d + Real(8) * (*c - *b));
}

/// Whether the derivative from the left is that from the right [error: h^2, the same for both]. On
/// a bend (the border of a texel) differences of any step give their mean, which is neither.
template <class Map>
bool isBend(const Map& map, double h, double tolerance) {
  const auto a = map(-2 * h), b = map(-h), m = map(0.0), c = map(h), d = map(2 * h);
  if (!a || !b || !m || !c || !d) return true;
  const auto left = Real(1 / (2 * h)) * (*a - Real(4) * *b + Real(3) * *m);
  const auto right = Real(1 / (2 * h)) * (Real(4) * *c - *d - Real(3) * *m);
  return !(sizeOf(right - left) < tolerance);
}

/// The same as fivePoints(), or nullopt where it cannot be trusted to `tolerance`: a smaller step
/// gives another result (a curve too sharp, a seam, the edge of total reflection), or rounding of
/// values of size `noise` would drown it. Two smaller steps are tried: across an edge two results
/// may agree by chance, which does happen in 10^5 events.
template <class Map>
auto trustedDifference(const Map& map, double h, double tolerance, double noise = 1)
    -> decltype(map(0.0)) {
  constexpr double epsilon = double(std::numeric_limits<Real>::epsilon());
  if (4 * noise * epsilon / h > 0.5 * tolerance) return std::nullopt;
  const auto wide = fivePoints(map, h), narrow = fivePoints(map, h / 2);
  if (!wide || !narrow || !(sizeOf(*wide - *narrow) < 0.3 * tolerance)) return std::nullopt;
  const auto between = fivePoints(map, 0.7 * h);
  if (!between || !(sizeOf(*between - *narrow) < 0.3 * tolerance)) return std::nullopt;
  if (isBend(map, h / 2, tolerance)) return std::nullopt;
  return narrow;
}

/// Whether the slope from a wide step is a mean over fine bends (the knots of a table): smaller
/// steps then give another one. A method that returns the slope of its own piece is right, but
/// differences cannot confirm it.
template <class Map, class Slope>
bool hasFineBends(const Map& map, const Slope& seen, double h, double tolerance, double noise) {
  constexpr double epsilon = double(std::numeric_limits<Real>::epsilon());
  for (double step = h / 8; 4 * noise * epsilon / step < 0.5 * tolerance; step /= 4) {
    const auto fine = fivePoints(map, step);
    const double allowed = 0.3 * tolerance + 4 * noise * epsilon / step;
    if (!fine || !(sizeOf(*fine - seen) < allowed)) return true;
  }
  return false;
}

/// Some unit tangent, by the angle.
inline Vec3 tangent(Vec3 unit, double angle) {
  const Frame f = Frame::around(unit);
  return Real(std::cos(angle)) * f.s + Real(std::sin(angle)) * f.t;
}

/// The point an angle away from a unit vector along a unit tangent.
inline Vec3 turned(Vec3 unit, Vec3 along, double angle) {
  return Real(std::cos(angle)) * unit + Real(std::sin(angle)) * along;
}

/// v, moved with the smallest turn that takes unit a to unit b.
inline Vec3 transport(Vec3 a, Vec3 b, Vec3 v) {
  const Vec3 w = cross(a, b);
  return v + cross(w, v) + cross(w, cross(w, v)) / (1 + dot(a, b));
}

/// The concrete frame that a sampler builds around its lobe: the lobe's middle is u = <1/2, 1/2>,
/// azimuth 0 lies towards u = <1, 1/2>. nullopt where either is absorbed or specular.
inline std::optional<Frame> lobeFrame(const Brdf& brdf, const ScatterPoint& p, Real lobe) {
  const Real half = Real(0.5);
  const auto axis = brdf.sample(p, {lobe, {half, half}});
  const auto side = brdf.sample(p, {lobe, {Real(0.6), half}});
  if (!axis || !side || axis->specular || axis->lobe != side->lobe) return std::nullopt;
  // Twice: what lies across the axis is a small difference, and not quite across it.
  return Frame::along(axis->toNext, Frame::along(axis->toNext, side->toNext).s);
}

}  // namespace vestige::judge
