// SPDX-License-Identifier: Apache-2.0
// Fine grains and cracks.
#include <vestige/plugin.h>
#include <vestige/tools/pattern_noise.h>

namespace vestige {

/// POV-Ray's `granite`: t = sum |noise(4 2^i p)| / 2^i over six octaves, at most 1; dark where the
/// noise changes sign. The coarsest grains are about 1/4 unit.
class Granite final : public Pigment {
 public:
  static Schema schema() {
    return {"pigment",
            "granite",
            "fine grains and cracks",
            {rgb("first", 0).place().doc("in the cracks"),
             rgb("second", 1).place().doc("in the grains"),
             integer("seed", 0).range(0, 4294967295.0).doc("another seed, another block")}};
  }

  explicit Granite(const Values& v)
      : first_(v.rgb(0)), second_(v.rgb(1)), seed_(std::uint32_t(v.integer(2))) {}

  Rgba eval(const Lookup& at) const noexcept override {
    Real t = kMean, share = 1;
    PatternFootprint p = scaled(PatternFootprint(at), 4);
    for (int i = 0; i < kOctaves; ++i, p = scaled(p, 2), share *= Real(0.5))
      t += share *
           octaveOver(p, octaveSeed(seed_, i), kNoiseMeanAbs, [](Real n) { return std::abs(n); });
    return mixed(std::clamp(t, Real(0), Real(1)));
  }

  Rgba mean() const noexcept override { return mixed(kMean); }

 private:
  static constexpr int kOctaves = 6;
  static constexpr Real kMean = kNoiseMeanAbs * (2 - Real(1) / 32);  // sum of 1/2^i

  Rgba mixed(Real t) const noexcept { return {first_ + t * (second_ - first_), 1}; }

  Rgb first_, second_;
  std::uint32_t seed_;
};

}  // namespace vestige

VESTIGE_PLUGIN(vestige::Pigment, vestige::Granite)
