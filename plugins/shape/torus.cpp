// SPDX-License-Identifier: Apache-2.0
// Torus around the y axis: a tube of radius r along a circle of radius R.
//
// The meeting points are the roots of a quartic. They are found from the inside out: the roots of
// each derivative cut the ray into pieces on which the next lower derivative is monotone, so that
// bisection with Newton steps cannot miss one or fail to converge.
#include <vestige/plugin.h>

#include "exact.h"

namespace vestige {
namespace {

using exact::V;

/// Value of c[0] + c[1] t + ... + c[n] t^n and its slope.
double value(const double* c, int n, double t, double& slope) noexcept {
  double v = c[n];
  slope = 0;
  for (int k = n - 1; k >= 0; --k) slope = slope * t + v, v = v * t + c[k];
  return v;
}

/// The one root between a and b, where the signs differ.
double rootBetween(const double* c, int n, double a, double b, double va) noexcept {
  double t = 0.5 * (a + b);
  for (int step = 0; step < 100; ++step) {
    double slope;
    const double v = value(c, n, t, slope);
    if (v == 0) return t;
    ((v < 0) == (va < 0) ? a : b) = t;
    double next = t - v / slope;
    if (!(next > a && next < b)) next = 0.5 * (a + b);
    if (std::abs(next - t) <= 1e-15 * std::abs(t) || next == t) return next;
    t = next;
  }
  return t;
}

/// Ascending roots in [low, high] of a polynomial of degree n <= 4; simple ones all, of a double
/// one (a ray that touches) none or two.
int rootsBetween(const double* c, int n, double low, double high, double* roots) noexcept {
  if (n == 1) {
    roots[0] = -c[0] / c[1];
    return roots[0] >= low && roots[0] <= high ? 1 : 0;
  }
  double derivative[4], turning[4];
  for (int k = 1; k <= n; ++k) derivative[k - 1] = k * c[k];
  const int pieces = rootsBetween(derivative, n - 1, low, high, turning);
  int found = 0;
  double slope, a = low, va = value(c, n, a, slope);
  for (int k = 0; k <= pieces; ++k) {
    const double b = k < pieces ? turning[k] : high, vb = value(c, n, b, slope);
    if ((va < 0) != (vb < 0)) roots[found++] = rootBetween(c, n, a, b, va);
    a = b, va = vb;
  }
  return found;
}

class Torus final : public Shape {
 public:
  enum Row { kMajor, kMinor };

  static Schema schema() {
    return {.kind = "shape",
            .name = "torus",
            .summary = "ring around the y axis, centred at the origin",
            .params = {real("major_radius", 1)
                           .need()
                           .place()
                           .positive()
                           .in("scene units")
                           .doc("from the centre to the middle of the tube"),
                       real("minor_radius", 0.25)
                           .need()
                           .place()
                           .positive()
                           .in("scene units")
                           .doc("of the tube")}};
  }
  explicit Torus(const Values& v) : R_(v.real(kMajor)), r_(v.real(kMinor)) {
    if (!(r_ < R_)) throw PluginError(kMinor, "the tube's radius must be smaller than the ring's");
  }

  Bounds bounds() const noexcept override {
    const Vec3 b{Real(R_ + r_), Real(r_), Real(R_ + r_)};
    return {-b, b};
  }

  std::optional<ShapeHit> intersect(const Ray& ray) const noexcept override {
    const Roots all = roots(ray);
    for (int i = 0; i < all.count; ++i)
      if (exact::within(all.t[i], ray)) return ShapeHit{Real(all.t[i])};
    return std::nullopt;
  }
  int crossings(const Ray& ray, std::span<Crossing> found) const noexcept override {
    const Roots all = roots(ray);
    std::size_t n = 0;
    for (int i = 0; i < all.count && n < found.size(); ++i)  // the line begins outside
      if (exact::within(all.t[i], ray)) found[n++] = {{Real(all.t[i])}, i % 2 == 0};
    return int(n);
  }

  SurfacePoint surface(Vec3 near, const ShapeHit&) const noexcept override {
    const V p(near);
    const double ring = std::hypot(p.x, p.z), x = ring - R_, tube = std::hypot(x, p.y);
    if (!(ring > 0) || !(tube > 0)) return point(1, 0, 1, 0);
    return point(p.x / ring, p.z / ring, x / tube, p.y / tube);
  }

  bool isClosed() const noexcept override { return true; }
  Real area() const noexcept override { return Real(area64()); }

  AreaSample samplePoint(Vec2 u) const noexcept override {
    // Around the tube the circumference is R + r cos b: b + (r/R) sin b = 2 pi u.y, which is
    // Kepler's equation.
    const double a = 2 * exact::kPi * u.x, mean = 2 * exact::kPi * u.y, e = r_ / R_;
    double low = 0, high = 2 * exact::kPi, b = mean;
    for (int step = 0; step < 60; ++step) {
      const double f = b + e * std::sin(b) - mean;
      (f < 0 ? low : high) = b;
      double next = b - f / (1 + e * std::cos(b));
      if (!(next > low && next < high)) next = 0.5 * (low + high);
      const bool done = std::abs(next - b) < 1e-14;
      b = next;
      if (done) break;
    }
    const SurfacePoint p = point(std::cos(a), std::sin(a), std::cos(b), std::sin(b));
    const Real byV = Real(1 / (1 + e * std::cos(b)));  // d(b / 2 pi) by u.y
    return {p, {p.dPdu, byV * p.dPdv}, {p.dNdu, byV * p.dNdv}, Real(1 / area64())};
  }

  int faces() const noexcept override { return 1; }
  SurfacePoint at(Vec2 uv, int) const noexcept override {
    const double a = 2 * exact::kPi * uv.x, b = 2 * exact::kPi * uv.y;
    return point(std::cos(a), std::sin(a), std::cos(b), std::sin(b));
  }

 private:
  /// All meetings of a ray's line, ascending.
  struct Roots {
    double t[4];
    int count = 0;
  };
  Roots roots(const Ray& ray) const noexcept {
    // Around the point nearest to the centre, in units of length, where the numbers are small.
    const V o(ray.origin), all(ray.direction);
    const double scale = length(all);
    const V d = (1 / scale) * all;
    const double shift = -dot(o, d);
    const V p = o + shift * d;
    const double chord2 = (R_ + r_) * (R_ + r_) - dot(p, p);  // of the sphere around it
    if (!(chord2 > 0)) return {};
    const double half = std::sqrt(chord2);
    // (t^2 + m)^2 - 4 R^2 ((px + t dx)^2 + (pz + t dz)^2), m = p.p + R^2 - r^2, as p.d = 0
    const double m = dot(p, p) + R_ * R_ - r_ * r_, k = 4 * R_ * R_;
    const double c[5] = {m * m - k * (p.x * p.x + p.z * p.z), -2 * k * (p.x * d.x + p.z * d.z),
                         2 * m - k * (d.x * d.x + d.z * d.z), 0, 1};
    Roots r;
    r.count = rootsBetween(c, 4, -half - 1e-9 * R_, half + 1e-9 * R_, r.t);
    for (int i = 0; i < r.count; ++i) r.t[i] = (r.t[i] + shift) / scale;
    return r;
  }

  double area64() const noexcept { return 4 * exact::kPi * exact::kPi * R_ * r_; }

  /// At angle a around the axis and b around the tube, by their cosines and sines.
  SurfacePoint point(double ca, double sa, double cb, double sb) const noexcept {
    const double ring = R_ + r_ * cb;
    SurfacePoint s;
    const V n{cb * ca, sb, cb * sa}, around{-sa, 0, ca}, up{-sb * ca, cb, -sb * sa};
    s.position = V{R_ * ca, 0, R_ * sa} + r_ * n;
    s.normal = s.geometricNormal = n;
    s.uv = {Real(exact::turns(ca, sa)), Real(exact::turns(cb, sb))};
    s.dPdu = 2 * exact::kPi * ring * around, s.dPdv = 2 * exact::kPi * r_ * up;
    s.dNdu = 2 * exact::kPi * cb * around, s.dNdv = 2 * exact::kPi * up;
    constexpr double turn = 4 * exact::kPi * exact::kPi;
    s.dPduu = -turn * ring * V{ca, 0, sa};
    s.dPduv = -turn * r_ * sb * around;
    s.dPdvv = -turn * r_ * n;
    return s;
  }

  double R_, r_;
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Shape, vestige::Torus)
