// SPDX-License-Identifier: Apache-2.0
// Text to tokens, once for each text: macros and loops read the same tokens again.
#pragma once
#include <memory>
#include <string>
#include <unordered_set>
#include <vector>

#include "lang/source.h"

namespace vestige::lang {

/// Strings kept once, so that equal names are equal pointers.
class Names {
 public:
  const std::string* intern(std::string text) { return &*pool_.insert(std::move(text)).first; }

 private:
  std::unordered_set<std::string> pool_;
};

struct Token {
  enum class Kind : std::uint8_t {
    end,        ///< of a text
    name,       ///< identifier or keyword
    number,     ///< `number`
    string,     ///< `text`: without quotes, escapes resolved
    sign,       ///< punctuation, `text`: "{", "<=", ...
    directive,  ///< `#if`, `text`: the word; `jump`: see below
    bad,        ///< `text`: what is wrong with it; complained about only where it is read
  };
  Kind kind = Kind::end;
  Span span;
  const std::string* text = nullptr;
  double number = 0;
  /// Of a directive that opens or continues a construct: the index in its list of the next part,
  /// #if -> #elseif -> #else -> #end. Of an #end: of what it closes.
  std::uint32_t jump = 0;

  bool is(const char* sign) const { return kind == Kind::sign && *text == sign; }
  bool isWord(const char* word) const { return kind == Kind::name && *text == word; }
};

/// All tokens of one text, the last of kind `end`.
struct TokenList {
  std::vector<Token> tokens;
  bool balanced = true;  ///< every #if, #for, #macro, ... has its #end
};

/// Never fails: what is wrong becomes a `bad` token, an unpaired #end or #if a diagnostic.
TokenList tokenise(int file, const Sources& sources, Names& names, Diagnostics& diagnostics);

/// "'light'", "number 3", "the end of the file": a token as messages name it.
std::string describe(const Token& token, const Sources& sources);

}  // namespace vestige::lang
