// SPDX-License-Identifier: Apache-2.0
// vestige plugin list: every plugin that is found, and every library that is refused.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/plugin.h"
#include "app/scene_input.h"
#include "app/schema_text.h"
#include "app/terminal.h"

namespace vestige::app {
namespace {

namespace fs = std::filesystem;

struct ListRequest {
  std::vector<std::string> pluginPaths;
  bool json = false;
};

std::string sdkText(const Plugin& p) {
  return fmt::format("{}.{}", p.entry->sdkMajor, p.entry->sdkMinor);
}

/// By folders, each named once: a table with whole paths would be too wide for any terminal.
void printTable(const std::vector<Plugin>& plugins, const std::vector<std::string>& folders) {
  for (const std::string& folder : folders) {
    std::vector<Row> rows;
    for (const Plugin& p : plugins)
      if (fs::path(p.file).parent_path() == fs::path(folder))
        rows.push_back({"  " + p.kind, p.name, p.version, "SDK " + sdkText(p),
                        fs::path(p.file).filename().string()});
    if (rows.empty()) continue;
    std::cout << folder << '\n' << table(rows, terminalWidth(STDOUT_FILENO)) << '\n';
  }
  // One tag for all: with another none would have been taken.
  std::cout << fmt::format("{}, for SDK {}.{} built as {}\n",
                           count(static_cast<long long>(plugins.size()), "plugin"), kSdkMajor,
                           kSdkMinor, kAbiTag);
}

void printJson(const std::vector<Plugin>& plugins, const std::vector<std::string>& refused) {
  nlohmann::ordered_json all = {{"plugins", nlohmann::json::array()}, {"refused", refused}};
  for (const Plugin& p : plugins)
    all["plugins"].push_back({{"kind", p.kind},
                              {"name", p.name},
                              {"version", p.version},
                              {"sdk", sdkText(p)},
                              {"abi", p.entry->abiTag},
                              {"file", p.file}});
  std::cout << all.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
}

/// Sound libraries of the same kind and name as one that goes before them.
std::vector<std::string> hidden(const Registry& registry, const std::vector<Plugin>& plugins,
                                const std::vector<std::string>& folders) {
  const auto isRefused = [&](const std::string& file) {
    const std::vector<Refusal>& all = registry.refused();
    return std::any_of(all.begin(), all.end(), [&](const Refusal& r) { return r.file == file; });
  };
  std::vector<std::string> sentences;
  for (const std::string& folder : folders)
    for (const std::string& file : librariesIn(folder)) {
      const auto promised = promisedBy(file);
      for (const Plugin& p : plugins)
        if (promised && p.kind == promised->kind && p.name == promised->name && p.file != file &&
            !isRefused(file))
          sentences.push_back(
              fmt::format("'{}' is not used: '{}' is also {} '{}' and goes before it", file, p.file,
                          p.kind, p.name));
    }
  return sentences;
}

int runList(const ListRequest& r) {
  const Registry registry = loadRegistry(r.pluginPaths);
  const std::vector<Plugin> plugins = registry.plugins();
  std::vector<std::string> refused;
  for (const Refusal& refusal : registry.refused()) refused.push_back(refusal.sentence);
  if (r.json)
    printJson(plugins, refused);
  else
    printTable(plugins, pluginFolders(r.pluginPaths));
  std::cout << std::flush;
  warnOfRefused(registry, {});
  for (const std::string& sentence : hidden(registry, plugins, pluginFolders(r.pluginPaths)))
    warn(sentence);
  return kFine;
}

}  // namespace

void addPluginList(CLI::App& plugin, Action& chosen) {
  CLI::App* command = plugin.add_subcommand("list", "List plugins, their versions and libraries");
  const auto request = std::make_shared<ListRequest>();
  command->add_flag("--json", request->json, "for programs");
  addPluginPath(*command, request->pluginPaths);
  command->callback([request, &chosen] { chosen = [request] { return runList(*request); }; });
}

}  // namespace vestige::app
