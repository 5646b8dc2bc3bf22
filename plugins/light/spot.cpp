// SPDX-License-Identifier: Apache-2.0
// A point light with a cone, as in POV-Ray: full intensity within `radius` of the axis, none beyond
// `falloff`, and a cubic in the cosine between them, 3t^2 - 2t^3.
#include <vestige/delta_light.h>

namespace vestige {
namespace {

class Spot final : public PointSource {
 public:
  enum Row { kLocation, kIntensity, kPointAt, kRadius, kFalloff };

  static Schema schema() {
    return {
        .kind = "light",
        .name = "spot",
        .summary = "a point that shines into a cone",
        .params = {vec3("location", {}).place().in("scene units").doc("where it stands"),
                   rgb("intensity", 1).range(0, 1e12).in("W/sr").doc("given off on the axis"),
                   vec3("point_at", {0, 0, 1}).in("scene units").doc("where the axis goes"),
                   real("radius", 30)
                       .unset()
                       .range(0, 180)
                       .in("degrees")
                       .doc("full intensity up to this angle from the axis; default 30, or falloff "
                            "if that is less"),
                   real("falloff", 45)
                       .unset()
                       .range(0, 180)
                       .in("degrees")
                       .doc("none from this angle on; default 45, or radius if that is more")}};
  }

  explicit Spot(const Values& values) : Spot(values, angles(values)) {}

  Rgb intensity(Vec3 d) const noexcept override { return cone(d.z) * intensity_; }
  Vec3 logIntensityGradient(Vec3 d) const noexcept override {
    return {0, 0, coneSlope(d.z) / cone(d.z)};
  }

  Rgb power() const noexcept override {
    // The mean of the cubic is 1/2.
    return 2 * kPi * (1 - cosFull_ + (cosFull_ - cosNone_) / 2) * intensity_;
  }

 private:
  /// Degrees: full intensity within the first, none beyond the second.
  struct Angles {
    Real full, none;
  };
  static Angles angles(const Values& values) {
    const Real outer =
        values.has(kFalloff) ? values.real(kFalloff) : std::max(Real(45), inner(values, 0));
    const Real full = inner(values, outer);
    if (!(outer > 0 && outer <= 180))
      throw PluginError(kFalloff, "falloff is " + words(outer) +
                                      ": expected more than 0 and at most 180 degrees");
    if (!(full >= 0 && full <= outer))
      throw PluginError(values.has(kFalloff) ? kFalloff : kRadius,
                        "radius is " + words(full) + " and falloff " + words(outer) +
                            " degrees: expected the radius (full intensity) within the falloff");
    return {full, outer};
  }
  Spot(const Values& values, Angles a)
      : PointSource(aim(values, kLocation, kPointAt), std::cos(radians(a.none))),
        intensity_(values.rgb(kIntensity)),
        cosFull_(std::cos(radians(a.full))),
        cosNone_(std::cos(radians(a.none))) {}

  static Real inner(const Values& values, Real outer) {
    return values.has(kRadius) ? values.real(kRadius) : std::min(Real(30), outer);
  }

  /// Share of the intensity at an angle with this cosine, 0 to 1.
  Real cone(Real c) const noexcept {
    if (c >= cosFull_) return 1;
    if (c <= cosNone_) return 0;
    const Real t = (c - cosNone_) / (cosFull_ - cosNone_);
    return t * t * (3 - 2 * t);
  }
  /// Its derivative by the cosine.
  Real coneSlope(Real c) const noexcept {
    if (c >= cosFull_ || c <= cosNone_) return 0;
    const Real t = (c - cosNone_) / (cosFull_ - cosNone_);
    return 6 * t * (1 - t) / (cosFull_ - cosNone_);
  }

  Rgb intensity_;
  Real cosFull_, cosNone_;  ///< cosines of radius and falloff
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Light, vestige::Spot)
