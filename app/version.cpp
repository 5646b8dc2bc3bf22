// SPDX-License-Identifier: Apache-2.0
// vestige --version: what a report of an error should contain.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "app/command.h"
#include "engine/picture/image.h"
#include "engine/scene/registry.h"
#include "engine/trace/world.h"

namespace vestige::app {
namespace {

std::string compilerText() {
#if defined(__clang__)
  return "clang " __clang_version__;
#else
  return "gcc " __VERSION__;
#endif
}

/// "31 plugins in DIR (+ DIR2), 1 refused".
std::string pluginText() {
  const std::vector<std::string> folders = pluginFolders({});
  std::vector<std::string> refused;
  const Registry registry = Registry::load(folders, refused);
  std::string text = fmt::format("{} in {}", registry.plugins().size(), fmt::join(folders, ", "));
  const std::size_t bad = refused.size() + registry.refused().size();
  if (bad > 0) text += fmt::format("; {} refused", bad);
  return text;
}

}  // namespace

std::string versionText() {
  std::string text = "vestige " VESTIGE_VERSION "\n";
  const auto row = [&](const char* name, const std::string& value) {
    text += fmt::format("  {:<10} {}\n", name, value);
  };
  row("tracing", "Embree " + World::embreeVersion());
  row("images", imageLibraryVersions());
  row("text", fmt::format("fmt {}.{}.{}, CLI11 {}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100,
                          FMT_VERSION % 100, CLI11_VERSION));
  row("compiler", compilerText());
  row("Real", sizeof(Real) == sizeof(double) ? "double" : "float");
  row("plugin ABI", fmt::format("SDK {}.{}, {}", kSdkMajor, kSdkMinor, kAbiTag));
  row("plugins", pluginText());
  return text;
}

}  // namespace vestige::app
