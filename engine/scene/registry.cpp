// SPDX-License-Identifier: Apache-2.0
#include "engine/scene/registry.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <optional>

#include "engine/scene/engine_schemas.h"

namespace vestige {
namespace {

namespace fs = std::filesystem;

/// Why an entry cannot be used, or "". Fields are read in the order in which they become safe to.
std::string refusal(const VestigePlugin& e) {
  if (e.magic != kPluginMagic) return "its entry does not begin with the magic number of a plugin";
  if (e.size < sizeof(VestigePlugin))
    return fmt::format("its entry is {} bytes long, this engine needs {}", e.size,
                       sizeof(VestigePlugin));
  if (e.sdkMajor != kSdkMajor || e.sdkMinor > kSdkMinor)
    return fmt::format("it was built for SDK {}.{}, this engine has {}.{}", e.sdkMajor, e.sdkMinor,
                       kSdkMajor, kSdkMinor);
  if (std::string(e.abiTag) != kAbiTag)
    return fmt::format("it was built as '{}', this engine as '{}'", e.abiTag, kAbiTag);
  if (!e.schema || !e.create || !e.destroy || !e.kind || !e.name)
    return "its entry has empty fields";
  return "";
}

/// Loads one library; nullopt with the reason in `why`.
std::optional<Plugin> loadPlugin(const std::string& file, std::string& why) {
  void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!library) {
    why = dlerror();
    return std::nullopt;
  }
  const auto* entry = static_cast<const VestigePlugin*>(dlsym(library, "vestige_plugin"));
  why = entry ? refusal(*entry) : "it exports no symbol 'vestige_plugin'";
  if (!why.empty()) {
    dlclose(library);
    return std::nullopt;
  }
  // Never closed again: objects of the plugin may live as long as the program.
  return Plugin{entry->kind, entry->name, entry->version,
                file,        entry,       static_cast<const Schema*>(entry->schema())};
}

std::vector<std::string> librariesIn(const std::string& folder) {
  std::vector<std::string> files;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (entry.path().extension() == ".so") files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

fs::path programFolder() {
  std::error_code ignored;
  return fs::read_symlink("/proc/self/exe", ignored).parent_path();
}

}  // namespace

std::string noteOnDifferences(const Plugin& plugin) {
  const bool sampled = plugin.entry->lacks & kLacksSampleDerivatives;
  const bool gradient = plugin.entry->lacks & kLacksLogGradient;
  const char* missing = !gradient  ? "no derivatives of its sampled directions"
                        : !sampled ? "no gradient of its value"
                                   : "no derivatives of its own";
  return fmt::format("{} '{}' gives {}: finite differences stand in, slower and less exact",
                     plugin.kind, plugin.name, missing);
}

Registry Registry::load(const std::vector<std::string>& folders,
                        std::vector<std::string>& refused) {
  Registry r;
  for (const std::string& folder : folders)
    for (const std::string& file : librariesIn(folder)) {
      std::string why;
      const std::optional<Plugin> p = loadPlugin(file, why);
      if (!p) {
        refused.push_back(fmt::format("plugin library '{}' was not loaded: {}", file, why));
        continue;
      }
      std::erase_if(r.plugins_,
                    [&](const Plugin& q) { return q.kind == p->kind && q.name == p->name; });
      r.plugins_.push_back(*p);
    }
  r.schemas_ = engineSchemas();
  for (const Plugin& p : r.plugins_) r.schemas_.push_back(withEngineRows(*p.schema));
  std::sort(r.schemas_.begin(), r.schemas_.end(), [](const Schema& a, const Schema& b) {
    return std::pair(a.kind, a.name) < std::pair(b.kind, b.name);
  });
  return r;
}

const Plugin* Registry::find(const std::string& kind, const std::string& name) const noexcept {
  for (const Plugin& p : plugins_)
    if (p.kind == kind && p.name == name) return &p;
  return nullptr;
}

const Schema* Registry::schema(const std::string& kind, const std::string& name) const noexcept {
  for (const Schema& s : schemas_)
    if (s.kind == kind && s.name == name) return &s;
  return nullptr;
}

std::string installedPluginFolder() {
  return (programFolder().parent_path() / "lib/vestige/plugins").string();
}

std::string installedIncludeFolder() {
  return (programFolder().parent_path() / "share/vestige/library").string();
}

std::vector<std::string> pluginFolders(const std::vector<std::string>& extra) {
  std::vector<std::string> folders = {installedPluginFolder()};
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
