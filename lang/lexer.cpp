// SPDX-License-Identifier: Apache-2.0
#include "lang/lexer.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <utility>

#include "lang/quotes.h"
#include "lang/utf8.h"

namespace vestige::lang {
namespace {

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool isBlank(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == '\v';
}
bool isWordPart(char c) { return isLetter(c) || isDigit(c) || c == '_'; }

/// Signs of two characters, before those of one.
constexpr const char* kDoubleSigns[] = {"<=", ">=", "!=", "==", "&&", "||"};
constexpr const char* kSigns = "(){}[]<>,;:?.+-*/%&|!=^";

class Lexer {
 public:
  Lexer(int file, const Sources& sources, Names& names, Budget& budget)
      : file_(file), text_(sources.text(file).text), names_(names), budget_(budget) {}

  std::vector<StoredToken> run() {
    if (text_.compare(0, 3, "\xEF\xBB\xBF") == 0) at_ = 3;  // byte order mark of UTF-8
    std::vector<StoredToken> tokens;
    do {
      const StoredToken t = next();
      budget_.reserveOne({file_, t.begin, t.end, -1}, tokens);
      tokens.push_back(t);
    } while (tokens.back().kind != Token::Kind::end);
    return tokens;
  }

 private:
  char peek(std::size_t ahead = 0) const {
    return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
  }
  bool atEnd() const { return at_ >= text_.size(); }

  StoredToken token(Token::Kind kind, std::size_t begin) const {
    StoredToken t;
    t.kind = kind;
    t.begin = std::uint32_t(begin), t.end = std::uint32_t(at_);
    return t;
  }
  StoredToken token(Token::Kind kind, std::size_t begin, std::string_view text) {
    StoredToken t = token(kind, begin);
    t.text = names_.intern(text);
    return t;
  }
  StoredToken bad(std::size_t begin, std::string_view what) {
    return token(Token::Kind::bad, begin, what);
  }
  std::string_view since(std::size_t begin) const {
    return std::string_view(text_).substr(begin, at_ - begin);
  }

  /// Comments count as blanks; an unclosed comment becomes a `bad` token.
  bool skipBlanks(std::size_t& openComment) {
    for (;;) {
      while (!atEnd() && isBlank(peek())) ++at_;
      if (peek() != '/') return true;
      if (peek(1) == '/') {
        while (!atEnd() && peek() != '\n') ++at_;
      } else if (peek(1) == '*') {
        openComment = at_;
        if (!skipComment()) return false;
      } else {
        return true;
      }
    }
  }
  bool skipComment() {
    int depth = 0;
    while (!atEnd()) {
      if (peek() == '/' && peek(1) == '*') {
        ++depth, at_ += 2;
      } else if (peek() == '*' && peek(1) == '/') {
        --depth, at_ += 2;
        if (depth == 0) return true;
      } else {
        ++at_;
      }
    }
    return false;
  }

  StoredToken next() {
    std::size_t begin = 0;
    if (!skipBlanks(begin)) {
      StoredToken t = bad(begin, "this comment is never closed: '*/' is missing");
      t.end = t.begin + 2;
      return t;
    }
    begin = at_;
    if (atEnd()) return token(Token::Kind::end, begin, "");
    const char c = peek();
    if (isLetter(c) || c == '_') return word(begin);
    if (isDigit(c) || (c == '.' && isDigit(peek(1)))) return number(begin);
    if (c == '"') return string(begin);
    if (c == '#') return directive(begin);
    return sign(begin);
  }

  StoredToken word(std::size_t begin) {
    while (isWordPart(peek())) ++at_;
    if (static_cast<unsigned char>(peek()) >= 0x80) {
      while (isWordPart(peek()) || static_cast<unsigned char>(peek()) >= 0x80) ++at_;
      return bad(begin, "a name is made of the letters a to z and A to Z, digits and '_'");
    }
    return token(Token::Kind::name, begin, since(begin));
  }

  StoredToken number(std::size_t begin) {
    while (isDigit(peek())) ++at_;
    if (peek() == '.') ++at_;
    while (isDigit(peek())) ++at_;
    if (peek() == 'e' || peek() == 'E') {
      const std::size_t sign = peek(1) == '+' || peek(1) == '-' ? 2 : 1;
      if (isDigit(peek(sign))) {
        at_ += sign;
        while (isDigit(peek())) ++at_;
      }
    }
    StoredToken t = token(Token::Kind::number, begin);
    t.number = 0;
    // from_chars does not depend on the locale; it accepts a leading or a trailing point.
    const auto end = text_.data() + at_;
    const auto [stop, error] = std::from_chars(text_.data() + begin, end, t.number);
    if (error == std::errc::result_out_of_range) t.number = isTiny(begin) ? 0 : HUGE_VAL;
    if (std::isinf(t.number)) return bad(begin, "this number is too large");
    return t;
  }
  bool isTiny(std::size_t begin) const {
    const std::string_view digits(text_.data() + begin, at_ - begin);
    const std::size_t exponent = digits.find_first_of("eE");
    if (exponent != std::string_view::npos) return digits[exponent + 1] == '-';
    return digits[0] == '.' || digits[0] == '0';
  }

  StoredToken string(std::size_t begin) {
    std::string value;
    std::string wrong;
    bool isJudged = false;
    ++at_;
    while (!atEnd() && peek() != '"') {
      if (peek() == '\n' && !std::exchange(isJudged, true) && isUnclosed(begin)) break;
      if (peek() == '\\')
        escape(value, wrong);
      else if (peek() == '\r' && peek(1) == '\n')
        ++at_;  // a line ends with one character
      else
        value += text_[at_++];
    }
    if (peek() != '"') return bad(begin, "this string is never closed: '\"' is missing");
    ++at_;
    if (!wrong.empty()) return bad(begin, wrong);
    return token(Token::Kind::string, begin, value);
  }

  /// Of a string that reaches the end of its line: whether it is an error there. The rest of the
  /// text is looked at once only; a mended string leaves as many quotation marks as it takes.
  bool isUnclosed(std::size_t begin) {
    const std::string_view text = std::string_view(text_).substr(begin);
    if (!isOneUnclosed_) isOneUnclosed_ = endsInString(text);
    if (!*isOneUnclosed_ || !looksUnclosed(text)) return false;
    isOneUnclosed_ = false;
    return true;
  }

  void escape(std::string& value, std::string& wrong) {
    static const std::string letters = "abfnrtv\\'\"", values = "\a\b\f\n\r\t\v\\'\"";
    const char c = peek(1);
    if (const auto known = letters.find(c); c != '\0' && known != std::string::npos) {
      value += values[known];
      at_ += 2;
    } else if (c == 'u') {
      unicode(value, wrong);
    } else {
      wrong = "no escape in a string begins '\\" + std::string(1, c) +
              "': known are \\a \\b \\f \\n \\r \\t \\v \\\\ \\' \\\" \\uNNNN "
              "(write '/' between folders, also on Windows)";
      at_ += 1;
    }
  }
  void unicode(std::string& value, std::string& wrong) {
    unsigned code = 0;
    const char* from = text_.data() + at_ + 2;
    const char* to = text_.data() + std::min(text_.size(), at_ + 6);
    const auto [stop, error] = std::from_chars(from, to, code, 16);
    at_ += 2;
    if (stop != from + 4) {
      wrong = "\\u in a string takes four hexadecimal digits";
      return;
    }
    at_ += 4;
    value += utf8(code);
  }

  StoredToken directive(std::size_t begin) {
    ++at_;
    while (peek() == ' ' || peek() == '\t' || peek() == '\n' || peek() == '\r') ++at_;
    const std::size_t name = at_;
    while (isWordPart(peek())) ++at_;
    if (at_ == name) {
      at_ = begin + 1;
      return bad(begin, "'#' begins a directive such as #declare, but no word follows it");
    }
    return token(Token::Kind::directive, begin, since(name));
  }

  StoredToken sign(std::size_t begin) {
    for (const char* s : kDoubleSigns)
      if (peek() == s[0] && peek(1) == s[1]) {
        at_ += 2;
        return sign(begin, signCode(s));
      }
    const auto c = static_cast<unsigned char>(text_[at_++]);
    if (c != 0 && std::string_view(kSigns).find(char(c)) != std::string_view::npos)
      return sign(begin, c);
    while (c >= 0x80 && (static_cast<unsigned char>(peek()) & 0xC0) == 0x80) ++at_;
    const std::string shown = c < 32 || c == 127
                                  ? "control character " + std::to_string(int(c))
                                  : "character '" + text_.substr(begin, at_ - begin) + "'";
    return bad(begin, shown + " means nothing here");
  }

  StoredToken sign(std::size_t begin, std::uint16_t code) {
    StoredToken t = token(Token::Kind::sign, begin);
    t.sign = code;
    // Of two characters the second is an '=' or a repetition of the first.
    const auto second = code < 256 ? 0 : code / 256 == '=' ? 1 : 2;
    const Name*& name = signs_[std::size_t(code % 256 * 3 + second)];
    if (!name) name = names_.intern(since(begin));
    t.text = name;
    return t;
  }

  int file_;
  const std::string& text_;
  Names& names_;
  Budget& budget_;
  std::size_t at_ = 0;
  std::array<const Name*, 128 * 3> signs_{};
  std::optional<bool> isOneUnclosed_;  ///< string in the text; not known before one is suspected
};

/// The tokens with the names of this run, which are met in the same order as by the Lexer: every
/// id and every byte counted is the same.
std::vector<StoredToken> renamed(int file, const std::vector<StoredToken>& known, Names& names,
                                 Budget& budget) {
  std::vector<const Name*> here;  // by the id there
  std::vector<StoredToken> tokens;
  for (StoredToken t : known) {
    if (t.kind != Token::Kind::number) {
      const std::size_t id = t.text->id;
      if (id >= here.size()) here.resize(id + 1);
      if (!here[id]) here[id] = names.intern(*t.text);
      t.text = here[id];
    }
    budget.reserveOne({file, t.begin, t.end, -1}, tokens);
    tokens.push_back(t);
  }
  return tokens;
}

bool opens(const std::string& word) {
  return word == "if" || word == "ifdef" || word == "ifndef" || word == "while" || word == "for" ||
         word == "switch" || word == "macro";
}
bool continues(const std::string& word) {
  return word == "else" || word == "elseif" || word == "case" || word == "range";
}

/// Links each construct's parts. Skipped text is paired too, as POV-Ray does.
void pair(TokenList& list, Reporter* reporter) {
  struct Open {
    std::uint32_t first, last;
  };
  std::vector<Open> open;
  auto& tokens = list.tokens;
  const auto close = [&](std::uint32_t part, std::uint32_t end) {
    for (; part < end; part = tokens[part].jump) list.closings[part] = end;
  };
  const auto isSwitch = [&](const Open& o) { return *tokens[o.first].text == "switch"; };
  for (std::uint32_t i = 0; i < tokens.size(); ++i) {
    StoredToken& t = tokens[i];
    if (t.kind != Token::Kind::directive) continue;
    t.jump = i;
    if (opens(*t.text)) {
      open.push_back({i, i});
    } else if (*t.text == "end" || continues(*t.text)) {
      const bool wantsSwitch = *t.text == "case" || *t.text == "range";
      if (open.empty() || (wantsSwitch && !isSwitch(open.back()))) {
        if (reporter)
          reporter->errorAhead(list.token(i).span,
                               "#" + *t.text + " without " +
                                   (wantsSwitch ? "a #switch around it" : "an open #if or #for"));
        continue;
      }
      tokens[open.back().last].jump = i;
      open.back().last = i;
      if (*t.text != "end") continue;
      close(open.back().first, i);
      t.jump = open.back().first;
      open.pop_back();
    }
  }
  for (const Open& o : open) {
    tokens[o.last].jump = std::uint32_t(tokens.size() - 1);
    close(o.first, tokens[o.last].jump);
    if (reporter)
      reporter->errorAhead(list.token(o.first).span, "#" + *tokens[o.first].text + " has no #end");
  }
}

}  // namespace

TokenList tokenise(int file, const Sources& sources, Names& names, Reporter* reporter,
                   Budget& budget, const std::vector<StoredToken>* known) {
  TokenList list;
  list.file = file;
  budget.copy({}, sources.text(file).text.size());
  list.tokens =
      known ? renamed(file, *known, names, budget) : Lexer(file, sources, names, budget).run();
  pair(list, reporter);
  constexpr std::size_t kClosing = 48;  // bytes of an entry of the map
  budget.keep(std::int64_t(list.closings.size() * kClosing));
  return list;
}

std::string describe(const Token& token, const Sources& sources) {
  if (token.kind == Token::Kind::end) return "the end of the file";
  if (token.kind == Token::Kind::directive) return "'#" + *token.text + "'";
  constexpr std::size_t kLongest = 40;
  const std::string shown = sources.excerpt(token.span, kLongest);
  if (token.kind == Token::Kind::number) return "the number " + shown;
  if (token.kind == Token::Kind::string) return "the string " + shown;
  return "'" + shown + "'";
}

}  // namespace vestige::lang
