// SPDX-License-Identifier: Apache-2.0
#include "lang/quotes.h"

#include <algorithm>

namespace vestige::lang {
namespace {

constexpr auto kNone = std::string_view::npos;

/// Behind the string that begins at `at`; kNone: it has no end.
std::size_t behindString(std::string_view text, std::size_t at) {
  for (++at; at < text.size(); ++at) {
    if (text[at] == '"') return at + 1;
    if (text[at] == '\\') ++at;
  }
  return kNone;
}

/// Behind the comment of several lines that begins at `at`; they nest.
std::size_t behindComment(std::string_view text, std::size_t at) {
  int depth = 0;
  while (at < text.size()) {
    const std::string_view two = text.substr(at, 2);
    depth += two == "/*" ? 1 : two == "*/" ? -1 : 0;
    at += two == "/*" || two == "*/" ? 2 : 1;
    if (depth == 0) break;
  }
  return at;
}

}  // namespace

bool endsInString(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::string_view two = text.substr(at, 2);
    if (text[at] == '"') {
      at = behindString(text, at);
      if (at == kNone) return true;
    } else if (two == "//") {
      at = std::min(text.find('\n', at), text.size());
    } else {
      at = two == "/*" ? behindComment(text, at) : at + 1;
    }
  }
  return false;
}

bool looksUnclosed(std::string_view text) {
  const std::size_t end = behindString(text, 0);
  if (end == kNone) return true;
  const std::string_view rest = text.substr(end, text.find('\n', end) - end);
  return std::count(rest.begin(), rest.end(), '"') % 2 == 1;
}

}  // namespace vestige::lang
