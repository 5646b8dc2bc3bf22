// SPDX-License-Identifier: Apache-2.0
// evaluate(), the sample's weight, etaScale() and diffuse().
#include "judge/brdf_tests.h"

namespace vestige::judge {
namespace {

/// Number of samples of each direction in the statistical tests of energy.
int energySamples(const Effort& effort) { return std::max(effort.samples / 2, 64); }

/// f(prev, next) etaScale, and f(next, prev).
struct BothWays {
  Rgb forth, back;
};
BothWays bothWays(const BrdfCase& c, const ScatterPoint& p, Vec3 toNext) {
  // The frame faces the known direction, on whichever side that is.
  const bool crosses = toNext.z < 0;
  const auto facing = [&](Vec3 d) { return crosses ? Vec3{d.x, d.y, -d.z} : d; };
  const ScatterPoint back = c.at(facing(toNext), p.behind != crosses);
  return {c.brdf->etaScale(p, toNext) * c.brdf->f(p, toNext), c.brdf->f(back, facing(p.toPrev))};
}

/// Compares with zero the mean of f cos without the diffuse part, which is left to rays.
void seeWhatIsLeft(Finding& f, const BrdfCase& c, const ScatterPoint& p, const DiffusePart& diffuse,
                   int samples, Random& r) {
  double sum = 0, squares = 0;
  for (int i = 0; i < samples; ++i)
    if (const auto s = c.brdf->sample(p, numbers(r))) {
      double rest = double(luminance(s->weight));
      if (!s->specular && s->toNext.z > 0)
        rest -= double(luminance(diffuse.albedo) / kPi * s->toNext.z / s->pdf);
      sum += rest, squares += rest * rest;
    }
  const double mean = sum / samples, variance = std::max(squares / samples - mean * mean, 0.0);
  f.worst.see(-mean / (5 * std::sqrt(variance / samples) + 0.01), [&] {
    return eventLine(c, p, {},
                     told("the mean of f cos without the diffuse part is", mean, 0) + " or more");
  });
}

}  // namespace

Finding weightIsTheQuotient(const BrdfCases& cases, const Effort& effort) {
  Finding f{"weight = f |cos| / pdf", "sample().weight"};
  const auto judge = [&](const BrdfCase& c, const ScatterPoint& p, ScatterNumbers n, Random&) {
    const auto s = c.brdf->sample(p, n);
    if (!s) return;
    if (s->specular) {  // then f has no value at a point
      f.worst.see(isBlack(c.brdf->f(p, s->toNext)) ? 0 : 2,
                  [&] { return eventLine(c, p, n, "the sample is specular, but f is not 0"); });
      return;
    }
    const Real pdf = c.brdf->pdf(p, s->toNext);
    const Rgb weight = std::abs(s->toNext.z) / pdf * c.brdf->f(p, s->toNext);
    const auto quotient = [&](const ScatterPoint& q, Vec3 d) {
      return std::abs(d.z) * maxComponent(c.brdf->f(q, d)) / c.brdf->pdf(q, d);
    };
    const double allowed = (kDouble ? 1e-9 : 1e-3) + 4 * wobble(p, s->toNext, quotient);
    f.worst.see(relative(weight, s->weight) / allowed, [&] {
      return eventLine(
          c, p, n,
          told("the weight is", double(maxComponent(s->weight)), double(maxComponent(weight))) +
              " = f |cos| / pdf");
    });
  };
  forEvents(cases, effort.events(), judge, effort.seed);
  return f;
}

Finding noEnergyIsGained(const BrdfCases& cases, const Effort& effort) {
  Finding f{"no more energy leaves than arrives", "evaluate().fCos"};
  const int samples = energySamples(effort);
  Random r(effort.seed + 2);
  for (const BrdfCase& c : cases)
    for (const Real height : {Real(1), Real(0.6), Real(0.3), Real(0.1), Real(0.02)})
      for (const bool behind : {false, true}) {
        const ScatterPoint p = c.at(atHeight(height, r), behind);
        Rgb sum, squares;
        for (int i = 0; i < samples; ++i)
          if (const auto s = c.brdf->sample(p, numbers(r)))
            sum += s->weight, squares += s->weight * s->weight;
        const auto excess = [&](Real total, Real square) {
          const double mean = double(total) / samples;
          const double variance = std::max(double(square) / samples - mean * mean, 0.0);
          return (mean - 1) / (5 * std::sqrt(variance / samples) + (kDouble ? 1e-9 : 2e-4));
        };
        const double e = std::max(
            {excess(sum.r, squares.r), excess(sum.g, squares.g), excess(sum.b, squares.b)});
        f.worst.see(e, [&] {
          return eventLine(c, p, {},
                           told("the reflected and transmitted fraction is",
                                double(maxComponent(sum)) / samples, 1) +
                               " at most");
        });
      }
  return f;
}

Finding diffusePartIsNoMoreThanThereIs(const BrdfCases& cases, const Effort& effort) {
  Finding f{"diffuse() is a part of f", "diffuse()"};
  Random r(effort.seed + 3);
  for (const BrdfCase& c : cases)
    for (const Real height : {Real(1), Real(0.5), Real(0.1)})
      for (const bool behind : {false, true}) {
        const ScatterPoint p = c.at(atHeight(height, r), behind);
        const DiffusePart diffuse = c.brdf->diffuse(p);
        const bool isAlbedo =
            std::min({diffuse.albedo.r, diffuse.albedo.g, diffuse.albedo.b}) >= 0 &&
            maxComponent(diffuse.albedo) <= Real(1.0001);
        if (!isAlbedo)
          f.worst.see(HUGE_VAL, [&] {
            return eventLine(c, p, {},
                             told("its albedo is", double(maxComponent(diffuse.albedo)), 1) +
                                 " at most, and no less than 0");
          });
        if (!diffuse.isAll) {
          seeWhatIsLeft(f, c, p, diffuse, energySamples(effort), r);
          continue;
        }
        const Vec3 next = anywhere(r);
        const Rgb expected = next.z > 0 ? diffuse.albedo / kPi : Rgb{};
        f.worst.see(relative(c.brdf->f(p, next), expected) / 1e-5, [&] {
          return eventLine(c, p, {},
                           told("isAll is set, but f is", double(maxComponent(c.brdf->f(p, next))),
                                double(maxComponent(expected))));
        });
      }
  return f;
}

Finding isReciprocal(const BrdfCases& cases, const Effort& effort, bool across) {
  Finding f{across ? "f(b, a) = etaScale(a, b) f(a, b) through the surface"
                   : "f(b, a) = f(a, b) on one side",
            across ? "etaScale()" : "evaluate().fCos"};
  const auto judge = [&](const BrdfCase& c, const ScatterPoint& p, ScatterNumbers n, Random& r) {
    Vec3 toNext = anywhere(r);  // half of them where the lobe is: a narrow one is zero elsewhere
    if (r.number() < Real(0.5))
      if (const auto s = c.brdf->sample(p, n)) toNext = s->toNext;
    if ((toNext.z < 0) != across || (across && !c.isReciprocalAcross)) return;
    if (std::abs(toNext.z) < Real(1e-3) || p.toPrev.z < Real(1e-3)) return;
    const BothWays f2 = bothWays(c, p, toNext);
    if (isBlack(f2.forth) && isBlack(f2.back)) return;
    const double allowed = evalTolerance(c, p, toNext);
    f.worst.see(relative(f2.forth, f2.back) / allowed, [&] {
      std::ostringstream text;
      text << told(across ? "etaScale f(a, b) is" : "f(a, b) is", double(maxComponent(f2.forth)),
                   double(maxComponent(f2.back)))
           << " = f(b, a), toNext " << toNext;
      return eventLine(c, p, n, text.str());
    });
  };
  forEvents(cases, effort.events(), judge, effort.seed);
  return f;
}

Finding etaScaleFollowsSnell(const BrdfCases& cases, const Effort& effort) {
  // Smooth interfaces have no f to be reciprocal, but n_prev sin(prev) = n_next sin(next).
  Finding f{"etaScale() is the square of Snell's indices", "etaScale()"};
  const auto judge = [&](const BrdfCase& c, const ScatterPoint& p, ScatterNumbers n, Random&) {
    const auto s = c.brdf->sample(p, n);
    if (!s || (s->toNext.z < 0 && !s->specular)) return;
    const auto sine2 = [](Vec3 d) { return double(sqr(d.x) + sqr(d.y)); };
    const double expected = s->toNext.z < 0 ? sine2(s->toNext) / sine2(p.toPrev) : 1;
    const double found = double(c.brdf->etaScale(p, s->toNext));
    f.worst.see(relative(found, expected) / (1e4 * kEpsilon),
                [&] { return eventLine(c, p, n, told("etaScale() is", found, expected)); });
  };
  forEvents(cases, std::max(effort.events() / 4, 1), judge, effort.seed);
  return f;
}

}  // namespace vestige::judge
