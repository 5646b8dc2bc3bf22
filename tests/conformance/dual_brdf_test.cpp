// SPDX-License-Identifier: Apache-2.0
// Derivatives by hand against derivatives by dual numbers: two ways to write the same derivative
// must agree to rounding, where finite differences can only say "about".
#include "support/brdf_duals.h"
#include "support/brdf_events.h"

using namespace vestige;
using namespace vestige::test;

namespace {

/// Relative.
constexpr double kTolerance = kDouble ? 1e-12 : 2e-4;
constexpr int kEvents = 10000;

std::vector<BrdfCase> casesOf(const std::string& plugin) {
  std::vector<BrdfCase> cases;
  for (BrdfCase& c : brdfCases(12))
    if (c.plugin == plugin) cases.push_back(std::move(c));
  return cases;
}

/// Every third near the horizon.
template <class F>
void forSteepAndGrazing(const std::vector<BrdfCase>& cases, const F& f) {
  Random r(41);
  for (int i = 0; i < kEvents; ++i) {
    const BrdfCase& c = cases[std::size_t(i) % cases.size()];
    const Real z = i % 3 == 0 ? std::pow(Real(10), r.number(-4, -1)) : r.number(Real(0.1), 1);
    f(c, c.at(atHeight(z, r), r.number() < Real(0.5)), numbers(r), r);
  }
}

/// Error over what is allowed, which is relative to `size`.
double error(Vec3 found, Vec3 expected, double size, double tolerance) {
  const double e = sizeOf(found - expected) / (tolerance * size);
  return std::isnan(e) ? HUGE_VAL : e;
}

struct Agreement {
  WorstEvent direction, du, dPrev, value, gradient;
};

/// `skip`: whether a documented limit of the hand-written derivative applies.
template <class Twin, class Skip>
Agreement agreement(const std::string& plugin, const Skip& skip) {
  Agreement a;
  forSteepAndGrazing(casesOf(plugin), [&](const BrdfCase& c, const ScatterPoint& p,
                                          ScatterNumbers n, Random& r) {
    const Twin twin(*c.brdf);
    const double allowed = kTolerance + 8 * kEpsilon * Twin::condition(p);
    const auto line = [&](const char* what, Vec3 found, Vec3 expected) {
      return [=, &c] {
        std::ostringstream text;
        text << what << " " << found << ", by duals " << expected;
        return eventLine(c, p, n, text.str());
      };
    };
    const auto s = c.brdf->sample(p, n);
    Vec3 toNext = anywhere(r);
    if (s && !skip(p, n)) {
      if (r.number() < Real(0.5)) toNext = s->toNext;
      const Vec3 d = value(twin.direction(p, lifted(p.toPrev), n.lobe, TVec2<Real>{n.u.x, n.u.y}));
      a.direction.see(error(s->toNext, d, 1, allowed), line("toNext", s->toNext, d));
      const ScatterJacobian hand = c.brdf->sampleDerivatives(p, n);
      const ScatterJacobian dual = twin.sampleDerivatives(p, n);
      const double size = std::max(sizeOf(dual.du.c[0]), sizeOf(dual.du.c[1]));
      for (const int k : {0, 1})
        a.du.see(error(hand.du.c[k], dual.du.c[k], size, allowed),
                 line("du", hand.du.c[k], dual.du.c[k]));
      const Vec3 along = tangent(p.toPrev, 2 * double(kPi * r.number()));
      const Vec3 x = hand.dPrev * along, y = dual.dPrev * along;
      a.dPrev.see(error(x, y, std::max(1.0, sizeOf(y)), allowed), line("dPrev", x, y));
    }
    const double f = luminance(c.brdf->f(p, toNext));
    if (!(f > 1e-25) || skip(p, n)) return;
    const double l = double(twin.logValue(p, lifted(p.toPrev), lifted(toNext)));
    const LogGradient hand = c.brdf->logGradient(p, toNext), dual = twin.logGradient(p, toNext);
    // A rounded lobe axis moves log f by its slope.
    const double rounding = 8 * kEpsilon * Twin::condition(p) * sizeOf(hand.dNext);
    a.value.see(std::abs(std::log(f) - l) / (allowed * std::max(1.0, std::abs(l)) + rounding),
                [&] { return eventLine(c, p, n, told("log f", std::log(f), l)); });
    const auto see = [&](Vec3 unit, Vec3 x, Vec3 y) {
      const Vec3 across = x - dot(unit, x) * unit;  // no tangent sees the rest
      a.gradient.see(error(across, y, std::max(1.0, sizeOf(x)), allowed), line("slope", across, y));
    };
    see(p.toPrev, hand.dPrev, dual.dPrev);
    see(toNext, hand.dNext, dual.dNext);
  });
  return a;
}

void check(const Agreement& a) {
  for (const WorstEvent* w : {&a.direction, &a.du, &a.dPrev, &a.value, &a.gradient}) {
    CHECK(w->events > 1000);
    test::check(*w);
  }
}

Real diskRadius(Vec2 u) { return std::max(std::abs(2 * u.x - 1), std::abs(2 * u.y - 1)); }

}  // namespace

TEST_CASE("lambert by hand is lambert by duals", "[brdf][dual]") {
  check(agreement<DualLambert>("lambert", [](const ScatterPoint&, ScatterNumbers n) {
    return diskRadius(n.u) > Real(0.9999);  // the horizon's slope is cut
  }));
}

TEST_CASE("phong by hand is phong by duals, both lobes", "[brdf][dual]") {
  check(agreement<DualPhong>("phong", [](const ScatterPoint& p, ScatterNumbers n) {
    const Real t = DualPhong::refracted(p), r = diskRadius(n.u);
    // Series in the middle of the lobe; a cut near total reflection and at the rim.
    return r < Real(1e-2) || r > Real(0.9999) || (t >= 0 && t < 10 * kMinRefractedCosine);
  }));
}

TEST_CASE("rough_conductor by hand is rough_conductor by duals", "[brdf][dual]") {
  check(agreement<DualConductor>("rough_conductor", [](const ScatterPoint&, ScatterNumbers n) {
    return diskRadius(n.u) > Real(0.9999);
  }));
}
