// SPDX-License-Identifier: Apache-2.0
// A library file looked at before it is loaded: the system's loader takes the lengths in it on
// trust.
#pragma once
#include <string>

namespace vestige {

/// Why a file is only the beginning of a library, or "". To load such a file ends the program with
/// a bus error. What is no library at all gets "" too: the loader refuses that itself.
std::string cutShort(const std::string& file);

}  // namespace vestige
