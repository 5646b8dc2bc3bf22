// SPDX-License-Identifier: Apache-2.0
// A point that shines into a cone. As POV-Ray's: full intensity within `radius` of the axis, none
// beyond `falloff`, and between them a cubic in the cosine, 3t^2 - 2t^3.
#include <vestige/light.h>
#include <vestige/plugin.h>
#include <vestige/sampling.h>
#include <vestige/words.h>

namespace vestige {
namespace {

class Spot final : public Light {
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

  explicit Spot(const Values& values)
      : location_(values.toWorld().point(values.vec3(kLocation))),
        intensity_(values.rgb(kIntensity)),
        axis_(normalize(values.toWorld().point(values.vec3(kPointAt)) - location_)) {
    if (lengthSquared(axis_) == 0)
      throw PluginError(kPointAt, "point_at is " + words(values.vec3(kPointAt)) +
                                      ", the light's own location: expected another point");
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
    cosFull_ = std::cos(radians(full)), cosNone_ = std::cos(radians(outer));
  }

  bool isDelta() const noexcept override { return true; }

  std::optional<LightSample> sample(Vec3 from, Vec2) const noexcept override {
    const Vec3 way = location_ - from, toLight = normalize(way);
    const Real d2 = lengthSquared(way), share = d2 > 0 ? cone(-dot(axis_, toLight)) : 0;
    if (!(share > 0)) return std::nullopt;
    return LightSample{
        {from, toLight, std::sqrt(d2), location_, {}, {}}, share / d2 * intensity_, 1};
  }

  Real pdf(const LightHit&) const noexcept override { return 0; }
  Rgb eval(const LightHit&) const noexcept override { return {}; }

  LightJacobian sampleDerivatives(Vec3 from, Vec2) const noexcept override {
    const Vec3 way = location_ - from;
    return {.du = {}, .dFrom = (-1 / length(way)) * projection(normalize(way))};
  }

  LightLogGradient logGradient(Vec3 from, Vec2) const noexcept override {
    const Vec3 way = location_ - from, toLight = normalize(way);
    const Real c = -dot(axis_, toLight), share = cone(c);
    if (!(share > 0)) return {};
    // dc = (projection(toLight) axis / distance) . d(from): the cosine grows with a step along it
    const Vec3 dCosine = projection(toLight) * axis_ / length(way);
    return {{}, 2 / lengthSquared(way) * way + coneSlope(c) / share * dCosine};
  }

  std::optional<Particle> emit(EmissionNumbers u) const noexcept override {
    const Vec3 local = uniformCap(u.direction, cosNone_).d;
    return Particle{.origin = location_,
                    .direction = Frame::around(axis_).toWorld(local),
                    .normal = {},
                    .power = 2 * kPi * (1 - cosNone_) * cone(local.z) * intensity_,
                    .variables = 2};
  }

  RayJacobian emissionDerivatives(EmissionNumbers u) const noexcept override {
    const Frame f = Frame::around(axis_);
    const Mat3x2 du = uniformCap(u.direction, cosNone_).du;
    return {.dOrigin = {}, .dDirection = {Vec3{}, Vec3{}, f.toWorld(du.c[0]), f.toWorld(du.c[1])}};
  }

  LightExtent extent() const noexcept override {
    return {{location_, location_}, axis_, 0, std::acos(cosNone_)};
  }

  Rgb power() const noexcept override {
    // The mean of the cubic is 1/2.
    return 2 * kPi * (1 - cosFull_ + (cosFull_ - cosNone_) / 2) * intensity_;
  }

 private:
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

  Vec3 location_;
  Rgb intensity_;
  Vec3 axis_;               ///< unit, from the light
  Real cosFull_, cosNone_;  ///< cosines of radius and falloff
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Light, vestige::Spot)
