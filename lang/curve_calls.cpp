// SPDX-License-Identifier: Apache-2.0
// The part of the expression parser that reads calls of splines, and sums and products.
#include <algorithm>

#include "lang/expressions.h"

namespace vestige::lang {

/// Whether '(' after this operand calls it. In a branch that is not taken an element of an array
/// has no value: there a call is assumed.
bool ExpressionParser::isSplineCall(const Operand& e) {
  if (std::holds_alternative<SplinePtr>(e.value)) return true;
  return reading_ == Reading::syntax && isBroken(e.value) && !e.tree;
}

// splineCall := spline '(' sum [',' kind] ')'
Operand ExpressionParser::splineCall(Operand of) {
  const Span open = stream_.nextRaw().span;
  const Nested nested(context_, open);
  const With mode(*this, {true, false, -1});
  const Span begin = of.span;
  Operand operands[2] = {std::move(of), expression()};
  Word kind = Word::none;
  if (stream_.accept(",")) {
    kind = stream_.peek().word();
    if (!isSplineKind(kind))
      unexpected("linear_spline, quadratic_spline, cubic_spline or natural_spline");
    stream_.next();
  }
  expect(")", open, "(");
  const Span whole = context_.sources.join(begin, stream_.last());
  if (context_.events.areWanted()) context_.events.call(context_.sources.excerpt(begin), whole);
  return made({.kind = Operation::Kind::spline, .word = kind, .span = whole, .wordSpan = open},
              operands);
}

/// In functions u is another name for x, and v for y.
static bool areAlike(Word a, Word b) {
  const auto isX = [](Word w) { return w == Word::x || w == Word::u; };
  const auto isY = [](Word w) { return w == Word::y || w == Word::v; };
  return (isX(a) && isX(b)) || (isY(a) && isY(b));
}

/// The slot of a parameter or of a counter of the function that is being read.
std::optional<int> ExpressionParser::slotOf(const Name* name) const {
  if (!function_) return {};
  const auto& parameters = function_->parameters;
  const int counter = int(std::find_if(counters_.begin(), counters_.end(),
                                       [name](const Counter& c) { return c.name == name; }) -
                          counters_.begin());
  if (counter < int(counters_.size())) return int(parameters.size()) + counter;
  for (std::size_t i = parameters.size(); i-- > 0;)
    if (parameters[i] == name || areAlike(parameters[i]->word, name->word)) return int(i);
  return {};
}

/// Nowhere for a parameter that has its name without being declared: x, y, z.
Span ExpressionParser::declarationOf(int slot) const {
  const auto at = std::size_t(slot), parameters = function_->parameters.size();
  if (at >= parameters) return counters_[at - parameters].declared;
  return at < function_->declared.size() ? function_->declared[at] : Span{};
}

// series := ('sum' | 'prod') '(' counter ',' from ',' to ',' body ')'
Operand ExpressionParser::series(const Token& word) {
  if (!function_)
    context_.reporter.syntaxError(
        word.span, "'" + *word.text + "' stands in functions only, as in 'function(n) { " +
                       *word.text + "(i, 1, n, i) }'");
  const Nested nested(context_, word.span);
  const Span open = stream_.peek().span;
  if (!stream_.accept("(")) unexpected("'(' after '" + *word.text + "'");
  const Token name = counter();
  const With mode(*this, {true, false, -1});
  Operand operands[3];
  for (int i = 0; i < 3; ++i) {
    if (!stream_.accept(","))
      unexpected("',' and " + std::string(i == 0   ? "the first value of the counter"
                                          : i == 1 ? "the last value of the counter"
                                                   : "what is added or multiplied"));
    if (i == 2) counters_.push_back({name.text, name.span});
    operands[i] = expression();
  }
  counters_.pop_back();
  expect(")", open, "(");
  return made({.kind = Operation::Kind::series,
               .op = word.word() == Word::sum ? Op::plus : Op::times,
               .slot = int(function_->parameters.size() + counters_.size()),
               .span = context_.sources.join(word.span, stream_.last()),
               .wordSpan = word.span},
              operands);
}

/// A new name. POV-Ray counts with words such as x or sin, too, with results of its own.
Token ExpressionParser::counter() {
  const Token name = stream_.nextRaw();
  const bool isWord = name.isName() && (name.word() != Word::none || name.text->builtin);
  if (!name.isName() || isWord)
    context_.reporter.syntaxError(name.span, "expected a name that counts, such as i, found " +
                                                 describe(name, context_.sources));
  if (slotOf(name.text))
    context_.reporter.syntaxError(name.span, "'" + *name.text +
                                                 "' has a value in this function already: count "
                                                 "with another name");
  context_.events.parameter(*name.text, name.span);
  return name;
}

}  // namespace vestige::lang
