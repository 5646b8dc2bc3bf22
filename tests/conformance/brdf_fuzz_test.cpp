// SPDX-License-Identifier: Apache-2.0
// Whatever numbers come, no BRDF answers with NaN, infinity or a negative density: grazing angles,
// the ends of the random numbers' interval, all parameters, and textures that leave their range.
#include "support/brdf_events.h"
#include "support/harsh.h"

using namespace vestige;
using namespace vestige::test;

namespace {

/// Heights down to the smallest number, often.
Vec3 harshDirection(Random& r) {
  const Real z = r.number() < Real(0.25) ? Real(1) : std::pow(Real(10), -36 * sqr(harsh(r)));
  return r.number() < Real(0.1) ? Vec3{0, 0, 1} : atHeight(z, r);
}

/// The promise that a sample breaks, or "".
std::string brokenPromise(const ScatterSample& s) {
  if (!isUnit(s.toNext)) return "toNext is no unit vector";
  if (!isColour(s.weight)) return "the weight is no colour";
  if (!s.specular && !(s.pdf > 0 && std::isfinite(s.pdf))) return "pdf is not positive";
  if (!s.specular && !(s.lobePdf > 0 && std::isfinite(s.lobePdf))) return "lobePdf is not positive";
  if (!(s.lobeChance > 0 && s.lobeChance <= 1)) return "lobeChance is no probability";
  return "";
}

std::string brokenPromise(const BrdfCase& c, const ScatterPoint& p, ScatterNumbers n, Vec3 other) {
  const auto s = c.brdf->sample(p, n);
  if (s)
    if (const std::string broken = brokenPromise(*s); !broken.empty()) return broken;
  const ScatterJacobian j = c.brdf->sampleDerivatives(p, n);
  if (s && !isFinite(j.du)) return "du is not finite";
  if (s && !isFinite(j.dPrev)) return "dPrev is not finite";
  for (const Vec3 toNext : {s ? s->toNext : other, other}) {
    if (!isColour(c.brdf->eval(p, toNext))) return "f is no colour";
    if (!isDensity(c.brdf->pdf(p, toNext))) return "pdf() is no density";
    const LogGradient g = c.brdf->logGradient(p, toNext);
    if (!isFinite(g.dPrev) || !isFinite(g.dNext)) return "logGradient is not finite";
    const Real scale = c.brdf->etaScale(p, toNext);
    if (!(scale > 0) || !std::isfinite(scale)) return "etaScale is not positive";
  }
  return "";
}

/// Numbers from a texture: schemas bind constants only.
BrdfCase beyondRange(const BrdfCase& c, const Schema& schema, Random& r) {
  BrdfCase wild = c;
  for (std::size_t i = 0; i < schema.inputs.size(); ++i) {
    if (schema.inputs[i].type != ValueType::real) continue;
    const Real x = harsh(r);
    wild.inputs[i].v[0] = x == 0 ? Real(-3) : 4 * x - 1;
  }
  wild.settings = "with wild textures";
  return wild;
}

std::vector<BrdfCase> casesAndWildOnes(Random& r) {
  std::vector<BrdfCase> cases = brdfCases(40);
  const std::size_t tame = cases.size();
  for (std::size_t i = 0; i < tame; i += 2)
    cases.push_back(beyondRange(cases[i], *pluginNamed("brdf", cases[i].plugin).schema, r));
  return cases;
}

void fuzz(int events) {
  Random r(6);
  const std::vector<BrdfCase> cases = casesAndWildOnes(r);
  for (int i = 0; i < events; ++i) {
    const BrdfCase& c = cases[std::size_t(r.number() * Real(cases.size()))];
    const Vec3 toPrev = harshDirection(r), far = harshDirection(r);
    const Vec3 other = r.number() < Real(0.5) ? far : Vec3{far.x, far.y, -far.z};
    const Real lobe = harsh(r), ux = harsh(r);
    const ScatterNumbers n = {lobe, {ux, harsh(r)}};
    const ScatterPoint p = c.at(toPrev, r.number() < Real(0.5));
    const std::string broken = brokenPromise(c, p, n, other);
    if (broken.empty()) continue;
    std::ostringstream text;
    text << broken << "; other toNext " << other;
    FAIL(eventLine(c, p, n, text.str()));
  }
  SUCCEED();
}

}  // namespace

TEST_CASE("nothing is ever infinite, negative or not a number", "[brdf][fuzz]") { fuzz(1000000); }

TEST_CASE("nothing is ever infinite, for long", "[brdf][fuzz][slow]") { fuzz(100000000); }
