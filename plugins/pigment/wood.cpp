// SPDX-License-Identifier: Apache-2.0
// Rings around the z axis, stirred by turbulence.
#include <vestige/plugin.h>
#include <vestige/tools/pattern_noise.h>

namespace vestige {

/// POV-Ray's `wood`: from the first colour to the second and back once a unit of distance from the
/// z axis, after turbulence has displaced the point; its own default is none. A footprint is cut
/// into pieces over which a ring is nearly straight; turbulence as for marble.
class Wood final : public Pigment {
 public:
  static Schema schema() {
    return {"pigment",
            "wood",
            "rings around the z axis, stirred by turbulence",
            {rgb("first", 0).place().doc("on the axis"),
             rgb("second", 1).place().doc("half a unit from it"),
             vec3("turbulence", {0, 0, 0}).doc("how far points are displaced"),
             integer("octaves", 6).range(1, 10).doc("layers of turbulence"),
             real("lambda", 2).range(1, 16).doc("how much finer each is than the last"),
             real("omega", 0.5).range(0, 1).doc("how much fainter"),
             integer("seed", 0).range(0, 4294967295.0).doc("another seed, another trunk")}};
  }

  explicit Wood(const Values& v)
      : first_(v.rgb(0)),
        second_(v.rgb(1)),
        strength_(v.vec3(2)),
        noise_{int(v.integer(3)), v.real(4), v.real(5), std::uint32_t(v.integer(6))} {}

  Rgba eval(const Lookup& at) const noexcept override {
    const PatternFootprint patch(at);
    if (patch.isHuge()) return mean();
    if (patch.isPoint()) return mixed(Real(stirred(patch)));
    const bool isStirred = strength_.x != 0 || strength_.y != 0;
    const Pieces n = isStirred ? grainPieces(patch, Real(0.3), 4) : Pieces{};
    return mixed(
        Real(overPieces(patch, n.a, n.b, [&](const PatternFootprint& p) { return stirred(p); })));
  }

  Rgba mean() const noexcept override { return mixed(Real(0.5)); }

 private:
  /// Over a patch within which turbulence bends little.
  double stirred(const PatternFootprint& still) const noexcept {
    PatternFootprint patch = still;
    double lost = 0;
    for (int axis = 0; axis < 2; ++axis) {
      if (strength_[axis] == 0) continue;
      TurbulenceSettings own = noise_;
      own.seed += std::uint32_t(axis) * 0x9e3779b1u;
      const Turbulence stir = turbulence(still, own);
      patch.centre[axis] += strength_[axis] * stir.value;
      patch.a[axis] += strength_[axis] * stir.alongA;
      patch.b[axis] += strength_[axis] * stir.alongB;
      lost += double(sqr(strength_[axis]) * stir.lost) / 2;  // half of it along the radius
    }
    return overPieces(patch, pieces(patch.a), pieces(patch.b),
                      [&](const PatternFootprint& p) { return ringShare(p, lost); });
  }

  static double ringShare(const PatternFootprint& p, double lost) noexcept {
    const Real r = std::sqrt(sqr(p.centre.x) + sqr(p.centre.y));
    const Vec3 outwards = r > 0 ? Vec3{p.centre.x / r, p.centre.y / r, 0} : Vec3{1, 0, 0};
    return filtered(TriangleWave{}, r,
                    Widths{dot(p.a, outwards), dot(p.b, outwards)}.blurred(lost));
  }
  static int pieces(Vec3 v) noexcept {
    return int(std::clamp(std::ceil(2 * std::sqrt(sqr(v.x) + sqr(v.y))), Real(1), Real(4)));
  }

  Rgba mixed(Real t) const noexcept { return {first_ + t * (second_ - first_), 1}; }

  Rgb first_, second_;
  Vec3 strength_;  ///< x and y count
  TurbulenceSettings noise_;
};

}  // namespace vestige

VESTIGE_PLUGIN(vestige::Pigment, vestige::Wood)
