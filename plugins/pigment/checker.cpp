// SPDX-License-Identifier: Apache-2.0
// Two colours in cells of 1: cubes in space, or squares in uv.
#include <vestige/pigment.h>
#include <vestige/plugin.h>

namespace vestige {

/// The first colour where floor(x) + floor(y) + floor(z) is even. POV-Ray's pattern and its remedy:
/// a surface that lies on a face between cells (the floor y = 0) would get either colour by
/// rounding, so cells reach 1/1000 below their lower faces. A surface within that of a face, but
/// meant to be on the other side, should be moved.
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
    const Real cells = isSolid_ ? std::floor(at.position.x + kFaceTolerance) +
                                      std::floor(at.position.y + kFaceTolerance) +
                                      std::floor(at.position.z + kFaceTolerance)
                                : std::floor(at.uv.x) + std::floor(at.uv.y);
    // As a remainder, not as an integer: whatever is so far away has no cells left, but no
    // overflow.
    const bool odd = cells != 2 * std::floor(cells / 2);
    return {colours_[odd], 1};
  }

  Rgba mean() const noexcept override { return {Real(0.5) * (colours_[0] + colours_[1]), 1}; }

 private:
  static constexpr Real kFaceTolerance = Real(1e-3);

  Rgb colours_[2];
  bool isSolid_;
};

}  // namespace vestige

VESTIGE_PLUGIN(vestige::Pigment, vestige::Checker)
