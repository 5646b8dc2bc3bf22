// SPDX-License-Identifier: Apache-2.0
// Two colours in cells of 1: cubes in space, or squares in uv.
#include <vestige/plugin.h>
#include <vestige/tools/pattern_filter.h>

namespace vestige {

/// The first colour where floor(x) + floor(y) + floor(z) is even. POV-Ray's pattern and its remedy:
/// a surface that lies on a face between cells (the floor y = 0) would get either colour by
/// rounding, so cells reach 1/1000 below their lower faces. A surface within that of a face, but
/// meant to be on the other side, should be moved. Over a footprint: the product of square waves,
/// exact where it lies along the axes.
class Checker final : public Pigment {
 public:
  static Schema schema() {
    return {"pigment",
            "checker",
            "two colours in cells of 1",
            {rgb("first", 0).place().doc("colour of the cell at the origin"),
             rgb("second", 1).place().doc("colour of its neighbours"),
             choice("mapping", {"solid", "uv"}).doc("cubes in space, or squares in uv")}};
  }

  explicit Checker(const Values& v)
      : colours_{v.rgb(0), v.rgb(1)}, isSolid_(v.text(2) == "solid") {}

  Rgba eval(const Lookup& at) const noexcept override {
    const Vec2* d = at.footprint.dUv;
    const PatternFootprint patch =
        isSolid_
            ? PatternFootprint(at)
            : PatternFootprint({at.uv.x, at.uv.y, 0}, {d[0].x, d[0].y, 0}, {d[1].x, d[1].y, 0});
    if (patch.isPoint()) return {colours_[isOdd(patch.centre)], 1};
    if (patch.isHuge()) return mean();
    const double odd =
        overSlant(patch, {1, 1, 1}, [&](const PatternFootprint& p) { return oddShare(p); });
    return {colours_[0] + Real(odd) * (colours_[1] - colours_[0]), 1};
  }

  Rgba mean() const noexcept override { return {Real(0.5) * (colours_[0] + colours_[1]), 1}; }

 private:
  static constexpr Real kFaceTolerance = Real(1e-3);

  Vec3 moved(Vec3 p) const noexcept {
    return isSolid_ ? p + Vec3{kFaceTolerance, kFaceTolerance, kFaceTolerance} : p;
  }

  bool isOdd(Vec3 at) const noexcept {
    const Vec3 p = moved(at);
    const Real cells = std::floor(p.x) + std::floor(p.y) + std::floor(p.z);
    // As a remainder, not as an integer: whatever is so far away has no cells left, but no
    // overflow.
    return cells != 2 * std::floor(cells / 2);
  }

  /// The mean of a product of independent waves, +1 in even cells and -1 in odd ones, is the
  /// product of their means.
  double oddShare(const PatternFootprint& patch) const noexcept {
    const Vec3 p = moved(patch.centre);
    double product = 1;
    for (int axis = 0; axis < 3; ++axis)
      product *= 2 * filtered(PulseWave{}, double(p[axis]) / 2, patch.along(axis, 2)) - 1;
    return (1 - product) / 2;
  }

  Rgb colours_[2];
  bool isSolid_;
};

}  // namespace vestige

VESTIGE_PLUGIN(vestige::Pigment, vestige::Checker)
