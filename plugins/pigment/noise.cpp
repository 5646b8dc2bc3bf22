// SPDX-License-Identifier: Apache-2.0
// Smooth random blobs between two colours.
#include <vestige/plugin.h>
#include <vestige/tools/pattern_noise.h>

namespace vestige {

/// t = 1/2 + 1/2 sum omega^i noise(lambda^i p) / sum omega^i, i < octaves, within [0, 1]: 0 is the
/// first colour, 1 the second. One blob is about one unit. Over a footprint every octave is
/// averaged by itself and has faded to its mean where the footprint is much wider than its blobs.
class Noise final : public Pigment {
 public:
  static Schema schema() {
    return {"pigment",
            "noise",
            "smooth random blobs between two colours",
            {rgb("first", 0).place().doc("where the noise is lowest"),
             rgb("second", 1).place().doc("where it is highest"),
             integer("octaves", 6).range(1, 16).doc("layers, each finer than the last"),
             real("lambda", 2).range(1, 16).doc("how much finer"),
             real("omega", 0.5).range(0, 1).doc("how much fainter"),
             integer("seed", 0).range(0, 4294967295.0).doc("another seed, other blobs")}};
  }

  explicit Noise(const Values& v)
      : first_(v.rgb(0)),
        second_(v.rgb(1)),
        octaves_(int(v.integer(2))),
        lambda_(v.real(3)),
        omega_(v.real(4)),
        seed_(std::uint32_t(v.integer(5))) {
    Real total = 0;
    for (int i = 0; i < octaves_; ++i) total += std::pow(omega_, Real(i));
    scale_ = 1 / total;
  }

  Rgba eval(const Lookup& at) const noexcept override {
    Real sum = 0, share = scale_;
    PatternFootprint p(at);
    for (int i = 0; i < octaves_; ++i, p = scaled(p, lambda_), share *= omega_)
      sum += share * octaveOver(p, octaveSeed(seed_, i), 0, [](Real n) { return n; });
    const Real t = std::clamp(Real(0.5) + Real(0.5) * sum, Real(0), Real(1));
    return {first_ + t * (second_ - first_), 1};
  }

  Rgba mean() const noexcept override { return {Real(0.5) * (first_ + second_), 1}; }

 private:
  Rgb first_, second_;
  int octaves_;
  Real lambda_, omega_, scale_;
  std::uint32_t seed_;
};

}  // namespace vestige

VESTIGE_PLUGIN(vestige::Pigment, vestige::Noise)
