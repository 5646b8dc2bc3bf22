// SPDX-License-Identifier: Apache-2.0
// Finds plugin libraries, and loads one when its plugin is asked for. Built-in plugins take the
// same way as a stranger's.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include <vestige/host.h>
#include <vestige/inputs.h>

#include "engine/scene/plugin_library.h"

namespace vestige {

/// For the user: that derivatives of this plugin are taken by finite differences, and which.
std::string noteOnDifferences(const Plugin& plugin);

/// A library that was asked for and could not be taken.
struct Refusal {
  PluginName promised;  ///< by the name of its file
  std::string file;
  std::string sentence;  ///< for the user: which file, and why
};

/// All plugins of some folders. A library is opened when somebody asks for what its file's name
/// promises: a scene pays for the plugins that it names, and hears nothing of a broken one that it
/// does not. So these functions are const in what they answer, not in what they do: ask on one
/// thread only, the one that reads and builds scenes. What they return lives as long as the
/// registry.
class Registry {
 public:
  /// Lists the libraries of these folders, in order; a later one of the same kind and name replaces
  /// an earlier, unless it is refused. Those whose file names promise nothing are opened now:
  /// `refused` receives a sentence for each of them that was not taken, with the reason.
  static Registry load(const std::vector<std::string>& folders, std::vector<std::string>& refused);
  Registry(Registry&&) noexcept;
  ~Registry();

  /// Whether no library was found, fit or not.
  bool isEmpty() const;
  /// How many plugins are loaded by now.
  std::size_t loaded() const;

  /// Whether there is such a plugin or block, as far as names of files tell. Opens nothing, and
  /// always answers the same.
  bool has(const std::string& kind, const std::string& name) const;
  /// Null where there is none, or none that can be taken: whyMissing().
  const Plugin* find(const std::string& kind, const std::string& name) const;
  /// A plugin's schema with the rows that the engine adds to its kind (opacity, normal_map,
  /// emission, ...), or that of a block that is no plugin (film, union, ...).
  const Schema* schema(const std::string& kind, const std::string& name) const;
  /// The reason if a library was to hold this plugin but was refused, else "".
  std::string whyMissing(const std::string& kind, const std::string& name) const;

  /// First words of blocks: "brdf", "film", ... Opens nothing.
  std::vector<std::string> kinds() const;
  /// What there is of one kind, by name. Opens all its libraries.
  std::vector<std::string> names(const std::string& kind) const;
  /// Everything, by kind and name. These open all libraries.
  std::vector<Plugin> plugins() const;
  std::vector<const Schema*> schemas() const;

  /// Files of all plugins that are loaded by now.
  std::vector<std::string> loadedFiles() const;
  /// What was asked for so far in vain.
  const std::vector<Refusal>& refused() const;

  /// Creates an object of plugin `kind name`; null with `error` filled. Interface must be the
  /// kind's. The host is told a note where the plugin leaves derivatives to differences.
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
/// Where in it are the plugins, the language includes, and the templates of new plugins.
std::string installedPluginFolder();
std::string installedIncludeFolder();
std::string installedTemplateFolder();
/// Where a user keeps plugins of his own, ~/.local/lib/vestige; "" for one without a home.
std::string userPluginFolder();
/// The installed folder, that of the user, VESTIGE_PLUGIN_PATH, then `extra`: what comes later
/// goes before.
std::vector<std::string> pluginFolders(const std::vector<std::string>& extra);

}  // namespace vestige
