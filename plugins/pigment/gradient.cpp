// SPDX-License-Identifier: Apache-2.0
// From one colour to another along a direction, again and again.
#include <vestige/plugin.h>
#include <vestige/tools/pattern_filter.h>

namespace vestige {

/// POV-Ray's `gradient`: t = p . direction, of which the part after the point goes from 0 (first
/// colour) to 1 (second) and falls back. The direction's length counts: <0, 2, 0> repeats twice a
/// unit. Its mean over a footprint is exact.
class Gradient final : public Pigment {
 public:
  static Schema schema() {
    return {"pigment",
            "gradient",
            "from one colour to another along a direction, repeating",
            {rgb("first", 0).place().doc("where p . direction is a whole number"),
             rgb("second", 1).place().doc("just below the next"),
             vec3("direction", {0, 1, 0}).doc("once per 1/length of it")}};
  }

  explicit Gradient(const Values& v) : first_(v.rgb(0)), second_(v.rgb(1)), direction_(v.vec3(2)) {
    if (!(lengthSquared(direction_) > 0))
      throw PluginError(2, "the direction of a gradient must not be <0, 0, 0>");
  }

  Rgba eval(const Lookup& at) const noexcept override {
    const Real t = dot(at.position, direction_);
    const Widths widths{dot(at.footprint.dP[0], direction_), dot(at.footprint.dP[1], direction_)};
    if (!widths.isPoint())
      return {first_ + Real(filtered(SawWave{}, t, widths)) * (second_ - first_), 1};
    const Real share = std::min(t - std::floor(t), kOneMinusEpsilon);  // -1e-9 would round to 1
    return {first_ + share * (second_ - first_), 1};
  }

  Rgba mean() const noexcept override { return {Real(0.5) * (first_ + second_), 1}; }

 private:
  Rgb first_, second_;
  Vec3 direction_;
};

}  // namespace vestige

VESTIGE_PLUGIN(vestige::Pigment, vestige::Gradient)
