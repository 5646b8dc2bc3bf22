// SPDX-License-Identifier: Apache-2.0
// The folder for files that can be created again.
#pragma once
#include <string>

namespace vestige {

/// $VESTIGE_CACHE, else $XDG_CACHE_HOME/vestige, else ~/.cache/vestige, made if it is not there; ""
/// with `why`.
std::string cacheFolder(std::string& why);

}  // namespace vestige
