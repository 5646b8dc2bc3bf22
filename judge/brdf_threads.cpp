// SPDX-License-Identifier: Apache-2.0
// Repeated calls return the same bits, in another order and from many threads at once.
#include "judge/brdf_tests.h"
#include "judge/same_answers.h"
#include "judge/timing.h"

namespace vestige::judge {
namespace {

struct Question {
  const BrdfCase* brdf;
  ScatterPoint at;
  ScatterNumbers numbers;
  Vec3 toNext;
  bool isDrawn;  ///< sample() returned a direction, so there are derivatives
};

const char* const kMethods[] = {"sample()", "evaluate().fCos", "evaluate().pdf",
                                "sampleDerivatives()", "logGradient()"};

/// One method's result, as bits.
Bits answer(const Question& q, std::size_t method) {
  const Brdf& b = *q.brdf->brdf;
  Bits bits;
  switch (method) {
    case 0:
      if (const auto s = b.sample(q.at, q.numbers)) {
        bits.add(s->toNext), bits.add(s->weight), bits.add(s->pdf), bits.add(s->lobePdf);
        bits.add(s->lobeChance), bits.add(Real(s->lobe)), bits.add(Real(s->specular));
      }
      break;
    case 1:
      bits.add(b.f(q.at, q.toNext));
      break;
    case 2:
      bits.add(b.pdf(q.at, q.toNext));
      break;
    case 3:
      if (q.isDrawn) {
        const ScatterJacobian j = b.sampleDerivatives(q.at, q.numbers);
        for (const Vec3 v : {j.du.c[0], j.du.c[1], j.dPrev.c[0], j.dPrev.c[1], j.dPrev.c[2]})
          bits.add(v);
      }
      break;
    default: {
      const LogGradient g = b.logGradient(q.at, q.toNext);
      bits.add(g.dPrev), bits.add(g.dNext);
    }
  }
  return bits;
}

std::vector<Question> questions(const BrdfCases& cases, int each, unsigned seed) {
  std::vector<Question> list;
  forEvents(
      cases, each,
      [&](const BrdfCase& c, const ScatterPoint& p, ScatterNumbers n, Random& r) {
        list.push_back({&c, p, n, anywhere(r), c.brdf->sample(p, n).has_value()});
      },
      seed);
  return list;
}

}  // namespace

Finding answersStayTheSame(const BrdfCases& cases, const Effort& effort) {
  const int each = std::clamp(effort.events() / 8, 16, 4096);
  const std::vector<Question> list = questions(cases, each, effort.seed);
  const auto ask = [&](std::size_t i, std::size_t method) { return answer(list[i], method); };
  return sameAnswers(list.size(), kMethods, ask, [&](std::size_t i, const std::string& what) {
    return eventLine(*list[i].brdf, list[i].at, list[i].numbers, what);
  });
}

std::vector<Timing> timings(const BrdfCases& cases) {
  const std::vector<Question> list = questions(cases, 100, 1);
  const auto taken = [&](const char* method, const auto& call) {
    return Timing{method,
                  nanoseconds(list, [&](const Question& q) { return call(*q.brdf->brdf, q); })};
  };
  using Q = const Question&;
  return {taken("sample()",
                [](const Brdf& b, Q q) {
                  const auto s = b.sample(q.at, q.numbers);
                  return s ? s->pdf : 0;
                }),
          taken("evaluate().fCos", [](const Brdf& b, Q q) { return b.f(q.at, q.toNext).g; }),
          taken("evaluate().pdf", [](const Brdf& b, Q q) { return b.pdf(q.at, q.toNext); }),
          taken("sampleDerivatives()",
                [](const Brdf& b, Q q) { return b.sampleDerivatives(q.at, q.numbers).du.c[0].x; }),
          taken("logGradient()",
                [](const Brdf& b, Q q) { return b.logGradient(q.at, q.toNext).dNext.x; })};
}

}  // namespace vestige::judge
