// SPDX-License-Identifier: Apache-2.0
// The rest of the parser: what can be declared, and transforms.
#include <cmath>

#include "lang/dismantle.h"
#include "lang/parser.h"
#include "lang/transforms.h"

namespace vestige::lang {

// value := block | 'transform' ... | function | array | dictionary | spline | expression
Parser::Declared Parser::value(ExpressionParser::Place place) {
  const Token t = stream_.peek();
  const bool isName = t.kind == Token::Kind::name;
  if (isName && t.word() == Word::transform) {
    Datum a = context_.budget.transform(t.span, transform());
    return {std::move(a), context_.sources.join(t.span, stream_.last())};
  }
  if (isName && words_.opensBlock(*t.text)) {
    auto declared = std::make_shared<const Block>(block());
    const Span span = declared->span;
    return {BlockPtr(std::move(declared)), span};
  }
  if (isName && t.word() == Word::function) return function();
  if (isName && t.word() == Word::array) return array();
  if (isName && t.isWord("dictionary") && !context_.symbols.value(t.text)) return dictionary();
  if (t.word() == Word::spline) {
    SplinePtr s = spline();
    return {std::move(s), context_.sources.join(t.span, stream_.last())};
  }
  const auto result = expressions_.evaluate(place);
  return {result.value, result.span};
}

// ---------------------------------------------------------------- transforms
// transform := ('translate' | 'rotate' | 'scale') expression | 'matrix' ...
//            | 'transform' (name | '{' ... '}')
Affine Parser::transform() {
  const Token word = stream_.next();
  if (word.word() == Word::matrix) return matrix();
  if (word.word() == Word::transform) return transformBlock();
  Span span;
  const auto v = transformVector(*word.text, span);
  if (!v) return {};
  if (word.word() == Word::translate) return translation(*v);
  if (word.word() == Word::rotate) return rotation(*v);
  if (v->at(0) == 0 || v->at(1) == 0 || v->at(2) == 0)
    context_.reporter.warning(span, "a scale of 0 would flatten everything: 1 is taken instead");
  return scaling(*v);
}

/// Three finite numbers; nothing if an error was reported.
std::optional<Numbers> Parser::transformVector(const std::string& word, Span& span) {
  if (!expressions_.begins(stream_.peek()) && stream_.peek().kind != Token::Kind::name)
    expressions_.unexpected("a vector <x, y, z> after '" + word + "'");
  const auto result = expressions_.evaluate(ExpressionParser::Place::setting);
  span = result.span;
  if (isBroken(result.value)) return {};
  const Numbers* n = numbers(result.value);
  if (!n || n->isColour || n->size > 3) {
    context_.reporter.error(
        span, "'" + word + "' takes a vector <x, y, z>, found " + describe(result.value));
    return {};
  }
  if (!std::isfinite(n->at(0) + n->at(1) + n->at(2))) {
    context_.reporter.error(span,
                            "'" + word + "' takes finite numbers, found " + describe(result.value));
    return {};
  }
  return *n;
}

// matrix := 'matrix' '<' 12 sums '>'            four row vectors
Affine Parser::matrix() {
  const Span open = stream_.peek().span;
  if (!stream_.accept("<")) expressions_.unexpected("'<' and 12 numbers after 'matrix'");
  double rows[12] = {};
  bool isWhole = true;
  for (int i = 0; i < 12; ++i) {
    if (stream_.peek().is(">"))
      context_.reporter.syntaxError(stream_.peek().span,
                                    "a matrix has 12 numbers, found " + std::to_string(i));
    const auto result = expressions_.evaluate(ExpressionParser::Place::setting);
    const Numbers* n = numbers(result.value);
    const bool isNumber = n && n->size == 1 && std::isfinite(n->v[0]);
    if (!isNumber && !isBroken(result.value))
      context_.reporter.error(
          result.span, "a matrix is made of finite numbers, found " + describe(result.value));
    if (isNumber) rows[i] = n->v[0];
    isWhole &= isNumber;
    stream_.accept(",");
  }
  expressions_.expect(">", open, "<");
  const Affine a = fromRows(rows);
  if (!isWhole) return {};
  if (a.determinant() != 0) return a;
  context_.reporter.error(context_.sources.join(open, stream_.last()),
                          "this matrix flattens everything: its determinant is 0");
  return {};
}

// 'transform' (name | '{' { transform | name | 'inverse' } '}')
Affine Parser::transformBlock() {
  const auto named = [&](const Token& t) {
    const Datum* value = t.isName() ? context_.symbols.value(t.text) : nullptr;
    const auto* found = value ? std::get_if<AffinePtr>(value) : nullptr;
    return found ? *found : nullptr;
  };
  const Span word = stream_.last();
  const Nested nested(context_, word);
  const Token ahead = stream_.peek();
  if (const AffinePtr a = named(ahead)) {
    context_.used(ahead);
    stream_.next();
    return *a;
  }
  if (!stream_.accept("{"))
    expressions_.unexpected("'{' or the name of a declared transform after 'transform'");
  Affine all;
  while (!stream_.peek().is("}")) {
    const Token t = stream_.peek();
    if (t.kind == Token::Kind::name && isTransformWord(*t.text)) {
      all = transform() * all;
    } else if (const AffinePtr a = named(t)) {
      all = *a * all;
      context_.used(t);
      stream_.next();
    } else if (t.isWord("inverse")) {
      stream_.next();
      if (all.determinant() == 0)
        context_.reporter.error(t.span, "this transform has no inverse");
      else
        all = all.inverse();
    } else if (t.kind == Token::Kind::name) {
      expressions_.unexpected("translate, rotate, scale, matrix, transform, inverse or '}'");
    } else {
      expressions_.expect("}", ahead.span, "{");
    }
  }
  stream_.next();
  return all;
}

// ---------------------------------------------------------------- functions and arrays
// function := 'function' ['(' name { ',' name } ')'] '{' (expression | 'transform' ... | spline)
// '}'
Parser::Declared Parser::function() { return functionBehind(stream_.next().span); }

Parser::Declared Parser::functionBehind(const Span& word) {
  const Nested nested(context_, word);
  auto f = makeHolder<Function>();
  const Span open = stream_.peekRaw().span;
  if (stream_.acceptRaw("(")) {
    do {
      const Token name = stream_.nextRaw();
      if (name.kind != Token::Kind::name)
        context_.reporter.syntaxError(name.span, "expected the name of a parameter, found " +
                                                     describe(name, context_.sources));
      f->parameters.push_back(name.text);
      context_.events.parameter(*name.text, name.span);
      if (context_.events.areWanted()) f->declared.push_back(name.span);
    } while (stream_.acceptRaw(","));
    expressions_.expect(")", open, "(");
  } else {
    for (const char* name : {"x", "y", "z"}) f->parameters.push_back(context_.names.intern(name));
  }
  if (stream_.peekRaw(1).isWord("transform")) {
    const Span brace = stream_.next().span;
    stream_.next();
    f->transform = transformBlock();
    expressions_.expect("}", brace, "{");
  } else if (stream_.peekRaw(1).word() == Word::spline) {
    const Span brace = stream_.next().span;
    f->spline = spline();
    expressions_.expect("}", brace, "{");
  } else {
    expressions_.functionBody(*f);
  }
  return {FunctionPtr(std::move(f)), context_.sources.join(word, stream_.last())};
}

/// POV-Ray 3.8 has a word for arrays of several kinds of values; here every array may be one.
void Parser::acceptMixed() {
  if (stream_.peekRaw().isWord("mixed")) stream_.nextRaw();
}

// array := 'array' ['mixed'] { '[' sum ']' } ['mixed'] [ elements ]
Parser::Declared Parser::array() {
  const Token word = stream_.next();
  auto a = makeHolder<Array>();
  std::size_t total = 1;
  acceptMixed();
  while (stream_.peekRaw().is("[")) {
    const Span open = stream_.next().span;
    const auto size = expressions_.evaluate(ExpressionParser::Place::setting);
    const Numbers* n = numbers(size.value);
    if (!n || n->size != 1 || !(n->v[0] >= 1)) {
      if (!isBroken(size.value))
        context_.reporter.error(
            size.span, "an array's size is a number from 1, found " + describe(size.value));
      throw SyntaxError{};
    }
    const double wanted = double(total) * std::trunc(n->v[0]);
    if (!(wanted <= double(context_.options.limits.arrayElements)))
      context_.reporter.stop(size.span, "this array has more than " +
                                            std::to_string(context_.options.limits.arrayElements) +
                                            " elements: --max-array-elements raises the limit");
    a->sizes.push_back(int(n->v[0]));
    total = std::size_t(wanted);
    expressions_.expect("]", open, "[");
  }
  acceptMixed();
  const bool isOpenEnded = a->sizes.empty();
  a->share = Share(context_.elements, isOpenEnded ? 0 : std::int64_t(total));
  context_.checkElements(word.span);
  if (!isOpenEnded) {
    const std::size_t bytes = sizeof(Array) + total * sizeof(Datum);
    a->bytes = context_.budget.take(word.span, bytes);
    context_.budget.copy(word.span, bytes);
    a->data.resize(total);
  }
  if (isOpenEnded && !stream_.peekRaw().is("{"))
    expressions_.unexpected("'[' and a size, or '{' and the elements, after 'array'");
  if (stream_.peekRaw().is("{")) elements(*a, 0, 0);
  if (isOpenEnded) {
    a->sizes.push_back(int(a->data.size()));
    const std::size_t bytes = a->data.capacity() * sizeof(Datum);
    context_.budget.keep(-std::int64_t(bytes));  // counted while it grew
    a->bytes = context_.budget.take(word.span, sizeof(Array) + bytes);
    a->share = Share(context_.elements, std::int64_t(a->data.size()));
    context_.checkElements(word.span);
  }
  return {ArrayPtr(std::move(a)), context_.sources.join(word.span, stream_.last())};
}

// elements := '{' [ (elements | value) { [','] (elements | value) } ] '}'
void Parser::elements(Array& array, std::size_t level, std::size_t first) {
  const Span open = stream_.next().span;
  const Nested nested(context_, open);
  const bool isOpenEnded = array.sizes.empty();
  const bool isInner = level + 1 < array.sizes.size();
  std::size_t stride = 1;
  for (std::size_t i = level + 1; i < array.sizes.size(); ++i)
    stride *= std::size_t(array.sizes[i]);
  const std::size_t size = isOpenEnded ? 0 : std::size_t(array.sizes[level]);
  for (std::size_t i = 0; !stream_.peek().is("}"); ++i) {
    if (!isOpenEnded && i >= size)
      context_.reporter.syntaxError(stream_.peek().span, "one element too many: the array has " +
                                                             std::to_string(size) + " here");
    const std::size_t next = first + i * stride;
    if (isInner) {
      if (!stream_.peek().is("{")) expressions_.unexpected("'{' and a row of the array");
      elements(array, level + 1, next);
    } else {
      Datum element = value(ExpressionParser::Place::setting).value;
      if (isOpenEnded) {
        context_.budget.reserveOne(open, array.data);
        array.data.push_back(std::move(element));
      } else {
        array.data[next] = std::move(element);
      }
    }
    if (!stream_.accept(",") && stream_.peek().kind == Token::Kind::end) break;
  }
  expressions_.expect("}", open, "{");
}

}  // namespace vestige::lang
