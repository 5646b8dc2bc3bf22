// SPDX-License-Identifier: Apache-2.0
// Light from everywhere around: one radiance, or an image in latitude and longitude.
//
// The image's middle column lies towards +z, u grows towards +x and v towards +y: with the world
// left-handed it is unmirrored from inside, and camera panorama, looking along +z, shows the image
// itself. Transforms rotate it. Negative and non-finite values count as black.
//
// Directions are drawn by a grid of the image's texels, each with the luminance that a bilinear
// lookup averages to over the texel, times the sine of the polar angle [MATH 1.13]: 1 6 1 over 8
// along either axis. So a dark texel beside a bright one, lit by interpolation, is drawn too, and
// the density is 0 only where the radiance is. One radiance is drawn uniformly.
#include <vestige/light.h>
#include <vestige/plugin.h>
#include <vestige/tools/grid_distribution.h>
#include <vestige/tools/scene_disk.h>

namespace vestige {
namespace {

/// Radiance with NaN, infinity and negative numbers replaced by 0.
Rgb lit(Rgb c) noexcept {
  const auto channel = [](Real x) { return x > 0 && std::isfinite(x) ? x : 0; };
  return {channel(c.r), channel(c.g), channel(c.b)};
}

/// The rotation (or mirrored rotation) next to a linear map: columns made orthonormal in turn.
Mat3 rotationOf(const Mat3& m) noexcept {
  const Vec3 x = normalize(m.c[0]);
  const Vec3 y = normalize(m.c[1] - dot(m.c[1], x) * x), z = cross(x, y);
  return {x, y, dot(z, m.c[2]) < 0 ? -z : z};
}

class Environment final : public Light {
 public:
  enum Row { kMap, kImage, kRadiance, kColourSpace };

  static Schema schema() {
    return {.kind = "light",
            .name = "environment",
            .summary = "light from all around, even or from an image",
            .params = {file("map").place().doc("image in latitude and longitude, EXR or HDR"),
                       block("image", "pigment").doc("the same as a block: image { \"sky.hdr\" }"),
                       rgb("radiance", 1)
                           .range(0, 1e12)
                           .in("W/(m^2 sr)")
                           .doc("from everywhere; multiplies an image"),
                       text("color_space", "").doc("of the image; \"\": as the file says")}};
  }

  Environment(const Values& values, Host& host)
      : radiance_(values.rgb(kRadiance)), turn_(rotationOf(values.toWorld().linear())) {
    loadImage(values, host);
    if (image_) readImage(host, values.span(values.has(kImage) ? kImage : kMap));
    if (!image_) flux_ = 4 * kPi * radiance_;
  }

  LightTraits traits() const noexcept override {
    const bool hasImage = image_ != nullptr;
    return {.isInfinite = true, .isDrawn = hasImage, .usesSpread = hasImage};
  }
  void setScene(const Bounds& scene) override { disk_ = SceneDisk::around(scene); }

  std::optional<LightSample> sample(const Receiver& r, Vec2 u) const noexcept override {
    const std::optional<Direction> d = draw(u);
    if (!d) return std::nullopt;
    const LightHit hit = {r.position, d->d, kInfinity, {}, {}, uvOf(local(d->d)).uv};
    const Real density = pdf(r, hit);
    if (!(density > 0)) return std::nullopt;  // rounding led out of the cell, into a black one
    return LightSample{hit, eval(hit), density};
  }

  Real pdf(const Receiver&, const LightHit& hit) const noexcept override {
    if (!image_) return 1 / (4 * kPi);
    const Place p = uvOf(local(hit.toLight));
    const Vec2 density = grid_.density(p.uv);
    return density.x * density.y / (2 * kPi * kPi * p.sine);
  }

  Rgb eval(const LightHit& hit) const noexcept override {
    if (!image_) return radiance_;
    const Vec3 d = local(hit.toLight);
    const Place p = uvOf(d);
    // d(uv) of a turn of the direction [MATH 1.13]; next to a pole a texel's height is the least
    // that the sine may be.
    const Real sine = std::max(p.sine, 1 / Real(image_->height()));
    Vec2 spread[2];
    for (int i = 0; i < 2; ++i) {
      const Vec3 t = local(hit.spread[i]);
      const Real around = (d.z * t.x - d.x * t.z) / p.sine;
      spread[i] = {around / (2 * kPi * sine), t.y / (kPi * p.sine)};
    }
    return radiance_ * lit(image_->lookup(p.uv, spread).colour);
  }

  LightJacobian sampleDerivatives(const Receiver&, Vec2 u) const noexcept override {
    const std::optional<Direction> d = draw(u);
    return {.du = d ? d->du : Mat3x2{}, .dFrom = {}};
  }

  LightLogGradient logGradient(const Receiver&, Vec2 u) const noexcept override {
    if (!image_ || grid_.isEmpty()) return {};
    const GridDistribution::Sample s = grid_.sample(u);
    const Real here = luminance(radiance_ * lookup(s.p));
    if (!(here > 0)) return {};
    const Vec2 slope = lookupSlope(s.p);
    return {{slope.x / (here * s.density.x), slope.y / (here * s.density.y)}, {}};
  }

  std::optional<Particle> emit(EmissionNumbers u) const noexcept override {
    const std::optional<LightSample> s = sample({}, u.direction);
    if (!s) return std::nullopt;
    const Vec3 direction = -s->hit.toLight;
    return Particle{.origin = disk_.start(direction, u.point),
                    .direction = direction,
                    .normal = {},
                    .power = disk_.area() / s->pdf * s->radiance,
                    .variables = 4};
  }

  RayJacobian emissionDerivatives(EmissionNumbers u) const noexcept override {
    const std::optional<Direction> d = draw(u.direction);
    if (!d) return {};
    const Vec3 direction = -d->d, start = disk_.start(direction, u.point);
    const Mat3x2 disk = disk_.du(direction, u.point);
    const auto turned = [&](Vec3 dToLight) { return disk_.turned(start, direction, -dToLight); };
    return {.dOrigin = {disk.c[0], disk.c[1], turned(d->du.c[0]), turned(d->du.c[1])},
            .dDirection = {Vec3{}, Vec3{}, -d->du.c[0], -d->du.c[1]}};
  }

  Rgb power() const noexcept override { return disk_.area() * flux_; }

 private:
  /// The uv of a direction, and the sine of its polar angle (bounded away from 0 at the poles,
  /// where densities would be infinite).
  struct Place {
    Vec2 uv;
    Real sine;
  };
  static Place uvOf(Vec3 d) noexcept {
    const Real across = std::hypot(d.x, d.z);
    const Real u = Real(0.5) + std::atan2(d.x, d.z) / (2 * kPi);
    return {{u < 1 ? u : 0, Real(0.5) + std::atan2(d.y, across) / kPi},
            std::max(across, Real(1e-8))};
  }
  Vec3 local(Vec3 world) const noexcept { return transpose(turn_) * world; }

  /// The direction that sample() draws, in world space; nullopt where the image is black.
  std::optional<Direction> draw(Vec2 u) const noexcept {
    if (!image_) {
      const Direction d = uniformCap(u, -1);
      return Direction{turn_ * d.d, turn_ * d.du};
    }
    if (grid_.isEmpty()) return std::nullopt;
    const GridDistribution::Sample s = grid_.sample(u);
    const Real side = kPi * (2 * s.p.x - 1), up = kPi * (s.p.y - Real(0.5));
    const Real x = std::sin(side), z = std::cos(side), y = std::sin(up), across = std::cos(up);
    const Vec3 dSide = {across * z, 0, -across * x}, dUp = {-y * x, across, -y * z};
    const Mat3x2 du = {2 * kPi / s.density.x * dSide, kPi / s.density.y * dUp};
    return Direction{turn_ * Vec3{across * x, y, across * z}, turn_ * du};
  }

  Rgb lookup(Vec2 uv) const noexcept {
    const Vec2 point[2] = {};
    return lit(image_->lookup(uv, point).colour);
  }

  /// Slope of the luminance by u and by v. Along either axis a bilinear lookup is straight between
  /// the centres of two texels.
  Vec2 lookupSlope(Vec2 uv) const noexcept {
    const auto along = [&](Real x, int n, auto at) {
      const Real low = (std::floor(x * n - Real(0.5)) + Real(0.5)) / n, step = Real(1) / n;
      const Rgb rise = lookup(at(low + step)) - lookup(at(low));
      return luminance(radiance_ * rise) * n;
    };
    return {along(uv.x, image_->width(),
                  [&](Real u) {
                    return Vec2{u, uv.y};
                  }),
            along(uv.y, image_->height(), [&](Real v) {
              return Vec2{uv.x, v};
            })};
  }

  void loadImage(const Values& values, Host& host);
  void readImage(Host& host, Span span);

  Rgb radiance_;
  Mat3 turn_;  ///< to world; orthonormal
  Rgb flux_;   ///< integral of the radiance over all directions
  SceneDisk disk_;
  std::shared_ptr<const Texture> image_;  ///< null: radiance_ from everywhere
  GridDistribution grid_;
};

void Environment::loadImage(const Values& values, Host& host) {
  if (!values.has(kMap) && !values.has(kImage)) return;
  if (values.has(kMap) && values.has(kImage))
    throw PluginError(kImage, "the light has a file and an image block: expected one of them");
  const int row = values.has(kMap) ? kMap : kImage;
  TextureRequest request = {.file = values.text(kMap),
                            .span = values.span(row),
                            .colourSpace = values.text(kColourSpace),
                            .wrapU = Wrap::repeat,
                            .wrapV = Wrap::clamp};
  if (row == kImage) {
    const Block* given = values.block(kImage);
    const Value* name = given && given->plugin == "image" ? given->find("file") : nullptr;
    if (!name) throw PluginError(kImage, "expected an image, as in image { \"sky.hdr\" }");
    if (!given->own.isIdentity())
      throw PluginError(kImage,
                        "an environment's image cannot be transformed: write the rotation "
                        "behind it, for the whole light");
    request.file = name->text, request.span = name->span;
    if (const Value* space = given->find("color_space")) request.colourSpace = space->text;
  }
  std::string error;
  image_ = host.texture(request, error);
  if (!image_) throw PluginError(row, error);
}

/// One pass over the texels: the grid, the flux, and a warning about invalid radiance.
void Environment::readImage(Host& host, Span span) {
  const int w = image_->width(), h = image_->height();
  std::vector<float> bright(std::size_t(w) * h);
  double flux[3] = {};
  std::size_t bad = 0;
  const auto texelArea = [&](int y) {  // solid angle, sr
    const double low = double(kPi) * y / h, high = double(kPi) * (y + 1) / h;
    return 2 * double(kPi) / w * (std::cos(low) - std::cos(high));
  };
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      const Rgb raw = image_->texel(x, y).colour, c = radiance_ * lit(raw);
      bad += !(lit(raw) == raw);
      bright[std::size_t(y) * w + x] = float(luminance(c));
      flux[0] += texelArea(y) * c.r, flux[1] += texelArea(y) * c.g, flux[2] += texelArea(y) * c.b;
    }
  std::vector<double> weights(bright.size());
  for (int y = 0; y < h; ++y) {
    const float* rows[3];
    for (int k = 0; k < 3; ++k) rows[k] = &bright[std::size_t(std::clamp(y + k - 1, 0, h - 1)) * w];
    const auto column = [&](int x) {
      return double(rows[0][x]) + 6 * double(rows[1][x]) + double(rows[2][x]);
    };
    for (int x = 0; x < w; ++x)
      weights[std::size_t(y) * w + x] =
          texelArea(y) / 64 *
          (column(x > 0 ? x - 1 : w - 1) + 6 * column(x) + column(x < w - 1 ? x + 1 : 0));
  }
  grid_ = GridDistribution(w, h, weights);
  flux_ = {Real(flux[0]), Real(flux[1]), Real(flux[2])};
  if (bad > 0)
    host.warn(span, "the environment's image has " + std::to_string(bad) +
                        " texels that are negative or not finite: they count as black");
}

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Light, vestige::Environment)
