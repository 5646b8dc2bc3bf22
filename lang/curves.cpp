// SPDX-License-Identifier: Apache-2.0
// The part of the parser that reads splines.
#include <cmath>

#include "lang/parser.h"
#include "lang/spline.h"

namespace vestige::lang {

// spline := 'spline' '{' [name of a spline] { kind } { time [','] point [','] } '}'
SplinePtr Parser::spline() {
  const Span word = stream_.next().span;
  const Nested nested(context_, word);
  const Span open = stream_.peek().span;
  if (!stream_.accept("{")) expressions_.unexpected("'{' after 'spline'");
  auto s = std::make_shared<Spline>();
  if (const auto* base = namedSpline()) {
    *s = **base;
    context_.used(stream_.peek());
    context_.budget.copy(word, s->times.size() * Spline::kPointBytes);
    stream_.next();
  }
  while (isSplineKind(stream_.peek().word())) s->kind = stream_.next().word();
  while (!stream_.peek().is("}")) {
    splinePoint(*s, open);
    stream_.accept(",");
  }
  expressions_.expect("}", open, "{");
  if (s->times.empty())
    context_.reporter.syntaxError(context_.sources.join(word, stream_.last()),
                                  "a spline has at least one time and point");
  const std::size_t bytes = s->times.size() * Spline::kPointBytes;
  s->bytes = context_.budget.take(word, 2 * bytes);  // sorted into a copy
  context_.budget.copy(word, 2 * bytes);
  s->finish();
  s->bytes = context_.budget.take(word, bytes);
  return s;
}

/// The declared spline whose name comes next, without a call, or null.
const SplinePtr* Parser::namedSpline() {
  const Token t = stream_.peek();
  const Datum* value = t.isName() ? context_.symbols.value(t.text) : nullptr;
  return value && !stream_.peekRaw(1).is("(") ? std::get_if<SplinePtr>(value) : nullptr;
}

// time [','] point
void Parser::splinePoint(Spline& s, const Span& open) {
  const auto time = expressions_.evaluate(ExpressionParser::Place::setting);
  const Numbers* t = numbers(time.value);
  if (!t || t->size != 1 || !std::isfinite(t->v[0])) {
    if (!isBroken(time.value))
      context_.reporter.error(
          time.span,
          "a spline has a time before each point, a finite number, found " + describe(time.value));
    throw SyntaxError{};
  }
  const double at = t->v[0];
  stream_.accept(",");
  const auto point = expressions_.evaluate(ExpressionParser::Place::setting);
  const Numbers* p = numbers(point.value);
  if (!p || p->isColour) {
    if (!isBroken(point.value))
      context_.reporter.error(point.span, "a point of a spline is a vector or a number, found " +
                                              describe(point.value));
    throw SyntaxError{};
  }
  s.size = std::max(s.size, p->size);
  s.times.push_back(at);
  s.points.push_back({p->at(0), p->at(1), p->size == 1 ? 0 : p->at(2), p->size == 1 ? 0 : p->at(3),
                      p->size == 1 ? 0 : p->at(4)});
  context_.budget.need(open, 4.0 * double(s.times.size() * Spline::kPointBytes));
}

}  // namespace vestige::lang
