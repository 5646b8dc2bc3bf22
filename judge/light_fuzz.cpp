// SPDX-License-Identifier: Apache-2.0
// Wherever one stands and whatever numbers come, no light answers with NaN, infinity or a negative
// density; and always the same.
#include "judge/harsh.h"
#include "judge/light_tests.h"
#include "judge/same_answers.h"

namespace vestige::judge {
namespace {

struct Broken {
  const char *method, *what;
};

/// A point that looks: anywhere near, far away, or at some height above a point of the light.
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

std::optional<Broken> brokenPromise(const Light& light, Vec3 from, Vec2 u) {
  const auto s = light.sample(from, u);
  if (!s) return std::nullopt;
  if (!isUnit(s->hit.toLight)) return Broken{"sample().hit", "toLight is no unit vector"};
  if (!(s->hit.distance > 0)) return Broken{"sample().hit", "the distance is not positive"};
  if (!isColour(s->radiance)) return Broken{"sample().radiance", "the radiance is no colour"};
  if (!(s->pdf > 0) || !std::isfinite(s->pdf))
    return Broken{"sample().pdf", "the sample's pdf is not positive"};
  if (!isDensity(light.pdf(s->hit))) return Broken{"pdf()", "pdf() is no density"};
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

const char* const kMethods[] = {"sample()", "sampleDerivatives()", "logGradient()", "emit()",
                                "emissionDerivatives()"};

struct Question {
  const LightCase* light;
  Vec3 from;
  Vec2 u, v;
  bool isDrawn, isEmitted;
};

Bits answer(const Question& q, std::size_t method) {
  const Light& l = *q.light->light;
  Bits bits;
  if (method == 0) {
    if (const auto s = l.sample(q.from, q.u))
      bits.add(s->hit.toLight), bits.add(s->radiance), bits.add(s->pdf), bits.add(l.pdf(s->hit)),
          bits.add(l.eval(s->hit));
  } else if (method == 1 && q.isDrawn) {
    const LightJacobian j = l.sampleDerivatives(q.from, q.u);
    for (const Vec3 d : {j.du.c[0], j.du.c[1], j.dFrom.c[0], j.dFrom.c[1], j.dFrom.c[2]})
      bits.add(d);
  } else if (method == 2 && q.isDrawn) {
    const LightLogGradient g = l.logGradient(q.from, q.u);
    bits.add(g.du.x), bits.add(g.du.y), bits.add(g.dFrom);
  } else if (method == 3) {
    if (const auto p = l.emit({q.u, q.v}))
      bits.add(p->origin), bits.add(p->direction), bits.add(p->power);
  } else if (method == 4 && q.isEmitted) {
    const RayJacobian j = l.emissionDerivatives({q.u, q.v});
    for (int k = 0; k < 4; ++k) bits.add(j.dOrigin[k]), bits.add(j.dDirection[k]);
  }
  return bits;
}

}  // namespace

Finding lightIsNeverNan(const LightCases& cases, const Effort& effort) {
  Finding f{"nothing is infinite, negative or not a number", "all"};
  forLightEvents(cases, effort, [&](const LightCase& c, Vec3, Vec2, Random& r) {
    const Vec3 from = lookout(*c.light, r);
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

Finding lightAnswersStayTheSame(const LightCases& cases, const Effort& effort) {
  std::vector<Question> list;
  forLightEvents(cases, {.samples = std::max(effort.samples / 8, 256), .seed = effort.seed},
                 [&](const LightCase& c, Vec3 from, Vec2 u, Random& r) {
                   const Vec2 v = r.pair();
                   list.push_back({&c, from, u, v, c.light->sample(from, u).has_value(),
                                   c.light->emit({u, v}).has_value()});
                 });
  const auto ask = [&](std::size_t i, std::size_t method) { return answer(list[i], method); };
  return sameAnswers(list.size(), kMethods, ask, [&](std::size_t i, const std::string& what) {
    return lightEvent(*list[i].light, list[i].from, list[i].u, what);
  });
}

}  // namespace vestige::judge
