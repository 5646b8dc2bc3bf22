// SPDX-License-Identifier: Apache-2.0
// Shape plugins for tests that come before the registry: the library is opened as the engine would.
#pragma once
#include <dlfcn.h>

#include <fstream>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <vestige/plugin.h>
#include <vestige/shape.h>

namespace vestige::test {

/// Answers with whatever the test put in.
struct FakeHost : Host {
  std::map<std::string, std::shared_ptr<const Texture>> textures;
  std::vector<std::string> warnings;
  std::string find(const std::string& file, Span, std::string& error) override {
    if (std::ifstream(file).good()) return file;
    error = "no file \"" + file + "\"";
    return "";
  }
  std::shared_ptr<const Texture> texture(const TextureRequest& r, std::string& error) override {
    const auto found = textures.find(r.file);
    if (found != textures.end()) return found->second;
    error = "no image \"" + r.file + "\"";
    return nullptr;
  }
  void warn(Span, const std::string& message) override { warnings.push_back(message); }
};

inline const VestigePlugin& shapePlugin(const std::string& name) {
  const std::string path = std::string(VESTIGE_PLUGINS) + "/shape_" + name + ".so";
  void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!library) throw std::runtime_error(dlerror());
  return *static_cast<const VestigePlugin*>(dlsym(library, "vestige_plugin"));
}

/// A shape with the values of some rows, by name; throws PluginError as its constructor would.
inline std::shared_ptr<Shape> makeShape(const std::string& name, std::map<std::string, Value> given,
                                        Host* host = nullptr) {
  FakeHost none;
  const VestigePlugin& plugin = shapePlugin(name);
  std::vector<Value> rows;
  for (const Parameter& p : static_cast<const Schema*>(plugin.schema())->params) {
    rows.push_back(given.count(p.name) ? given[p.name] : p.initial);
    given.erase(p.name);
  }
  if (!given.empty()) throw std::runtime_error(name + " has no row " + given.begin()->first);
  const Values values(rows, Affine{});
  VestigeError error{};
  void* made = plugin.create(&values, host ? host : &none, &error);
  if (!made) throw PluginError(error.input, error.text);
  return {static_cast<Shape*>(made), plugin.destroy};
}

/// Why a shape is refused; "" if it is not.
inline std::string whyRefused(const std::string& name, std::map<std::string, Value> given,
                              Host* host = nullptr) {
  try {
    makeShape(name, std::move(given), host);
    return "";
  } catch (const PluginError& e) {
    return e.what();
  }
}

inline Value number(double x) { return numberValue(x); }
inline Value vec(double x, double y, double z) { return vectorValue({x, y, z}); }
inline Value fileValue(const std::string& name) { return textValue(name); }

// ---------------------------------------------------------------- transforms
inline Affine move(double x, double y, double z) {
  Affine a;
  a.m[0][3] = x, a.m[1][3] = y, a.m[2][3] = z;
  return a;
}
inline Affine scale(double x, double y, double z) {
  Affine a;
  a.m[0][0] = x, a.m[1][1] = y, a.m[2][2] = z;
  return a;
}
/// By an angle about an axis [Rodrigues].
inline Affine turn(Vec3 axis, double angle) {
  const Vec3 n = normalize(axis);
  const double c = std::cos(angle), s = std::sin(angle), k[3] = {n.x, n.y, n.z};
  const double x[3][3] = {{0, -k[2], k[1]}, {k[2], 0, -k[0]}, {-k[1], k[0], 0}};
  Affine a;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) a.m[i][j] = (i == j ? c : 0) + (1 - c) * k[i] * k[j] + s * x[i][j];
  return a;
}

// ---------------------------------------------------------------- random numbers
/// Numbers for tests: a fixed sequence [Steele et al. 2014, SplitMix].
class Random {
 public:
  explicit Random(std::uint64_t seed = 1) : state_(seed) {}
  double number() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return double((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }
  double between(double a, double b) { return a + (b - a) * number(); }
  Vec2 square() {
    const Real x = Real(number());
    return {x < 1 ? x : 0, Real(std::min(number(), 0.9999999))};
  }
  Vec3 direction() {
    const double z = between(-1, 1), r = std::sqrt(1 - z * z), a = between(0, 6.283185307179586);
    return {Real(r * std::cos(a)), Real(r * std::sin(a)), Real(z)};
  }
  Vec3 inBox(double half) {
    return {Real(between(-half, half)), Real(between(-half, half)), Real(between(-half, half))};
  }

 private:
  std::uint64_t state_;
};

}  // namespace vestige::test
