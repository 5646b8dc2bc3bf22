// SPDX-License-Identifier: Apache-2.0
// An isotropic point light: irradiance is intensity / distance^2.
#include <vestige/delta_light.h>

namespace vestige {
namespace {

class Point final : public PointSource {
 public:
  enum Row { kLocation, kIntensity };

  static Schema schema() {
    return {.kind = "light",
            .name = "point",
            .summary = "a point that shines all around",
            .params = {vec3("location", {}).place().in("scene units").doc("where it stands"),
                       rgb("intensity", 1)
                           .range(0, 1e12)
                           .in("W/sr")
                           .doc("given off; falls with the square of the distance")}};
  }

  explicit Point(const Values& values)
      : PointSource(values.toWorld().point(values.vec3(kLocation))),
        intensity_(values.rgb(kIntensity)) {}

  Rgb intensity(Vec3) const noexcept override { return intensity_; }
  Vec3 logIntensityGradient(Vec3) const noexcept override { return {}; }
  Rgb power() const noexcept override { return 4 * kPi * intensity_; }

 private:
  Rgb intensity_;
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Light, vestige::Point)
