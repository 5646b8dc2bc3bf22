// SPDX-License-Identifier: Apache-2.0
#include "lang/printable.h"

#include <algorithm>

namespace vestige::lang {
namespace {

/// Bytes of the character at the beginning of a text; 0 if it is not UTF-8.
std::size_t lengthOf(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const std::size_t length = byte(0) < 0x80                      ? 1
                             : byte(0) >= 0xC2 && byte(0) < 0xE0 ? 2
                             : byte(0) >= 0xE0 && byte(0) < 0xF0 ? 3
                             : byte(0) >= 0xF0 && byte(0) < 0xF5 ? 4
                                                                 : 0;
  if (length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xC0) != 0x80) return 0;
  return length;
}

std::string cleaned(std::string_view text, std::string_view kept) {
  std::string clean;
  while (!text.empty()) {
    const std::size_t length = lengthOf(text);
    const auto c = static_cast<unsigned char>(text[0]);
    const bool isC0 = length == 1 && (c < 32 || c == 127) && kept.find(char(c)) == kept.npos;
    const bool isC1 = length == 0
                          ? c < 0xA0
                          : length == 2 && c == 0xC2 && static_cast<unsigned char>(text[1]) < 0xA0;
    const std::size_t taken = std::max<std::size_t>(1, length);
    if (isC0 || isC1)
      clean += '?';
    else
      clean += text.substr(0, taken);
    text.remove_prefix(taken);
  }
  return clean;
}

}  // namespace

std::string printable(std::string_view text) { return cleaned(text, "\n\t"); }

std::string debugText(std::string_view text) { return cleaned(text, "\n\t\a\b\f\r\v"); }

}  // namespace vestige::lang
