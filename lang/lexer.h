// SPDX-License-Identifier: Apache-2.0
// Text to tokens, once for each text: macros and loops read the same tokens again.
#pragma once
#include <memory>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "lang/budget.h"
#include "lang/report.h"
#include "lang/source.h"

namespace vestige::lang {

/// Strings kept once, so that equal names are equal pointers.
class Names {
 public:
  explicit Names(Total memory) : memory_(std::move(memory)) {}
  const std::string* intern(std::string text) {
    const auto [at, isNew] = pool_.insert(std::move(text));
    if (isNew) *memory_ += std::int64_t(kNode + at->capacity());
    return &*at;
  }

 private:
  static constexpr std::size_t kNode = 80;  ///< bytes of an entry without its letters
  Total memory_;
  std::unordered_set<std::string> pool_;
};

/// One or two characters as a number; 0 is not a sign.
constexpr std::uint16_t signCode(const char* s) {
  const auto first = static_cast<unsigned char>(s[0]);
  return std::uint16_t(first + (first ? static_cast<unsigned char>(s[1]) * 256 : 0));
}

struct Token {
  enum class Kind : std::uint8_t {
    end,        ///< of a text
    name,       ///< identifier or keyword
    number,     ///< `number`
    string,     ///< `text`: without quotes, escapes resolved
    sign,       ///< punctuation, `text`: "{", "<=", ...
    directive,  ///< `#if`, `text`: the word; `jump`: see below
    bad,        ///< `text`: the error message, reported only if the parser gets here
  };
  Kind kind = Kind::end;
  std::uint16_t sign = 0;  ///< of punctuation: signCode() of it, for quick comparison
  Span span;
  const std::string* text = nullptr;
  double number = 0;
  /// For a directive that opens or continues a construct: the token index of the next part, #if ->
  /// #elseif -> #else -> #end. For an #end: the index of the directive that it closes.
  std::uint32_t jump = 0;

  bool is(const char* s) const { return sign == signCode(s); }
  bool isWord(const char* word) const { return kind == Kind::name && *text == word; }
};

/// All tokens of one text, the last of kind `end`.
struct TokenList {
  std::vector<Token> tokens;
  /// For a directive that opens or continues a construct: the token index of its #end, or of the
  /// end of the text.
  std::unordered_map<std::uint32_t, std::uint32_t> closings = {};
};

/// Never fails: a lexical error becomes a `bad` token, an unpaired #end or #if a diagnostic.
TokenList tokenise(int file, const Sources& sources, Names& names, Reporter& reporter,
                   Budget& budget);

/// "'light'", "number 3", "the end of the file": a token in messages.
std::string describe(const Token& token, const Sources& sources);

}  // namespace vestige::lang
