// SPDX-License-Identifier: Apache-2.0
// Bands across x, stirred by turbulence.
#include <vestige/plugin.h>
#include <vestige/tools/pattern_noise.h>

namespace vestige {

/// POV-Ray's `marble`: from the first colour to the second and back once a unit along x, after
/// turbulence has displaced the point; its own default is none. Without it the mean over a
/// footprint is exact; with it, what turbulence does inside the footprint is taken as linear where
/// it is coarse, as a blur where it is fine.
class Marble final : public Pigment {
 public:
  static Schema schema() {
    return {"pigment",
            "marble",
            "bands across x, stirred by turbulence",
            {rgb("first", 0).place().doc("where x is a whole number"),
             rgb("second", 1).place().doc("half way between"),
             vec3("turbulence", {0, 0, 0}).doc("how far points are displaced"),
             integer("octaves", 6).range(1, 10).doc("layers of turbulence"),
             real("lambda", 2).range(1, 16).doc("how much finer each is than the last"),
             real("omega", 0.5).range(0, 1).doc("how much fainter"),
             integer("seed", 0).range(0, 4294967295.0).doc("another seed, another block")}};
  }

  explicit Marble(const Values& v)
      : first_(v.rgb(0)),
        second_(v.rgb(1)),
        strength_(v.vec3(2).x),
        noise_{int(v.integer(3)), v.real(4), v.real(5), std::uint32_t(v.integer(6))} {}

  Rgba eval(const Lookup& at) const noexcept override {
    const PatternFootprint patch(at);
    if (patch.isHuge()) return mean();
    if (strength_ == 0)
      return mixed(Real(filtered(TriangleWave{}, at.position.x, patch.along(0, 1))));
    return mixed(
        Real(overTurbulence(patch, noise_, [&](const PatternFootprint& p, const Turbulence& stir) {
          Widths widths = p.along(0, 1);
          widths.a += double(strength_ * stir.alongA), widths.b += double(strength_ * stir.alongB);
          return filtered(TriangleWave{}, p.centre.x + strength_ * stir.value,
                          widths.blurred(double(sqr(strength_) * stir.lost)));
        })));
  }

  Rgba mean() const noexcept override { return mixed(Real(0.5)); }

 private:
  Rgba mixed(Real t) const noexcept { return {first_ + t * (second_ - first_), 1}; }

  Rgb first_, second_;
  Real strength_;  ///< along x: across the bands
  TurbulenceSettings noise_;
};

}  // namespace vestige

VESTIGE_PLUGIN(vestige::Pigment, vestige::Marble)
