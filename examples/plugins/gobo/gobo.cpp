// SPDX-License-Identifier: Apache-2.0
// A projector: a point that throws a picture (a slide, a "gobo") into a pyramid along its axis.
//
//     radiant intensity = intensity picture(x, y),   (x, y) = where the direction meets the slide
//
// The slide stands one unit in front of the point, 2 tan(angle / 2) wide. Particles start evenly
// over the slide, so with density 1 / (area cos^3 a) per steradian. logGradient() has the picture's
// slope between two texels, but not the edges of the slide, where a derivative would say nothing.
#include <vestige/delta_light.h>

namespace vestige {
namespace {

class Gobo final : public PointSource {
 public:
  enum Row { kSlide, kLocation, kPointAt, kSky, kAngle, kIntensity };

  static Schema schema() {
    return {
        .kind = "light",
        .name = "gobo",
        .summary = "a projector that throws a picture",
        .params = {file("slide").place().need().doc("the picture: PNG, JPEG, EXR, ..."),
                   vec3("location", {}).in("scene units").doc("where it stands"),
                   vec3("point_at", {0, 0, 1}).in("scene units").doc("the middle of the picture"),
                   vec3("sky", {0, 1, 0}).doc("the direction that is upwards in the picture"),
                   real("angle", 40).range(1, 170).in("degrees").doc("width of the beam"),
                   rgb("intensity", 1).range(0, 1e12).in("W/sr").doc("where the slide is white")}};
  }

  Gobo(const Values& values, Host& host) : Gobo(values, slideOf(values, host)) {}

  /// Black beside the slide and behind the lamp.
  Rgb intensity(Vec3 d) const noexcept override {
    if (!(d.z > 0)) return {};
    const Vec2 uv = onPicture(d);
    if (!(uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1)) return {};
    const Rgba c = lookup(uv);
    return intensity_ * c.alpha * c.colour;
  }

  Vec3 logIntensityGradient(Vec3 d) const noexcept override {
    const Vec2 uv = onPicture(d);
    const Vec3 du = Vec3{1, 0, -d.x / d.z} / (2 * halfWidth_ * d.z);
    const Vec3 dv = Vec3{0, 1, -d.y / d.z} / (2 * halfHeight_ * d.z);
    return (slope(uv, 0) * du + slope(uv, 1) * dv) / luminance(intensity(d));
  }

  std::optional<Particle> emit(EmissionNumbers u) const noexcept override {
    const Vec3 direction = normalize(onSlide(u.direction));
    const Real cosine = direction.z, area = 4 * halfWidth_ * halfHeight_;
    return Particle{.origin = location(),
                    .direction = frame().toWorld(direction),
                    .normal = {},
                    .power = area * cosine * cosine * cosine * intensity(direction),
                    .variables = 2};
  }

  RayJacobian emissionDerivatives(EmissionNumbers u) const noexcept override {
    const Vec3 d = onSlide(u.direction);
    const Mat3 across = (1 / length(d)) * projection(normalize(d));
    return {.dOrigin = {},
            .dDirection = {Vec3{}, Vec3{}, frame().toWorld(across * Vec3{2 * halfWidth_, 0, 0}),
                           frame().toWorld(across * Vec3{0, 2 * halfHeight_, 0})}};
  }

  /// As if the picture were even: solid angle of the slide times its mean.
  Rgb power() const noexcept override {
    const Real w = halfWidth_, h = halfHeight_;
    const Real angle = 4 * std::asin(w * h / std::sqrt((1 + w * w) * (1 + h * h)));
    return angle * intensity_ * slide_->mean().colour;
  }

 private:
  Gobo(const Values& values, std::shared_ptr<const Texture> slide)
      : Gobo(values, slide, std::tan(radians(values.real(kAngle)) / 2)) {}
  Gobo(const Values& values, std::shared_ptr<const Texture> slide, Real halfWidth)
      : PointSource(beam(values), cosCorner(*slide, halfWidth)),
        intensity_(values.rgb(kIntensity)),
        slide_(std::move(slide)),
        halfWidth_(halfWidth),
        halfHeight_(halfWidth * Real(slide_->height()) / Real(slide_->width())) {}

  static std::shared_ptr<const Texture> slideOf(const Values& values, Host& host) {
    std::string error;
    auto slide = host.texture({.file = values.text(kSlide),
                               .span = values.span(kSlide),
                               .colourSpace = "",
                               .wrapU = Wrap::clamp,
                               .wrapV = Wrap::clamp},
                              error);
    if (!slide) throw PluginError(kSlide, error);
    return slide;
  }
  /// s to the right of the picture, t up, n along the beam.
  static Aim beam(const Values& values) {
    Aim a = aim(values, kLocation, kPointAt);
    const Vec3 right = cross(values.toWorld().vector(values.vec3(kSky)), a.frame.n);
    if (!(lengthSquared(right) > 0))
      throw PluginError(kSky, "sky " + words(values.vec3(kSky)) + " lies along the beam");
    a.frame.s = normalize(right);
    a.frame.t = cross(a.frame.n, a.frame.s);
    return a;
  }
  static Real cosCorner(const Texture& slide, Real halfWidth) {
    const Real height = Real(slide.height()) / Real(slide.width());
    return 1 / std::sqrt(1 + sqr(halfWidth) * (1 + sqr(height)));
  }

  /// A point of the slide by numbers in the unit square; v upwards, as in a texture.
  Vec3 onSlide(Vec2 u) const noexcept {
    return {halfWidth_ * (2 * u.x - 1), halfHeight_ * (2 * u.y - 1), 1};
  }
  /// Where a direction of the lamp's own frame meets the picture, d.z > 0.
  Vec2 onPicture(Vec3 d) const noexcept {
    return {(d.x / d.z / halfWidth_ + 1) / 2, (d.y / d.z / halfHeight_ + 1) / 2};
  }
  Rgba lookup(Vec2 uv) const noexcept {
    const Vec2 point[2] = {};
    return slide_->lookup(uv, point);
  }
  /// Of the intensity's luminance by u (axis 0) or v (1): between the centres of two texels a
  /// lookup is straight in colour and in alpha.
  Real slope(Vec2 uv, int axis) const noexcept {
    const int n = axis == 0 ? slide_->width() : slide_->height();
    const Real x = axis == 0 ? uv.x : uv.y;
    const Real low = (std::floor(x * n - Real(0.5)) + Real(0.5)) / n, high = low + Real(1) / n;
    const Rgba a = lookup(axis == 0 ? Vec2{low, uv.y} : Vec2{uv.x, low});
    const Rgba b = lookup(axis == 0 ? Vec2{high, uv.y} : Vec2{uv.x, high});
    const Rgba c = lookup(uv);
    const Rgb rise = c.alpha * (b.colour - a.colour) + (b.alpha - a.alpha) * c.colour;
    return luminance(intensity_ * rise) * n;
  }

  Rgb intensity_;
  std::shared_ptr<const Texture> slide_;
  Real halfWidth_, halfHeight_;  ///< of the slide, at distance 1
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Light, vestige::Gobo)
