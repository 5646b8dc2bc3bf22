// SPDX-License-Identifier: Apache-2.0
// Diffuse: the same radiance in every direction, from either side.
//
//     f(prev, next) = diffuse / pi
#include <vestige/brdf.h>
#include <vestige/plugin.h>
#include <vestige/tools/sampling.h>

namespace vestige {
namespace {

class Lambert final : public Brdf {
 public:
  enum Input { kDiffuse };

  static Schema schema() {
    return {.kind = "brdf",
            .name = "lambert",
            .summary = "diffuse: the same radiance in every direction",
            .inputs = {rgb("diffuse", 0.5).range(0, 1).doc("reflected fraction")}};
  }

  ScatterValue evaluate(const ScatterPoint& p, Vec3 toNext) const noexcept override {
    const Real density = std::max(toNext.z, Real(0)) / kPi;
    return {density * p.inputs.rgb(kDiffuse), density};
  }

  std::optional<ScatterSample> sample(const ScatterPoint& p,
                                      ScatterNumbers n) const noexcept override {
    const Vec3 toNext = cosineHemisphere(n.u).d;
    return ScatterSample::only(toNext, p.inputs.rgb(kDiffuse), toNext.z / kPi);
  }

  /// The direction does not depend on toPrev.
  ScatterJacobian sampleDerivatives(const ScatterPoint&, ScatterNumbers n) const noexcept override {
    return {.du = cosineHemisphere(n.u).du, .dPrev = {}};
  }

  bool usesLobeNumber() const noexcept override { return false; }

  DiffusePart diffuse(const ScatterPoint& p) const noexcept override {
    return {p.inputs.rgb(kDiffuse), true};
  }

  LogGradient logGradient(const ScatterPoint&, Vec3) const noexcept override { return {}; }
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Brdf, vestige::Lambert)
