// SPDX-License-Identifier: Apache-2.0
// vestige plugin: for those who write plugins.
#include "app/plugin.h"

#include <CLI/CLI.hpp>

#include "app/plugin_test.h"

namespace vestige::app {

void addPlugin(CLI::App& program, Action& chosen) {
  CLI::App* plugin = program.add_subcommand("plugin", "Make, list and test plugins");
  addPluginNew(*plugin, chosen);
  addPluginList(*plugin, chosen);
  addPluginTest(*plugin, chosen);
  plugin->require_subcommand(1);
}

}  // namespace vestige::app
