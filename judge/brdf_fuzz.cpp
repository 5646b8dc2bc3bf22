// SPDX-License-Identifier: Apache-2.0
// No BRDF may return NaN, infinity or a negative density: for grazing angles, the ends of the
// random numbers' interval, and textures outside their range.
#include "judge/brdf_tests.h"
#include "judge/harsh.h"

namespace vestige::judge {
namespace {

struct Broken {
  std::string method, what;
};

/// Heights down to the smallest number, often.
Vec3 harshDirection(Random& r) {
  const Real z = r.number() < Real(0.25) ? Real(1) : std::pow(Real(10), -36 * sqr(harsh(r)));
  return r.number() < Real(0.1) ? Vec3{0, 0, 1} : atHeight(z, r);
}

/// The promise that a sample violates, or "".
std::optional<Broken> brokenPromise(const ScatterSample& s) {
  if (!isUnit(s.toNext)) return Broken{"sample().toNext", "toNext is no unit vector"};
  if (!isColour(s.weight)) return Broken{"sample().weight", "the weight is no colour"};
  if (!(s.lobeChance > 0 && s.lobeChance <= 1))
    return Broken{"sample().lobeChance", "lobeChance is no probability"};
  if (s.specular) return std::nullopt;
  if (!(s.pdf > 0 && std::isfinite(s.pdf))) return Broken{"sample().pdf", "pdf is not positive"};
  if (!(s.lobePdf > 0 && std::isfinite(s.lobePdf)))
    return Broken{"sample().lobePdf", "lobePdf is not positive"};
  return std::nullopt;
}

std::optional<Broken> brokenPromise(const BrdfCase& c, const ScatterPoint& p, Vec3 toNext) {
  if (!isColour(c.brdf->f(p, toNext))) return Broken{"evaluate().fCos", "f is no colour"};
  if (!isDensity(c.brdf->pdf(p, toNext)))
    return Broken{"evaluate().pdf", "evaluate().pdf is no density"};
  const LogGradient g = c.brdf->logGradient(p, toNext);
  if (!isFinite(g.dPrev) || !isFinite(g.dNext))
    return Broken{"logGradient()", "logGradient() is not finite"};
  const Real scale = c.brdf->etaScale(p, toNext);
  if (!(scale > 0) || !std::isfinite(scale))
    return Broken{"etaScale()", "etaScale() is not positive"};
  return std::nullopt;
}

bool isSame(const std::optional<ScatterSample>& a, const std::optional<ScatterSample>& b) {
  if (!a || !b) return !a && !b;
  return a->toNext == b->toNext && a->weight == b->weight && a->lobe == b->lobe;
}

std::optional<Broken> brokenPromise(const BrdfCase& c, const ScatterPoint& p, ScatterNumbers n,
                                    Vec3 other) {
  const auto s = c.brdf->sample(p, n);
  if (!c.brdf->usesLobeNumber() && !isSame(s, c.brdf->sample(p, {Real(0), n.u})))
    return Broken{"usesLobeNumber()", "sample() depends on the lobe number"};
  if (s)
    if (const auto broken = brokenPromise(*s)) return broken;
  const ScatterJacobian j = c.brdf->sampleDerivatives(p, n);
  if (s && !isFinite(j.du)) return Broken{"sampleDerivatives().du", "du is not finite"};
  if (s && !isFinite(j.dPrev)) return Broken{"sampleDerivatives().dPrev", "dPrev is not finite"};
  for (const Vec3 toNext : {s ? s->toNext : other, other})
    if (const auto broken = brokenPromise(c, p, toNext)) return broken;
  return std::nullopt;
}

/// Numbers from a texture: schemas bind constants only.
BrdfCase beyondRange(const BrdfCase& c, const Schema& schema, Random& r) {
  BrdfCase wild = c;
  for (std::size_t i = 0; i < schema.inputs.size(); ++i) {
    if (schema.inputs[i].type != ValueType::real) continue;
    const Real x = harsh(r);
    wild.inputs[i].v[0] = x == 0 ? Real(-3) : 4 * x - 1;
  }
  std::ostringstream text;
  text.precision(9);
  text << "{";
  for (std::size_t i = 0; i < schema.inputs.size(); ++i)
    if (schema.inputs[i].type == ValueType::real)
      text << " " << schema.inputs[i].name << " " << wild.inputs[i].v[0] << " (textured)";
  wild.settings = text.str() + " } from " + c.settings;
  return wild;
}

}  // namespace

Finding nothingIsNan(const BrdfCases& tame, const Schema* schema, int events, unsigned seed) {
  Finding f{"nothing is infinite, negative or not a number", "all"};
  Random r(seed + 5);
  BrdfCases cases = tame;
  for (std::size_t i = 0; schema && i < tame.size(); i += 2)
    cases.push_back(beyondRange(tame[i], *schema, r));
  for (int i = 0; i < events; ++i) {
    const BrdfCase& c = cases[std::size_t(r.number() * Real(cases.size()))];
    const Vec3 toPrev = harshDirection(r), far = harshDirection(r);
    const Vec3 other = r.number() < Real(0.5) ? far : Vec3{far.x, far.y, -far.z};
    const Real lobe = harsh(r), ux = harsh(r);
    const ScatterNumbers n = {lobe, {ux, harsh(r)}};
    const ScatterPoint p = c.at(toPrev, r.number() < Real(0.5));
    const auto broken = brokenPromise(c, p, n, other);
    f.worst.see(broken ? HUGE_VAL : 0, [&] {
      f.method = broken->method;
      std::ostringstream text;
      text.precision(9);
      text << broken->what << "; other toNext " << other;
      return eventLine(c, p, n, text.str());
    });
  }
  return f;
}

}  // namespace vestige::judge
