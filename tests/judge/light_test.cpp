// SPDX-License-Identifier: Apache-2.0
// The judge blames what is wrong with a light or a camera, by name, and nothing else.
#include "blamed.h"
#include "broken_light.h"
#include "support/plugins.h"

using namespace vestige;
using namespace vestige::test;

namespace {

constexpr judge::Effort kEffort = {.samples = 1 << 13};

template <class Broken>
judge::Judgement judgedLight(const std::string& name) {
  judge::LightCases cases = judge::lightCases(pluginNamed("light", name), 3, 1);
  for (judge::LightCase& c : cases) c = {"broken " + c.title, std::make_shared<Broken>(c.light)};
  return judge::judgeLight(cases, kEffort);
}

template <class Broken>
judge::Judgement judgedCamera(const std::string& name) {
  judge::CameraCases cases = judge::cameraCases(pluginNamed("camera", name), 3, 1);
  for (judge::CameraCase& c : cases) c = {"broken " + c.title, std::make_shared<Broken>(c.camera)};
  return judge::judgeCamera(cases, kEffort);
}

void checkBuiltIn(unsigned seed) {
  for (const char* kind : {"light", "camera"})
    for (const LoadedPlugin& plugin : pluginsOfKind(kind)) {
      const judge::Judgement j = judge::judgePlugin(plugin, {.samples = 1 << 13, .seed = seed});
      INFO(plugin.name << ", seed " << seed << "\n" << failures(j));
      CHECK(j.passed());
      CHECK(j.unchecked.empty() == (plugin.name != "environment"));
      CHECK(j.timings.size() == (plugin.kind == "light" ? 7 : 3));
      CHECK(j.verdicts.size() > 4);
    }
}

}  // namespace

TEST_CASE("judge: lights that are wrong", "[judge][light]") {
  for (const char* name : {"area", "point", "environment"}) {
    INFO(name);
    checkBlamed(judgedLight<PowerByPi>(name), "power()");
    checkBlamed(judgedLight<DimParticles>(name), "emit()");
    checkBlamed(judgedLight<WrongEmission>(name), "emissionDerivatives()");
  }
  checkBlamed(judgedLight<PdfByArea>("area"), "pdf()");
  checkBlamed(judgedLight<ForgottenFrom>("spot"), "sampleDerivatives().dFrom");
  checkBlamed(judgedLight<NoLightGradient>("spot"), "logGradient()");
}

TEST_CASE("judge: cameras that are wrong", "[judge][camera]") {
  checkBlamed(judgedCamera<WrongUnits>("pinhole"), "sampleDerivatives()");
  checkBlamed(judgedCamera<WrongUnits>("panorama"), "sampleDerivatives()");
  checkBlamed(judgedCamera<NanWeight>("thin_lens"), "sample().weight");
  checkBlamed(judgedCamera<WrongCameraPdf>("pinhole"), "pdf()");
  checkBlamed(judgedCamera<WideRays>("pinhole"), "sample()");
  checkBlamed(judgedCamera<PdfOfEverything>("pinhole"), "pdf()");
}

TEST_CASE("judge: kinds without tests of their own", "[judge]") {
  for (const char* kind : {"pigment", "shape", "integrator"})
    for (const LoadedPlugin& plugin : pluginsOfKind(kind)) {
      const judge::Judgement j = judge::judgePlugin(plugin, kEffort);
      INFO(plugin.file << "\n" << failures(j));
      CHECK(j.passed());
      CHECK_THAT(j.unchecked, containsText("no tests for the methods of a"));
    }
}

TEST_CASE("judge: no false alarm on lights and cameras", "[judge]") { checkBuiltIn(1); }

TEST_CASE("judge: no false alarm on lights and cameras, five seeds", "[judge][slow]") {
  for (unsigned seed = 1; seed <= 5; ++seed) checkBuiltIn(seed);
}
