// SPDX-License-Identifier: Apache-2.0
// Text with @words@ to be replaced, as CMake has them.
#pragma once
#include <map>
#include <string>

namespace vestige::app {

/// Every @word@ of `text` that `words` has, replaced.
std::string filledIn(const std::string& text, const std::map<std::string, std::string>& words);

/// "soft_box" -> "SoftBox".
std::string classNameOf(const std::string& word);

/// Whether `word` stands in `text`, not as a part of another word.
bool hasWord(const std::string& text, const std::string& word);

}  // namespace vestige::app
