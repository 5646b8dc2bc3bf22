// SPDX-License-Identifier: Apache-2.0
// A point that shines evenly all around: irradiance intensity / distance^2.
#include <vestige/light.h>
#include <vestige/plugin.h>
#include <vestige/sampling.h>

namespace vestige {
namespace {

class Point final : public Light {
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
      : location_(values.toWorld().point(values.vec3(kLocation))),
        intensity_(values.rgb(kIntensity)) {}

  bool isDelta() const noexcept override { return true; }

  std::optional<LightSample> sample(Vec3 from, Vec2) const noexcept override {
    const Vec3 way = location_ - from;
    const Real d2 = lengthSquared(way);
    if (!(d2 > 0)) return std::nullopt;
    return LightSample{
        {from, normalize(way), std::sqrt(d2), location_, {}, {}}, intensity_ / d2, 1};
  }

  Real pdf(const LightHit&) const noexcept override { return 0; }
  Rgb eval(const LightHit&) const noexcept override { return {}; }

  LightJacobian sampleDerivatives(Vec3 from, Vec2) const noexcept override {
    const Vec3 way = location_ - from;
    return {.du = {}, .dFrom = (-1 / length(way)) * projection(normalize(way))};
  }

  LightLogGradient logGradient(Vec3 from, Vec2) const noexcept override {
    const Vec3 way = location_ - from;
    return {{}, 2 / lengthSquared(way) * way};
  }

  std::optional<Particle> emit(EmissionNumbers u) const noexcept override {
    return Particle{.origin = location_,
                    .direction = uniformCap(u.direction, -1).d,
                    .normal = {},
                    .power = power(),
                    .variables = 2};
  }

  RayJacobian emissionDerivatives(EmissionNumbers u) const noexcept override {
    const Mat3x2 du = uniformCap(u.direction, -1).du;
    return {.dOrigin = {}, .dDirection = {Vec3{}, Vec3{}, du.c[0], du.c[1]}};
  }

  LightExtent extent() const noexcept override { return {{location_, location_}}; }

  Rgb power() const noexcept override { return 4 * kPi * intensity_; }

 private:
  Vec3 location_;
  Rgb intensity_;
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Light, vestige::Point)
