// SPDX-License-Identifier: Apache-2.0
// All tests of a BRDF, and the method at fault: the one that several tests contradict.
#include "judge/judge.h"

namespace vestige::judge {
namespace {

/// The findings of all tests, so that one can be judged by another.
struct BrdfFindings {
  DensityFindings density;
  Finding ownPdf, lobePart, weight, energy, diffuse, oneSide, across, snell;
  Finding area, du, dPrev, logGradient, fuzz, threads;
};

BrdfFindings findings(const BrdfCases& cases, const Schema* schema, const Effort& e) {
  return {.density = samplesFollowPdf(cases, e),
          .ownPdf = samplesKnowTheirPdf(cases, e),
          .lobePart = lobesArePartsOfPdf(cases, e),
          .weight = weightIsTheQuotient(cases, e),
          .energy = noEnergyIsGained(cases, e),
          .diffuse = diffusePartIsNoMoreThanThereIs(cases, e),
          .oneSide = isReciprocal(cases, e, false),
          .across = isReciprocal(cases, e, true),
          .snell = etaScaleFollowsSnell(cases, e),
          .area = areaIsInverseDensity(cases, e),
          .du = duIsTheDerivative(cases, e),
          .dPrev = dPrevIsTheDerivative(cases, e),
          .logGradient = logGradientIsTheDerivative(cases, e),
          .fuzz = nothingIsNan(cases, schema, 4 * e.samples, e.seed),
          .threads = answersStayTheSame(cases, e)};
}

/// Which of the three statements about the sampling map is wrong, or "": see brdf_tests.h.
std::string culpritOfMap(const BrdfFindings& f) {
  const bool density = f.density.distribution.passed() && f.density.mass.passed();
  if (density) return "";
  if (!f.ownPdf.passed()) return "evaluate().pdf";  // the sample's own pdf disagrees as well
  if (!f.du.passed())
    return "sample()";  // neither evaluate().pdf nor the derivative belongs to this map
  return "evaluate().pdf";
}

/// The lobe's density or the derivative: the differences decide.
std::string culpritOfArea(const BrdfFindings& f) {
  if (!f.du.passed()) return f.du.method;
  const bool density = f.density.distribution.passed() && f.density.mass.passed();
  if (!density && f.ownPdf.passed())
    return "evaluate().pdf";  // both densities of the sample agree with it
  return "sample().lobePdf";
}

std::string culpritOfWeight(const BrdfFindings& f, const std::string& map) {
  if (!map.empty()) return map;
  if (!f.ownPdf.passed()) return f.ownPdf.method;
  return f.oneSide.passed() ? "sample().weight" : "evaluate().fCos";
}

}  // namespace

Judgement judgeBrdf(const BrdfCases& cases, const Schema* schema, const Effort& effort) {
  const BrdfFindings f = findings(cases, schema, effort);
  const std::string map = culpritOfMap(f);
  const std::string weight = culpritOfWeight(f, map);
  // Non-deterministic or NaN results make other tests fail too: they are reported first.
  Judgement j;
  j.verdicts = {verdictOf(f.threads),
                verdictOf(f.fuzz),
                verdictOf(f.density.distribution, map),
                verdictOf(f.density.mass, map),
                verdictOf(f.ownPdf, map),
                verdictOf(f.area, f.area.passed() ? "" : culpritOfArea(f)),
                verdictOf(f.du, map == "sample()" ? map : ""),
                verdictOf(f.dPrev),
                verdictOf(f.lobePart, map),
                verdictOf(f.weight, f.weight.passed() ? "" : weight),
                verdictOf(f.energy, f.weight.passed() ? "" : weight),
                verdictOf(f.oneSide),
                verdictOf(f.across),
                verdictOf(f.snell),
                verdictOf(f.diffuse),
                verdictOf(f.logGradient)};
  j.timings = timings(cases);
  return j;
}

}  // namespace vestige::judge
