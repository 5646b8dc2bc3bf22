// SPDX-License-Identifier: Apache-2.0
// A mixture of two BRDFs: the share `amount` of the second, the rest of the first.
//
//     f = (1 - amount) first + amount second,   channel by channel
//
// One of them is drawn, by the luminance of its share; the density is that of both.
#include <vestige/brdf.h>
#include <vestige/plugin.h>

namespace vestige {
namespace {

class Mix final : public Brdf {
 public:
  enum Param { kFirst, kSecond };
  enum Input { kAmount };

  static Schema schema() {
    return {.kind = "brdf",
            .name = "mix",
            .summary = "two BRDFs at once",
            .params = {block("first", "brdf").doc("the one where amount is 0 (lambert)"),
                       block("second", "brdf").doc("the one where amount is 1 (lambert)")},
            .inputs = {rgb("amount", 0.5).range(0, 1).doc("share of the second")}};
  }

  Mix(const Values& values, Host& host)
      : parts_{host.brdf(values.block(kFirst)), host.brdf(values.block(kSecond))} {}

  ScatterValue evaluate(const ScatterPoint& p, Vec3 toNext) const noexcept override {
    ScatterValue sum;
    for (const int i : {0, 1}) {
      const Part part = partOf(p, i);
      if (!(part.chance > 0)) continue;
      const ScatterValue v = parts_[i].brdf->evaluate(parts_[i].at(p), toNext);
      sum.fCos += part.share * v.fCos;
      sum.pdf += part.chance * v.pdf;
    }
    return sum;
  }

  std::optional<ScatterSample> sample(const ScatterPoint& p,
                                      ScatterNumbers n) const noexcept override {
    const Choice c = choose(p, n.lobe);
    std::optional<ScatterSample> s =
        parts_[c.index].brdf->sample(parts_[c.index].at(p), {c.rest, n.u});
    if (!s) return s;
    s->lobe = 2 * s->lobe + c.index;
    s->lobeChance *= c.part.chance;
    if (s->specular) {
      s->weight = c.part.share / c.part.chance * s->weight;
      return s;
    }
    const ScatterValue v = evaluate(p, s->toNext);
    if (!(v.pdf > 0)) return std::nullopt;
    s->weight = v.fCos / v.pdf;
    s->pdf = v.pdf;
    return s;
  }

  ScatterJacobian sampleDerivatives(const ScatterPoint& p,
                                    ScatterNumbers n) const noexcept override {
    const Choice c = choose(p, n.lobe);
    return parts_[c.index].brdf->sampleDerivatives(parts_[c.index].at(p), {c.rest, n.u});
  }

  LogGradient logGradient(const ScatterPoint& p, Vec3 toNext) const noexcept override {
    // d(log(a + b)) = (a d(log a) + b d(log b)) / (a + b)
    Real f[2] = {};
    for (const int i : {0, 1})
      f[i] = luminance(partOf(p, i).share * parts_[i].brdf->evaluate(parts_[i].at(p), toNext).fCos);
    LogGradient sum = {};
    for (const int i : {0, 1}) {
      if (!(f[i] > 0)) continue;
      const LogGradient g = parts_[i].brdf->logGradient(parts_[i].at(p), toNext);
      sum.dPrev += f[i] / (f[0] + f[1]) * g.dPrev;
      sum.dNext += f[i] / (f[0] + f[1]) * g.dNext;
    }
    return sum;
  }

  DiffusePart diffuse(const ScatterPoint& p) const noexcept override {
    DiffusePart sum{{}, true};
    for (const int i : {0, 1}) {
      const Part part = partOf(p, i);
      if (!(part.chance > 0)) continue;
      const DiffusePart d = parts_[i].brdf->diffuse(parts_[i].at(p));
      sum.albedo += part.share * d.albedo;
      sum.isAll = sum.isAll && d.isAll;
    }
    return sum;
  }

  Real etaScale(const ScatterPoint& p, Vec3 toNext) const noexcept override {
    if (!(toNext.z < 0)) return 1;
    // Of the part that lets light pass there; if none has a value, of a specular one.
    const auto passes = [&](int i) {
      return partOf(p, i).chance > 0 &&
             !isBlack(parts_[i].brdf->evaluate(parts_[i].at(p), toNext).fCos);
    };
    const int i = passes(0) ? 0 : passes(1) ? 1 : partOf(p, 0).chance > 0 ? 0 : 1;
    return parts_[i].brdf->etaScale(parts_[i].at(p), toNext);
  }

 private:
  struct Part {
    Rgb share;
    Real chance;  ///< probability of drawing from it; 0 if its share is black
  };
  struct Choice {
    int index;
    Part part;
    Real rest;  ///< the random number that chose, rescaled to [0,1)
  };

  static Part partOf(const ScatterPoint& p, int i) noexcept {
    const auto unit = [](Real x) { return std::clamp(x, Real(0), Real(1)); };
    const Rgb amount = p.inputs.rgb(kAmount);
    const Rgb second = {unit(amount.r), unit(amount.g), unit(amount.b)};
    const Real chance = luminance(second);
    return i == 0 ? Part{grey(1) - second, std::max(1 - chance, Real(0))} : Part{second, chance};
  }
  static Choice choose(const ScatterPoint& p, Real lobe) noexcept {
    const Part second = partOf(p, 1);
    if (lobe < second.chance) return {1, second, std::min(lobe / second.chance, kOneMinusEpsilon)};
    const Part first = partOf(p, 0);
    return {0, first, std::min((lobe - second.chance) / first.chance, kOneMinusEpsilon)};
  }

  NestedBrdf parts_[2];
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Brdf, vestige::Mix)
