// SPDX-License-Identifier: Apache-2.0
// Parallel light from infinitely far away: a sun without size.
#include <vestige/light.h>
#include <vestige/plugin.h>
#include <vestige/scene_disk.h>

namespace vestige {
namespace {

class Distant final : public Light {
 public:
  enum Row { kDirection, kIrradiance };

  static Schema schema() {
    return {.kind = "light",
            .name = "distant",
            .summary = "parallel light from infinity",
            .params = {vec3("direction", {0, -1, 0}).place().doc("the way the light travels"),
                       rgb("irradiance", 1)
                           .range(0, 1e12)
                           .in("W/m^2")
                           .doc("on a surface across that direction")}};
  }

  explicit Distant(const Values& values)
      : direction_(normalize(values.toWorld().vector(values.vec3(kDirection)))),
        irradiance_(values.rgb(kIrradiance)) {
    if (lengthSquared(direction_) == 0)
      throw PluginError(kDirection,
                        "direction has no length: expected a vector such as <0, -1, 0>");
  }

  bool isDelta() const noexcept override { return true; }
  bool isInfinite() const noexcept override { return true; }

  void setScene(const Bounds& scene) override { disk_ = SceneDisk::around(scene); }

  std::optional<LightSample> sample(Vec3 from, Vec2) const noexcept override {
    return LightSample{{from, -direction_, kInfinity, {}, {}, {}}, irradiance_, 1};
  }

  Real pdf(const LightHit&) const noexcept override { return 0; }
  Rgb eval(const LightHit&) const noexcept override { return {}; }
  LightJacobian sampleDerivatives(Vec3, Vec2) const noexcept override { return {}; }
  LightLogGradient logGradient(Vec3, Vec2) const noexcept override { return {}; }

  std::optional<Particle> emit(EmissionNumbers u) const noexcept override {
    return Particle{.origin = disk_.start(direction_, u.point),
                    .direction = direction_,
                    .normal = {},
                    .power = power(),
                    .variables = 2};
  }

  RayJacobian emissionDerivatives(EmissionNumbers u) const noexcept override {
    const Mat3x2 du = disk_.du(direction_, u.point);
    return {.dOrigin = {du.c[0], du.c[1]}, .dDirection = {}};
  }

  /// What falls on the disk that covers the scene.
  Rgb power() const noexcept override { return disk_.area() * irradiance_; }

 private:
  Vec3 direction_;  ///< unit, away from the light
  Rgb irradiance_;
  SceneDisk disk_;
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Light, vestige::Distant)
