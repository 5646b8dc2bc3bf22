// SPDX-License-Identifier: Apache-2.0
// What a BRDF without derivatives of its own gets from the SDK: finite differences, held against
// the derivatives that the built-in plugins write by hand. Those are proved in
// brdf_derivatives_test.cpp, by other differences than these.
#include <vestige/dual_brdf.h>
#include <vestige/plugin.h>

#include "support/brdf_events.h"
#include "support/forwarding_brdf.h"

using namespace vestige;
using namespace vestige::test;

namespace {

constexpr double kTolerance = kDouble ? 1e-5 : 1e-2;

using Bare = Forwarding<Brdf>;

struct Half : Bare {
  using Bare::Forwarding;
  LogGradient logGradient(const ScatterPoint&, Vec3) const noexcept override { return {}; }
};

class Hidden : public Bare {
  using Bare::Forwarding;
  ScatterJacobian sampleDerivatives(const ScatterPoint&, ScatterNumbers) const noexcept override {
    return {};
  }
  LogGradient logGradient(const ScatterPoint&, Vec3) const noexcept override { return {}; }
};

struct ByDuals : DualBrdf<ByDuals> {
  template <class T>
  TVec3<T> direction(const ScatterPoint&, const TVec3<T>& toPrev, Real,
                     const TVec2<T>&) const noexcept {
    return toPrev;
  }
  template <class T>
  T logValue(const ScatterPoint&, const TVec3<T>&, const TVec3<T>&) const noexcept {
    return {};
  }
};

/// How many of the events seen are off by more than allowed, and the last of them.
struct Share {
  int seen = 0, off = 0;
  std::string event;
  template <class Describe>
  void see(double e, const Describe& describe) {
    ++seen;
    if (e <= 1) return;
    ++off, event = describe().line;
  }
  void check(double most) const {
    INFO(off << " of " << seen << " events, one is\n  " << event);
    CHECK(seen > 1000);
    CHECK(off <= most * seen);
  }
};

/// Relative to the size of what is expected, at least `size`, and to what rounding of values of
/// size 1 leaves of a difference.
double error(Vec3 found, Vec3 expected, double size = 1) {
  const double rounding = 8 * kEpsilon / double(differences::kStep);
  const double allowed = kTolerance * std::max(size, sizeOf(expected)) + rounding;
  const double e = sizeOf(found - expected) / allowed;
  return std::isnan(e) ? HUGE_VAL : e;
}

/// What of v is no turn about the lobe's axis: differences leave such a turn out, and a lobe that
/// is not built in a frame has one.
Vec3 withoutSpin(const Brdf& brdf, const ScatterPoint& p, ScatterNumbers n, Vec3 toNext, Vec3 v) {
  const auto frame = lobeFrame(brdf, p, n.lobe);
  if (!frame) return v;
  const Vec3 spin = normalize(cross(frame->n, toNext));
  return v - dot(spin, v) * spin;
}

/// A map with all that differences have to go round: it bends at u.x = 0.3, absorbs from u.x = 0.9
/// on, is another lobe from u.y = 0.6 on, stands still outside of the unit square, and takes note
/// of who asks below the horizon.
class Seams : public Brdf {
 public:
  mutable int askedBelow = 0;

  ScatterValue evaluate(const ScatterPoint& p, Vec3 toNext) const noexcept override {
    askedBelow += !(p.toPrev.z > 0);
    return {grey(p.toPrev.z * sqr(toNext.z)), 1};
  }
  std::optional<ScatterSample> sample(const ScatterPoint& p,
                                      ScatterNumbers n) const noexcept override {
    askedBelow += !(p.toPrev.z > 0);
    if (n.u.x >= Real(0.9) && n.u.x < 1) return std::nullopt;
    const Vec2 u = {std::clamp(n.u.x, Real(0), Real(1)), std::clamp(n.u.y, Real(0), Real(1))};
    auto s =
        ScatterSample::only(normalize(Vec3{bent(u.x, Real(0.3)), bent(u.y, Real(0.6)), 1}), {}, 1);
    s.lobe = u.y < Real(0.6) ? 0 : 1;
    return s;
  }
  /// By one of the two numbers, by hand; `side` -1: what it is left of a bend.
  static Vec3 slope(Vec2 u, int k, Real side = 1) {
    const Vec3 w = {bent(u.x, Real(0.3)), bent(u.y, Real(0.6)), 1}, n = normalize(w);
    const Real speed = (k == 0 ? u.x - Real(0.3) : u.y - Real(0.6)) + side * Real(1e-12);
    const Vec3 axis = k == 0 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    return (speed < 0 ? Real(1) : Real(3)) / length(w) * (axis - dot(n, axis) * n);
  }

 private:
  static Real bent(Real x, Real at) { return x < at ? x : at + 3 * (x - at); }
};

bool isBuiltInAFrame(const BrdfCase& c) { return c.plugin == "phong" || c.plugin == "lambert"; }

}  // namespace

TEST_CASE("differences of sample() are the derivatives by hand", "[brdf][differences]") {
  std::map<std::string, std::array<Share, 2>> plugins;
  forEvents(brdfCases(), 300, [&](const BrdfCase& c, auto& p, ScatterNumbers n, Random& r) {
    const auto s = c.brdf->sample(p, n);
    if (!s) return;
    const ScatterJacobian found = Bare(*c.brdf).sampleDerivatives(p, n);
    const ScatterJacobian expected = c.brdf->sampleDerivatives(p, n);
    auto& [byNumbers, byPrev] = plugins[c.plugin];
    const double size = std::max(sizeOf(expected.du.c[0]), sizeOf(expected.du.c[1]));
    for (const int k : {0, 1})
      byNumbers.see(error(found.du.c[k], expected.du.c[k], size), [&] {
        return eventLine(c, p, n, told("du", sizeOf(found.du.c[k]), sizeOf(expected.du.c[k])));
      });
    const Vec3 along = tangent(p.toPrev, 2 * double(kPi * r.number()));
    Vec3 a = found.dPrev * along, b = expected.dPrev * along;
    if (!isBuiltInAFrame(c) && !s->specular)
      a = withoutSpin(*c.brdf, p, n, s->toNext, a), b = withoutSpin(*c.brdf, p, n, s->toNext, b);
    byPrev.see(error(a, b), [&] {
      std::ostringstream text;
      text << "dPrev " << along << " gives " << a << ", expected " << b;
      return eventLine(c, p, n, text.str());
    });
  });
  for (const auto& [plugin, shares] : plugins) {
    INFO(plugin);
    shares[0].check(0.02);
    shares[1].check(0.02);
  }
}

TEST_CASE("differences go round seams, borders and other lobes", "[brdf][differences]") {
  const Seams brdf;
  const Real h = differences::kStep;
  const ScatterPoint p{{0, 0, 1}, false, {}};
  int tried = 0;
  for (const Real seam : {Real(0), Real(0.3), Real(0.6), Real(0.9), Real(1)})
    for (const Real steps : {-3.0, -1.0, -0.3, -0.02, 0.0, 0.02, 0.5, 2.0})
      for (const int k : {0, 1}) {
        const Real x = seam + steps * h;
        const Vec2 u = k == 0 ? Vec2{x, Real(0.45)} : Vec2{Real(0.15), x};
        if (!(x >= 0 && x < 1) || !brdf.sample(p, {0, u})) continue;
        const Vec3 found = brdf.sampleDerivatives(p, {0, u}).du.c[k], expected = Seams::slope(u, k);
        double e = error(found, expected);
        // In the bend itself, within one lobe, either side is right; the middle is not.
        if (k == 0) e = std::min(e, error(found, Seams::slope(u, k, -1)));
        std::ostringstream text;
        text << "u " << u.x << ", " << u.y << ", by number " << k << ": " << found << ", expected "
             << expected;
        INFO(text.str());
        CHECK(e <= 1);
        ++tried;
      }
  CHECK(tried > 50);
}

TEST_CASE("differences of a bend are the slope of one side", "[differences]") {
  const auto slope = [](Real at) {
    const auto bent = [&](Real x) -> std::optional<Real> { return x < at ? x : at + 3 * (x - at); };
    return double(differences::derivative(bent, *bent(0), differences::kStep));
  };
  const double middle = slope(0);
  CHECK(std::min(std::abs(middle - 1), std::abs(middle - 3)) < 1e-3);
  CHECK(slope(differences::kStep / 50) == Approx(1).epsilon(1e-3));
  CHECK(slope(-differences::kStep / 50) == Approx(3).epsilon(1e-3));
}

TEST_CASE("differences keep toPrev above the horizon", "[brdf][differences]") {
  const Seams brdf;
  Random r(32);
  for (const Real z : {Real(1e-20), Real(1e-6), Real(1e-3), Real(0.01), Real(0.5)}) {
    const ScatterPoint p{atHeight(z, r), false, {}};
    const ScatterJacobian j = brdf.sampleDerivatives(p, {0, {Real(0.2), Real(0.2)}});
    const Vec3 toNext = normalize(Vec3{1, 2, 2});
    const LogGradient g = brdf.logGradient(p, toNext);
    CHECK(error(j.dPrev * Frame::along(p.toPrev, {0, 0, 1}).s, {}) <= 1);
    CHECK(isFinite(g.dPrev));
    if (z < Real(1e-2)) continue;
    const Vec3 up = Frame::along(p.toPrev, {0, 0, 1}).s;  // log f = log z + log z'
    CHECK(error(g.dPrev, up.z / z * up, 10) <= 1);
    const Vec3 across = Frame::along(toNext, {0, 0, 1}).s;
    CHECK(error(g.dNext, across.z / toNext.z * across, 10) <= 1);
  }
  CHECK(brdf.askedBelow == 0);
}

TEST_CASE("differences of log f are the gradients by hand", "[brdf][differences]") {
  std::map<std::string, Share> plugins;
  forEvents(brdfCases(), 300, [&](const BrdfCase& c, auto& p, ScatterNumbers n, Random& r) {
    Vec3 toNext = anywhere(r);
    if (r.number() < Real(0.5))
      if (const auto s = c.brdf->sample(p, n)) toNext = s->toNext;
    const LogGradient found = Bare(*c.brdf).logGradient(p, toNext);
    if (!(luminance(c.brdf->f(p, toNext)) > Real(1e-30))) return;
    const LogGradient expected = c.brdf->logGradient(p, toNext);
    const auto see = [&](Vec3 unit, Vec3 a, Vec3 b) {
      b -= dot(unit, b) * unit;  // by hand, a gradient may have a part that no tangent sees
      const double scale = std::max(1 / double(std::abs(unit.z)), 10.0);
      plugins[c.plugin].see(error(a, b, scale), [&] {
        std::ostringstream text;
        text << "slope " << a << ", expected " << b << ", toNext " << toNext;
        return eventLine(c, p, n, text.str());
      });
    };
    see(p.toPrev, found.dPrev, expected.dPrev);
    see(toNext, found.dNext, expected.dNext);
  });
  for (const auto& [plugin, share] : plugins) {
    INFO(plugin);
    if (plugin == "mirror" || plugin == "glass") continue;  // f is zero
    share.check(kDouble ? 0.03 : 0.06);  // a float has lobes that it can hardly tell from a mirror
  }
}

TEST_CASE("differences are finite at the ends of everything", "[brdf][differences][fuzz]") {
  Random r(31);
  const Real ends[] = {0, Real(0.5), Real(1e-7), Real(0.25), kOneMinusEpsilon};
  for (const BrdfCase& c : brdfCases(2)) {
    int broken = 0;
    for (int i = 0; i < 150; ++i) {
      const Real z = i % 5 == 0 ? 1 : std::pow(Real(10), Real(-30) * sqr(r.number()));
      const ScatterPoint p = c.at(i % 10 == 0 ? Vec3{0, 0, 1} : atHeight(z, r), i % 2 == 1);
      const ScatterNumbers n = {r.number(), {ends[i % 5], ends[i / 5 % 5]}};
      const ScatterJacobian j = Bare(*c.brdf).sampleDerivatives(p, n);
      for (const Vec3 v : {j.du.c[0], j.du.c[1], j.dPrev.c[0], j.dPrev.c[1], j.dPrev.c[2]})
        broken += !isFinite(v);
      const auto s = c.brdf->sample(p, n);
      if (s && s->specular) broken += !(j.du.c[0] == Vec3{} && j.du.c[1] == Vec3{});
      if (!s) broken += !(j.du.c[0] == Vec3{} && j.dPrev.c[0] == Vec3{});
      const LogGradient g = Bare(*c.brdf).logGradient(p, s ? s->toNext : anywhere(r));
      broken += !isFinite(g.dPrev) || !isFinite(g.dNext);
    }
    INFO(c.title());
    CHECK(broken == 0);
  }
}

TEST_CASE("a plugin tells which derivatives it leaves to differences", "[brdf][differences]") {
  CHECK(detail::lacks<Brdf, Bare>() == (kLacksSampleDerivatives | kLacksLogGradient));
  CHECK(detail::lacks<Brdf, Half>() == kLacksSampleDerivatives);
  CHECK(detail::lacks<Brdf, Hidden>() == 0);
  CHECK(detail::lacks<Brdf, ByDuals>() == 0);
  for (const LoadedPlugin& plugin : allPlugins()) {
    INFO(plugin.file);
    CHECK(plugin.entry->lacks == 0);  // all that we ship have theirs by hand
  }
}
