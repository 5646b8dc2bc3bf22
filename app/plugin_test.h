// SPDX-License-Identifier: Apache-2.0
// vestige plugin test: judges one library.
#pragma once
#include "app/command.h"

namespace vestige::app {

/// Adds `test` to the command `plugin`.
void addPluginTest(CLI::App& plugin, Action& chosen);

}  // namespace vestige::app
