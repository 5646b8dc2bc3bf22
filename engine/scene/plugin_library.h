// SPDX-License-Identifier: Apache-2.0
// One plugin library: what its file's name promises, and what is in it once it is opened.
#pragma once
#include <compare>
#include <optional>
#include <string>
#include <vector>

#include <vestige/abi.h>
#include <vestige/schema.h>

namespace vestige {

/// By what a scene asks for a plugin: `brdf phong`. Blocks that are no plugins have a kind only.
struct PluginName {
  std::string kind, name;
  auto operator<=>(const PluginName&) const = default;
};

/// One plugin that passed the checks.
struct Plugin {
  std::string kind, name, version, file;
  const VestigePlugin* entry;
  const Schema* schema;  ///< as the plugin wrote it
};

/// Names of the libraries in a folder, sorted. None of them is opened.
std::vector<std::string> librariesIn(const std::string& folder);

/// `.../brdf_phong.so` promises brdf phong. A file whose name has no known kind, or no word of the
/// language after it, promises nothing.
std::optional<PluginName> promisedBy(const std::string& file);

/// Opens one library and checks it; nullopt with the reason in `why`. What is there must be what
/// was promised, if something was: found under one name and used under another, it would be known
/// only to those who have asked for the wrong one.
std::optional<Plugin> openPlugin(const std::string& file, const std::optional<PluginName>& promised,
                                 std::string& why);

}  // namespace vestige
