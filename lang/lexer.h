// SPDX-License-Identifier: Apache-2.0
// Text to tokens, once for each text: macros and loops read the same tokens again.
#pragma once
#include <string>
#include <unordered_map>
#include <vector>

#include "lang/budget.h"
#include "lang/names.h"
#include "lang/report.h"
#include "lang/source.h"

namespace vestige::lang {

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
  /// For a directive that opens or continues a construct: the token index of the next part, #if ->
  /// #elseif -> #else -> #end. For an #end: the index of the directive that it closes.
  std::uint32_t jump = 0;
  const Name* text = nullptr;  ///< null for a number
  double number = 0;

  bool is(const char* s) const { return sign == signCode(s); }
  bool isWord(const char* word) const { return kind == Kind::name && *text == word; }
  bool isName() const { return kind == Kind::name; }
  /// The word of the language that a name is.
  Word word() const { return kind == Kind::name ? text->word : Word::none; }
};

/// A token as its list stores it: without the text that all tokens of the list share.
struct StoredToken {
  Token::Kind kind = Token::Kind::end;
  std::uint16_t sign = 0;
  std::uint32_t begin = 0, end = 0;  ///< byte offsets
  std::uint32_t jump = 0;
  union {
    const Name* text = nullptr;  ///< of all but numbers
    double number;
  };
};
static_assert(sizeof(StoredToken) == 24);

/// All tokens of one text, the last of kind `end`.
struct TokenList {
  int file = -1;
  std::vector<StoredToken> tokens;
  /// For a directive that opens or continues a construct: the token index of its #end, or of the
  /// end of the text.
  std::unordered_map<std::uint32_t, std::uint32_t> closings = {};

  /// Token i, as read through `via`.
  Token token(std::uint32_t i, std::int32_t via = -1) const {
    Token t;
    get(i, via, t);
    return t;
  }
  void get(std::uint32_t i, std::int32_t via, Token& t) const {
    const StoredToken& s = tokens[i];
    const bool isNumber = s.kind == Token::Kind::number;
    t.kind = s.kind, t.sign = s.sign, t.jump = s.jump;
    t.span = {file, s.begin, s.end, via};
    t.number = isNumber ? s.number : 0;
    t.text = isNumber ? nullptr : s.text;
  }
};

/// Never fails: a lexical error becomes a `bad` token, an unpaired #end or #if a diagnostic
/// (null: none).
/// `known`: the tokens of an equal text, with names of their own; the text is not scanned again.
TokenList tokenise(int file, const Sources& sources, Names& names, Reporter* reporter,
                   Budget& budget, const std::vector<StoredToken>* known = nullptr);

/// "'light'", "number 3", "the end of the file": a token in messages.
std::string describe(const Token& token, const Sources& sources);

}  // namespace vestige::lang
