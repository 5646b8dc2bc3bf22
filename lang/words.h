// SPDX-License-Identifier: Apache-2.0
// The words and signs of expressions and directives as numbers, so that the parser compares no
// letters. A word is looked up once, when a text first contains it.
#pragma once
#include <cstdint>
#include <string_view>

namespace vestige::lang {

enum class Word : std::uint8_t {
  none,  ///< any other name
  rgb,
  rgbf,
  rgbt,
  rgbft,
  srgb,
  srgbf,
  srgbt,
  srgbft,
  color,
  colour,
  red,  ///< the channels of a colour, in their order
  green,
  blue,
  filter,
  transmit,
  gray,
  grey,
  x,
  y,
  z,
  t,
  u,
  v,
  pi,
  tau,
  isTrue,
  yes,
  on,
  isFalse,
  no,
  off,
  clock,
  clockOn,
  now,
  version,
  defined,
  sum,
  prod,
  linearSpline,
  quadraticSpline,
  cubicSpline,
  naturalSpline,
  spline,
  array,
  function,
  translate,
  rotate,
  scale,
  matrix,
  transform,
  global,
  declare,
  local,
  undef,
  macro,
  include,
  fopen,
  fclose,
  read,
  write,
  debug,
  warning,
  error,
};

/// `none` for a word that is not in the list.
Word wordOf(std::string_view text);
/// How a word is written, for messages.
const char* textOf(Word word);

constexpr bool isColour(Word w) { return w >= Word::rgb && w <= Word::colour; }
constexpr bool isBareColour(Word w) { return w == Word::color || w == Word::colour; }
/// Constants that depend on the run. They are not `defined()`, and -D may declare them.
constexpr bool isSetting(Word w) { return w >= Word::clock && w <= Word::now; }
constexpr bool isSplineKind(Word w) { return w >= Word::linearSpline && w <= Word::naturalSpline; }
constexpr bool isTransform(Word w) { return w >= Word::translate && w <= Word::transform; }
/// The place of a channel in a colour; -1: not the name of one.
constexpr int channelOf(Word w) {
  return w >= Word::red && w <= Word::transmit ? int(w) - int(Word::red) : -1;
}
/// What may follow a '.'.
constexpr bool isComponent(Word w) { return w >= Word::red && w <= Word::v; }
/// Directives with an effect of their own, unlike #if or #end, which choose the text to read.
constexpr bool isStatement(Word w) {
  return w == Word::version || (w >= Word::declare && w <= Word::error);
}

enum class Op : std::uint8_t {
  none,
  plus,
  minus,
  times,
  over,
  modulo,
  less,
  lessEqual,
  equal,
  greaterEqual,
  greater,
  notEqual,
  both,
  either,
  invert,
};

/// One or two characters as a number; 0 is not a sign.
constexpr std::uint16_t signCode(const char* s) {
  const auto first = static_cast<unsigned char>(s[0]);
  return std::uint16_t(first + (first ? static_cast<unsigned char>(s[1]) * 256 : 0));
}

/// The operator between two operands; `none` for other signs.
constexpr Op operatorOf(std::uint16_t sign) {
  switch (sign) {
    case signCode("+"):
      return Op::plus;
    case signCode("-"):
      return Op::minus;
    case signCode("*"):
      return Op::times;
    case signCode("/"):
      return Op::over;
    case signCode("%"):
      return Op::modulo;
    case signCode("<"):
      return Op::less;
    case signCode("<="):
      return Op::lessEqual;
    case signCode("="):
    case signCode("=="):
      return Op::equal;
    case signCode(">="):
      return Op::greaterEqual;
    case signCode(">"):
      return Op::greater;
    case signCode("!="):
      return Op::notEqual;
    case signCode("&"):
    case signCode("&&"):
      return Op::both;
    case signCode("|"):
    case signCode("||"):
      return Op::either;
    default:
      return Op::none;
  }
}
const char* textOf(Op op);

/// How strongly an operator binds. 0: not an operator.
enum class Level : std::uint8_t { none, logic, comparison, sum, product, operand };
constexpr Level levelOf(Op op) {
  if (op == Op::none || op == Op::invert) return Level::none;
  if (op >= Op::both) return Level::logic;
  if (op >= Op::less) return Level::comparison;
  return op >= Op::times ? Level::product : Level::sum;
}
constexpr bool isRelation(Op op) { return levelOf(op) == Level::comparison; }
constexpr Level above(Level level) { return Level(std::uint8_t(level) + 1); }

}  // namespace vestige::lang
