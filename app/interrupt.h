// SPDX-License-Identifier: Apache-2.0
// Ctrl-C: the first stops politely, the second at once.
#pragma once
#include <atomic>

namespace vestige::app {

/// From here on SIGINT and SIGTERM set the flag; a second one ends the program on the spot. The
/// flag is what RenderOptions::cancel wants. [main thread]
const std::atomic<bool>& catchInterrupts();

}  // namespace vestige::app
