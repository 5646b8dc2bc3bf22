// SPDX-License-Identifier: Apache-2.0
// What every BRDF has to keep of the contract in brdf.h, tried on every BRDF library found, whoever
// wrote it, over ranges and awkward corners of its parameters.
//
// sample(), pdf() and sampleDerivatives() are three independent statements about one map:
//     sample and pdf           chi-square
//     pdf and derivative       |du.c0 x du.c1| lobePdf = 1
//     sample and derivative    finite differences
// A fault in one of them breaks two of these tests, which names the culprit. eval() is held by its
// quotient with pdf(), by energy and by reciprocity; logGradient() by differences of eval().
//
// A failure prints the worst event: plugin, parameters, directions and random numbers.
#include "support/brdf_cases.h"
#include "support/catch.h"
#include "support/statistics.h"
#include "support/trusted_difference.h"

using namespace vestige;
using namespace vestige::test;

namespace {

constexpr bool kDouble = sizeof(Real) == 8;
constexpr double kEpsilon = double(std::numeric_limits<Real>::epsilon());

double relative(double value, double expected) {
  return std::abs(value - expected) / std::max(std::abs(expected), 1e-30);
}
double relative(Rgb value, Rgb expected) {
  const Rgb d = value - expected;
  return maxComponent({std::abs(d.r), std::abs(d.g), std::abs(d.b)}) /
         std::max(double(maxComponent(expected)), 1e-30);
}

/// How much a number that depends on both directions changes, relatively, when each moves by a few
/// units of rounding: what narrow lobes, grazing angles and the edge of total reflection do to the
/// best of implementations.
template <class F>
double wobble(const ScatterPoint& p, Vec3 toNext, const F& f) {
  constexpr double kRounding = 4 * kEpsilon;
  const double value = std::max(double(f(p, toNext)), 1e-30);
  double most = 0;
  for (int i = 0; i < 4; ++i) {
    const double angle = i * double(kPi) / 2;
    const ScatterPoint q = {turned(p.toPrev, tangent(p.toPrev, angle), kRounding), p.inside,
                            p.inputs};
    const Vec3 d = turned(toNext, tangent(toNext, angle), kRounding);
    most = std::max(most, std::abs(double(f(q, toNext)) - value) / value);
    most = std::max(most, std::abs(double(f(p, d)) - value) / value);
  }
  return most;
}
double pdfTolerance(const BrdfCase& c, const ScatterPoint& p, Vec3 toNext) {
  const auto pdf = [&](const ScatterPoint& q, Vec3 d) { return c.brdf->pdf(q, d); };
  return (kDouble ? 1e-9 : 1e-3) + 4 * wobble(p, toNext, pdf);
}
double evalTolerance(const BrdfCase& c, const ScatterPoint& p, Vec3 toNext) {
  const auto f = [&](const ScatterPoint& q, Vec3 d) { return maxComponent(c.brdf->eval(q, d)); };
  return (kDouble ? 1e-9 : 1e-3) + 4 * wobble(p, toNext, f);
}

std::string told(const char* what, double value, double expected) {
  std::ostringstream text;
  text.precision(9);
  text << what << " " << value << ", expected " << expected;
  return text.str();
}

/// Random events of all cases: f(case, point, numbers, random).
template <class F>
void forEvents(const std::vector<BrdfCase>& cases, int eventsPerCase, const F& f) {
  Random r(1);
  for (const BrdfCase& c : cases)
    for (int i = 0; i < eventsPerCase; ++i) {
      const ScatterPoint p = c.at(aboveSurface(r), i % 2 == 1);
      f(c, p, numbers(r), r);
    }
}

void check(const WorstEvent& worst) {
  INFO(worst.event);
  CHECK(worst.events > 0);
  CHECK(worst.error <= 1);
}

// ------------------------------------------------------------------------------ sample and pdf

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
  checkGoodness(brdfCases(12), 1 << 19, 10);
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

// ----------------------------------------------------------------------------- derivatives

namespace {

constexpr double kMapStep = kDouble ? 1e-3 : 1e-2;
constexpr double kMapTolerance = kDouble ? 1e-6 : 4e-3;

/// toNext of one lobe, as a map from anything that moves an event a little.
std::optional<Vec3> within(const BrdfCase& c, const ScatterPoint& p, ScatterNumbers n, int lobe) {
  const auto s = c.brdf->sample(p, n);
  return s && s->lobe == lobe ? std::optional(s->toNext) : std::nullopt;
}

}  // namespace

TEST_CASE("the derivative's area is the density's inverse", "[brdf][derivatives]") {
  WorstEvent worst;
  forEvents(brdfCases(), 2000, [&](const BrdfCase& c, auto& p, ScatterNumbers n, Random&) {
    const auto s = c.brdf->sample(p, n);
    if (!s) return;
    const Mat3x2 du = c.brdf->sampleDerivatives(p, n).du;
    const double area = double(length(cross(du.c[0], du.c[1])) * s->lobePdf);
    if (s->specular) {
      worst.see(area > 0 ? 2 : 0, [&] { return eventLine(c, p, n, "specular, but du is not 0"); });
      return;
    }
    // Columns that are almost parallel cancel in their product.
    const double stretch = double(length(du.c[0]) * length(du.c[1]) * s->lobePdf);
    const double allowed = (kDouble ? 1e-9 : 1e-3) + 20 * kEpsilon * stretch;
    worst.see(std::abs(area - 1) / allowed,
              [&] { return eventLine(c, p, n, told("|du0 x du1| lobePdf", area, 1)); });
  });
  check(worst);
}

TEST_CASE("du is the derivative of the sampling map by its numbers", "[brdf][derivatives]") {
  WorstEvent worst;
  int asked = 0, judged = 0;
  forEvents(brdfCases(), 2000, [&](const BrdfCase& c, auto& p, ScatterNumbers n, Random& r) {
    const auto s = c.brdf->sample(p, n);
    if (!s || s->specular || !differsSmoothly(n.u, Real(0.03))) return;
    const Mat3x2 du = c.brdf->sampleDerivatives(p, n).du;
    const double size = double(std::max(length(du.c[0]), length(du.c[1])));
    const double angle = 2 * double(kPi * r.number());
    const Vec2 along = {Real(std::cos(angle)), Real(std::sin(angle))};
    const auto map = [&](double h) {
      return within(c, p, {n.lobe, n.u + Real(h) * along}, s->lobe);
    };
    ++asked;
    const auto expected = trustedDifference(map, kMapStep, kMapTolerance * size);
    if (!expected) return;
    ++judged;
    worst.see(sizeOf(du * along - *expected) / (kMapTolerance * size), [&] {
      return eventLine(c, p, n, told("|du|", sizeOf(du * along), sizeOf(*expected)));
    });
  });
  check(worst);
  CHECK(judged > asked / 3);
}

TEST_CASE("dPrev is the derivative of the sampling map by toPrev", "[brdf][derivatives]") {
  // A lobe built in a frame around its axis may turn that frame as it likes; the derivative is the
  // one without spin, so the frame's own spin is taken out of the differences. A lobe that is not
  // built so has no spin to take out. Which of the two a lobe is, it has to be at every event.
  std::map<std::string, std::array<WorstEvent, 2>> lobes;
  int asked = 0, judged = 0;
  forEvents(brdfCases(), 2000, [&](const BrdfCase& c, auto& p, ScatterNumbers n, Random& r) {
    const auto s = c.brdf->sample(p, n);
    if (!s || p.toPrev.z < Real(0.05)) return;
    const ScatterJacobian j = c.brdf->sampleDerivatives(p, n);
    const Vec3 along = tangent(p.toPrev, 2 * double(kPi * r.number()));
    const auto moved = [&](double h) { return c.at(turned(p.toPrev, along, h), p.inside); };
    const auto asIs = [&](double h) { return within(c, moved(h), n, s->lobe); };
    const auto frame = lobeFrame(*c.brdf, p, n.lobe);
    const auto unspun = [&](double h) -> std::optional<Vec3> {
      const auto toNext = asIs(h);
      const auto there = lobeFrame(*c.brdf, moved(h), n.lobe);
      if (!toNext || !there || !frame) return std::nullopt;
      const Vec3 local = there->toLocal(*toNext);
      return transport(frame->n, there->n, frame->toWorld(local));
    };
    const Vec3 found = j.dPrev * along;
    const double step = kMapStep * double(p.toPrev.z);
    const double allowed = kMapTolerance * std::max(1.0, sizeOf(found));
    auto& [direct, transported] = lobes[c.plugin + " lobe " + std::to_string(s->lobe)];
    const auto judge = [&](WorstEvent& worst, const std::optional<Vec3>& expected) {
      if (!expected) return;
      worst.see(sizeOf(found - *expected) / allowed, [&] {
        std::ostringstream text;
        text << "dPrev " << along << " gives " << found << ", expected " << *expected;
        return eventLine(c, p, n, text.str());
      });
    };
    ++asked;
    const auto plain = trustedDifference(asIs, step, allowed);
    judged += plain.has_value();
    judge(direct, plain);
    if (frame && !s->specular) judge(transported, trustedDifference(unspun, step, allowed));
  });
  CHECK(judged > asked / 3);
  for (const auto& [lobe, worst] : lobes) {
    INFO(lobe);
    const bool spins = worst[1].events > 0 && worst[1].error < worst[0].error;
    check(worst[spins ? 1 : 0]);
  }
}

TEST_CASE("logGradient is the derivative of log f", "[brdf][derivatives]") {
  WorstEvent worst;
  int asked = 0, judged = 0;
  forEvents(brdfCases(), 2000, [&](const BrdfCase& c, auto& p, ScatterNumbers n, Random& r) {
    Vec3 toNext = anywhere(r);  // as a light would choose it; or as the BRDF does
    if (r.number() < Real(0.5))
      if (const auto s = c.brdf->sample(p, n)) toNext = s->toNext;
    const LogGradient g = c.brdf->logGradient(p, toNext);
    if (!(luminance(c.brdf->eval(p, toNext)) > 0)) {
      const double size = sizeOf(g.dPrev) + sizeOf(g.dNext);
      worst.see(size > 0 ? 2 : 0, [&] { return eventLine(c, p, n, "f is zero, its slope not"); });
      return;
    }
    const double sharp = std::sqrt(double(c.brdf->pdf(p, toNext)));
    for (const bool next : {false, true}) {
      const Vec3 from = next ? toNext : p.toPrev;
      const Vec3 along = tangent(from, 2 * double(kPi * r.number()));
      const auto logF = [&](double h) -> std::optional<Real> {
        const Vec3 d = turned(from, along, h);
        const ScatterPoint q = next ? p : c.at(d, p.inside);
        if (q.toPrev.z <= 0) return std::nullopt;
        const Real f = luminance(c.brdf->eval(q, next ? d : toNext));
        return f > Real(1e-25) ? std::optional(std::log(f)) : std::nullopt;
      };
      const double found = double(dot(next ? g.dNext : g.dPrev, along));
      // A step is a fraction of the lobe's width, or of the height above the horizon.
      const double width = 1 / (1 + sharp + std::abs(found) + 1 / sizeOf(from.z));
      const double step = (kDouble ? 1e-2 : 0.1) * width;
      const double allowed = kMapTolerance / width;
      const auto f = [&](const ScatterPoint& q, Vec3 d) { return luminance(c.brdf->eval(q, d)); };
      const double noise = 2 + wobble(p, toNext, f) / kEpsilon;
      ++asked;
      const auto expected = trustedDifference(logF, step, allowed, noise);
      if (!expected) continue;
      ++judged;
      worst.see(std::abs(found - double(*expected)) / allowed, [&] {
        std::ostringstream text;
        text << told(next ? "slope by next" : "slope by prev", found, double(*expected))
             << ", toNext " << toNext;
        return eventLine(c, p, n, text.str());
      });
    }
  });
  check(worst);
  CHECK(judged > asked / 3);
}

// ------------------------------------------------------------------------------------ fuzz

namespace {

/// Numbers that a sampler may draw, the ends of the interval often.
Real harsh(Random& r) {
  switch (int(r.number() * 8)) {
    case 0:
      return 0;
    case 1:
      return kOneMinusEpsilon;
    case 2:
      return Real(0.5);
    default:
      return r.number();
  }
}

/// Heights down to the smallest number, often.
Vec3 harshDirection(Random& r) {
  const Real z = r.number() < Real(0.25) ? Real(1) : std::pow(Real(10), -36 * sqr(harsh(r)));
  return r.number() < Real(0.1) ? Vec3{0, 0, 1} : atHeight(z, r);
}

bool isFinite(const Mat3& m) { return isFinite(m.c[0]) && isFinite(m.c[1]) && isFinite(m.c[2]); }
bool isColour(Rgb c) { return isFinite(c) && c.r >= 0 && c.g >= 0 && c.b >= 0; }
bool isDensity(Real x) { return std::isfinite(x) && x >= 0; }

/// The promise that a sample breaks, or "".
std::string brokenPromise(const ScatterSample& s) {
  if (!(std::abs(length(s.toNext) - 1) < Real(1e-3))) return "toNext is no unit vector";
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
  if (s && !(isFinite(j.du.c[0]) && isFinite(j.du.c[1]))) return "du is not finite";
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

void fuzz(int events) {
  const std::vector<BrdfCase> cases = brdfCases(40);
  Random r(6);
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
