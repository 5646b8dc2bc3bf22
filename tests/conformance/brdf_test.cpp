// SPDX-License-Identifier: Apache-2.0
// What every BRDF has to keep of the contract in brdf.h, tried on every BRDF library found, whoever
// wrote it, over ranges and awkward corners of its parameters.
//
// sample(), pdf() and sampleDerivatives() are three independent statements about one map:
//     sample and pdf           chi-square                        here
//     pdf and derivative       |du.c0 x du.c1| lobePdf = 1       brdf_derivatives_test.cpp
//     sample and derivative    finite differences                likewise
// A fault in one of them breaks two of these tests, which names the culprit. eval() is held by its
// quotient with pdf(), by energy and by reciprocity; logGradient() by differences of eval().
//
// A failure prints the worst event: plugin, parameters, directions and random numbers.
#include <complex>

#include "support/brdf_events.h"
#include "support/statistics.h"

using namespace vestige;
using namespace vestige::test;

namespace {

struct Goodness {
  double pValue;
  double missing;  ///< 1 - integral of pdf - P(nullopt or specular), in standard deviations
};

/// Directions that sample() gives with a density, out of n calls.
std::vector<Vec3> densitySamples(const Brdf& brdf, const ScatterPoint& p, int n, Random& r) {
  std::vector<Vec3> list;
  for (int i = 0; i < n; ++i)
    if (const auto s = brdf.sample(p, numbers(r)); s && !s->specular) list.push_back(s->toNext);
  return list;
}

/// A lobe in which neighbouring directions of this Real are far apart has no density to speak of.
bool isTooNarrow(const Brdf& brdf, const ScatterPoint& p, Random& r) {
  for (int i = 0; i < 50; ++i)
    if (const auto s = brdf.sample(p, numbers(r)); s && !s->specular)
      if (std::sqrt(double(s->pdf)) * kEpsilon > 2e-3) return true;
  return false;
}

Goodness goodness(const Brdf& brdf, const ScatterPoint& p, int n, int depth, Random& r) {
  const SpherePartition cells(densitySamples(brdf, p, n / 4, r), depth);
  std::vector<double> expected = cells.integrate([&](Vec3 d) { return brdf.pdf(p, d); });
  double sum = 0;
  for (double& e : expected) sum += e, e *= n;
  std::vector<double> seen(cells.cells(), 0);
  const std::vector<Vec3> samples = densitySamples(brdf, p, n, r);
  for (const Vec3 d : samples) ++seen[cells.cellOf(d)];
  const double drawn = double(samples.size()) / n;
  const double deviation = std::sqrt(std::max(drawn * (1 - drawn), 1e-12) / n) + 1e-3;
  return {chiSquareTest(expected, seen), (sum - drawn) / deviation};
}

void checkGoodness(const std::vector<BrdfCase>& cases, int n, int depth) {
  Random r(2);
  double lowest = 1;
  std::string event;
  std::size_t tests = 0;
  WorstEvent mass;
  for (const BrdfCase& c : cases)
    for (const Real height : {Real(1), Real(0.7), Real(0.25), Real(0.02)})
      for (const bool inside : {false, true}) {
        if (inside && !c.hasInside) continue;
        const ScatterPoint p = c.at(atHeight(height, r), inside);
        if (isTooNarrow(*c.brdf, p, r)) continue;
        const Goodness g = goodness(*c.brdf, p, n, depth, r);
        const std::string line =
            eventLine(c, p, {}, told("p-value", g.pValue, 1) + "; " + told("mass", g.missing, 0));
        ++tests;
        if (g.pValue < lowest) lowest = g.pValue, event = line;
        mass.see(std::abs(g.missing) / 5, [&] { return line; });
      }
  INFO(event);
  CHECK(lowest > sidakLevel(0.01, tests));
  check(mass);
}

}  // namespace

TEST_CASE("samples are distributed as pdf says", "[brdf][chi2]") {
  checkGoodness(brdfCases(2), 1 << 15, 7);
}

TEST_CASE("samples are distributed as pdf says, with many samples", "[brdf][chi2][slow]") {
  checkGoodness(brdfCases(8), 1 << 18, 10);
}

TEST_CASE("a sample knows its own pdf", "[brdf]") {
  WorstEvent worst;
  forEvents(brdfCases(), 2000, [&](const BrdfCase& c, auto& p, ScatterNumbers n, Random&) {
    const auto s = c.brdf->sample(p, n);
    if (!s || s->specular) return;
    const double pdf = double(c.brdf->pdf(p, s->toNext));
    const double allowed = pdfTolerance(c, p, s->toNext);
    worst.see(relative(pdf, double(s->pdf)) / allowed,
              [&] { return eventLine(c, p, n, told("pdf()", pdf, double(s->pdf))); });
    // One lobe of several: together they are at least as dense.
    const double part = double(s->lobePdf * s->lobeChance);
    worst.see((part / double(s->pdf) - 1) / allowed,
              [&] { return eventLine(c, p, n, told("lobe's part", part, double(s->pdf))); });
  });
  check(worst);
}

// ----------------------------------------------------------------------------------- eval

TEST_CASE("the weight is f cos / pdf", "[brdf]") {
  WorstEvent worst;
  forEvents(brdfCases(), 2000, [&](const BrdfCase& c, auto& p, ScatterNumbers n, Random&) {
    const auto s = c.brdf->sample(p, n);
    if (!s) return;
    if (s->specular) {  // then f has no value at a point
      CHECK(isBlack(c.brdf->eval(p, s->toNext)));
      return;
    }
    const Real pdf = c.brdf->pdf(p, s->toNext);
    const Rgb weight = std::abs(s->toNext.z) / pdf * c.brdf->eval(p, s->toNext);
    const auto quotient = [&](const ScatterPoint& q, Vec3 d) {
      return std::abs(d.z) * maxComponent(c.brdf->eval(q, d)) / c.brdf->pdf(q, d);
    };
    const double allowed = (kDouble ? 1e-9 : 1e-3) + 4 * wobble(p, s->toNext, quotient);
    worst.see(relative(weight, s->weight) / allowed, [&] {
      return eventLine(
          c, p, n,
          told("f cos / pdf", double(maxComponent(weight)), double(maxComponent(s->weight))));
    });
  });
  check(worst);
}

TEST_CASE("no surface gives back more than it gets", "[brdf][energy]") {
  constexpr int kSamples = 1 << 14;
  Random r(3);
  WorstEvent worst;
  for (const BrdfCase& c : brdfCases())
    for (const Real height : {Real(1), Real(0.6), Real(0.3), Real(0.1), Real(0.02)})
      for (const bool inside : {false, true}) {
        const ScatterPoint p = c.at(atHeight(height, r), inside);
        Rgb sum, squares;
        for (int i = 0; i < kSamples; ++i)
          if (const auto s = c.brdf->sample(p, numbers(r)))
            sum += s->weight, squares += s->weight * s->weight;
        const auto excess = [&](Real total, Real square) {
          const double mean = double(total) / kSamples;
          const double variance = std::max(double(square) / kSamples - mean * mean, 0.0);
          return (mean - 1) / (5 * std::sqrt(variance / kSamples) + (kDouble ? 1e-9 : 2e-4));
        };
        const double e = std::max(
            {excess(sum.r, squares.r), excess(sum.g, squares.g), excess(sum.b, squares.b)});
        worst.see(e, [&] {
          return eventLine(c, p, {}, told("energy", double(maxComponent(sum)) / kSamples, 1));
        });
      }
  check(worst);
}

TEST_CASE("the matt part is no more than there is, and all where it says so", "[brdf][energy]") {
  constexpr int kSamples = 1 << 14;
  Random r(4);
  WorstEvent worst;
  for (const BrdfCase& c : brdfCases())
    for (const Real height : {Real(1), Real(0.5), Real(0.1)})
      for (const bool inside : {false, true}) {
        const ScatterPoint p = c.at(atHeight(height, r), inside);
        const MattPart matt = c.brdf->matt(p);
        INFO(c.title());
        REQUIRE(std::min({matt.albedo.r, matt.albedo.g, matt.albedo.b}) >= 0);
        REQUIRE(maxComponent(matt.albedo) <= Real(1.0001));
        if (matt.isAll) {
          const Vec3 next = anywhere(r);
          const Rgb f = next.z > 0 ? matt.albedo / kPi : Rgb{};
          CHECK(relative(c.brdf->eval(p, next), f) < 1e-5);
          continue;
        }
        // What is left for rays must not be light taken away, in the mean over directions.
        double sum = 0, squares = 0;
        for (int i = 0; i < kSamples; ++i)
          if (const auto s = c.brdf->sample(p, numbers(r))) {
            double rest = double(luminance(s->weight));
            if (!s->specular && s->toNext.z > 0)
              rest -= double(luminance(matt.albedo) / kPi * s->toNext.z / s->pdf);
            sum += rest, squares += rest * rest;
          }
        const double mean = sum / kSamples,
                     variance = std::max(squares / kSamples - mean * mean, 0.0);
        worst.see(-mean / (5 * std::sqrt(variance / kSamples) + 0.01),
                  [&] { return eventLine(c, p, {}, told("what is left", mean, 0)); });
      }
  check(worst);
}

TEST_CASE("what loses nothing by its model gives back all", "[brdf][energy]") {
  const Value tint = colourValue(0.9, 0.5, 0.1), white = colourValue(1, 1, 1);
  const std::pair<BrdfCase, Rgb> exact[] = {
      {brdfCase("lambert", {{"diffuse", tint}}), {Real(0.9), Real(0.5), Real(0.1)}},
      {brdfCase("mirror", {{"specular", tint}}), {Real(0.9), Real(0.5), Real(0.1)}},
      {brdfCase("glass", {{"ior", numberValue(1.5)}}), grey(1)},
      {brdfCase("glass", {{"ior", numberValue(1)}}), grey(1)},
      {brdfCase("glass", {{"ior", numberValue(0.7)}}), grey(1)},
  };
  Random r(4);
  for (const auto& [c, expected] : exact)
    for (int i = 0; i < 1000; ++i) {
      const ScatterNumbers n = numbers(r);
      const auto s = c.brdf->sample(c.at(aboveSurface(r), i % 2 == 1), n);
      REQUIRE(s);  // every weight alone, so the mean is exact without noise
      REQUIRE(relative(s->weight, expected) < 10 * kEpsilon);
    }

  // Facets lose only what bounces between them, which vanishes with their roughness; at the bottom
  // of its range every direction of a smooth surface is alike.
  const BrdfCase smooth[] = {
      brdfCase("rough_conductor", {{"alpha", numberValue(0)}}),
      brdfCase("rough_dielectric", {{"alpha", numberValue(0)}}),
      brdfCase(
          "principled",
          {{"base_color", white}, {"metallic", numberValue(1)}, {"roughness", numberValue(0)}}),
      brdfCase(
          "principled",
          {{"base_color", white}, {"transmission", numberValue(1)}, {"roughness", numberValue(0)}}),
      brdfCase("phong", {{"specular", white}, {"exponent", numberValue(1e6)}}),
  };
  for (const BrdfCase& c : smooth)
    for (const bool inside : {false, true}) {
      Rgb sum;
      for (int i = 0; i < 1 << 14; ++i)
        if (const auto s = c.brdf->sample(c.at({0, 0, 1}, inside), numbers(r))) sum += s->weight;
      INFO(c.title());
      CHECK(relative(sum / Real(1 << 14), grey(1)) < 1e-3);
    }
}

TEST_CASE("f(b, a) = etaScale(a, b) f(a, b)", "[brdf][reciprocity]") {
  // A lobe about the refracted direction has no mirror image: it widens where the light narrows.
  const auto exempt = [](const BrdfCase& c, Vec3 toNext) {
    return c.plugin == "phong" && toNext.z < 0;
  };
  WorstEvent worst;
  int across = 0;
  forEvents(brdfCases(), 2000, [&](const BrdfCase& c, auto& p, ScatterNumbers n, Random& r) {
    Vec3 toNext = anywhere(r);  // half of them where the lobe is: a narrow one is zero elsewhere
    if (r.number() < Real(0.5))
      if (const auto s = c.brdf->sample(p, n)) toNext = s->toNext;
    if (exempt(c, toNext) || std::abs(toNext.z) < Real(1e-3) || p.toPrev.z < Real(1e-3)) return;
    // The frame faces the known direction, on whichever side that is.
    const bool crosses = toNext.z < 0;
    const auto facing = [&](Vec3 d) { return crosses ? Vec3{d.x, d.y, -d.z} : d; };
    const ScatterPoint back = c.at(facing(toNext), p.inside != crosses);
    const Rgb forth = c.brdf->etaScale(p, toNext) * c.brdf->eval(p, toNext);
    const Rgb expected = c.brdf->eval(back, facing(p.toPrev));
    if (isBlack(forth) && isBlack(expected)) return;
    across += crosses;
    const double allowed = evalTolerance(c, p, toNext);
    worst.see(relative(forth, expected) / allowed, [&] {
      std::ostringstream text;
      text << told("etaScale f(a, b)", double(forth.g), double(expected.g)) << ", toNext "
           << toNext;
      return eventLine(c, p, n, text.str());
    });
  });
  check(worst);
  CHECK(across > 1000);
}

TEST_CASE("etaScale is the square of the indices' quotient, as Snell's law has it",
          "[brdf][reciprocity]") {
  // Smooth interfaces have no f to be reciprocal, but n_prev sin(prev) = n_next sin(next).
  WorstEvent worst;
  forEvents(brdfCases(), 500, [&](const BrdfCase& c, auto& p, ScatterNumbers n, Random&) {
    const auto s = c.brdf->sample(p, n);
    if (!s || (s->toNext.z < 0 && !s->specular)) return;
    const auto sine2 = [](Vec3 d) { return double(sqr(d.x) + sqr(d.y)); };
    const double expected = s->toNext.z < 0 ? sine2(s->toNext) / sine2(p.toPrev) : 1;
    const double found = double(c.brdf->etaScale(p, s->toNext));
    worst.see(relative(found, expected) / (1e4 * kEpsilon),
              [&] { return eventLine(c, p, n, told("etaScale", found, expected)); });
  });
  check(worst);
}

TEST_CASE("smooth surfaces follow Snell and Fresnel", "[brdf][energy]") {
  // Both polarisations with complex numbers: metals, dielectrics and total reflection in one.
  const auto reflected = [](double c, std::complex<double> index) {
    const std::complex<double> t = std::sqrt(index * index - (1 - c * c));
    const auto s = (c - t) / (c + t), p = (index * index * c - t) / (index * index * c + t);
    return (std::norm(s) + std::norm(p)) / 2;
  };
  const Value white = colourValue(1, 1, 1), none = numberValue(0);
  const BrdfCase clear[] = {
      brdfCase("glass", {}),
      brdfCase("rough_dielectric", {{"alpha", none}}),
      brdfCase("principled",
               {{"base_color", white}, {"transmission", numberValue(1)}, {"roughness", none}}),
  };
  const Vec2 middle = {Real(0.5), Real(0.5)};
  Random r(7);
  for (const Real height : {Real(1), Real(0.9), Real(0.5), Real(0.2)})
    for (const bool inside : {false, true}) {
      const double index = inside ? 1 / 1.5 : 1.5;
      const double f = reflected(double(height), index);
      const Vec3 toPrev = atHeight(height, r);
      for (const BrdfCase& c : clear) {
        INFO(c.title() << " at height " << height << (inside ? " inside" : " outside"));
        const auto low = c.brdf->sample(c.at(toPrev, inside), {0, middle});
        REQUIRE(low);
        CHECK(low->lobeChance == Approx(f).epsilon(3e-3));
        const auto high = c.brdf->sample(c.at(toPrev, inside), {kOneMinusEpsilon, middle});
        REQUIRE(high);
        CHECK((high->toNext.z > 0) == (f == 1));
        if (f < 1)
          CHECK(length(Real(index) * cross(high->toNext, {0, 0, 1}) +  //
                       cross(toPrev, {0, 0, 1})) < 2e-3);
      }
      const BrdfCase through =
          brdfCase("phong", {{"transmission", white}, {"exponent", numberValue(1e6)}});
      const auto s = through.brdf->sample(through.at(toPrev, inside), {0, middle});
      CHECK(bool(s) == (f < 1));
      if (s)
        CHECK(length(Real(index) * cross(s->toNext, {0, 0, 1}) + cross(toPrev, {0, 0, 1})) < 2e-3);
      const BrdfCase gold = brdfCase("rough_conductor", {{"alpha", none},
                                                         {"eta", colourValue(0.143, 0.375, 1.442)},
                                                         {"k", colourValue(3.983, 2.386, 1.603)}});
      const auto m = gold.brdf->sample(gold.at(toPrev, inside), {0, middle});
      REQUIRE(m);
      CHECK(m->weight.r == Approx(reflected(double(height), {0.143, 3.983})).epsilon(2e-3));
      CHECK(m->weight.g == Approx(reflected(double(height), {0.375, 2.386})).epsilon(2e-3));
      CHECK(m->weight.b == Approx(reflected(double(height), {1.442, 1.603})).epsilon(2e-3));
    }
}

TEST_CASE("a surface without colour absorbs", "[brdf]") {
  const Value black = colourValue(0, 0, 0);
  const Value none = numberValue(0);
  const BrdfCase cases[] = {
      brdfCase("phong", {}),
      brdfCase("mirror", {{"specular", black}}),
      brdfCase("glass", {{"specular", black}, {"transmission", black}}),
      brdfCase("principled", {{"base_color", black}, {"specular", none}}),
  };
  Random r(5);
  for (const BrdfCase& c : cases)
    for (int i = 0; i < 1000; ++i) {
      const ScatterPoint p = c.at(aboveSurface(r), false);
      const auto s = c.brdf->sample(p, numbers(r));
      REQUIRE((!s || isBlack(s->weight)));
      REQUIRE(isBlack(c.brdf->eval(p, anywhere(r))));
    }
}
