// SPDX-License-Identifier: Apache-2.0
#include "lang/printable.h"

#include "lang/utf8.h"

namespace vestige::lang {
namespace {

std::string cleaned(std::string_view text, std::string_view kept) {
  std::string clean;
  for (std::size_t at = 0; at < text.size();) {
    const Character c = characterAt(text, at);
    const bool isC0 = (c.code < 32 || c.code == 127) && kept.find(char(c.code)) == kept.npos;
    const bool isC1 = c.code >= 0x80 && c.code < 0xA0;
    if (isC0 || isC1)
      clean += '?';
    else
      clean += text.substr(at, c.bytes);
    at += c.bytes;
  }
  return clean;
}

}  // namespace

std::string printable(std::string_view text) { return cleaned(text, "\n\t"); }

std::string debugText(std::string_view text) { return cleaned(text, "\n\t\a\b\f\r\v"); }

}  // namespace vestige::lang
