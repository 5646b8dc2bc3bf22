// SPDX-License-Identifier: Apache-2.0
// A library that loads, and whose pdf() is half of what it should be: for `vestige plugin test`.
#include <vestige/brdf.h>
#include <vestige/plugin.h>
#include <vestige/sampling.h>

namespace vestige {
namespace {

class HalfPdf final : public Brdf {
 public:
  static Schema schema() {
    return {.kind = "brdf",
            .name = "half_pdf",
            .summary = "matt, with a wrong density",
            .inputs = {rgb("diffuse", 0.5).range(0, 1).doc("reflected fraction")}};
  }
  Rgb eval(const ScatterPoint& p, Vec3 toNext) const noexcept override {
    return toNext.z > 0 ? p.inputs.rgb(0) / kPi : Rgb{};
  }
  std::optional<ScatterSample> sample(const ScatterPoint& p,
                                      ScatterNumbers n) const noexcept override {
    const Vec3 toNext = cosineHemisphere(n.u).d;
    return ScatterSample{toNext, p.inputs.rgb(0), toNext.z / kPi, toNext.z / kPi, 1, 0, false};
  }
  Real pdf(const ScatterPoint&, Vec3 toNext) const noexcept override {
    return std::max(toNext.z, Real(0)) / (2 * kPi);
  }
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Brdf, vestige::HalfPdf)
