// SPDX-License-Identifier: Apache-2.0
// Tests of a BRDF's derivatives: of its sampled direction by the random numbers and by toPrev, and
// of log f. By the area identity and five-point differences.
#include <array>
#include <map>

#include "judge/brdf_tests.h"

namespace vestige::judge {
namespace {

constexpr double kMapStep = kDouble ? 1e-3 : 1e-2;
constexpr double kMapTolerance = kDouble ? 1e-6 : 4e-3;

/// Near total reflection derivatives have no bound, and plugins clamp them (kMinRefractedCosine):
/// the only place where they may differ from finite differences.
constexpr double kCut = 3e3;

/// toNext of one lobe, as a map from anything that moves an event a little.
std::optional<Vec3> within(const BrdfCase& c, const ScatterPoint& p, ScatterNumbers n, int lobe) {
  const auto s = c.brdf->sample(p, n);
  return s && s->lobe == lobe ? std::optional(s->toNext) : std::nullopt;
}

std::string toldVectors(const char* what, auto along, Vec3 found, Vec3 expected) {
  std::ostringstream text;
  text.precision(9);
  text << what << " along " << along << " gives " << found << ", expected " << expected;
  return text.str();
}

}  // namespace

Finding areaIsInverseDensity(const BrdfCases& cases, const Effort& effort) {
  Finding f{"|du.c0 x du.c1| lobePdf = 1", "sampleDerivatives().du"};
  const auto judge = [&](const BrdfCase& c, const ScatterPoint& p, ScatterNumbers n, Random&) {
    const auto s = c.brdf->sample(p, n);
    if (!s) return;
    const Mat3x2 du = c.brdf->sampleDerivatives(p, n).du;
    const double area = double(length(cross(du.c[0], du.c[1])) * s->lobePdf);
    if (s->specular) {
      f.worst.see(area > 0 ? 2 : 0,
                  [&] { return eventLine(c, p, n, "specular, but du is not 0"); });
      return;
    }
    // Columns that are almost parallel cancel in their product.
    const double stretch = double(length(du.c[0]) * length(du.c[1]) * s->lobePdf);
    const double allowed = (kDouble ? 1e-9 : 1e-3) + 20 * kEpsilon * stretch;
    f.worst.see(std::abs(area - 1) / allowed,
                [&] { return eventLine(c, p, n, told("|du0 x du1| lobePdf is", area, 1)); });
  };
  forEvents(cases, effort.events(), judge, effort.seed);
  return f;
}

Finding duIsTheDerivative(const BrdfCases& cases, const Effort& effort) {
  Finding f{"du is the derivative of sample() by its random numbers", "sampleDerivatives().du"};
  const auto judge = [&](const BrdfCase& c, const ScatterPoint& p, ScatterNumbers n, Random& r) {
    const auto s = c.brdf->sample(p, n);
    if (!s || s->specular || !differsSmoothly(n.u, Real(0.03))) return;
    const Mat3x2 du = c.brdf->sampleDerivatives(p, n).du;
    // The longer column is at least this long: |du.c0 x du.c1| lobePdf = 1.
    const double least = 1 / std::sqrt(double(s->lobePdf));
    const double size = std::max({sizeOf(du.c[0]), sizeOf(du.c[1]), least});
    if (c.hasInside && size > kCut) return;
    const double angle = 2 * double(kPi * r.number());
    const Vec2 along = {Real(std::cos(angle)), Real(std::sin(angle))};
    const auto map = [&](double h) {
      return within(c, p, {n.lobe, n.u + Real(h) * along}, s->lobe);
    };
    ++f.asked;
    const auto expected = trustedDifference(map, kMapStep, kMapTolerance * size);
    if (!expected) return;
    ++f.judged;
    f.worst.see(sizeOf(du * along - *expected) / (kMapTolerance * size), [&] {
      return eventLine(c, p, n, toldVectors("du", along, du * along, *expected));
    });
  };
  forEvents(cases, effort.events(), judge, effort.seed);
  return f;
}

Finding dPrevIsTheDerivative(const BrdfCases& cases, const Effort& effort) {
  Finding f{"dPrev is the derivative of sample() by toPrev", "sampleDerivatives().dPrev"};
  // The frame around a lobe's axis may spin arbitrarily, but the derivative is defined without
  // spin, so the spin is removed from the differences. Lobes without such a frame have no spin. A
  // lobe must be of the same type at every event.
  std::map<std::string, std::array<WorstEvent, 2>> lobes;
  const auto judge = [&](const BrdfCase& c, const ScatterPoint& p, ScatterNumbers n, Random& r) {
    const auto s = c.brdf->sample(p, n);
    if (!s || p.toPrev.z < Real(0.05)) return;
    const ScatterJacobian j = c.brdf->sampleDerivatives(p, n);
    const Vec3 along = tangent(p.toPrev, 2 * double(kPi * r.number()));
    const auto moved = [&](double h) { return c.at(turned(p.toPrev, along, h), p.behind); };
    const auto asIs = [&](double h) { return within(c, moved(h), n, s->lobe); };
    const auto frame = lobeFrame(*c.brdf, p, n.lobe);
    const auto unspun = [&](double h) -> std::optional<Vec3> {
      const auto toNext = asIs(h);
      const auto there = lobeFrame(*c.brdf, moved(h), n.lobe);
      if (!toNext || !there || !frame) return std::nullopt;
      const Vec3 local = there->toLocal(*toNext);
      return transport(frame->n, there->n, frame->toWorld(local));
    };
    const Vec3 found = j.dPrev * along;
    if (c.hasInside && sizeOf(found) > kCut) return;
    const double step = kMapStep * double(p.toPrev.z);
    const double allowed = kMapTolerance * std::max(1.0, sizeOf(found));
    auto& [direct, transported] = lobes[c.plugin + " lobe " + std::to_string(s->lobe)];
    const auto see = [&](WorstEvent& worst, const std::optional<Vec3>& expected) {
      if (!expected) return;
      worst.see(sizeOf(found - *expected) / allowed, [&] {
        return eventLine(c, p, n, toldVectors("dPrev", along, found, expected.value()));
      });
    };
    ++f.asked;
    const auto plain = trustedDifference(asIs, step, allowed);
    f.judged += plain.has_value();
    see(direct, plain);
    if (frame && !s->specular) see(transported, trustedDifference(unspun, step, allowed));
  };
  forEvents(cases, effort.events(), judge, effort.seed);

  for (const auto& [lobe, worst] : lobes) {
    const bool spins = worst[1].events > 0 && worst[1].error < worst[0].error;
    const WorstEvent& chosen = worst[spins ? 1 : 0];
    const int events = f.worst.events + chosen.events;
    f.worst.see(chosen.error, [&] { return chosen.event; });
    f.worst.events = events;
  }
  return f;
}

Finding logGradientIsTheDerivative(const BrdfCases& cases, const Effort& effort) {
  Finding f{"logGradient() is the derivative of log f", "logGradient()"};
  const auto judge = [&](const BrdfCase& c, const ScatterPoint& p, ScatterNumbers n, Random& r) {
    Vec3 toNext = anywhere(r);  // as a light would choose it, or drawn by the BRDF
    if (r.number() < Real(0.5))
      if (const auto s = c.brdf->sample(p, n)) toNext = s->toNext;
    const LogGradient g = c.brdf->logGradient(p, toNext);
    if (!(luminance(c.brdf->f(p, toNext)) > 0)) {
      const double size = sizeOf(g.dPrev) + sizeOf(g.dNext);
      f.worst.see(size > 0 ? 2 : 0,
                  [&] { return eventLine(c, p, n, "f is zero, but logGradient() is not"); });
      return;
    }
    const double sharp = std::sqrt(double(c.brdf->pdf(p, toNext)));
    for (const bool next : {false, true}) {
      const Vec3 from = next ? toNext : p.toPrev;
      const Vec3 along = tangent(from, 2 * double(kPi * r.number()));
      const auto logF = [&](double h) -> std::optional<Real> {
        const Vec3 d = turned(from, along, h);
        const ScatterPoint q = next ? p : c.at(d, p.behind);
        if (q.toPrev.z <= 0) return std::nullopt;
        const Real f = luminance(c.brdf->f(q, next ? d : toNext));
        return f > Real(1e-25) ? std::optional(std::log(f)) : std::nullopt;
      };
      const double found = double(dot(next ? g.dNext : g.dPrev, along));
      if (c.hasInside && std::abs(found) > kCut) continue;
      // A step is a fraction of the lobe's width, or of the height above the horizon.
      const double width = 1 / (1 + sharp + std::abs(found) + 1 / sizeOf(from.z));
      const double step = (kDouble ? 1e-2 : 0.1) * width;
      const double allowed = kMapTolerance / width;
      const auto value = [&](const ScatterPoint& q, Vec3 d) { return luminance(c.brdf->f(q, d)); };
      const double noise = 2 + wobble(p, toNext, value) / kEpsilon;
      ++f.asked;
      const auto expected = trustedDifference(logF, step, allowed, noise);
      if (!expected) continue;
      ++f.judged;
      f.worst.see(std::abs(found - double(*expected)) / allowed, [&] {
        std::ostringstream text;
        text << told(next ? "the slope of log f by toNext is" : "the slope of log f by toPrev is",
                     found, double(*expected))
             << ", toNext " << toNext;
        return eventLine(c, p, n, text.str());
      });
    }
  };
  forEvents(cases, effort.events(), judge, effort.seed);
  return f;
}

}  // namespace vestige::judge
