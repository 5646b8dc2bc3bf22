// SPDX-License-Identifier: Apache-2.0
// The gradient of the score F/p, which the SDK takes from gradients of f and differences of
// evaluate().pdf, held against another route: at an event F/p is the weight that sample() returns.
#include <vestige/footprint/score.h>

#include "support/brdf_events.h"

using namespace vestige;
using namespace vestige::test;

namespace {

/// The SDK's answers, in a shading frame that is the world's.
struct Gradients {
  EventGradient score, contribution;

  Gradients(const BrdfCase& c, const ScatterPoint& p, Vec3 toNext) {
    const Frame world{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const SurfaceMotion flat{};
    const FrameMotion still(SurfacePoint{}, flat, world);
    const ScatterEvent event{world, toNext, flat, still};
    score = scoreGradient(event, *c.brdf, p, toNext);
    contribution = contributionGradient(event, c.brdf->logGradient(p, toNext));
  }
};

}  // namespace

TEST_CASE("the score changes as the weight of samples does", "[conformance][footprint]") {
  int judged = 0, off = 0;
  std::string event;
  forEvents(
      brdfCases(), 400, [&](const BrdfCase& c, const ScatterPoint& p, ScatterNumbers n, auto&) {
        const auto s = c.brdf->sample(p, n);
        if (!s || s->specular) return;
        const Gradients g(c, p, s->toNext);
        const ScatterJacobian j = c.brdf->sampleDerivatives(p, n);
        const auto logWeight = [&](Vec3 toPrev, Vec2 u) -> std::optional<Real> {
          if (!(u.x >= 0 && u.x < 1 && u.y >= 0 && u.y < 1 && toPrev.z > 0)) return std::nullopt;
          const auto t = c.brdf->sample(differences::facing(p, toPrev), {n.lobe, u});
          if (!t || t->lobe != s->lobe) return std::nullopt;
          return std::log(luminance(t->weight));
        };
        // What is left of F's change by p's is as exact as those two are.
        const auto see = [&](Vec3 dPrev, Vec3 dNext, const auto& map, const char* what) {
          const double found = double(dot(g.score.byPrev, dPrev) + dot(g.score.byNext, dNext));
          const double whole = std::abs(double(dot(g.contribution.byPrev, dPrev))) +
                               std::abs(double(dot(g.contribution.byNext, dNext)));
          const double tolerance =
              (kDouble ? 1e-4 : 0.03) * std::max({1.0, std::abs(found), whole});
          const auto expected = trustedDifference(map, kDouble ? 1e-3 : 1e-2, tolerance, 2);
          if (!expected) return;
          ++judged;
          if (std::abs(found - double(*expected)) <= tolerance) return;
          ++off, event = eventLine(c, p, n, told(what, found, double(*expected))).line;
        };
        for (const int k : {0, 1})
          see(
              {}, j.du.c[k],
              [&](double h) {
                const Real x = Real(h);
                return logWeight(p.toPrev, k ? Vec2{n.u.x, n.u.y + x} : Vec2{n.u.x + x, n.u.y});
              },
              "by u");
        if (c.plugin == "phong") return;  // its lobe's frame spins with toPrev, which only shifts u
        const Frame f = Frame::around(p.toPrev);
        for (const Vec3 t : {f.s, f.t})
          see(
              t, j.dPrev * t, [&](double h) { return logWeight(turned(p.toPrev, t, h), n.u); },
              "by toPrev");
      });
  INFO(off << " of " << judged << " are off, one is\n  " << event);
  CHECK(judged > 10000);
  CHECK(off <= 0.03 * judged);
}

TEST_CASE("perfect importance sampling leaves no gradient", "[conformance][footprint]") {
  int seen = 0;
  forEvents(
      brdfCases(), 50, [&](const BrdfCase& c, const ScatterPoint& p, ScatterNumbers n, auto&) {
        if (c.plugin != "lambert") return;
        const auto s = c.brdf->sample(p, n);
        if (s->toNext.z < Real(0.1)) return;
        const EventGradient g = Gradients(c, p, s->toNext).score;
        CHECK(length(g.byNext - dot(g.byNext, s->toNext) * s->toNext) < Real(0.01) / s->toNext.z);
        CHECK(length(g.byPrev) < Real(1e-3));
        ++seen;
      });
  CHECK(seen > 0);
}
