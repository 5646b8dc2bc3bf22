// SPDX-License-Identifier: Apache-2.0
// Plugins are strangers' code in our process: when the program crashes, it says in whose.
#pragma once

namespace vestige::app {

/// From now on a crash tells its kind and the plugin library it happened in, before it ends the
/// program as ever (with a core dump where those are on).
void tellOfCrashes();
/// The calling thread tells of endless recursion, too: it gets a stack for that. Done by
/// tellOfCrashes() for its own thread; for others where plugins are created.
void useCrashStack();

}  // namespace vestige::app
