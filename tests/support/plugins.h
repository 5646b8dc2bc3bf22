// SPDX-License-Identifier: Apache-2.0
// Plugins as the engine meets them: every library of the build's plugin folder, opened, checked
// against the SDK's tag, and made with the values a test chooses.
//
//     for (const LoadedPlugin& plugin : pluginsOfKind("brdf")) {
//       const auto brdf = make<Brdf>(plugin, {});
//       const InputBuffer inputs = inputsFor(*plugin.schema, {{"exponent", numberValue(40)}});
//       ... brdf->eval({toPrev, false, Inputs(inputs.data())}, toNext) ...
//     }
#pragma once
#include <dlfcn.h>
#include <vestige/abi.h>
#include <vestige/host.h>
#include <vestige/inputs.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace vestige::test {

/// A library that stays open until the program ends: objects and schemas of it may outlive any
/// test.
struct LoadedPlugin {
  std::string kind, name, file;
  const VestigePlugin* entry = nullptr;
  const Schema* schema = nullptr;
};

/// Values by parameter name, in place of the schema's defaults.
using Settings = std::map<std::string, Value>;

/// 8 x 4 texels, smooth and nowhere black: a sky that has a brightest place, towards u = 0.25,
/// v = 0.8. Constant inside a texel, so that sums over texels are exact.
class SmallTexture final : public Texture {
 public:
  Rgba lookup(Vec2 uv, const Vec2*) const noexcept override {
    const Real u = uv.x - std::floor(uv.x), v = std::clamp(uv.y, Real(0), kOneMinusEpsilon);
    return texel(std::min(int(u * width()), width() - 1),
                 std::min(int(v * height()), height() - 1));
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
};

/// Every file is found, every image is the small texture, warnings are kept.
class NullHost final : public Host {
 public:
  std::string find(const std::string& file, Span, std::string&) override { return file; }
  std::shared_ptr<const Texture> texture(const TextureRequest&, std::string&) override {
    return std::make_shared<SmallTexture>();
  }
  void warn(Span, const std::string& message) override { warnings.push_back(message); }
  std::vector<std::string> warnings;
};

/// Opens one library. Throws where it is no plugin of this build: the suite must not pass over it.
inline LoadedPlugin openPlugin(const std::string& file) {
  void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!library) throw std::runtime_error(std::string("cannot open plugin: ") + dlerror());
  const auto* entry = static_cast<const VestigePlugin*>(dlsym(library, "vestige_plugin"));
  if (!entry || entry->magic != kPluginMagic || std::strcmp(entry->abiTag, kAbiTag) != 0)
    throw std::runtime_error(file + " is no plugin of this build");
  const auto* schema = static_cast<const Schema*>(entry->schema());
  return {entry->kind, entry->name, file, entry, schema};
}

/// All libraries of the folder VESTIGE_PLUGINS, by name.
inline std::vector<LoadedPlugin> allPlugins() {
  std::vector<LoadedPlugin> list;
  for (const auto& entry : std::filesystem::directory_iterator(VESTIGE_PLUGINS))
    if (entry.path().extension() == ".so") list.push_back(openPlugin(entry.path().string()));
  std::sort(list.begin(), list.end(),
            [](const LoadedPlugin& a, const LoadedPlugin& b) { return a.file < b.file; });
  return list;
}

/// Those of one kind: "brdf", "light", "camera", "shape", "pigment", "integrator".
inline std::vector<LoadedPlugin> pluginsOfKind(const std::string& kind) {
  std::vector<LoadedPlugin> list;
  for (LoadedPlugin& plugin : allPlugins())
    if (plugin.kind == kind) list.push_back(std::move(plugin));
  return list;
}

/// One plugin by kind and name. Throws where it was not built.
inline LoadedPlugin pluginNamed(const std::string& kind, const std::string& name) {
  return openPlugin(std::string(VESTIGE_PLUGINS) + "/" + kind + "_" + name + ".so");
}

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
std::shared_ptr<Interface> make(const LoadedPlugin& plugin, const Settings& settings, Host& host,
                                const Affine& toWorld = {}) {
  const std::vector<Value> rows = rowValues(plugin.schema->params, settings);
  const Values values(rows, toWorld);
  VestigeError error = {};
  void* made = plugin.entry->create(&values, &host, &error);
  if (!made) throw std::runtime_error(error.text);
  return std::shared_ptr<Interface>(static_cast<Interface*>(made), plugin.entry->destroy);
}
template <class Interface>
std::shared_ptr<Interface> make(const LoadedPlugin& plugin, const Settings& settings = {},
                                const Affine& toWorld = {}) {
  NullHost host;
  return make<Interface>(plugin, settings, host, toWorld);
}

/// The numbers that a BRDF finds in its Inputs: settings and defaults, zero where there is neither.
inline InputBuffer inputsFor(const Schema& schema, const Settings& settings) {
  InputBuffer buffer = {};
  const std::vector<Value> values = rowValues(schema.inputs, settings);
  for (std::size_t i = 0; i < values.size(); ++i)
    for (int c = 0; c < 3; ++c) buffer[i].v[c] = Real(values[i].v[c]);
  return buffer;
}

}  // namespace vestige::test
