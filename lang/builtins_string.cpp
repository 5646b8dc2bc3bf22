// SPDX-License-Identifier: Apache-2.0
// Functions of strings. Positions count from 1.
#include <charconv>
#include <cmath>
#include <cstdio>

#include "lang/builtins.h"

namespace vestige::lang {
namespace {

/// Widest field and most digits that str() lays out: a double has no more than 1074 of them.
constexpr int kWidest = 1100;

/// C's "%*.*f": negative width fills with zeros, negative precision means 6.
std::string layout(const Call& c, double x, int width, int digits) {
  constexpr int kDigitsAStep = 2;
  const bool zeros = width < 0;
  width = std::min(std::abs(std::max(width, -kWidest)), kWidest);
  digits = digits < 0 ? 6 : std::min(digits, kWidest);
  c.context.step(c.span, (width + digits) / kDigitsAStep);
  std::string s(
      std::size_t(std::snprintf(nullptr, 0, zeros ? "%0*.*f" : "%*.*f", width, digits, x)), '\0');
  std::snprintf(s.data(), s.size() + 1, zeros ? "%0*.*f" : "%*.*f", width, digits, x);
  return s;
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

/// vstr(n, vector, separator, width, digits): the first n components; a number fills all.
Datum vectorText(const Call& c) {
  const int n = c.integer(0);
  if (n < 2 || n > 5) return c.complain(0, "vstr() writes 2 to 5 components, found " + shortest(n));
  const Numbers v = c.vector(1);
  std::string s;
  for (int i = 0; i < n; ++i) {
    if (i > 0) append(c, s, c.text(2));
    append(c, s, layout(c, v.at(i), c.integer(3), c.integer(4)));
  }
  return made(c, std::move(s));
}

Datum part(const Call& c) {
  const std::string& s = c.text(0);
  const int from = c.integer(1), length = c.integer(2);
  if (from < 1 || length < 0 || std::size_t(from - 1) + std::size_t(length) > s.size())
    return c.complain(1, "substr() from " + shortest(from) + ", " + shortest(length) +
                             " long, reaches outside a string of " + shortest(double(s.size())) +
                             " characters");
  return made(c, s.substr(std::size_t(from - 1), std::size_t(length)));
}

Datum character(const Call& c) {
  const int code = c.integer(0);
  if (code < 0 || code > 255)
    return c.complain(0, "chr() takes 0 to 255, found " + shortest(c.number(0)));
  return textDatum(std::string(1, char(code)));
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

/// Of the first letters that differ, where the end of a string counts as 0.
int difference(const std::string& a, const std::string& b) {
  const auto code = [](const std::string& s, std::size_t i) {
    return i < s.size() ? int(static_cast<unsigned char>(s[i])) : 0;
  };
  std::size_t i = 0;
  while (i < a.size() && i < b.size() && a[i] == b[i]) ++i;
  return code(a, i) - code(b, i);
}

Datum numberOf(const Call& c) {
  const std::string& s = c.text(0);
  std::size_t from = s.find_first_not_of(" \t");
  if (from != std::string::npos && s[from] == '+') ++from;
  double x = 0;
  if (from == std::string::npos ||
      std::from_chars(s.data() + from, s.data() + s.size(), x).ec != std::errc())
    c.warn(0, "val() finds no number in \"" + s + "\" and gives 0");
  return Numbers(x);
}

Datum fileExists(const Call& c) {
  c.context.step(c.span, kFileSteps);
  return Numbers(c.context.fileExists && c.context.fileExists(c.text(0)) ? 1 : 0);
}

}  // namespace

std::vector<Builtin> stringBuiltins() {
  return {
      {"asc", "s",
       [](const Call& c) -> Datum {
         return Numbers(c.text(0).empty() ? 0 : static_cast<unsigned char>(c.text(0)[0]));
       }},
      {"chr", "n", character},
      {"concat", "s+", concat},
      {"file_exists", "s", fileExists, false},
      {"str", "nnn",
       [](const Call& c) { return made(c, layout(c, c.number(0), c.integer(1), c.integer(2))); }},
      {"strcmp", "ss",
       [](const Call& c) -> Datum { return Numbers(difference(c.text(0), c.text(1))); }},
      {"strlen", "s", [](const Call& c) -> Datum { return Numbers(double(c.text(0).size())); }},
      {"strlwr", "s", changeCase<false>},
      {"strupr", "s", changeCase<true>},
      {"substr", "snn", part},
      {"val", "s", numberOf},
      {"vstr", "nvsnn", vectorText},
  };
}

}  // namespace vestige::lang
