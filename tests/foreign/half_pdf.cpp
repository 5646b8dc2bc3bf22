// SPDX-License-Identifier: Apache-2.0
// A library that loads, and whose density is half of what it should be: for `vestige plugin test`.
#include <vestige/brdf.h>
#include <vestige/plugin.h>
#include <vestige/tools/sampling.h>

namespace vestige {
namespace {

class HalfPdf final : public Brdf {
 public:
  static Schema schema() {
    return {.kind = "brdf",
            .name = "half_pdf",
            .summary = "diffuse, with a wrong density",
            .inputs = {rgb("diffuse", 0.5).range(0, 1).doc("reflected fraction")}};
  }
  ScatterValue evaluate(const ScatterPoint& p, Vec3 toNext) const noexcept override {
    const Real density = std::max(toNext.z, Real(0)) / kPi;
    return {density * p.inputs.rgb(0), density / 2};
  }
  std::optional<ScatterSample> sample(const ScatterPoint& p,
                                      ScatterNumbers n) const noexcept override {
    const Vec3 toNext = cosineHemisphere(n.u).d;
    return ScatterSample::only(toNext, p.inputs.rgb(0), toNext.z / kPi);
  }
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Brdf, vestige::HalfPdf)
