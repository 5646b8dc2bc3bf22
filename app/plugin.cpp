// SPDX-License-Identifier: Apache-2.0
// vestige plugin: what authors of plugins need.
#include <CLI/CLI.hpp>

#include "app/plugin_test.h"

namespace vestige::app {

void addPlugin(CLI::App& program, Action& chosen) {
  CLI::App* plugin = program.add_subcommand("plugin", "For authors of plugins: test one");
  plugin->require_subcommand(1);
  addPluginTest(*plugin, chosen);
}

}  // namespace vestige::app
