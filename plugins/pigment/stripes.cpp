// SPDX-License-Identifier: Apache-2.0
// Two colours in turn along a direction.
#include <vestige/plugin.h>
#include <vestige/tools/pattern_filter.h>

namespace vestige {

/// The first colour where the fraction of t = p . direction is below 1 - width, else the second.
/// The direction's length counts: <0, 2, 0> repeats twice a unit. The mean over a footprint is
/// exact.
class Stripes final : public Pigment {
 public:
  static Schema schema() {
    return {"pigment",
            "stripes",
            "two colours in turn along a direction",
            {rgb("first", 0).place().doc("from where p . direction is a whole number"),
             rgb("second", 1).place().doc("from there to the next"),
             vec3("direction", {1, 0, 0}).doc("across the stripes; once per 1/length of it"),
             real("width", 0.5).range(0, 1).doc("share of the second colour")}};
  }

  explicit Stripes(const Values& v)
      : first_(v.rgb(0)), second_(v.rgb(1)), direction_(v.vec3(2)), wave_{1 - double(v.real(3))} {
    if (!(lengthSquared(direction_) > 0))
      throw PluginError(2, "the direction of stripes must not be <0, 0, 0>");
  }

  Rgba eval(const Lookup& at) const noexcept override {
    const Widths widths{dot(at.footprint.dP[0], direction_), dot(at.footprint.dP[1], direction_)};
    return mixed(filtered(wave_, dot(at.position, direction_), widths));
  }

  Rgba mean() const noexcept override { return mixed(wave_.mean()); }

 private:
  Rgba mixed(double first) const noexcept {
    return {second_ + Real(first) * (first_ - second_), 1};
  }

  Rgb first_, second_;
  Vec3 direction_;
  PulseWave wave_;  ///< of the first colour
};

}  // namespace vestige

VESTIGE_PLUGIN(vestige::Pigment, vestige::Stripes)
