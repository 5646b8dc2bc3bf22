// SPDX-License-Identifier: Apache-2.0
// The judge blames what is wrong with a light or a camera, by name, and nothing else.
#include <vestige/delta_light.h>

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

/// A point whose intensity is a table of the cosine, linear between knots that are as fine as the
/// steps of the judge's differences; its slope is that of the piece, times a factor.
class TableLamp final : public PointSource {
 public:
  explicit TableLamp(Real factor) : PointSource({0, Real(0.2), 0}), factor_(factor) {}
  Rgb intensity(Vec3 d) const noexcept override {
    const Real x = place(d), n = std::floor(x);
    return grey(value(n) + (x - n) * (value(n + 1) - value(n)));
  }
  Vec3 logIntensityGradient(Vec3 d) const noexcept override {
    const Real n = std::floor(place(d));
    return {0, 0, factor_ * (value(n + 1) - value(n)) * kKnots / intensity(d).g};
  }

 private:
  static constexpr Real kKnots = 200;  ///< a unit of cosine
  static Real place(Vec3 d) { return (d.z + 1) * kKnots; }
  static Real value(Real n) { return Real(1.1) + std::sin(8 * (n / kKnots - 1)); }
  Real factor_;
};

struct EvenLamp final : PointSource {
  EvenLamp() : PointSource({}) {}
  Rgb intensity(Vec3) const noexcept override { return {1, 1, 1}; }
};

/// Sends no particles.
struct Silent final : Light {
  std::optional<LightSample> sample(const Receiver&, Vec2) const noexcept override { return {}; }
  Real pdf(const Receiver&, const LightHit&) const noexcept override { return 0; }
  Rgb eval(const LightHit&) const noexcept override { return {}; }
  Rgb power() const noexcept override { return {}; }
};

struct OnlyRays final : Camera {
  std::optional<CameraSample> sample(CameraNumbers) const noexcept override { return {}; }
};

judge::Judgement judgedTable(Real factor) {
  const judge::LightCases cases = {{"broken table", std::make_shared<TableLamp>(factor)}};
  return judge::judgeLight(cases, {.samples = 1 << 16});
}

/// The derivatives of a good light left to the interface's defaults.
class Bare final : public Light {
 public:
  explicit Bare(std::shared_ptr<const Light> good) : good_(std::move(good)) {}
  LightTraits traits() const noexcept override { return good_->traits(); }
  const TriangleMesh* geometry() const noexcept override { return good_->geometry(); }
  std::optional<LightSample> sample(const Receiver& r, Vec2 u) const noexcept override {
    return good_->sample(r, u);
  }
  Real pdf(const Receiver& r, const LightHit& h) const noexcept override {
    return good_->pdf(r, h);
  }
  Rgb eval(const LightHit& h) const noexcept override { return good_->eval(h); }
  std::optional<Particle> emit(EmissionNumbers u) const noexcept override { return good_->emit(u); }
  Rgb power() const noexcept override { return good_->power(); }

 private:
  std::shared_ptr<const Light> good_;
};

/// How many of the events differ by more than `allowed`, relative to 1 and to the exact one.
struct Share {
  int events = 0, off = 0;
  void see(Vec3 found, Vec3 exact, double allowed) {
    ++events;
    off += !(double(length(found - exact)) <= allowed * std::max(1.0, double(length(exact))));
  }
};

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

TEST_CASE("judge: a table with fine knots is not blamed, a wrong slope of one is", "[judge]") {
  const judge::Judgement good = judgedTable(1);
  INFO(failures(good));
  CHECK(good.passed());
  checkBlamed(judgedTable(Real(1.2)), "logGradient()");
}

TEST_CASE("light: default derivatives are those written by hand, nearly", "[judge][light]") {
  const double allowed = sizeof(Real) == 8 ? 1e-5 : 1e-2;
  for (const char* name : {"area", "point", "spot", "distant", "environment"}) {
    Share sample, factor, origin, direction;
    for (const judge::LightCase& c : judge::lightCases(pluginNamed("light", name), 4, 3)) {
      const Bare bare(c.light);
      judge::forLightEvents(
          {c}, {.samples = 1 << 12},
          [&](const judge::LightCase&, const Receiver& from, Vec2 u, judge::Random& r) {
            const EmissionNumbers v = {u, r.pair()};
            if (c.light->sample(from, u)) {
              const LightJacobian a = bare.sampleDerivatives(from, u),
                                  b = c.light->sampleDerivatives(from, u);
              const LightLogGradient g = bare.logGradient(from, u),
                                     h = c.light->logGradient(from, u);
              for (int k = 0; k < 2; ++k) sample.see(a.du.c[k], b.du.c[k], allowed);
              for (int k = 0; k < 3; ++k) sample.see(a.dFrom.c[k], b.dFrom.c[k], allowed);
              factor.see({g.du.x, g.du.y, 0}, {h.du.x, h.du.y, 0}, allowed);
              factor.see(g.dFrom, h.dFrom, allowed);
            }
            if (!c.light->emit(v)) return;
            const RayJacobian a = bare.emissionDerivatives(v), b = c.light->emissionDerivatives(v);
            for (int k = 0; k < 4; ++k) {
              origin.see(a.dOrigin[k], b.dOrigin[k], allowed);
              direction.see(a.dDirection[k], b.dDirection[k], allowed);
            }
          });
    }
    for (const auto& [what, share] : {std::pair{"sample", sample},
                                      {"factor", factor},
                                      {"origin", origin},
                                      {"direction", direction}}) {
      INFO(name << ", " << what << ": " << share.off << " of " << share.events);
      CHECK(share.events > 100);
      CHECK(share.off <= 0.03 * share.events);
    }
  }
}

TEST_CASE("light: what it leaves to defaults is known", "[judge][light]") {
  CHECK(detail::lacks<Light, TableLamp>() == 0);
  CHECK(detail::lacks<Light, EvenLamp>() == kLacksLogGradient);
  CHECK(detail::lacks<Light, Silent>() ==
        (kLacksSampleDerivatives | kLacksLogGradient | kLacksEmission));
  CHECK(detail::lacks<Camera, OnlyRays>() == (kLacksSampleDerivatives | kLacksPdf));
  CHECK(detail::lacks<Light, Bare>() ==
        (kLacksSampleDerivatives | kLacksLogGradient | kLacksEmissionDerivatives));
  CHECK(detail::lacks<Camera, AsGoodCamera>() == 0);
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
