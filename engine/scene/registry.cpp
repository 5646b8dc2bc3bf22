// SPDX-License-Identifier: Apache-2.0
#include "engine/scene/registry.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>

#include "engine/scene/engine_schemas.h"

namespace vestige {
namespace {

namespace fs = std::filesystem;

std::string notLoaded(const std::string& file, const std::string& why) {
  return fmt::format("plugin library '{}' was not loaded: {}", file, why);
}

fs::path programFolder() {
  std::error_code ignored;
  return fs::read_symlink("/proc/self/exe", ignored).parent_path();
}

}  // namespace

std::string noteOnDifferences(const Plugin& plugin) {
  const bool sampled = plugin.entry->lacks & kLacksSampleDerivatives;
  const bool gradient = plugin.entry->lacks & kLacksLogGradient;
  const bool emission = plugin.entry->lacks & kLacksEmissionDerivatives;
  const char* missing = sampled + gradient + emission > 1 ? "no derivatives of its own"
                        : sampled  ? "no derivatives of its sampled directions"
                        : gradient ? "no gradient of its value"
                                   : "no derivatives of its particles";
  return fmt::format("{} '{}' gives {}: finite differences stand in, slower and less exact",
                     plugin.kind, plugin.name, missing);
}

/// The plugins known so far; grows as libraries are opened.
class Registry::Catalogue {
 public:
  Catalogue();
  /// Processes the next library of the folders: notes it if its name announces a plugin, else opens
  /// it.
  void add(const std::string& file, std::vector<std::string>& refusedNow);
  /// After these nothing of that name, that kind, nothing at all waits.
  void open(const PluginName& wanted);
  void openKind(const std::string& kind);
  void openAll();

  /// Unopened files whose names announce a plugin, in the order of their folders. They have
  /// precedence over a plugin of the same name in `plugins`.
  std::map<PluginName, std::vector<std::string>> waiting;
  std::map<PluginName, Plugin> plugins;
  std::map<PluginName, Schema> schemas;  ///< of plugins and of blocks that are none
  std::vector<Refusal> refused;

 private:
  void take(const Plugin& plugin);
};

Registry::Catalogue::Catalogue() {
  for (const Schema& s : engineSchemas()) schemas[{s.kind, s.name}] = s;
}

void Registry::Catalogue::add(const std::string& file, std::vector<std::string>& refusedNow) {
  if (const std::optional<PluginName> promised = promisedBy(file)) {
    waiting[*promised].push_back(file);
    return;
  }
  std::string why;
  if (const std::optional<Plugin> plugin = openPlugin(file, {}, why)) {
    waiting.erase({plugin->kind, plugin->name});
    take(*plugin);
  } else {
    refusedNow.push_back(notLoaded(file, why));
  }
}

void Registry::Catalogue::take(const Plugin& plugin) {
  const PluginName name = {plugin.kind, plugin.name};
  plugins[name] = plugin;
  schemas[name] = withEngineRows(*plugin.schema);
}

void Registry::Catalogue::open(const PluginName& wanted) {
  const auto files = waiting.extract(wanted);
  if (!files) return;
  for (auto file = files.mapped().rbegin(); file != files.mapped().rend(); ++file) {
    std::string why;
    if (const std::optional<Plugin> plugin = openPlugin(*file, wanted, why)) return take(*plugin);
    refused.push_back({wanted, *file, notLoaded(*file, why)});
  }
}

void Registry::Catalogue::openKind(const std::string& kind) {
  for (auto next = waiting.lower_bound({kind, ""});
       next != waiting.end() && next->first.kind == kind; next = waiting.lower_bound({kind, ""}))
    open(PluginName(next->first));
}

void Registry::Catalogue::openAll() {
  while (!waiting.empty()) open(PluginName(waiting.begin()->first));
}

Registry::Registry() : catalogue_(std::make_unique<Catalogue>()) {}
Registry::Registry(Registry&&) noexcept = default;
Registry::~Registry() = default;

Registry Registry::load(const std::vector<std::string>& folders,
                        std::vector<std::string>& refused) {
  Registry r;
  for (const std::string& folder : folders)
    for (const std::string& file : librariesIn(folder)) r.catalogue_->add(file, refused);
  return r;
}

bool Registry::isEmpty() const {
  return catalogue_->plugins.empty() && catalogue_->waiting.empty() && catalogue_->refused.empty();
}

std::size_t Registry::loaded() const { return catalogue_->plugins.size(); }

bool Registry::has(const std::string& kind, const std::string& name) const {
  const PluginName wanted = {kind, name};
  const auto isWanted = [&](const Refusal& r) { return r.promised == wanted; };
  const std::vector<Refusal>& refused = catalogue_->refused;
  return catalogue_->schemas.count(wanted) > 0 || catalogue_->waiting.count(wanted) > 0 ||
         std::any_of(refused.begin(), refused.end(), isWanted);
}

const Plugin* Registry::find(const std::string& kind, const std::string& name) const {
  const PluginName wanted = {kind, name};
  catalogue_->open(wanted);
  const auto found = catalogue_->plugins.find(wanted);
  return found == catalogue_->plugins.end() ? nullptr : &found->second;
}

const Schema* Registry::schema(const std::string& kind, const std::string& name) const {
  const PluginName wanted = {kind, name};
  catalogue_->open(wanted);
  const auto found = catalogue_->schemas.find(wanted);
  return found == catalogue_->schemas.end() ? nullptr : &found->second;
}

std::string Registry::whyMissing(const std::string& kind, const std::string& name) const {
  if (schema(kind, name)) return "";
  for (const Refusal& r : catalogue_->refused)
    if (r.promised == PluginName{kind, name}) return r.sentence;
  return "";
}

std::vector<std::string> Registry::kinds() const {
  std::vector<std::string> found;
  const auto add = [&](const auto& map) {
    for (const auto& [name, ignored] : map) found.push_back(name.kind);
  };
  add(catalogue_->schemas), add(catalogue_->waiting);
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

std::vector<std::string> Registry::names(const std::string& kind) const {
  catalogue_->openKind(kind);
  std::vector<std::string> found;
  for (const auto& [name, ignored] : catalogue_->schemas)
    if (name.kind == kind) found.push_back(name.name);
  return found;
}

std::vector<Plugin> Registry::plugins() const {
  catalogue_->openAll();
  std::vector<Plugin> all;
  for (const auto& [ignored, plugin] : catalogue_->plugins) all.push_back(plugin);
  return all;
}

std::vector<const Schema*> Registry::schemas() const {
  catalogue_->openAll();
  std::vector<const Schema*> all;
  for (const auto& [ignored, schema] : catalogue_->schemas) all.push_back(&schema);
  return all;
}

std::vector<std::string> Registry::loadedFiles() const {
  std::vector<std::string> files;
  for (const auto& [ignored, plugin] : catalogue_->plugins) files.push_back(plugin.file);
  return files;
}

const std::vector<Refusal>& Registry::refused() const { return catalogue_->refused; }

std::string installationFolder() { return programFolder().parent_path().string(); }

std::string installedPluginFolder() {
  return (programFolder().parent_path() / "lib/vestige/plugins").string();
}

std::string userPluginFolder() {
  const char* home = std::getenv("HOME");
  return home && *home ? (fs::path(home) / ".local/lib/vestige").string() : "";
}

std::string installedIncludeFolder() {
  return (programFolder().parent_path() / "share/vestige/library").string();
}

std::string installedTemplateFolder() {
  return (programFolder().parent_path() / "share/vestige/templates").string();
}

std::vector<std::string> pluginFolders(const std::vector<std::string>& extra) {
  std::vector<std::string> folders = {installedPluginFolder()};
  if (const std::string own = userPluginFolder(); !own.empty()) folders.push_back(own);
  if (const char* path = std::getenv("VESTIGE_PLUGIN_PATH")) {
    std::string rest = path;
    for (std::size_t colon; !rest.empty();
         rest = colon == rest.npos ? "" : rest.substr(colon + 1)) {
      colon = rest.find(':');
      if (const std::string folder = rest.substr(0, colon); !folder.empty())
        folders.push_back(folder);
    }
  }
  folders.insert(folders.end(), extra.begin(), extra.end());
  return folders;
}

}  // namespace vestige
