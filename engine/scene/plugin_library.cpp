// SPDX-License-Identifier: Apache-2.0
#include "engine/scene/plugin_library.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string_view>
#include <system_error>

#include "engine/scene/library_file.h"

namespace vestige {
namespace {

namespace fs = std::filesystem;

/// The kinds for which the engine has an interface.
constexpr std::array<std::string_view, 8> kKinds = {"brdf",   "camera", "integrator", "light",
                                                    "medium", "phase",  "pigment",    "shape"};

bool isWord(std::string_view text) {
  const auto isLetter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
  };
  const auto isPart = [&](char c) { return isLetter(c) || (c >= '0' && c <= '9'); };
  return !text.empty() && isLetter(text[0]) && std::all_of(text.begin(), text.end(), isPart);
}

/// Why an entry cannot be used, or "". Fields are read in the order in which they become safe to.
std::string refusal(const VestigePlugin& e) {
  if (e.magic != kPluginMagic) return "its entry does not begin with the magic number of a plugin";
  if (e.size < offsetof(VestigePlugin, abiTag))
    return fmt::format("its entry is only {} bytes long", e.size);
  if (e.sdkMajor != kSdkMajor || e.sdkMinor > kSdkMinor)
    return fmt::format("it was built for SDK {}.{}, this engine has {}.{}: build it again",
                       e.sdkMajor, e.sdkMinor, kSdkMajor, kSdkMinor);
  if (e.size < sizeof(VestigePlugin))
    return fmt::format("its entry is {} bytes long, this engine needs {}", e.size,
                       sizeof(VestigePlugin));
  if (!e.abiTag || std::string_view(e.abiTag) != kAbiTag)
    return fmt::format("it was built as '{}', this engine as '{}'", e.abiTag ? e.abiTag : "",
                       kAbiTag);
  if (!e.schema || !e.create || !e.destroy || !e.kind || !e.name)
    return "its entry has empty fields";
  return "";
}

/// The loader identifies libraries by name and would return the old one for a rebuilt file, so such
/// a file is opened as a copy under another name. Null, with the loader's message in `why`.
void* openLibrary(const std::string& file, std::string& why) {
  struct Opened {
    fs::file_time_type written;
    std::string name;  ///< under which the loader has opened it
  };
  static std::map<std::string, Opened> known;
  std::error_code failed;
  const fs::file_time_type written = fs::last_write_time(file, failed);
  const auto before = known.find(file);
  if (before != known.end() && before->second.written == written)
    if (void* library = dlopen(before->second.name.c_str(), RTLD_NOW | RTLD_LOCAL)) return library;
  std::string name = file;
  const bool isCopy = before != known.end() && !failed;
  std::string folder;
  if (isCopy) {  // of the same name, which crashes tell
    folder = (fs::temp_directory_path(failed) / "vestige-XXXXXX").string();
    if (!mkdtemp(folder.data())) failed = std::make_error_code(std::errc(errno));
    name = folder + '/' + fs::path(file).filename().string();
    if (!failed) fs::copy_file(file, name, failed);
  }
  known[file] = {written, name};
  void* library = failed && isCopy ? nullptr : dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!library) why = failed && isCopy ? failed.message() : dlerror();
  if (isCopy) fs::remove_all(folder, failed);
  return library;
}

std::string brokenPromise(const VestigePlugin& e, const std::optional<PluginName>& promised) {
  if (!promised || *promised == PluginName{e.kind, e.name}) return "";
  return fmt::format("its name promises {} '{}', but it holds {} '{}': call it {}_{}.so",
                     promised->kind, promised->name, e.kind, e.name, e.kind, e.name);
}

}  // namespace

std::vector<std::string> librariesIn(const std::string& folder) {
  std::vector<std::string> files;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (entry.path().extension() == ".so") files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

std::optional<PluginName> promisedBy(const std::string& file) {
  const std::string stem = fs::path(file).stem().string();
  const std::size_t end = stem.find('_');
  if (end == stem.npos) return std::nullopt;
  const PluginName promised = {stem.substr(0, end), stem.substr(end + 1)};
  const bool isKind = std::find(kKinds.begin(), kKinds.end(), promised.kind) != kKinds.end();
  if (!isKind || !isWord(promised.name)) return std::nullopt;
  return promised;
}

std::optional<Plugin> openPlugin(const std::string& file, const std::optional<PluginName>& promised,
                                 std::string& why) {
  if (why = cutShort(file); !why.empty()) return std::nullopt;
  void* library = openLibrary(file, why);
  if (!library) return std::nullopt;
  const auto* entry = static_cast<const VestigePlugin*>(dlsym(library, "vestige_plugin"));
  why = entry ? refusal(*entry) : "it exports no symbol 'vestige_plugin'";
  if (why.empty()) why = brokenPromise(*entry, promised);
  if (!why.empty()) {
    dlclose(library);
    return std::nullopt;
  }
  // Never closed again: objects of the plugin may live as long as the program.
  return Plugin{entry->kind, entry->name, entry->version,
                file,        entry,       static_cast<const Schema*>(entry->schema())};
}

}  // namespace vestige
