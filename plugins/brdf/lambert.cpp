// SPDX-License-Identifier: Apache-2.0
// Matt: the same radiance in every direction, from either side.
//
//     f(prev, next) = diffuse / pi
#include <vestige/brdf.h>
#include <vestige/plugin.h>
#include <vestige/sampling.h>

namespace vestige {
namespace {

class Lambert final : public Brdf {
 public:
  enum Input { kDiffuse };

  static Schema schema() {
    return {.kind = "brdf",
            .name = "lambert",
            .summary = "matt: the same radiance in every direction",
            .inputs = {rgb("diffuse", 0.5).range(0, 1).doc("reflected fraction")}};
  }

  Rgb eval(const ScatterPoint& p, Vec3 toNext) const noexcept override {
    return toNext.z > 0 ? p.inputs.rgb(kDiffuse) / kPi : Rgb{};
  }

  std::optional<ScatterSample> sample(const ScatterPoint& p,
                                      ScatterNumbers n) const noexcept override {
    const Vec3 toNext = cosineHemisphere(n.u).d;
    const Real density = toNext.z / kPi;
    return ScatterSample{.toNext = toNext,
                         .weight = p.inputs.rgb(kDiffuse),
                         .pdf = density,
                         .lobePdf = density,
                         .lobeChance = 1,
                         .lobe = 0,
                         .specular = false};
  }

  Real pdf(const ScatterPoint&, Vec3 toNext) const noexcept override {
    return std::max(toNext.z, Real(0)) / kPi;
  }

  /// The direction depends on the normal alone.
  ScatterJacobian sampleDerivatives(const ScatterPoint&, ScatterNumbers n) const noexcept override {
    return {.du = cosineHemisphere(n.u).du, .dPrev = {}};
  }

  MattPart matt(const ScatterPoint& p) const noexcept override {
    return {p.inputs.rgb(kDiffuse), true};
  }

  LogGradient logGradient(const ScatterPoint&, Vec3) const noexcept override { return {}; }
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Brdf, vestige::Lambert)
