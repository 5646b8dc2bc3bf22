// SPDX-License-Identifier: Apache-2.0
// Functions of strings. Positions count from 1.
#include <charconv>
#include <cmath>
#include <cstdio>

#include "lang/builtins.h"
#include "lang/utf8.h"

namespace vestige::lang {
namespace {

/// Widest field and most digits that are laid out: a double has no more than 1074 of them.
constexpr int kWidest = 1100;

/// C's "%*.*f" or "%*.*g": negative width fills with zeros, negative precision means 6.
std::string layout(const Call& c, double x, int width, int digits, char kind = 'f') {
  constexpr int kDigitsAStep = 2;
  const bool zeros = width < 0;
  width = std::min(std::abs(std::max(width, -kWidest)), kWidest);
  digits = digits < 0 ? 6 : std::min(digits, kWidest);
  c.context.step(c.span, (width + digits) / kDigitsAStep);
  const char* format = kind == 'f' ? zeros ? "%0*.*f" : "%*.*f" : zeros ? "%0*.*g" : "%*.*g";
  std::string s(std::size_t(std::snprintf(nullptr, 0, format, width, digits, x)), '\0');
  std::snprintf(s.data(), s.size() + 1, format, width, digits, x);
  return s;
}

/// str(x, width, digits). POV-Ray has room for so many characters: what is longer is written with
/// an exponent, and what that does not shorten as "<invalid>".
std::string numberText(const Call& c) {
  constexpr std::size_t kLongest = 254;
  std::string s = layout(c, c.number(0), c.integer(1), c.integer(2));
  if (s.size() > kLongest) s = layout(c, c.number(0), c.integer(1), c.integer(2), 'g');
  return s.size() > kLongest ? "<invalid>" : s;
}

/// Adds to a string that a call builds.
void append(const Call& c, std::string& s, const std::string& part) {
  const std::size_t most = c.context.options.limits.stringLength;
  if (s.size() + part.size() > most)
    c.context.reporter.stop(c.span, "this string is longer than " + std::to_string(most) +
                                        " characters: --max-string-length raises the limit");
  s += part;
}

Datum made(const Call& c, std::string s) { return c.context.budget.text(c.span, std::move(s)); }

Datum concat(const Call& c) {
  std::string s;
  for (std::size_t i = 0; i < c.args.size(); ++i) append(c, s, c.text(i));
  return made(c, std::move(s));
}

/// vstr(n, vector, separator, width, digits): the first n components, 0 for those that the vector
/// does not have; a number is the first one.
Datum vectorText(const Call& c) {
  const int n = std::clamp(c.integer(0), 2, 5);
  if (n != c.integer(0))
    c.warn(0, "vstr() writes 2 to 5 components, not " + shortest(c.integer(0)) + ": it writes " +
                  shortest(n));
  const Numbers v = c.vector(1);
  std::string s;
  for (int i = 0; i < n; ++i) {
    if (i > 0) append(c, s, c.text(2));
    append(c, s, layout(c, v.v[std::size_t(i)], c.integer(3), c.integer(4)));
  }
  return made(c, std::move(s));
}

Datum part(const Call& c) {
  const std::string& s = c.text(0);
  const int from = c.integer(1), length = c.integer(2);
  const std::size_t size = lengthOf(s);
  if (from < 1 || length < 0 || std::size_t(from - 1) + std::size_t(length) > size)
    return c.complain(1, "substr() from " + shortest(from) + ", " + shortest(length) +
                             " long, reaches outside a string of " + shortest(double(size)) +
                             " characters");
  const std::size_t begin = beginOf(s, std::size_t(from - 1));
  const std::string_view rest = std::string_view(s).substr(begin);
  return made(c, std::string(rest.substr(0, beginOf(rest, std::size_t(length)))));
}

/// chr(0) ends a string, so it is empty.
Datum character(const Call& c) {
  const int code = c.integer(0);
  if (code < 0 || code > 65535)
    return c.complain(0, "chr() takes 0 to 65535, found " + shortest(c.number(0)));
  return textDatum(code == 0 ? std::string() : utf8(std::uint32_t(code)));
}

template <bool toUpper>
Datum changeCase(const Call& c) {
  std::string s = c.text(0);
  for (char& letter : s) {
    if (toUpper && letter >= 'a' && letter <= 'z') letter = char(letter - 'a' + 'A');
    if (!toUpper && letter >= 'A' && letter <= 'Z') letter = char(letter - 'A' + 'a');
  }
  return made(c, std::move(s));
}

/// Of the first characters that differ, where the end of a string counts as 0.
double difference(const std::string& a, const std::string& b) {
  for (std::size_t at = 0;;) {
    const Character x = characterAt(a, at), y = characterAt(b, at);
    if (x.code != y.code || at >= a.size()) return double(x.code) - double(y.code);
    at += x.bytes;
  }
}

/// Magnitude of a number beyond the range of double, without its sign.
double beyondRange(std::string_view digits) {
  const std::size_t exponent = digits.find_first_of("eEpP");
  const bool isTiny = exponent == digits.npos ? digits[0] == '.' || digits[0] == '0'
                                              : digits.substr(exponent + 1, 1) == "-";
  return isTiny ? 0 : HUGE_VAL;
}

/// C's strtod() whatever the locale: blanks, a sign, decimal or 0x... digits, inf or nan.
double readNumber(std::string_view s, bool& isFound) {
  s.remove_prefix(std::min(s.find_first_not_of(" \t\n\v\f\r"), s.size()));
  const bool isNegative = !s.empty() && s[0] == '-';
  if (!s.empty() && (s[0] == '-' || s[0] == '+')) s.remove_prefix(1);
  double x = 0;
  const bool isHex = s.size() > 2 && s[0] == '0' && (s[1] == 'x' || s[1] == 'X');
  const auto read = [&](std::string_view digits, std::chars_format format) {
    if (digits.empty() || digits[0] == '-') return false;
    const auto error = std::from_chars(digits.data(), digits.data() + digits.size(), x, format).ec;
    if (error == std::errc::result_out_of_range) x = beyondRange(digits);
    return error != std::errc::invalid_argument;
  };
  isFound =
      (isHex && read(s.substr(2), std::chars_format::hex)) || read(s, std::chars_format::general);
  return isNegative ? -x : x;
}

Datum numberOf(const Call& c) {
  bool isFound = false;
  const double x = readNumber(c.text(0), isFound);
  if (!isFound) c.warn(0, "val() finds no number in \"" + c.text(0) + "\" and gives 0");
  return Numbers(isFound ? x : 0);
}

Datum fileExists(const Call& c) {
  c.context.step(c.span, kFileSteps);
  return Numbers(c.context.fileExists && c.context.fileExists(c.text(0)) ? 1 : 0);
}

}  // namespace

std::vector<Builtin> stringBuiltins() {
  return {
      {"asc", "s", [](const Call& c) -> Datum { return Numbers(characterAt(c.text(0), 0).code); }},
      {"chr", "n", character},
      {"concat", "s+", concat},
      {"file_exists", "s", fileExists, false},
      {"str", "nnn", [](const Call& c) { return made(c, numberText(c)); }},
      {"strcmp", "ss",
       [](const Call& c) -> Datum { return Numbers(difference(c.text(0), c.text(1))); }},
      {"strlen", "s", [](const Call& c) -> Datum { return Numbers(double(lengthOf(c.text(0)))); }},
      {"strlwr", "s", changeCase<false>},
      {"strupr", "s", changeCase<true>},
      {"substr", "snn", part},
      {"val", "s", numberOf},
      {"vstr", "ncsnn", vectorText},
  };
}

}  // namespace vestige::lang
