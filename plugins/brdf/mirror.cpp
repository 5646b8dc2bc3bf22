// SPDX-License-Identifier: Apache-2.0
// A perfect mirror, from either side.
#include <vestige/brdf.h>
#include <vestige/plugin.h>
#include <vestige/tools/fresnel.h>

namespace vestige {
namespace {

class Mirror final : public Brdf {
 public:
  enum Input { kSpecular };

  static Schema schema() {
    return {.kind = "brdf",
            .name = "mirror",
            .summary = "perfect mirror",
            .inputs = {rgb("specular", 1).range(0, 1).doc("reflected fraction")}};
  }

  ScatterValue evaluate(const ScatterPoint&, Vec3) const noexcept override { return {}; }

  std::optional<ScatterSample> sample(const ScatterPoint& p,
                                      ScatterNumbers) const noexcept override {
    const Rgb specular = p.inputs.rgb(kSpecular);
    if (isBlack(specular)) return std::nullopt;
    return ScatterSample::mirror(reflectAt(p.toPrev, kNormal).direction, specular);
  }

  ScatterJacobian sampleDerivatives(const ScatterPoint& p, ScatterNumbers) const noexcept override {
    return {.du = {}, .dPrev = reflectAt(p.toPrev, kNormal).dPrev()};
  }

  LogGradient logGradient(const ScatterPoint&, Vec3) const noexcept override { return {}; }

  bool usesLobeNumber() const noexcept override { return false; }

 private:
  static constexpr Vec3 kNormal = {0, 0, 1};
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Brdf, vestige::Mirror)
