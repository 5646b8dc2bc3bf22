// SPDX-License-Identifier: Apache-2.0
// Lights to test, each with a place where it is seen well.
#pragma once
#include <vestige/camera.h>
#include <vestige/light.h>
#include <vestige/sampling.h>

#include <functional>
#include <optional>

#include "support/judge.h"
#include "support/plugins.h"

namespace vestige::test {

inline Value at(Vec3 p) { return vectorValue({double(p.x), double(p.y), double(p.z)}); }

/// A grey image from a function of uv, looked up bilinearly: repeats along u, ends along v.
class Picture final : public Texture {
 public:
  Picture(int width, int height, const std::function<Real(Real, Real)>& at)
      : width_(width), height_(height) {
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        texels_.push_back(at((x + Real(0.5)) / width, (y + Real(0.5)) / height));
  }
  Rgba lookup(Vec2 uv, const Vec2*) const noexcept override {
    const Real x = uv.x * width_ - Real(0.5), y = uv.y * height_ - Real(0.5);
    const int i = int(std::floor(x)), j = int(std::floor(y));
    const auto row = [&](int k) { return value(i, k) * (1 - (x - i)) + value(i + 1, k) * (x - i); };
    return {grey(row(j) * (1 - (y - j)) + row(j + 1) * (y - j)), 1};
  }
  Rgba texel(int x, int y) const noexcept override { return {grey(value(x, y)), 1}; }
  int width() const noexcept override { return width_; }
  int height() const noexcept override { return height_; }
  bool hasAlpha() const noexcept override { return false; }
  Rgba mean() const noexcept override { return {}; }

 private:
  Real value(int x, int y) const noexcept {
    return texels_[std::size_t(std::clamp(y, 0, height_ - 1)) * width_ +
                   (x % width_ + width_) % width_];
  }
  int width_, height_;
  std::vector<Real> texels_;
};

/// Hands out one picture, or none.
class PictureHost final : public Host {
 public:
  explicit PictureHost(std::optional<Picture> picture = std::nullopt)
      : picture_(std::move(picture)) {}
  std::string find(const std::string& file, Span, std::string&) override { return file; }
  std::shared_ptr<const Texture> texture(const TextureRequest& request,
                                         std::string& error) override {
    last = request;
    if (picture_) return std::make_shared<Picture>(*picture_);
    error = "no file " + request.file;
    return nullptr;
  }
  void warn(Span, const std::string& message) override { warnings.push_back(message); }
  std::vector<std::string> warnings;
  TextureRequest last;

 private:
  std::optional<Picture> picture_;
};

inline Value imageBlock(const std::string& plugin, const std::string& file) {
  auto block = std::make_shared<Block>();
  block->kind = "pigment", block->plugin = plugin;
  block->settings.push_back({"file", textValue(file), {}});
  block->settings.push_back({"color_space", textValue("raw"), {}});
  Value v;
  v.kind = Value::Kind::block, v.block = block;
  return v;
}

inline std::shared_ptr<Light> environment(const Picture& picture, Settings settings = {},
                                          const Affine& toWorld = {}) {
  PictureHost host(picture);
  settings["image"] = imageBlock("image", "sky.hdr");
  return make<Light>(pluginNamed("light", "environment"), settings, host, toWorld);
}

/// 64 x 32, a sky with a gradient, and a sun in one texel high to the right.
inline Picture sunny() {
  return Picture(64, 32, [](Real u, Real v) {
    const bool sun = int(u * 64) == 40 && int(v * 32) == 24;
    return sun ? Real(72000) : Real(0.2) + v + Real(0.1) * std::sin(6 * kPi * u);
  });
}

/// LANGUAGE's example: 2 x 2, five units up, shines down.
inline Settings downLight() {
  return {{"corner", at({-1, 5, -1})}, {"edge1", at({2, 0, 0})}, {"edge2", at({0, 0, 2})}};
}

inline Affine rotation(Vec3 axis, double degrees) {
  const double a = degrees * M_PI / 180, c = std::cos(a), s = std::sin(a);
  const Vec3 n = normalize(axis);
  Affine r;
  for (int j = 0; j < 3; ++j) {
    Vec3 e;
    e[j] = 1;
    const Vec3 turned = Real(c) * e + Real(s) * cross(n, e) + Real(1 - c) * dot(n, e) * n;
    for (int i = 0; i < 3; ++i) r.m[i][j] = double(turned[i]);
  }
  return r;
}

/// The rim of the concentric disk is the horizon or the far pole, where derivatives have no bound.
inline bool awayFromRim(Vec2 u) {
  return differsSmoothly(u) && std::max(std::abs(2 * u.x - 1), std::abs(2 * u.y - 1)) < Real(0.9);
}

struct LightCase {
  std::string name;
  std::shared_ptr<Light> light;
  Vec3 from;      ///< sees the light, or most of it
  Vec3 receiver;  ///< unit normal of a surface there that faces it
  SphereGrid grid = {32, 16};
  int fine = 32;              ///< points across a bin of it, to integrate
  Mat3 toImage = identity();  ///< turns world directions into those of `grid`
  Vec3 centre = {};           ///< of the scene that setScene() was told
  Real powerTolerance = 0;    ///< power() of an image is an estimate
  /// Whether sample() is smooth around these numbers.
  std::function<bool(Vec2)> smooth = [](Vec2 u) { return awayFromRim(u); };
  /// The same for the direction numbers of emit().
  std::function<bool(Vec2)> smoothEmission = smooth;
};

/// An environment with a picture: derivatives jump at the borders of texels (of the density) and at
/// their centres (of the lookup).
inline LightCase pictureCase(std::string name, const Picture& picture, const Affine& toWorld) {
  LightCase c{std::move(name), environment(picture, {}, toWorld), {}, {}};
  c.from = {Real(0.2), Real(0.1), 0}, c.receiver = normalize(Vec3{1, 2, 1});
  c.grid = {picture.width(), picture.height()}, c.toImage = transpose(toWorld.linear());
  c.fine = 16, c.powerTolerance = Real(0.02);
  const auto light = c.light;
  const Mat3 toImage = c.toImage;
  const SphereGrid halves = {2 * c.grid.columns, 2 * c.grid.rows};
  const Real h = kStep;
  c.smooth = [light, toImage, halves, h](Vec2 u) {
    std::size_t first = 0;
    for (int i = 0; i < 4; ++i) {
      const Real s = (i & 1) ? 3 * h : -3 * h;
      const Vec2 v = (i & 2) ? Vec2{u.x + s, u.y} : Vec2{u.x, u.y + s};
      if (!(v.x > 0 && v.x < 1 && v.y > 0 && v.y < 1)) return false;
      const auto drawn = light->sample({}, v);
      if (!drawn) return false;
      const std::size_t bin = halves.bin(toImage * drawn->hit.toLight);
      if (i == 0) first = bin;
      if (bin != first) return false;
    }
    return true;
  };
  c.smoothEmission = c.smooth;
  return c;
}

inline std::vector<LightCase> lightCases() {
  const auto light = [](const std::string& name, const Settings& settings,
                        const Affine& toWorld = {}) {
    return make<Light>(pluginNamed("light", name), settings, toWorld);
  };
  const Value colour = colourValue(3, 5, 4);
  Settings area = {{"corner", at({-1, 2, -1})},
                   {"edge1", at({Real(2.5), Real(0.2), 0})},
                   {"edge2", at({Real(0.3), Real(0.1), 2})},
                   {"radiance", colour}};
  std::vector<LightCase> list;
  LightCase one{"area", light("area", area), {Real(0.2), 1, Real(0.1)}, {0, 1, 0}};
  one.grid = {128, 64};
  list.push_back(one);
  area["two_sided"] = numberValue(1);
  LightCase both{
      "area, two-sided, from above", light("area", area, rotation({1, 2, 3}, 40)), {}, {}};
  const Affine turn = rotation({1, 2, 3}, 40);
  both.from = turn.point({Real(0.2), 3, Real(0.1)}), both.receiver = turn.vector({0, -1, 0});
  both.grid = {128, 64};
  both.smoothEmission = [](Vec2 u) {  // either half of the first number leaves by its own side
    const Real x = 2 * u.x - std::floor(2 * u.x);
    return awayFromRim({x, u.y}) && differsSmoothly({x, u.y}, 2 * kStep);
  };
  list.push_back(both);
  list.push_back({"point",
                  light("point", {{"location", at({0, 2, 0})}, {"intensity", colour}}),
                  {Real(0.3), 1, Real(-0.2)},
                  {0, 1, 0}});
  list.push_back({"spot",
                  light("spot", {{"location", at({0, 2, 0})},
                                 {"point_at", at({Real(0.3), 0, 0})},
                                 {"intensity", colour},
                                 {"radius", numberValue(10)},
                                 {"falloff", numberValue(60)}}),
                  {Real(0.5), 1, Real(0.1)},
                  {0, 1, 0}});
  list.push_back({"distant",
                  light("distant", {{"direction", at({1, -3, 2})}, {"irradiance", colour}}),
                  {Real(0.3), 1, Real(-0.2)},
                  {0, 1, 0}});
  list.push_back({"environment, even",
                  light("environment", {{"radiance", colour}}),
                  {Real(0.3), 1, Real(-0.2)},
                  {0, 1, 0}});
  const Picture smooth(8, 4,
                       [](Real u, Real v) { return 2 + std::sin(2 * kPi * (u + Real(0.1))) + v; });
  list.push_back(pictureCase("environment, 8 x 4", smooth, {}));
  list.push_back(pictureCase("environment, sun", sunny(), {}));
  list.push_back(pictureCase("environment, turned", smooth, rotation({1, 2, 3}, 50)));
  for (LightCase& c : list) {
    c.light->setScene({{-1, -2, -1}, {2, 1, 1}});
    c.centre = {Real(0.5), Real(-0.5), 0};
  }
  return list;
}

}  // namespace vestige::test
