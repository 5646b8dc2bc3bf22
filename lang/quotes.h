// SPDX-License-Identifier: Apache-2.0
// Which string of a text was never closed. A string may go on over several lines, so a missing
// quotation mark shifts all others, and is noticed at the end of the text only.
#pragma once
#include <string_view>

namespace vestige::lang {

/// Whether the text ends within a string. Linear in its length.
bool endsInString(std::string_view text);

/// Whether the string, which begins at text[0] and is longer than its line, was meant to end in it:
/// it has no end, or the line of its end has an odd number of further quotation marks.
bool looksUnclosed(std::string_view text);

}  // namespace vestige::lang
