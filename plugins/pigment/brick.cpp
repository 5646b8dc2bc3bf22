// SPDX-License-Identifier: Apache-2.0
// Bricks in a running bond.
#include <vestige/plugin.h>
#include <vestige/tools/pattern_filter.h>

namespace vestige {

/// POV-Ray's `brick`: rows along y; a brick starts at the origin, with the mortar behind it on each
/// of the three axes. Every other row is shifted by half a brick along x; along z it is the rows at
/// even numbers that are shifted. Over a footprint, two products of pulses along the axes, one for
/// each kind of row: exact where the footprint lies along the axes.
class Brick final : public Pigment {
 public:
  static Schema schema() {
    return {"pigment",
            "brick",
            "bricks in a running bond",
            {parameter("first", ValueType::rgb, colourValue(0.5, 0.5, 0.5))
                 .place()
                 .doc("colour of the mortar"),
             parameter("second", ValueType::rgb, colourValue(0.6, 0.15, 0.15))
                 .place()
                 .doc("colour of the bricks"),
             vec3("brick_size", {8, 3, Real(4.5)}).doc("from brick to brick, mortar included"),
             real("mortar", 0.5).range(0, 1e6).doc("thickness of the mortar")}};
  }

  explicit Brick(const Values& v)
      : mortar_(v.rgb(0)), brick_(v.rgb(1)), size_(v.vec3(2)), thickness_(v.real(3)) {
    for (int axis = 0; axis < 3; ++axis)
      if (!(size_[axis] > thickness_))
        throw PluginError(2, "a brick must be larger than the mortar in every direction");
  }

  Rgba eval(const Lookup& at) const noexcept override {
    const PatternFootprint patch(at);
    if (patch.isPoint()) return mixed(brickShare(patch));
    const auto cells = [&](Vec3 v) { return Vec3{v.x / size_.x, v.y / size_.y, v.z / size_.z}; };
    if (PatternFootprint({}, cells(patch.a), cells(patch.b)).isHuge()) return mean();
    return mixed(overSlant(patch, Real(0.5) * size_,
                           [&](const PatternFootprint& p) { return brickShare(p); }));
  }

  Rgba mean() const noexcept override { return mixed(duty(0) * duty(1) * duty(2)); }

 private:
  double duty(int axis) const noexcept { return 1 - double(thickness_) / double(size_[axis]); }

  /// Share of brick along x or z, for rows that are not shifted or shifted by half.
  double across(const PatternFootprint& p, int axis, double shift) const noexcept {
    const double t = double(p.centre[axis]) / double(size_[axis]) + shift;
    return filtered(PulseWave{duty(axis)}, t, p.along(axis, size_[axis]));
  }

  double brickShare(const PatternFootprint& p) const noexcept {
    const PulseWave row{duty(1) / 2};  // a period is two rows
    const double t = double(p.centre.y) / (2 * double(size_.y));
    const Widths widths = p.along(1, 2 * size_.y);
    return filtered(row, t, widths) * across(p, 0, 0) * across(p, 2, 0.5) +
           filtered(row, t + 0.5, widths) * across(p, 0, 0.5) * across(p, 2, 0);
  }

  Rgba mixed(double brick) const noexcept {
    return {mortar_ + Real(brick) * (brick_ - mortar_), 1};
  }

  Rgb mortar_, brick_;
  Vec3 size_;
  Real thickness_;
};

}  // namespace vestige

VESTIGE_PLUGIN(vestige::Pigment, vestige::Brick)
