// SPDX-License-Identifier: Apache-2.0
// Repeated calls of a light, in another order and from many threads at once; and the time of a
// call.
#include "judge/light_tests.h"
#include "judge/same_answers.h"
#include "judge/timing.h"

namespace vestige::judge {
namespace {

const char* const kMethods[] = {"sample()", "sampleDerivatives()", "logGradient()", "emit()",
                                "emissionDerivatives()"};

struct Question {
  const LightCase* light;
  Receiver from;
  Vec2 u, v;
  bool isDrawn, isEmitted;
};

Bits answer(const Question& q, std::size_t method) {
  const Light& l = *q.light->light;
  Bits bits;
  if (method == 0) {
    if (const auto s = l.sample(q.from, q.u))
      bits.add(s->hit.toLight), bits.add(s->radiance), bits.add(s->pdf),
          bits.add(l.pdf(q.from, s->hit)), bits.add(l.eval(s->hit));
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

std::vector<Question> questions(const LightCases& cases, int samples, unsigned seed) {
  std::vector<Question> list;
  forLightEvents(cases, {.samples = std::max(samples, 256), .seed = seed},
                 [&](const LightCase& c, const Receiver& from, Vec2 u, Random& r) {
                   const Vec2 v = r.pair();
                   list.push_back({&c, from, u, v, c.light->sample(from, u).has_value(),
                                   c.light->emit({u, v}).has_value()});
                 });
  return list;
}

/// Results of sample(), as arguments of other methods.
struct Seen {
  const Light* light;
  Receiver from;
  LightHit hit;
};
std::vector<Seen> hits(const std::vector<Question>& list) {
  std::vector<Seen> found;
  for (const Question& q : list)
    if (const auto s = q.light->light->sample(q.from, q.u))
      found.push_back({q.light->light.get(), q.from, s->hit});
  return found;
}

}  // namespace

Finding lightAnswersStayTheSame(const LightCases& cases, const Effort& effort) {
  const std::vector<Question> list = questions(cases, effort.samples / 8, effort.seed);
  const auto ask = [&](std::size_t i, std::size_t method) { return answer(list[i], method); };
  return sameAnswers(list.size(), kMethods, ask, [&](std::size_t i, const std::string& what) {
    return lightEvent(*list[i].light, list[i].from, list[i].u, what);
  });
}

std::vector<Timing> lightTimings(const LightCases& cases) {
  const std::vector<Question> list = questions(cases, 1600, 1);
  const std::vector<Seen> found = hits(list);
  const auto taken = [&](const char* method, const auto& call) {
    return Timing{method,
                  nanoseconds(list, [&](const Question& q) { return call(*q.light->light, q); })};
  };
  using Q = const Question&;
  return {
      taken("sample()",
            [](const Light& l, Q q) {
              const auto s = l.sample(q.from, q.u);
              return s ? s->pdf : 0;
            }),
      {"pdf()", nanoseconds(found, [](const Seen& s) { return s.light->pdf(s.from, s.hit); })},
      {"eval()", nanoseconds(found, [](const Seen& s) { return s.light->eval(s.hit).g; })},
      taken("sampleDerivatives()",
            [](const Light& l, Q q) {
              return q.isDrawn ? l.sampleDerivatives(q.from, q.u).dFrom.c[0].x : 0;
            }),
      taken("logGradient()",
            [](const Light& l, Q q) { return q.isDrawn ? l.logGradient(q.from, q.u).dFrom.x : 0; }),
      taken("emit()",
            [](const Light& l, Q q) {
              const auto p = l.emit({q.u, q.v});
              return p ? p->power.g : 0;
            }),
      taken("emissionDerivatives()", [](const Light& l, Q q) {
        return q.isEmitted ? l.emissionDerivatives({q.u, q.v}).dDirection[2].x : 0;
      })};
}

}  // namespace vestige::judge
