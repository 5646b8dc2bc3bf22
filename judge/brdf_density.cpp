// SPDX-License-Identifier: Apache-2.0
// sample() against evaluate().pdf.
#include "judge/brdf_tests.h"
#include "judge/statistics.h"

namespace vestige::judge {
namespace {

struct Goodness {
  double pValue;
  double missing;  ///< 1 - integral of pdf - P(nullopt or specular), in standard deviations
  double mass, drawn;
  double ratio;  ///< samples seen for each expected, where they differ most
};

/// Directions that sample() gives with a density, out of n calls.
std::vector<Vec3> densitySamples(const Brdf& brdf, const ScatterPoint& p, int n, Random& r) {
  std::vector<Vec3> list;
  for (int i = 0; i < n; ++i)
    if (const auto s = brdf.sample(p, numbers(r)); s && !s->specular && isFinite(s->toNext))
      list.push_back(s->toNext);
  return list;
}

/// Densities above this cannot be tested: neighbouring directions of type Real are too far apart
/// inside the lobe.
bool isTooNarrow(const Brdf& brdf, const ScatterPoint& p, Random& r) {
  for (int i = 0; i < 50; ++i)
    if (const auto s = brdf.sample(p, numbers(r)); s && !s->specular)
      if (std::sqrt(double(s->pdf)) * kEpsilon > 2e-3) return true;
  return false;
}

/// The effect of rounding toNext.z on evaluate().pdf near the normal, where a step of a float is
/// not small compared with the solid angle of a lobe, 1 / pdf.
double rounding(const Brdf& brdf, const ScatterPoint& p, const std::vector<Vec3>& samples) {
  const std::size_t n = std::min<std::size_t>(samples.size(), 100);
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) sum += double(brdf.pdf(p, samples[i])) * kEpsilon;
  return n > 0 ? std::min(sum / double(n) / 4, 0.01) : 0;
}

Goodness goodness(const Brdf& brdf, const ScatterPoint& p, const Effort& effort, Random& r) {
  const int n = effort.samples;
  const int pilots = std::max(n / 4, 1 << 13);  // fewer would miss narrow lobes beside wide ones
  const SpherePartition cells(densitySamples(brdf, p, pilots, r), effort.depth);
  std::vector<double> expected = cells.integrate([&](Vec3 d) { return brdf.pdf(p, d); });
  double sum = 0;
  for (double& e : expected) sum += e, e *= n;
  std::vector<double> seen(cells.cells(), 0);
  const std::vector<Vec3> samples = densitySamples(brdf, p, n, r);
  for (const Vec3 d : samples) ++seen[cells.cellOf(d)];
  const double drawn = double(samples.size()) / n;
  const double deviation =
      std::sqrt(std::max(drawn * (1 - drawn), 1e-12) / n) + 1e-3 + rounding(brdf, p, samples);
  return {chiSquareTest(expected, seen), (sum - drawn) / deviation, sum, drawn,
          worstRatio(expected, seen)};
}

}  // namespace

DensityFindings samplesFollowPdf(const BrdfCases& cases, const Effort& effort) {
  Random r(effort.seed + 1);
  DensityFindings f{{"samples are distributed as evaluate().pdf predicts", "evaluate().pdf"},
                    {"evaluate().pdf integrates to 1 - P(nullopt or specular)", "evaluate().pdf"}};
  const double level = sidakLevel(effort.falseAlarm, cases.size() * 6);
  for (const BrdfCase& c : cases)
    for (const Real height : {Real(1), Real(0.7), Real(0.25), Real(0.02)})
      for (const bool behind : {false, true}) {
        if (behind && !c.hasInside) continue;
        const ScatterPoint p = c.at(atHeight(height, r), behind);
        if (isTooNarrow(*c.brdf, p, r)) continue;
        const Goodness g = goodness(*c.brdf, p, effort, r);
        const double ratio = relative(g.mass, g.drawn) > 0.02 ? g.drawn / g.mass : g.ratio;
        f.distribution.worst.see(std::log(std::max(g.pValue, 1e-300)) / std::log(level), [&] {
          std::ostringstream text;
          text.precision(3);
          text << "sample() lands " << ratio
               << " times as often as evaluate().pdf predicts (p-value " << g.pValue << ")";
          return eventLine(c, p, {}, text.str());
        });
        f.mass.worst.see(std::abs(g.missing) / 5, [&] {
          return eventLine(c, p, {}, told("the integral of evaluate().pdf is", g.mass, g.drawn));
        });
      }
  return f;
}

Finding samplesKnowTheirPdf(const BrdfCases& cases, const Effort& effort) {
  Finding f{"a sample's pdf equals evaluate().pdf", "sample().pdf"};
  forEvents(
      cases, effort.events(),
      [&](const BrdfCase& c, const ScatterPoint& p, ScatterNumbers n, Random&) {
        const auto s = c.brdf->sample(p, n);
        if (!s || s->specular) return;
        const double pdf = double(c.brdf->pdf(p, s->toNext));
        const double allowed = pdfTolerance(c, p, s->toNext);
        f.worst.see(relative(double(s->pdf), pdf) / allowed, [&] {
          return eventLine(c, p, n,
                           told("sample().pdf is", double(s->pdf), pdf) + " as evaluate().pdf");
        });
      },
      effort.seed);
  return f;
}

Finding lobesArePartsOfPdf(const BrdfCases& cases, const Effort& effort) {
  Finding f{"lobePdf lobeChance is no more than pdf", "sample().lobePdf"};
  forEvents(
      cases, effort.events(),
      [&](const BrdfCase& c, const ScatterPoint& p, ScatterNumbers n, Random&) {
        const auto s = c.brdf->sample(p, n);
        if (!s || s->specular) return;
        const double part = double(s->lobePdf * s->lobeChance);
        f.worst.see((part / double(s->pdf) - 1) / pdfTolerance(c, p, s->toNext), [&] {
          return eventLine(c, p, n,
                           told("lobePdf lobeChance is", part, double(s->pdf)) + " at most");
        });
      },
      effort.seed);
  return f;
}

}  // namespace vestige::judge
