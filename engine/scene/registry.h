// SPDX-License-Identifier: Apache-2.0
// Finds, checks and loads plugin libraries. Built-in plugins take the same way as a stranger's.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include <vestige/abi.h>
#include <vestige/host.h>
#include <vestige/inputs.h>

namespace vestige {

/// One plugin that passed the checks.
struct Plugin {
  std::string kind, name, version, file;
  const VestigePlugin* entry;
  const Schema* schema;  ///< as the plugin wrote it
};

/// For the user: that derivatives of this plugin are taken by finite differences, and which.
std::string noteOnDifferences(const Plugin& plugin);

class Registry {
 public:
  /// Loads every library of these folders, in order; a later one of the same kind and name replaces
  /// an earlier. `refused` receives a sentence for each library that was not taken, with the
  /// reason.
  static Registry load(const std::vector<std::string>& folders, std::vector<std::string>& refused);

  const std::vector<Plugin>& plugins() const noexcept { return plugins_; }
  const Plugin* find(const std::string& kind, const std::string& name) const noexcept;

  /// What the language may say: every plugin's schema with the rows that the engine adds to its
  /// kind (opacity, normal_map, emission, ...), and the blocks that are no plugins (film, union,
  /// ...).
  const std::vector<Schema>& schemas() const noexcept { return schemas_; }
  const Schema* schema(const std::string& kind, const std::string& name) const noexcept;

  /// Creates an object of plugin `kind name`; null with `error` filled. Interface must be the
  /// kind's. The host is told a note where the plugin leaves derivatives to differences.
  template <class Interface>
  std::shared_ptr<Interface> create(const std::string& kind, const std::string& name,
                                    const Values& values, Host& host, VestigeError& error) const {
    const Plugin* plugin = find(kind, name);
    void* made = plugin ? plugin->entry->create(&values, &host, &error) : nullptr;
    if (!made) return nullptr;
    if (plugin->entry->lacks) host.note(noteOnDifferences(*plugin));
    return std::shared_ptr<Interface>(static_cast<Interface*>(made), plugin->entry->destroy);
  }

 private:
  std::vector<Plugin> plugins_;
  std::vector<Schema> schemas_;
};

/// Where this installation keeps its plugins and its language includes: found beside the program.
std::string installedPluginFolder();
std::string installedIncludeFolder();
/// The installed folder, then VESTIGE_PLUGIN_PATH, then `extra`.
std::vector<std::string> pluginFolders(const std::vector<std::string>& extra);

}  // namespace vestige
