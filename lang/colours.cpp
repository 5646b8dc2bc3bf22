// SPDX-License-Identifier: Apache-2.0
// The grammar of colours.
#include "lang/expressions.h"

namespace vestige::lang {

// colour := ['color' | 'colour'] ('rgb' | 'rgbf' | 'rgbt' | 'rgbft' | 'srgb' ...) expression
// [channels]
//         | ('color' | 'colour') expression [channels]
//         | ['color' | 'colour'] channels
// It begins a value, as in POV-Ray: within a sum, the extent of its word would be a riddle.
Operand ExpressionParser::colour() {
  if (channelOf(stream_.peek().word()) >= 0) return channels({});
  Token word = stream_.next();
  if (isBareColour(word.word())) {
    const Word ahead = stream_.peek().word();
    if (channelOf(ahead) >= 0) return channels({});
    if (isColour(ahead) && !isBareColour(ahead)) word = stream_.next();
  }
  Operand operand = expression();
  Operand plain = made(
      {.kind = Operation::Kind::colour, .word = word.word(), .wordSpan = word.span}, {&operand, 1});
  // `filter "box"` is the next setting of a block.
  const bool isSetting = stream_.peekRaw(1).kind == Token::Kind::string;
  return isChannelAhead() && !isSetting ? channels(std::move(plain)) : std::move(plain);
}

bool ExpressionParser::isColourAhead() {
  const Token& ahead = stream_.peek();
  return isColour(ahead.word()) || (isChannelAhead() && !declared(ahead));
}

bool ExpressionParser::isChannelAhead() {
  if (channelOf(stream_.peek().word()) < 0) return false;
  return mode_.endsAtDirective || begins(stream_.peekRaw(1));
}

void ExpressionParser::misplacedColour() {
  const Token word = stream_.peek();
  context_.reporter.syntaxError(
      word.span,
      "a colour cannot stand within an expression: write '" + *word.text +
          "' in front of all of it, as in 'rgb 2*<1, 0, 0>', or declare the colour first");
}

// channels := { ('red' | 'green' | 'blue' | 'filter' | 'transmit') sum }      the last one counts
// `base`: a colour whose channels they replace; nothing: black.
Operand ExpressionParser::channels(std::optional<Operand> base) {
  Operation o{.kind = Operation::Kind::channels, .wordSpan = stream_.peek().span};
  Operand operands[6];
  if (base) operands[5] = std::move(*base), o.given = 1 << 5;
  do {
    const int channel = channelOf(stream_.next().word());
    operands[channel] = binary(Level::sum);
    o.given |= std::uint8_t(1 << channel);
  } while (channelOf(stream_.peek().word()) >= 0);
  return made(o, operands);
}

}  // namespace vestige::lang
