// SPDX-License-Identifier: Apache-2.0
// Plugins as the engine meets them: every library of the build's plugin folder, opened, checked
// against the SDK's tag, and made with the values a test chooses.
//
//     for (const LoadedPlugin& plugin : pluginsOfKind("brdf")) {
//       const auto brdf = make<Brdf>(plugin, {});
//       const InputBuffer inputs = inputsFor(*plugin.schema, {{"exponent", numberValue(40)}});
//       ... brdf->evaluate({.toPrev = toPrev, .inputs = Inputs(inputs.data())}, toNext) ...
//     }
#pragma once
#include <vestige/abi.h>

#include <filesystem>
#include <utility>

#include "judge/made.h"
#include "support/judge.h"

namespace vestige::test {

/// A library that stays open until the program ends: objects and schemas of it may outlive any
/// test.
using LoadedPlugin = Plugin;

/// Opens one library. Throws where it is no plugin of this build: the suite must not pass over it.
inline LoadedPlugin openPlugin(const std::string& file) {
  std::string why;
  const std::optional<Plugin> plugin = vestige::openPlugin(file, {}, why);
  if (!plugin) throw std::runtime_error(file + " is no plugin of this build: " + why);
  return *plugin;
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

}  // namespace vestige::test
