// SPDX-License-Identifier: Apache-2.0
// Maps from the unit square with their derivatives. Each has a density that never vanishes inside
// the square and no pole, so that its derivative is bounded [MATH 1.7].
#pragma once
#include <vestige/math.h>

namespace vestige {

/// A point of the unit disk with its derivatives by u.
struct Disk {
  Vec2 d;
  Vec2 du[2];  ///< columns: d(d)/du.x, d(d)/du.y; |cross| = pi everywhere
};

/// Shirley and Chiu's concentric map, area preserving. The map is continuous; its derivative jumps
/// across the seams |2u-1| = |2v-1| [SC97].
inline Disk concentricDisk(Vec2 u) noexcept {
  const Real a = 2 * u.x - 1, b = 2 * u.y - 1;
  if (a == 0 && b == 0) return {{0, 0}, {{2, 0}, {0, kPi / 2}}};
  if (std::abs(a) > std::abs(b)) {
    const Real p = (kPi / 4) * b / a, c = std::cos(p), s = std::sin(p);
    return {{a * c, a * s}, {{2 * (c + p * s), 2 * (s - p * c)}, {-(kPi / 2) * s, (kPi / 2) * c}}};
  }
  const Real p = (kPi / 4) * a / b, c = std::cos(p), s = std::sin(p);
  return {{b * s, b * c}, {{(kPi / 2) * c, -(kPi / 2) * s}, {2 * (s - p * c), 2 * (c + p * s)}}};
}

/// A direction with its derivatives by u.
struct Direction {
  Vec3 d;
  Mat3x2 du;  ///< per unit of random number; |du.c0 x du.c1| pdf = 1
};

/// A direction around +z with density z / pi.
inline Direction cosineHemisphere(Vec2 u) noexcept {
  const Disk k = concentricDisk(u);
  const Real z = std::max(safeSqrt(1 - dot(k.d, k.d)), Real(1e-6));  // the horizon has no tangent
  const auto column = [&](Vec2 d) { return Vec3{d.x, d.y, -dot(k.d, d) / z}; };
  return {{k.d.x, k.d.y, z}, {column(k.du[0]), column(k.du[1])}};
}

/// A direction around +z, uniform over the cap cos >= cosMax: density 1 / (2 pi (1 - cosMax)).
/// cosMax = 0 gives the hemisphere, -1 the sphere.
inline Direction uniformCap(Vec2 u, Real cosMax) noexcept {
  // z = 1 - h q with h = 1 - cosMax; radius^2 = 1 - z^2 = q m^2, m^2 = h (2 - h q)
  const Disk k = concentricDisk(u);
  const Real h = 1 - cosMax, q = dot(k.d, k.d);
  const Real m = std::sqrt(std::max(h * (2 - h * q), Real(1e-12)));
  const auto column = [&](Vec2 d) {
    const Real dq = 2 * dot(k.d, d), dm = -h * h * dq / (2 * m);
    return Vec3{d.x * m + k.d.x * dm, d.y * m + k.d.y * dm, -h * dq};
  };
  return {{k.d.x * m, k.d.y * m, 1 - h * q}, {column(k.du[0]), column(k.du[1])}};
}

/// Barycentric coordinates (of the second and third corner), uniform over the triangle, piecewise
/// linear: the derivative is constant on each side of u.x = u.y [Heitz 2019, low-distortion map].
struct TrianglePoint {
  Vec2 b;
  Vec2 du[2];  ///< columns: db/du.x, db/du.y; |cross| = 1/2
};
inline TrianglePoint uniformTriangle(Vec2 u) noexcept {
  constexpr Real h = Real(0.5);
  if (u.y > u.x) return {{u.x * h, u.y - u.x * h}, {{h, -h}, {0, 1}}};
  return {{u.x - u.y * h, u.y * h}, {{1, 0}, {-h, h}}};
}

/// Weight of the strategy that has density a, against one with density b: power 2 [Vea97 9.2.4].
inline Real powerHeuristic(Real a, Real b) noexcept {
  if (!std::isfinite(a)) return 1;
  const Real r = a > 0 ? b / a : kInfinity;  // the quotient first: a * a may overflow
  return 1 / (1 + r * r);
}

}  // namespace vestige
