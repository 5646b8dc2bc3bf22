// SPDX-License-Identifier: Apache-2.0
// Lights to test, each with a place where it is seen well.
#pragma once
#include <vestige/camera.h>
#include <vestige/light.h>
#include <vestige/tools/sampling.h>

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

struct LightCase {
  std::string name;
  std::shared_ptr<Light> light;
  Vec3 from;      ///< sees the light, or most of it
  Vec3 receiver;  ///< unit normal of a surface there that faces it
};

inline LightCase pictureCase(std::string name, const Picture& picture, const Affine& toWorld) {
  return {std::move(name),
          environment(picture, {}, toWorld),
          {Real(0.2), Real(0.1), 0},
          normalize(Vec3{1, 2, 1})};
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
  list.push_back({"area", light("area", area), {Real(0.2), 1, Real(0.1)}, {0, 1, 0}});
  area["two_sided"] = numberValue(1);
  const Affine turn = rotation({1, 2, 3}, 40);
  list.push_back({"area, two-sided, from above", light("area", area, turn),
                  turn.point({Real(0.2), 3, Real(0.1)}), turn.vector({0, -1, 0})});
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
  for (LightCase& c : list) c.light->setScene({{-1, -2, -1}, {2, 1, 1}});
  return list;
}

}  // namespace vestige::test
