// SPDX-License-Identifier: Apache-2.0
// Dual numbers against differences, and a BRDF that has its derivatives from them against the same
// BRDF's derivatives by hand.
#include <vestige/dual_brdf.h>
#include <vestige/sampler.h>

#include "support/catch.h"

using namespace vestige;

namespace {

constexpr double kTight = sizeof(Real) == 8 ? 1e-12 : 2e-4;

Vec3 mirror(Vec3 d) { return {-d.x, -d.y, d.z}; }

/// f = cos^7 about the mirror direction, sampled by the cosine around it: enough to try every part
/// of the base class.
class Glossy final : public DualBrdf<Glossy> {
 public:
  static constexpr Real kExponent = 7;

  template <class T>
  TVec3<T> direction(const ScatterPoint&, const TVec3<T>& toPrev, Real,
                     const TVec2<T>& u) const noexcept {
    using std::sqrt;
    const TVec2<T> d = concentricDisk(u);
    const TVec3<T> axis{-toPrev.x, -toPrev.y, toPrev.z};
    return inFrameAround(axis, {d.x, d.y, sqrt(T(1) - d.x * d.x - d.y * d.y)});
  }
  template <class T>
  T logValue(const ScatterPoint&, const TVec3<T>& toPrev, const TVec3<T>& toNext) const noexcept {
    using std::log;
    return T(kExponent) * log(toNext.z * toPrev.z - toNext.x * toPrev.x - toNext.y * toPrev.y);
  }

  ScatterValue evaluate(const ScatterPoint& p, Vec3 toNext) const noexcept override {
    const Real f = std::pow(std::max(dot(mirror(p.toPrev), toNext), Real(0)), kExponent);
    return {grey(std::abs(toNext.z) * f), 0};
  }
  std::optional<ScatterSample> sample(const ScatterPoint&, ScatterNumbers) const noexcept override {
    return std::nullopt;
  }
};

}  // namespace

TEST_CASE("dual arithmetic has the derivatives of calculus", "[dual]") {
  const double h = sizeof(Real) == 8 ? 1e-4 : 1e-2;
  const auto check = [&](auto f, double x) {
    const double a = double(f(Dual::variable(Real(x), 2)).d[2]);
    const auto at = [&](double y) { return double(f(Dual(Real(y))).v); };
    const double d = (8 * (at(x + h) - at(x - h)) - (at(x + 2 * h) - at(x - 2 * h))) / (12 * h);
    CHECK(a == Approx(d).epsilon(sizeof(Real) == 8 ? 1e-9 : 2e-3).margin(1e-4));
  };
  for (const double x : {0.3, 0.9, 2.5}) {
    check([](Dual a) { return a * a + Dual(3) * a - a / (a + Dual(1)); }, x);
    check([](Dual a) { return sqrt(a) * exp(-a); }, x);
    check([](Dual a) { return log(a) * sin(a) - cos(a); }, x);
    check([](Dual a) { return expm1(a) * log1p(a); }, x);
    check([](Dual a) { return pow(a, Real(2.5)); }, x);
    check([](Dual a) { return abs(a - Dual(1)) + max(a, Dual(1)) + min(a, Dual(2)); }, x);
  }
  CHECK(sqrt(Dual::variable(0, 0)).d[0] == 0);  // none is better than an infinite one
  CHECK(std::isfinite(pow(Dual::variable(0, 0), Real(0.5)).d[0]));
}

TEST_CASE("derivatives by dual numbers equal those by hand", "[dual]") {
  const Glossy brdf;
  for (std::uint32_t i = 0; i < 500; ++i) {
    const Sampler s(3, 4, i, 5);
    ScatterPoint p{};
    p.toPrev = cosineHemisphere(s.pair(0)).d;
    const ScatterNumbers n{0, s.pair(2)};
    const Direction local = cosineHemisphere(n.u);
    if (local.d.z < Real(0.05)) continue;  // the hand-written map clamps the horizon's slope
    const Vec3 axis = mirror(p.toPrev), toNext = Frame::around(axis).toWorld(local.d);
    const ScatterJacobian j = brdf.sampleDerivatives(p, n);
    // d(toNext) = (axis x d(axis)) x toNext for a tangent of toPrev; columns by the sampling map.
    const Mat3 turn = (dot(axis, toNext) * identity() - outer(axis, toNext)) * diagonal(-1, -1, 1);
    const Frame f = Frame::around(p.toPrev);
    for (const Vec3 tangent : {f.s, f.t})
      CHECK(length(j.dPrev * tangent - turn * tangent) < kTight);
    for (const int k : {0, 1}) {
      const Vec3 hand = Frame::around(axis).toWorld(local.du.c[k]);
      CHECK(length(j.du.c[k] - hand) < kTight * std::max(Real(1), length(hand)));
    }
    if (isBlack(brdf.f(p, toNext))) continue;
    const LogGradient g = brdf.logGradient(p, toNext);
    const Real slope = Glossy::kExponent / dot(axis, toNext);
    const Vec3 prev = projection(p.toPrev) * (slope * mirror(toNext));
    const Vec3 next = projection(toNext) * (slope * axis);
    CHECK(length(g.dPrev - prev) < kTight * std::max(Real(1), length(prev)));
    CHECK(length(g.dNext - next) < kTight * std::max(Real(1), length(next)));
  }
}
