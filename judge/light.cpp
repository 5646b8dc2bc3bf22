// SPDX-License-Identifier: Apache-2.0
// All tests of a light, and the method at fault.
#include "judge/judge.h"

namespace vestige::judge {
namespace {

/// The method at fault if two densities agree with each other but not with the map, or disagree.
std::string culpritOfDensity(const LightDensityFindings& d, const Finding& du) {
  if (d.distribution.passed() && d.mass.passed()) return "";
  return d.ownPdf.passed() && !du.passed() ? "sample()" : "pdf()";
}

}  // namespace

Judgement judgeLight(const LightCases& cases, const Effort& e) {
  const LightDensityFindings density = lightSamplesFollowPdf(cases, e);
  const Finding area = lightAreaIsInverseDensity(cases, e), du = lightDuIsTheDerivative(cases, e);
  const FluxFindings flux = fluxAgrees(cases, e);
  const std::string map = culpritOfDensity(density, du);
  // Of three estimates of the flux, the one that contradicts the other two is at fault.
  std::string power = flux.arriving.passed() ? "power()" : "emit()";
  std::string arriving = flux.power.passed() ? "sample()" : "emit()";
  if (!flux.power.passed() && !flux.arriving.passed() && !flux.powerIsArriving) power = "emit()";
  if (!map.empty()) arriving = map;  // sample() divides by its pdf
  Judgement j;
  j.verdicts = {verdictOf(lightAnswersStayTheSame(cases, e)),
                verdictOf(lightIsNeverNan(cases, e)),
                verdictOf(density.distribution, map),
                verdictOf(density.mass, map),
                verdictOf(density.ownPdf, map),
                verdictOf(density.ownRadiance),
                verdictOf(area, du.passed() ? (map.empty() ? "sample().pdf" : map) : ""),
                verdictOf(du, map == "sample()" ? map : ""),
                verdictOf(lightFromIsTheDerivative(cases, e)),
                verdictOf(lightLogGradientIsTheDerivative(cases, e)),
                verdictOf(flux.power, power),
                verdictOf(flux.arriving, arriving),
                verdictOf(emissionIsTheDerivative(cases, e))};
  j.timings = lightTimings(cases);
  return j;
}

}  // namespace vestige::judge
