// SPDX-License-Identifier: Apache-2.0
// Several meetings of one ray with a shape, and shapes written over dual numbers.
#include <vestige/dual_shape.h>

#include "support/catch.h"
#include "support/solids.h"

using namespace vestige;
using namespace vestige::test;

namespace {

constexpr bool kDouble = sizeof(Real) == 8;

std::vector<Crossing> crossings(const Shape& shape, const Ray& ray) {
  std::array<Crossing, 16> found;
  const int n = shape.crossings(ray, found);
  return {found.begin(), found.begin() + n};
}

/// A torus of any number: the ring around y.
double torusSide(Vec3 p) {
  return std::hypot(std::hypot(double(p.x), double(p.z)) - 1.25, double(p.y)) - 0.5;
}

/// A sphere as the author of a plugin would write it, uv as the plugin `sphere` has them.
class Globe final : public DualShape<Globe> {
 public:
  Globe(Vec3 centre, Real radius) : c_(centre), r_(radius) {}

  template <class T>
  TVec3<T> point(const T& u, const T& v, int) const noexcept {
    using std::cos;
    using std::sin;
    const T a = T(2 * kPi) * u, b = T(kPi) * v, ring = T(r_) * sin(b);
    return {T(c_.x) + ring * cos(a), T(c_.y) - T(r_) * cos(b), T(c_.z) + ring * sin(a)};
  }
  Real side(int) const noexcept override { return -1; }
  bool isClosed() const noexcept override { return true; }
  Bounds bounds() const noexcept override {
    const Vec3 r{r_, r_, r_};
    return {c_ - r, c_ + r};
  }
  std::optional<ShapeHit> intersect(const Ray& ray) const noexcept override {
    const Vec3 o = ray.origin - c_;
    const double a = dot(ray.direction, ray.direction), b = dot(o, ray.direction);
    const double d = b * b - a * (double(dot(o, o)) - double(r_) * r_);
    if (d < 0) return std::nullopt;
    for (const double t : {(-b - std::sqrt(d)) / a, (-b + std::sqrt(d)) / a})
      if (t > ray.tMin && t < ray.tMax) {
        const Vec3 n = (o + Real(t) * ray.direction) / r_;
        const double turn = std::atan2(n.z, n.x) / (2 * kPi);
        return ShapeHit{
            Real(t),
            0,
            {Real(turn < 0 ? turn + 1 : turn), Real(std::atan2(std::hypot(n.x, n.z), -n.y) / kPi)}};
      }
    return std::nullopt;
  }

 private:
  Vec3 c_;
  Real r_;
};

void checkSame(Vec3 found, Vec3 expected, double tolerance) {
  CHECK(length(found - expected) <= tolerance * std::max(Real(1), length(expected)));
}

}  // namespace

TEST_CASE("crossings of closed shapes enter and leave in turn", "[shape][crossings]") {
  for (const Solid& solid : solids()) {
    INFO(solid.name);
    const auto shape = solid.make();
    Random random(17);
    int seen = 0, several = 0;
    for (int k = 0; k < 2000; ++k) {
      const bool isInside = k % 2 != 0;
      const Vec3 from = isInside ? random.inBox(1.5) : Real(2 * solid.reach) * random.direction();
      Ray ray{from, normalize(random.inBox(1.2) - from), 0, kInfinity};
      if (k % 3 == 0) ray.direction = Real(0.37) * ray.direction;
      if (std::abs(solid.side(from)) < 1e-3) continue;
      const std::vector<Crossing> all = crossings(*shape, ray);
      const auto first = shape->intersect(ray);
      REQUIRE(first.has_value() == !all.empty());
      if (all.empty()) continue;
      ++seen;
      several += all.size() > 2;
      CHECK(all[0].hit.t == first->t);
      CHECK(all[0].hit.part == first->part);
      bool isIn = solid.side(from) < 0;
      for (std::size_t i = 0; i < all.size(); ++i) {
        if (i > 0) CHECK(all[i].hit.t >= all[i - 1].hit.t);
        CHECK(std::abs(solid.side(ray.at(all[i].hit.t))) < (kDouble ? 1e-9 : 1e-4));
        if (solid.closed) CHECK(all[i].enters == !isIn);
        isIn = !isIn;
      }
      if (solid.closed) CHECK(!isIn);  // far away it is outside again
      // Between two crossings the witness agrees on the side.
      for (std::size_t i = 0; solid.closed && i + 1 < all.size(); ++i) {
        const Real middle = (all[i].hit.t + all[i + 1].hit.t) / 2;
        if (all[i + 1].hit.t - all[i].hit.t > Real(1e-3))
          CHECK((solid.side(ray.at(middle)) < 0) == all[i].enters);
      }
    }
    CHECK(seen > 100);
    if (solid.name == "torus") CHECK(several > 50);
  }
}

TEST_CASE("crossings by default are those of the shape's own", "[shape][crossings]") {
  for (const Solid& solid : solids()) {
    INFO(solid.name);
    const auto shape = solid.make();
    Random random(4);
    int wrong = 0, seen = 0;
    for (int k = 0; k < 500; ++k) {
      const Vec3 from = Real(2 * solid.reach) * random.direction();
      const Ray ray{from, normalize(random.inBox(1) - from), 0, kInfinity};
      const std::vector<Crossing> own = crossings(*shape, ray);
      std::array<Crossing, 16> found;
      const int n = shape->Shape::crossings(ray, found);
      seen += n;
      bool isSame = std::size_t(n) == own.size();
      for (int i = 0; isSame && i < n; ++i)
        isSame = found[std::size_t(i)].hit.t == own[std::size_t(i)].hit.t &&
                 found[std::size_t(i)].enters == own[std::size_t(i)].enters;
      wrong += !isSame;
    }
    CHECK(seen > 100);
    CHECK(wrong <= 1);  // a ray through an edge
  }
}

TEST_CASE("crossings keep to limits, to the span, and come in pairs where a ray touches",
          "[shape][crossings]") {
  const auto sphere = makeShape("sphere", {{"centre", vec(0, 0, 0)}, {"radius", number(1)}});
  const Ray ray{{0, 0, -3}, {0, 0, 1}, 0, kInfinity};
  std::array<Crossing, 4> found;
  CHECK(sphere->crossings(ray, found) == 2);
  CHECK((found[0].hit.t == 2 && found[0].enters));
  CHECK((found[1].hit.t == 4 && !found[1].enters));
  CHECK(sphere->crossings(ray, std::span(found).first(1)) == 1);
  CHECK(found[0].hit.t == 2);
  CHECK(sphere->crossings(ray, std::span(found).first(0)) == 0);
  Ray part = ray;
  part.tMin = 3;
  CHECK(sphere->crossings(part, found) == 1);
  CHECK((found[0].hit.t == 4 && !found[0].enters));
  part.tMax = Real(3.5);
  CHECK(sphere->crossings(part, found) == 0);
  // Exactly along the side: entered and left at one point, or not met.
  for (const Real x : {Real(1), -Real(1)}) {
    const int n = sphere->crossings({{x, 0, -3}, {0, 0, 1}, 0, kInfinity}, found);
    CHECK(n % 2 == 0);
  }
  const auto torus =
      makeShape("torus", {{"major_radius", number(1.25)}, {"minor_radius", number(0.5)}});
  CHECK(torus->crossings({{-3, Real(0.5), 0}, {1, 0, 0}, 0, kInfinity}, found) % 2 == 0);
  CHECK(torus->crossings({{-3, 0, Real(0.75)}, {1, 0, 0}, 0, kInfinity}, found) % 2 == 0);
  CHECK(torus->crossings({{-3, 0, 0}, {1, 0, 0}, 0, kInfinity}, found) == 4);
  CHECK(torusSide(Vec3{-3, 0, 0} + found[1].hit.t * Vec3{1, 0, 0}) == Approx(0).margin(1e-5));
  // Down the axis of a cone, and through its edge.
  const auto cone = makeShape("cone", {{"base", vec(0, 0, 0)},
                                       {"base_radius", number(1)},
                                       {"cap", vec(0, 2, 0)},
                                       {"cap_radius", number(0)}});
  CHECK(cone->crossings({{0, 5, 0}, {0, -1, 0}, 0, kInfinity}, found) == 2);
  CHECK(cone->crossings({{-3, 0, 0}, {1, 0, 0}, 0, kInfinity}, found) % 2 == 0);
}

TEST_CASE("a shape over dual numbers bends as the one written by hand", "[shape][derivatives]") {
  const auto hand = makeShape("sphere", {{"centre", vec(0.5, -0.25, 1)}, {"radius", number(1.5)}});
  const Globe dual({Real(0.5), Real(-0.25), 1}, Real(1.5));
  const double tolerance = kDouble ? 1e-12 : 2e-5;
  Random random(3);
  for (int k = 0; k < 200; ++k) {
    const Vec2 uv{Real(random.between(0, 0.999)), Real(random.between(0.02, 0.98))};
    const SurfacePoint a = dual.at(uv, 0), b = hand->at(uv, 0);
    checkSame(a.position, b.position, tolerance);
    checkSame(a.normal, b.normal, tolerance);
    checkSame(a.geometricNormal, b.geometricNormal, tolerance);
    checkSame(a.dPdu, b.dPdu, tolerance);
    checkSame(a.dPdv, b.dPdv, tolerance);
    checkSame(a.dNdu, b.dNdu, 20 * tolerance);  // near a pole the normal divides by sin(pi v)
    checkSame(a.dNdv, b.dNdv, 20 * tolerance);
    checkSame(a.dPduu, b.dPduu, tolerance);
    checkSame(a.dPduv, b.dPduv, tolerance);
    checkSame(a.dPdvv, b.dPdvv, tolerance);
  }
  for (int k = 0; k < 100; ++k) {
    const Vec3 from = Real(4) * random.direction();
    const Ray ray{from, normalize(random.inBox(1) - from), 0, kInfinity};
    const auto a = dual.intersect(ray), b = hand->intersect(ray);
    REQUIRE(a.has_value() == b.has_value());
    if (!a) continue;
    const SurfacePoint s = dual.surface(ray.at(a->t), *a), t = hand->surface(ray.at(b->t), *b);
    checkSame(s.position, t.position, 1e-4);
    checkSame(s.normal, t.normal, 1e-4);
  }
  // At the poles the tangents are finite and span the tangent plane.
  for (const Real v : {Real(0), Real(1)}) {
    const SurfacePoint s = dual.at({Real(0.3), v}, 0);
    CHECK(isFinite(s.normal));
    CHECK(length(cross(s.dPdu, s.dPdv)) > 0);
    CHECK(std::abs(s.normal.y) == Approx(1).epsilon(1e-4));
  }
}

TEST_CASE("second derivatives of a number agree with differences", "[dual]") {
  const auto f = [](const auto& u, const auto& v) {
    using std::cos;
    using std::exp;
    using std::log;
    using std::sin;
    using std::sqrt;
    return exp(u * v) * sin(u + v * v) / sqrt(u + v) + log(u) * cos(v) - pow(u, Real(1.7));
  };
  const double u = 0.8, v = 0.6, h = 1e-4;
  const Jet x = f(Jet(Real(u), 1, 0, 0, 0, 0), Jet(Real(v), 0, 1, 0, 0, 0));
  const auto at = [&](double a, double b) {
    return std::exp(a * b) * std::sin(a + b * b) / std::sqrt(a + b) + std::log(a) * std::cos(b) -
           std::pow(a, double(Real(1.7)));
  };
  CHECK(x.v == Approx(at(u, v)).epsilon(1e-5));
  CHECK(x.du == Approx((at(u + h, v) - at(u - h, v)) / (2 * h)).epsilon(1e-4));
  CHECK(x.dv == Approx((at(u, v + h) - at(u, v - h)) / (2 * h)).epsilon(1e-4));
  CHECK(x.duu == Approx((at(u + h, v) - 2 * at(u, v) + at(u - h, v)) / (h * h)).epsilon(1e-4));
  CHECK(x.dvv == Approx((at(u, v + h) - 2 * at(u, v) + at(u, v - h)) / (h * h)).epsilon(1e-4));
  CHECK(x.duv ==
        Approx((at(u + h, v + h) - at(u + h, v - h) - at(u - h, v + h) + at(u - h, v - h)) /
               (4 * h * h))
            .epsilon(1e-4));
}
