// SPDX-License-Identifier: Apache-2.0
// What `vestige plugin` can do, one file each.
#pragma once
#include "app/command.h"

namespace vestige::app {

/// Each adds its command to `vestige plugin`.
void addPluginNew(CLI::App& plugin, Action& chosen);
void addPluginList(CLI::App& plugin, Action& chosen);

}  // namespace vestige::app
