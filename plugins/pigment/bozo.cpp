// SPDX-License-Identifier: Apache-2.0
// Soft random blobs of one size.
#include <vestige/plugin.h>
#include <vestige/tools/pattern_noise.h>

namespace vestige {

/// POV-Ray's `bozo`: one octave of noise, t = 1/2 + noise(p) / 2 within [0, 1], with a spread of
/// 0.13. One blob is about one unit.
class Bozo final : public Pigment {
 public:
  static Schema schema() {
    return {"pigment",
            "bozo",
            "soft random blobs of one size",
            {rgb("first", 0).place().doc("where the noise is lowest"),
             rgb("second", 1).place().doc("where it is highest"),
             integer("seed", 0).range(0, 4294967295.0).doc("another seed, another arrangement")}};
  }

  explicit Bozo(const Values& v)
      : first_(v.rgb(0)), second_(v.rgb(1)), seed_(std::uint32_t(v.integer(2))) {}

  Rgba eval(const Lookup& at) const noexcept override {
    const Real n = octaveOver(PatternFootprint(at), seed_, 0, [](Real x) { return x; });
    return mixed(std::clamp(Real(0.5) + Real(0.5) * n, Real(0), Real(1)));
  }

  Rgba mean() const noexcept override { return mixed(Real(0.5)); }

 private:
  Rgba mixed(Real t) const noexcept { return {first_ + t * (second_ - first_), 1}; }

  Rgb first_, second_;
  std::uint32_t seed_;
};

}  // namespace vestige

VESTIGE_PLUGIN(vestige::Pigment, vestige::Bozo)
