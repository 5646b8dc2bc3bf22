// SPDX-License-Identifier: Apache-2.0
// A phase function, a medium that holds one, and a BRDF that holds the medium: three plugins of one
// file, chosen by STUB_KIND.
#include <vestige/brdf.h>
#include <vestige/medium.h>
#include <vestige/plugin.h>

namespace vestige {
namespace {

/// (1 + a cos) / (4 pi), cos between the directions of travel.
class Lean final : public PhaseFunction {
 public:
  static Schema schema() {
    return {.kind = "phase",
            .name = "lean",
            .summary = "linear in the cosine",
            .params = {real("a", 0).range(-1, 1).doc("1: mostly forwards")}};
  }
  explicit Lean(const Values& v) : a_(v.real(0)) {}
  ScatterValue evaluate(Vec3 toPrev, Vec3 toNext) const noexcept override {
    const Real f = (1 - a_ * dot(toPrev, toNext)) / (4 * kPi);
    return {grey(f), f};
  }
  std::optional<PhaseSample> sample(Vec3, Vec2) const noexcept override { return std::nullopt; }

 private:
  Real a_;
};

class Fog final : public Medium {
 public:
  static Schema schema() {
    return {.kind = "medium",
            .name = "fog",
            .summary = "the same everywhere",
            .params = {real("density", 1).range(0, 1e6).doc("extinction, 1 per scene unit"),
                       block("phase", "phase").doc("how it scatters")}};
  }
  Fog(const Values& v, Host& host) : density_(v.real(0)) {
    if (!v.block(1)) throw PluginError(1, "fog needs a phase function");
    phase_ = host.phase(*v.block(1));
  }
  FreeFlight fly(const Ray& ray, FlightNumbers) const noexcept override {
    return {false, ray.tMax, {1, 1, 1}};
  }
  Rgb transmittance(const Ray& ray, FlightNumbers) const noexcept override {
    return grey(std::exp(-density_ * (ray.tMax - ray.tMin)));
  }
  const PhaseFunction& phase() const noexcept override { return *phase_; }

 private:
  Real density_;
  std::shared_ptr<const PhaseFunction> phase_;
};

/// f |cos| is the transmittance of a unit of the medium, and the density its phase function.
class Foggy final : public Brdf {
 public:
  static Schema schema() {
    return {.kind = "brdf",
            .name = "foggy",
            .summary = "shows the medium that it holds",
            .params = {block("inside", "medium").doc("the medium")}};
  }
  Foggy(const Values& v, Host& host) {
    if (!v.block(0)) throw PluginError(0, "foggy needs a medium");
    medium_ = host.medium(*v.block(0));
  }
  ScatterValue evaluate(const ScatterPoint& p, Vec3 toNext) const noexcept override {
    const Ray unit{{}, toNext, 0, 1};
    return {medium_->transmittance(unit, {}), medium_->phase().evaluate(p.toPrev, toNext).pdf};
  }
  std::optional<ScatterSample> sample(const ScatterPoint&, ScatterNumbers) const noexcept override {
    return std::nullopt;
  }

 private:
  std::shared_ptr<const Medium> medium_;
};

}  // namespace
}  // namespace vestige

#if STUB_KIND == 0
VESTIGE_PLUGIN(vestige::PhaseFunction, vestige::Lean)
#elif STUB_KIND == 1
VESTIGE_PLUGIN(vestige::Medium, vestige::Fog)
#else
VESTIGE_PLUGIN(vestige::Brdf, vestige::Foggy)
#endif
