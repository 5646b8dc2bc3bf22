// SPDX-License-Identifier: Apache-2.0
// One plugin library: the plugin that its file name announces, and its contents once it is opened.
#pragma once
#include <compare>
#include <optional>
#include <string>
#include <vector>

#include <vestige/abi.h>
#include <vestige/schema.h>

namespace vestige {

/// The name of a plugin in a scene: `brdf phong`. Blocks that are no plugins have a kind only.
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

/// `.../brdf_phong.so` announces brdf phong. A file whose name has no known kind, or no word of the
/// language after it, announces no plugin.
std::optional<PluginName> promisedBy(const std::string& file);

/// Opens one library and checks it; nullopt with the reason in `why`. Its plugin must be the
/// announced one, if the file name announces one.
std::optional<Plugin> openPlugin(const std::string& file, const std::optional<PluginName>& promised,
                                 std::string& why);

}  // namespace vestige
