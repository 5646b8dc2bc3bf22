// SPDX-License-Identifier: Apache-2.0
// A disc that shines mostly forwards, as a lamp with a reflector does.
//
//     L = radiance cos^exponent a,   a = angle(axis, direction)
#include <vestige/area_light.h>

namespace vestige {
namespace {

class Beam final : public AreaLight {
 public:
  enum Row { kLocation, kPointAt, kRadius, kRadiance, kExponent };

  static Schema schema() {
    return {.kind = "light",
            .name = "beam",
            .summary = "a disc that shines mostly forwards",
            .params = {vec3("location", {}).place().in("scene units").doc("its middle"),
                       vec3("point_at", {0, 0, 1}).in("scene units").doc("where its axis goes"),
                       real("radius", 1).positive().in("scene units").doc("of the disc"),
                       rgb("radiance", 1).range(0, 1e12).in("W/(m^2 sr)").doc("along the axis"),
                       real("exponent", 10).range(0, 1000).doc("0 is diffuse, 20 a narrow beam")}};
  }

  explicit Beam(const Values& values)
      : radiance_(values.rgb(kRadiance)), exponent_(values.real(kExponent)) {
    const Aim a = ownAim(values, kLocation, kPointAt);
    const Real radius = values.real(kRadius);
    if (!(radius > 0))
      throw PluginError(kRadius, "radius is " + words(radius) + ": expected more than 0");
    place(values.toWorld(), a.location, radius * a.frame.s, radius * a.frame.t);
  }

  Disk outline(Vec2 u) const noexcept override { return concentricDisk(u); }

  Rgb radiance(Vec2, Vec3 d) const noexcept override {
    return std::pow(d.z, exponent_) * radiance_;
  }
  RadianceGradient logRadianceGradient(Vec2, Vec3 d) const noexcept override {
    return {{}, {0, 0, exponent_ / d.z}};
  }

  Rgb power() const noexcept override { return 2 * kPi / (exponent_ + 2) * area() * radiance_; }

 private:
  Rgb radiance_;
  Real exponent_;
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Light, vestige::Beam)
