// SPDX-License-Identifier: Apache-2.0
#include "engine/files/cache_folder.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

namespace vestige {

namespace fs = std::filesystem;

namespace {

/// A variable of the environment that names a folder; relative ones are ignored, as the XDG
/// specification requires.
fs::path named(const char* variable) {
  const char* text = std::getenv(variable);
  return text && fs::path(text).is_absolute() ? fs::path(text) : fs::path();
}

fs::path wanted() {
  // The user's own word may be relative.
  if (const char* own = std::getenv("VESTIGE_CACHE"); own && *own) return own;
  if (const fs::path xdg = named("XDG_CACHE_HOME"); !xdg.empty()) return xdg / "vestige";
  if (const fs::path home = named("HOME"); !home.empty()) return home / ".cache" / "vestige";
  return {};
}

}  // namespace

std::string cacheFolder(std::string& why) {
  const fs::path folder = wanted();
  std::error_code code;
  if (folder.empty()) {
    why = "there is no folder for it: neither VESTIGE_CACHE nor HOME is set";
    return "";
  }
  fs::create_directories(folder, code);
  const fs::path whole = fs::absolute(folder, code).lexically_normal();
  if (!fs::is_directory(folder, code))
    why = fmt::format("the cache folder '{}' cannot be made", whole.string());
  else if (access(folder.c_str(), R_OK | W_OK | X_OK) != 0)
    why = fmt::format("no permission to write into the cache folder '{}'", whole.string());
  return why.empty() ? whole.string() : "";
}

}  // namespace vestige
