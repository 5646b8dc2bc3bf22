// SPDX-License-Identifier: Apache-2.0
// Texts of users on a terminal: control characters must not reach it.
#pragma once
#include <string>
#include <string_view>

namespace vestige::lang {

/// The text with '?' in place of control characters: C0 but for line feeds and tabs, DEL, and C1,
/// in UTF-8 or as a stray byte.
std::string printable(std::string_view text);

/// The text of #debug: as printable(), but it keeps what the escapes \a \b \f \r \v of strings
/// are for.
std::string debugText(std::string_view text);

}  // namespace vestige::lang
