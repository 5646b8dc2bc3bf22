// SPDX-License-Identifier: Apache-2.0
// Creates objects of plugins without a scene, with values chosen by a test and a host that finds
// every file.
#pragma once
#include <vestige/host.h>
#include <vestige/inputs.h>
#include <vestige/tools/sampling.h>

#include <algorithm>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/scene/plugin_library.h"

namespace vestige::judge {

/// Values by parameter name, in place of the schema's defaults.
using Settings = std::map<std::string, Value>;

/// 8 x 4 texels, smooth and nowhere black: a sky that has a brightest place, towards u = 0.25,
/// v = 0.8. Bilinear, as host.h has it.
class SmallTexture final : public Texture {
 public:
  explicit SmallTexture(Wrap wrapU = Wrap::repeat, Wrap wrapV = Wrap::repeat)
      : wrapU_(wrapU), wrapV_(wrapV) {}
  Rgba lookup(Vec2 uv, const Vec2*) const noexcept override {
    const Real x = uv.x * width() - Real(0.5), y = uv.y * height() - Real(0.5);
    const int i = int(std::floor(x)), j = int(std::floor(y));
    const Real a = x - i, b = y - j;
    return {(1 - b) * ((1 - a) * around(i, j) + a * around(i + 1, j)) +
                b * ((1 - a) * around(i, j + 1) + a * around(i + 1, j + 1)),
            1};
  }
  Rgba texel(int x, int y) const noexcept override {
    const Real u = (x + Real(0.5)) / width(), v = (y + Real(0.5)) / height();
    const Real bright = 1 + 4 * std::exp(-20 * (sqr(u - Real(0.25)) + sqr(v - Real(0.8))));
    return {{bright, bright * (Real(0.5) + v / 2), Real(0.3) + u}, 1};
  }
  int width() const noexcept override { return 8; }
  int height() const noexcept override { return 4; }
  bool hasAlpha() const noexcept override { return false; }
  Rgba mean() const noexcept override {
    Rgb sum;
    for (int y = 0; y < height(); ++y)
      for (int x = 0; x < width(); ++x) sum += texel(x, y).colour;
    return {sum / Real(width() * height()), 1};
  }

 private:
  static int wrapped(int i, int n, Wrap wrap) noexcept {
    if (wrap == Wrap::clamp) return std::clamp(i, 0, n - 1);
    const int turn = wrap == Wrap::mirror ? 2 * n : n, k = (i % turn + turn) % turn;
    return k < n ? k : turn - 1 - k;
  }
  Rgb around(int x, int y) const noexcept {
    return texel(wrapped(x, width(), wrapU_), wrapped(y, height(), wrapV_)).colour;
  }

  Wrap wrapU_, wrapV_;
};

/// Diffuse BRDF of albedo 0.5: the nested BRDF of any BRDF that needs one.
class PlainDiffuse final : public Brdf {
 public:
  ScatterValue evaluate(const ScatterPoint&, Vec3 toNext) const noexcept override {
    const Real density = std::max(toNext.z, Real(0)) / kPi;
    return {grey(density / 2), density};
  }
  std::optional<ScatterSample> sample(const ScatterPoint&,
                                      ScatterNumbers n) const noexcept override {
    const Vec3 toNext = cosineHemisphere(n.u).d;
    return ScatterSample::only(toNext, grey(Real(0.5)), toNext.z / kPi);
  }
  ScatterJacobian sampleDerivatives(const ScatterPoint&, ScatterNumbers n) const noexcept override {
    return {.du = cosineHemisphere(n.u).du, .dPrev = {}};
  }
  LogGradient logGradient(const ScatterPoint&, Vec3) const noexcept override { return {}; }
  DiffusePart diffuse(const ScatterPoint&) const noexcept override {
    return {grey(Real(0.5)), true};
  }
};

/// Every file is found, every image is the small texture, every BRDF inside another is a plain
/// diffuse one; warnings are kept.
class NullHost final : public Host {
 public:
  std::string find(const std::string& file, Span, std::string&) override { return file; }
  std::shared_ptr<const Texture> texture(const TextureRequest& request, std::string&) override {
    return std::make_shared<SmallTexture>(request.wrapU, request.wrapV);
  }
  NestedBrdf brdf(const Block*) override { return {std::make_shared<PlainDiffuse>(), 0}; }
  void warn(Span, const std::string& message) override { warnings.push_back(message); }
  std::vector<std::string> warnings;
};

/// One value a row: the setting of that name, or the default. Throws for a name that no row has.
inline std::vector<Value> rowValues(const std::vector<Parameter>& rows, const Settings& settings) {
  std::vector<Value> values;
  std::size_t used = 0;
  for (const Parameter& row : rows) {
    const auto given = settings.find(row.name);
    values.push_back(given == settings.end() ? row.initial : given->second);
    used += given != settings.end();
  }
  if (used != settings.size()) throw std::runtime_error("a setting names no row of the schema");
  return values;
}

/// An object of the plugin. Throws std::runtime_error with the plugin's own words where it refuses.
/// The Values live only during the call, as the engine's do.
template <class Interface>
std::shared_ptr<Interface> make(const Plugin& plugin, const Settings& settings, Host& host,
                                const Affine& toWorld = {}) {
  const std::vector<Value> rows = rowValues(plugin.schema->params, settings);
  const Values values(rows, toWorld);
  VestigeError error = {};
  void* made = plugin.entry->create(&values, &host, &error);
  if (!made) throw std::runtime_error(error.text);
  return std::shared_ptr<Interface>(static_cast<Interface*>(made), plugin.entry->destroy);
}
template <class Interface>
std::shared_ptr<Interface> make(const Plugin& plugin, const Settings& settings = {},
                                const Affine& toWorld = {}) {
  NullHost host;
  return make<Interface>(plugin, settings, host, toWorld);
}

/// The inputs of a BRDF: settings and defaults, zero where there is neither.
inline InputBuffer inputsFor(const Schema& schema, const Settings& settings) {
  InputBuffer buffer = {};
  const std::vector<Value> values = rowValues(schema.inputs, settings);
  for (std::size_t i = 0; i < values.size(); ++i)
    for (int c = 0; c < 3; ++c) buffer[i].v[c] = Real(values[i].v[c]);
  return buffer;
}

}  // namespace vestige::judge
