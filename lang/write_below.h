// SPDX-License-Identifier: Apache-2.0
// Writes files that a scene names, below one folder and nowhere else.
#pragma once
#include <string>

namespace vestige::lang {

/// Replaces the contents of folder/name, or makes the file; folders must exist. False, with the
/// reason in `why`, if it cannot. Symbolic links below the folder are refused at every step, and so
/// is what is no regular file: between the check and the opening nothing can be exchanged.
bool writeBelow(const std::string& folder, const std::string& name, const std::string& text,
                std::string& why);

}  // namespace vestige::lang
