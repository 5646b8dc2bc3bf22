// SPDX-License-Identifier: Apache-2.0
// The judge blames what is wrong, by name, and nothing else.
#include "blamed.h"
#include "broken.h"
#include "support/brdf_cases.h"

using namespace vestige;
using namespace vestige::test;

namespace {

const Value kGrey = colourValue(0.7, 0.7, 0.7);

/// A library with one set of parameters and one method spoilt.
template <class Broken, class... More>
judge::Judgement judged(const std::string& name, const Settings& settings, More... more) {
  BrdfCase c = brdfCase(name, settings);
  c.brdf = std::make_shared<Broken>(c.brdf, more...);
  c.plugin = "broken";
  return judge::judgeBrdf({c}, nullptr, {});
}

template <class How>
judge::Judgement judgedSample(How how) {
  return judged<SpoiltSample<How>>("phong", {{"specular", kGrey}, {"exponent", numberValue(8)}},
                                   how);
}

const Settings kGlossy = {{"specular", kGrey}, {"exponent", numberValue(8)}};
const Settings kDiffuse = {{"diffuse", kGrey}};
const Settings kRough = {{"alpha", numberValue(0.3)}};

void checkBuiltIn(unsigned seed) {
  for (const LoadedPlugin& plugin : pluginsOfKind("brdf")) {
    const judge::Effort effort = {.samples = 1 << 13, .seed = seed};
    const auto cases = judge::brdfCases(plugin, 2, seed);
    const judge::Judgement j = judge::judgeBrdf(cases, plugin.schema, effort);
    INFO(plugin.name << ", seed " << seed << "\n" << failures(j));
    CHECK(j.passed());
    CHECK(j.timings.size() == 5);
  }
}

}  // namespace

TEST_CASE("judge: pdf() that is wrong", "[judge][brdf]") {
  const judge::Judgement j = judged<HalfPdf>("phong", kGlossy);
  checkBlamed(j, "evaluate().pdf");
  CHECK_THAT(failures(j), containsText("times as often as evaluate().pdf predicts"));
  checkBlamed(judged<UniformPdf>("lambert", kDiffuse), "evaluate().pdf");
}

TEST_CASE("judge: sample() that is wrong", "[judge][brdf]") {
  checkBlamed(judgedSample([](ScatterSample& s) { s.weight = s.weight / s.toNext.z; }),
              "sample().weight");
  checkBlamed(judgedSample([](ScatterSample& s) { s.lobePdf = s.pdf / 2; }), "sample().lobePdf");
  checkBlamed(judgedSample([](ScatterSample& s) { s.pdf = s.pdf * Real(1.1); }), "sample().pdf");
  checkBlamed(judged<BiasedSample>("lambert", kDiffuse), "sample()");
  checkBlamed(judged<HiddenLobe>("lambert", kDiffuse), "usesLobeNumber()");
}

TEST_CASE("judge: derivatives that are wrong", "[judge][brdf]") {
  checkBlamed(judged<WrongSign>("phong", kGlossy), "sampleDerivatives().du");
  checkBlamed(judged<ForgottenPrev>("phong", kGlossy), "sampleDerivatives().dPrev");
  checkBlamed(judged<PolarPole>("lambert", kDiffuse), "sampleDerivatives().du");
  checkBlamed(judged<WrongLogGradient>("rough_conductor", kRough), "logGradient()");
}

TEST_CASE("judge: values that are wrong", "[judge][brdf]") {
  checkBlamed(judged<SwappedEta>("rough_dielectric", kRough), "etaScale()");
  checkBlamed(judged<SwappedEta>("glass", {}), "etaScale()");
  checkBlamed(judged<EnergyGain>("phong", kGlossy), "evaluate().fCos");
  checkBlamed(judged<OneWay>("phong", kGlossy), "evaluate().fCos");
  checkBlamed(judged<NanAtGrazing>("phong", kGlossy), "evaluate().fCos");
  checkBlamed(judged<TooDiffuse>("lambert", kDiffuse), "diffuse()");
}

TEST_CASE("judge: a state that threads share", "[judge][brdf]") {
  checkBlamed(judged<SharedState>("phong", kGlossy), "sampleDerivatives()");
}

TEST_CASE("judge: no false alarm on BRDFs", "[judge][brdf]") { checkBuiltIn(1); }

TEST_CASE("judge: no false alarm on BRDFs, five seeds", "[judge][brdf][slow]") {
  for (unsigned seed = 1; seed <= 5; ++seed) checkBuiltIn(seed);
}
