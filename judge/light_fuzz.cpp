// SPDX-License-Identifier: Apache-2.0
// No light may return NaN, infinity or a negative density, for any receiver and any random numbers.
#include "judge/harsh.h"
#include "judge/light_tests.h"

namespace vestige::judge {
namespace {

struct Broken {
  const char *method, *what;
};

/// A receiver: near, far away, or at some height above a point of the light.
Vec3 lookout(const Light& light, Random& r) {
  const Vec3 anywhere = r.point(-3, 3);
  const Real kind = r.number();
  if (kind < Real(0.4)) return anywhere;
  if (kind < Real(0.5)) return Real(1e4) * anywhere;
  const auto p = light.emit({harshPair(r), harshPair(r)});
  if (!p || !isFinite(p->origin)) return anywhere;
  const Vec3 normal = isUnit(p->normal) ? p->normal : p->direction;
  const Real height = r.number() < Real(0.3) ? 0 : std::pow(Real(10), r.number(-4, 0));
  const Vec3 across = r.number() < Real(0.5) ? Vec3{} : projection(normal) * anywhere;
  return p->origin + height * normal + across;
}

std::optional<Broken> brokenPromise(const Light& light, const Receiver& from, Vec2 u) {
  const auto s = light.sample(from, u);
  if (!s) return std::nullopt;
  if (!isUnit(s->hit.toLight)) return Broken{"sample().hit", "toLight is no unit vector"};
  if (!(s->hit.from == from.position))
    return Broken{"sample().hit", "hit.from is not where it was asked"};
  if (!(s->hit.distance > 0)) return Broken{"sample().hit", "the distance is not positive"};
  if (!isColour(s->radiance)) return Broken{"sample().radiance", "the radiance is no colour"};
  if (!(s->pdf > 0) || !std::isfinite(s->pdf))
    return Broken{"sample().pdf", "the sample's pdf is not positive"};
  if (light.traits().isDelta && !(s->pdf == 1 && light.pdf(from, s->hit) == 0))
    return Broken{"pdf()", "a delta light's pdf is not 1 of a sample, 0 of a hit"};
  if (!isDensity(light.pdf(from, s->hit))) return Broken{"pdf()", "pdf() is no density"};
  if (!isColour(light.eval(s->hit))) return Broken{"eval()", "eval() is no colour"};
  const LightJacobian j = light.sampleDerivatives(from, u);
  if (!isFinite(j.du) || !isFinite(j.dFrom))
    return Broken{"sampleDerivatives()", "sampleDerivatives() is not finite"};
  const LightLogGradient g = light.logGradient(from, u);
  if (!isFinite(g.dFrom) || !std::isfinite(g.du.x + g.du.y))
    return Broken{"logGradient()", "logGradient() is not finite"};
  return std::nullopt;
}

std::optional<Broken> brokenPromise(const Light& light, EmissionNumbers u) {
  const auto p = light.emit(u);
  if (!p) return std::nullopt;
  if (!isFinite(p->origin) || !isUnit(p->direction)) return Broken{"emit()", "the ray is none"};
  if (!isColour(p->power)) return Broken{"emit()", "a particle's power is no colour"};
  if (!isFinite(light.emissionDerivatives(u)))
    return Broken{"emissionDerivatives()", "emissionDerivatives() is not finite"};
  return std::nullopt;
}

}  // namespace

Finding lightIsNeverNan(const LightCases& cases, const Effort& effort) {
  Finding f{"nothing is infinite, negative or not a number", "all"};
  forLightEvents(cases, effort, [&](const LightCase& c, const Receiver& at, Vec2, Random& r) {
    const Receiver from = {lookout(*c.light, r), at.normal};
    const Vec2 u = harshPair(r), v = harshPair(r);
    auto broken = brokenPromise(*c.light, from, u);
    if (!broken) broken = brokenPromise(*c.light, EmissionNumbers{u, v});
    f.worst.see(broken ? HUGE_VAL : 0, [&] {
      f.method = broken->method;
      std::ostringstream text;
      text.precision(9);
      text << broken->what << "; direction numbers of emit() " << v;
      return lightEvent(c, from, u, text.str());
    });
  });
  return f;
}

}  // namespace vestige::judge
