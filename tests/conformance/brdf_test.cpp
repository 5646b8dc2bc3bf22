// SPDX-License-Identifier: Apache-2.0
// What every BRDF has to keep of the contract in brdf.h, tried on every BRDF library found, whoever
// wrote it, over ranges and awkward corners of its parameters. The tests themselves are the judge's
// (judge/brdf_tests.h), which `vestige plugin test` runs for authors of plugins.
//
// A failure prints the worst event: plugin, parameters, directions and random numbers.
#include <complex>

#include "judge/brdf_tests.h"
#include "support/brdf_events.h"

using namespace vestige;
using namespace vestige::test;

namespace {

/// 2000 events of every set of parameters.
constexpr judge::Effort kEffort = {.samples = 1 << 15};

}  // namespace

TEST_CASE("samples are distributed as pdf says", "[brdf][chi2]") {
  const judge::DensityFindings f = judge::samplesFollowPdf(brdfCases(2), {.falseAlarm = 0.01});
  check(f.distribution);
  check(f.mass);
}

TEST_CASE("samples are distributed as pdf says, with many samples", "[brdf][chi2][slow]") {
  const judge::DensityFindings f =
      judge::samplesFollowPdf(brdfCases(8), {.samples = 1 << 18, .falseAlarm = 0.01, .depth = 10});
  check(f.distribution);
  check(f.mass);
}

TEST_CASE("a sample knows its own pdf", "[brdf]") {
  check(judge::samplesKnowTheirPdf(brdfCases(), kEffort));
  check(judge::lobesArePartsOfPdf(brdfCases(), kEffort));
}

// ----------------------------------------------------------------------------------- eval

TEST_CASE("the weight is f cos / pdf", "[brdf]") {
  check(judge::weightIsTheQuotient(brdfCases(), kEffort));
}

TEST_CASE("no surface gives back more than it gets", "[brdf][energy]") {
  check(judge::noEnergyIsGained(brdfCases(), kEffort));
}

TEST_CASE("the diffuse part is no more than there is, and all where it says so", "[brdf][energy]") {
  check(judge::diffusePartIsNoMoreThanThereIs(brdfCases(), kEffort));
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
    for (const bool behind : {false, true}) {
      Rgb sum;
      for (int i = 0; i < 1 << 14; ++i)
        if (const auto s = c.brdf->sample(c.at({0, 0, 1}, behind), numbers(r))) sum += s->weight;
      INFO(c.title());
      CHECK(relative(sum / Real(1 << 14), grey(1)) < 1e-3);
    }
}

TEST_CASE("f(b, a) = etaScale(a, b) f(a, b)", "[brdf][reciprocity]") {
  check(judge::isReciprocal(brdfCases(), kEffort, false));
  const judge::Finding across = judge::isReciprocal(brdfCases(), kEffort, true);
  check(across);
  CHECK(across.worst.events > 1000);
}

TEST_CASE("etaScale is the square of the indices' quotient, as Snell's law has it",
          "[brdf][reciprocity]") {
  check(judge::etaScaleFollowsSnell(brdfCases(), kEffort));
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
    for (const bool behind : {false, true}) {
      const double index = behind ? 1 / 1.5 : 1.5;
      const double f = reflected(double(height), index);
      const Vec3 toPrev = atHeight(height, r);
      for (const BrdfCase& c : clear) {
        INFO(c.title() << " at height " << height << (behind ? " inside" : " outside"));
        const auto low = c.brdf->sample(c.at(toPrev, behind), {0, middle});
        REQUIRE(low);
        CHECK(low->lobeChance == Approx(f).epsilon(3e-3));
        const auto high = c.brdf->sample(c.at(toPrev, behind), {kOneMinusEpsilon, middle});
        REQUIRE(high);
        CHECK((high->toNext.z > 0) == (f == 1));
        if (f < 1)
          CHECK(length(Real(index) * cross(high->toNext, {0, 0, 1}) +  //
                       cross(toPrev, {0, 0, 1})) < 2e-3);
      }
      const BrdfCase through =
          brdfCase("phong", {{"transmission", white}, {"exponent", numberValue(1e6)}});
      const auto s = through.brdf->sample(through.at(toPrev, behind), {0, middle});
      CHECK(bool(s) == (f < 1));
      if (s)
        CHECK(length(Real(index) * cross(s->toNext, {0, 0, 1}) + cross(toPrev, {0, 0, 1})) < 2e-3);
      const BrdfCase gold = brdfCase("rough_conductor", {{"alpha", none},
                                                         {"eta", colourValue(0.143, 0.375, 1.442)},
                                                         {"k", colourValue(3.983, 2.386, 1.603)}});
      const auto m = gold.brdf->sample(gold.at(toPrev, behind), {0, middle});
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
      REQUIRE(isBlack(c.brdf->f(p, anywhere(r))));
    }
}
