// SPDX-License-Identifier: Apache-2.0
// Strings are UTF-8 and are counted in characters. A byte that belongs to no character counts as
// one.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace vestige::lang {

struct Character {
  std::uint32_t code;
  std::size_t bytes;
};

/// The character that begins at a byte of the string.
inline Character characterAt(std::string_view s, std::size_t at) noexcept {
  const auto byte = [&](std::size_t i) {
    return i < s.size() ? static_cast<unsigned char>(s[i]) : 0u;
  };
  const std::uint32_t first = byte(at);
  const std::size_t bytes = first < 0xC2   ? 1
                            : first < 0xE0 ? 2
                            : first < 0xF0 ? 3
                            : first < 0xF5 ? 4
                                           : 1;
  if (bytes == 1) return {first, 1};
  std::uint32_t code = first & (0x7Fu >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(at + i) & 0xC0) != 0x80) return {first, 1};
    code = (code << 6) | (byte(at + i) & 0x3F);
  }
  return {code, bytes};
}

/// Number of characters.
inline std::size_t lengthOf(std::string_view s) noexcept {
  std::size_t n = 0;
  for (std::size_t at = 0; at < s.size(); at += characterAt(s, at).bytes) ++n;
  return n;
}

/// The byte at which character k begins, counted from 0; the end of a shorter string.
inline std::size_t beginOf(std::string_view s, std::size_t k) noexcept {
  std::size_t at = 0;
  while (at < s.size() && k-- > 0) at += characterAt(s, at).bytes;
  return at;
}

/// A character of at most 16 bits.
inline std::string utf8(std::uint32_t code) {
  if (code < 0x80) return std::string(1, char(code));
  const auto rest = [](std::uint32_t bits) { return char(0x80 | (bits & 0x3F)); };
  if (code < 0x800) return {char(0xC0 | (code >> 6)), rest(code)};
  return {char(0xE0 | (code >> 12)), rest(code >> 6), rest(code)};
}

}  // namespace vestige::lang
