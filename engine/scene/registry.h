// SPDX-License-Identifier: Apache-2.0
// Finds plugin libraries, and loads one when its plugin is requested. Built-in and third-party
// plugins are treated alike.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include <vestige/host.h>
#include <vestige/inputs.h>

#include "engine/scene/plugin_library.h"

namespace vestige {

/// A note for the user: the derivatives of this plugin that are taken by finite differences.
std::string noteOnDifferences(const Plugin& plugin);

/// A library that was requested and refused.
struct Refusal {
  PluginName promised;  ///< announced by its file name
  std::string file;
  std::string sentence;  ///< for the user: which file, and why
};

/// All plugins of some folders. A library is opened on the first request for the plugin that its
/// file name announces: a scene loads only the plugins that it names, and broken libraries that it
/// does not name cause no errors. So these functions return the same results on every call but are
/// not thread-safe: call them only on the thread that reads and builds scenes. Their results live
/// as long as the registry.
class Registry {
 public:
  /// Lists the libraries of these folders, in order; a later one of the same kind and name replaces
  /// an earlier, unless it is refused. Libraries whose file names announce no plugin are opened
  /// now: `refused` receives a message for each that was refused, with the reason.
  static Registry load(const std::vector<std::string>& folders, std::vector<std::string>& refused);
  Registry(Registry&&) noexcept;
  ~Registry();

  /// Whether no library was found, fit or not.
  bool isEmpty() const;
  /// Number of plugins loaded so far.
  std::size_t loaded() const;

  /// Whether there is such a plugin or block, judged by file names. Opens no library; the result
  /// never changes.
  bool has(const std::string& kind, const std::string& name) const;
  /// The plugin, or null if there is none or it was refused: see whyMissing().
  const Plugin* find(const std::string& kind, const std::string& name) const;
  /// A plugin's schema with the rows that the engine adds to its kind (opacity, normal_map,
  /// emission, ...), or that of a block that is no plugin (film, union, ...).
  const Schema* schema(const std::string& kind, const std::string& name) const;
  /// The reason why the library of this plugin was refused, else "".
  std::string whyMissing(const std::string& kind, const std::string& name) const;

  /// First words of blocks: "brdf", "film", ... Opens nothing.
  std::vector<std::string> kinds() const;
  /// All plugins of one kind, by name. Opens all its libraries.
  std::vector<std::string> names(const std::string& kind) const;
  /// Everything, by kind and name. These open all libraries.
  std::vector<Plugin> plugins() const;
  std::vector<const Schema*> schemas() const;

  /// Files of all plugins loaded so far.
  std::vector<std::string> loadedFiles() const;
  /// The libraries requested and refused so far.
  const std::vector<Refusal>& refused() const;

  /// Creates an object of plugin `kind name`; null with `error` filled. Interface must be the
  /// kind's. Notifies the user once if the plugin relies on finite-difference derivatives.
  template <class Interface>
  std::shared_ptr<Interface> create(const std::string& kind, const std::string& name,
                                    const Values& values, Host& host, VestigeError& error) const {
    const Plugin* plugin = find(kind, name);
    void* made = plugin ? plugin->entry->create(&values, &host, &error) : nullptr;
    if (!made) return nullptr;
    if (plugin->entry->lacks & kLacksDerivatives) host.note(noteOnDifferences(*plugin));
    return std::shared_ptr<Interface>(static_cast<Interface*>(made), plugin->entry->destroy);
  }

 private:
  class Catalogue;
  Registry();

  std::unique_ptr<Catalogue> catalogue_;
};

/// The folder that holds bin/, lib/ and share/ of this installation: found beside the program.
std::string installationFolder();
/// Its folders of plugins, of language includes, and of templates for new plugins.
std::string installedPluginFolder();
std::string installedIncludeFolder();
std::string installedTemplateFolder();
/// The user's own folder of plugins, ~/.local/lib/vestige; "" without a home folder.
std::string userPluginFolder();
/// The installed folder, that of the user, VESTIGE_PLUGIN_PATH, then `extra`: what comes later
/// goes before.
std::vector<std::string> pluginFolders(const std::vector<std::string>& extra);

}  // namespace vestige
