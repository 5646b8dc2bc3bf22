// SPDX-License-Identifier: Apache-2.0
#include "app/template_text.h"

#include <cctype>

namespace vestige::app {
namespace {

bool isPart(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

}  // namespace

std::string filledIn(const std::string& text, const std::map<std::string, std::string>& words) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t open = text.find('@', at);
    const std::size_t close = open == text.npos ? open : text.find('@', open + 1);
    if (close == text.npos) return out + text.substr(at);
    const auto word = words.find(text.substr(open + 1, close - open - 1));
    const bool isKnown = word != words.end();
    out += text.substr(at, open - at) + (isKnown ? word->second : "@");
    at = isKnown ? close + 1 : open + 1;
  }
  return out;
}

std::string classNameOf(const std::string& word) {
  std::string name;
  bool isFirst = true;
  for (const char c : word) {
    if (c != '_') name += isFirst ? char(std::toupper(static_cast<unsigned char>(c))) : c;
    isFirst = c == '_';
  }
  return name;
}

bool hasWord(const std::string& text, const std::string& word) {
  for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + 1)) {
    const bool begins = at == 0 || !isPart(text[at - 1]);
    const std::size_t end = at + word.size();
    if (begins && (end == text.size() || !isPart(text[end]))) return true;
  }
  return false;
}

}  // namespace vestige::app
