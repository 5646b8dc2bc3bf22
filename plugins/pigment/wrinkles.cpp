// SPDX-License-Identifier: Apache-2.0
// Like leather or crumpled paper.
#include <vestige/plugin.h>
#include <vestige/tools/pattern_noise.h>

namespace vestige {

/// POV-Ray's `wrinkles`: t = 1/2 sum (1/2 + noise(2^i p)) / 2^i over ten octaves, each cut to
/// [0, 1]. The coarsest folds are about one unit.
class Wrinkles final : public Pigment {
 public:
  static Schema schema() {
    return {"pigment",
            "wrinkles",
            "like leather or crumpled paper",
            {rgb("first", 0).place().doc("where the noise is lowest"),
             rgb("second", 1).place().doc("where it is highest"),
             integer("seed", 0).range(0, 4294967295.0).doc("another seed, another sheet")}};
  }

  explicit Wrinkles(const Values& v)
      : first_(v.rgb(0)), second_(v.rgb(1)), seed_(std::uint32_t(v.integer(2))) {}

  Rgba eval(const Lookup& at) const noexcept override {
    Real t = kMean, share = Real(0.5);
    PatternFootprint p(at);
    for (int i = 0; i < kOctaves; ++i, p = scaled(p, 2), share *= Real(0.5))
      t += share * octaveOver(p, octaveSeed(seed_, i), Real(0.5),
                              [](Real n) { return std::clamp(Real(0.5) + n, Real(0), Real(1)); });
    return mixed(std::clamp(t, Real(0), Real(1)));
  }

  Rgba mean() const noexcept override { return mixed(kMean); }

 private:
  static constexpr int kOctaves = 10;
  static constexpr Real kMean = Real(0.5) * (1 - Real(1) / 1024);  // of the sum of 1/2^i, halves

  Rgba mixed(Real t) const noexcept { return {first_ + t * (second_ - first_), 1}; }

  Rgb first_, second_;
  std::uint32_t seed_;
};

}  // namespace vestige

VESTIGE_PLUGIN(vestige::Pigment, vestige::Wrinkles)
