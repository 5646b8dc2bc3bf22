// SPDX-License-Identifier: Apache-2.0
// Double precision for the inside of an intersection: a ray that starts a few rounding steps off a
// surface in float must not meet it again.
#pragma once
#include <vestige/shape.h>

namespace vestige::exact {

struct V {
  double x = 0, y = 0, z = 0;
  V() = default;
  V(double a, double b, double c) : x(a), y(b), z(c) {}
  V(Vec3 v) : x(v.x), y(v.y), z(v.z) {}  // NOLINT: widening is what it is for
  operator Vec3() const noexcept { return {Real(x), Real(y), Real(z)}; }
};
inline V operator+(V a, V b) noexcept { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline V operator-(V a, V b) noexcept { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline V operator*(double s, V a) noexcept { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(V a, V b) noexcept { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline V cross(V a, V b) noexcept {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(V a) noexcept { return std::sqrt(dot(a, a)); }
inline V normalize(V a) noexcept { return (1 / length(a)) * a; }

inline constexpr double kPi = 3.14159265358979323846;

inline bool within(double t, const Ray& ray) noexcept { return t > ray.tMin && t < ray.tMax; }

/// The meetings of a ray with a solid that is all between two points of its line.
inline int interval(const ShapeHit& in, double tIn, const ShapeHit& out, double tOut,
                    const Ray& ray, std::span<Crossing> found) noexcept {
  std::size_t n = 0;
  if (within(tIn, ray) && n < found.size()) found[n++] = {in, true};
  if (within(tOut, ray) && n < found.size()) found[n++] = {out, false};
  return int(n);
}

/// Real roots of a t^2 + 2 b t + c, ascending; count of them (0, 1 for a == 0, or 2).
inline int quadratic(double a, double b, double c, double roots[2]) noexcept {
  if (a == 0) {
    if (b == 0) return 0;
    roots[0] = -c / (2 * b);
    return 1;
  }
  const double d = b * b - a * c;
  if (!(d >= 0)) return 0;
  // The sum without cancellation first, the other root from the product of both.
  const double q = -(b + std::copysign(std::sqrt(d), b));
  roots[0] = q / a;
  roots[1] = q != 0 ? c / q : roots[0];
  if (!std::isfinite(roots[0])) roots[0] = roots[1];  // a next to nothing: all but a line
  if (roots[0] > roots[1]) std::swap(roots[0], roots[1]);
  return 2;
}

/// Right-angled axes around a unit normal n in which a picture reads upright from the side that n
/// points to: s to the right, t up. For n = y they are x and z.
struct Axes {
  V s, t, n;
  static Axes around(V n) noexcept {
    const V right = std::abs(n.x) < 0.999 ? V{1, 0, 0} : V{0, 0, 1};
    const V s = normalize(right - dot(right, n) * n);
    return {s, cross(s, n), n};
  }
  V local(V v) const noexcept { return {dot(v, s), dot(v, t), dot(v, n)}; }
  V world(V v) const noexcept { return v.x * s + v.y * t + v.z * n; }
};

/// Angle of (x, y) from +x in turns, [0, 1).
inline double turns(double x, double y) noexcept {
  const double a = std::atan2(y, x) / (2 * kPi);
  return a < 0 ? std::min(a + 1, 1 - 1e-9) : a;
}

/// The radius where a direction around a pole has died out: derivatives are taken no nearer, so
/// that they still span the tangent plane. Share of the shape's radius.
inline constexpr double kPole = 1e-4;

}  // namespace vestige::exact
