// SPDX-License-Identifier: Apache-2.0
// Plugins are strangers' code in our process: when the program crashes, it says in whose.
#pragma once

namespace vestige::app {

/// From now on a crash tells its kind and the plugin library it happened in, before it ends the
/// program as ever (with a core dump where those are on).
void tellOfCrashes();

}  // namespace vestige::app
