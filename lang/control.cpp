// SPDX-License-Identifier: Apache-2.0
// Choices and loops. The lexer has linked their parts (Token::jump), so that taking a branch or
// going round a loop is a jump in the list of tokens.
#include <cmath>

#include "lang/directives.h"

namespace vestige::lang {

/// The #end of the construct that the directive at this index belongs to, or the end of the text.
std::uint32_t Directives::endOf(std::uint32_t part) {
  const auto& closings = stream_.frame().list->closings;
  const auto closing = closings.find(part);
  return closing == closings.end() ? part : closing->second;
}

void Directives::jumpBehind(std::uint32_t index) {
  Frame& f = stream_.frame();
  f.at = std::min(index + 1, f.end);
  stream_.drop();
}

/// The text from here up to that directive is not read; returns its index.
std::uint32_t Directives::skipTo(std::uint32_t part) {
  const Frame& f = stream_.frame();
  context_.events.skipped(*f.list, f.at, part, f.via);
  return part;
}

/// Leaves the construct of this part: neither the rest of the part being read nor the parts behind
/// it are read.
void Directives::skipParts(std::uint32_t part) {
  const auto& tokens = stream_.frame().list->tokens;
  const std::uint32_t last = endOf(part);
  while (part < last && context_.events.areWanted()) {
    part = tokens[part].jump;
    if (part < stream_.frame().at) continue;  // it was read
    context_.step(stream_.frame().token(part).span);
    skipTo(part);
    jumpBehind(part);
  }
  jumpBehind(last);
}

/// Recovers from an error in the head of a construct: continues behind it, if its text is still
/// being read.
void Directives::abandon(std::uint32_t first, std::size_t frames) {
  while (stream_.frames().size() > frames) stream_.pop();
  if (stream_.frames().size() == frames) jumpBehind(endOf(first));
}

/// Whether this part belongs to the innermost open construct: not if it is unpaired (already
/// reported by the lexer) or inside a head, as in `#if (1 #else`.
bool Directives::isOpen(std::uint32_t part) {
  const Frame& f = stream_.frame();
  if (f.open.empty()) return false;
  const std::uint32_t first = f.open.back().first;
  const Token& last = f.token(endOf(part));
  if (last.kind == Token::Kind::directive) return *last.text == "end" && last.jump == first;
  std::uint32_t at = first;  // without #end: each part leads to the next one
  while (at < part) {
    context_.step(last.span);
    at = f.list->tokens[at].jump;
  }
  return at == part;
}

void Directives::countLoop(const Span& span) {
  if (++loops_ > context_.options.limits.loopIterations)
    context_.reporter.stop(span, "the loops have run more than " +
                                     std::to_string(context_.options.limits.loopIterations) +
                                     " times: does this one ever end? --max-loop-iterations raises "
                                     "the limit");
}

// ---------------------------------------------------------------- #if
// '(' (name { '[' sum ']' } | number | string) ')'      only a name has a value to ask for
bool Directives::isDefined() {
  const Span open = stream_.peekRaw().span;
  if (!stream_.acceptRaw("(")) parser_.expressions().unexpected("'(' and a name");
  const Token t = stream_.peekRaw();
  const bool isConstant = t.kind == Token::Kind::number || t.kind == Token::Kind::string;
  if (isConstant) stream_.nextRaw();
  const bool isKnown = !isConstant && parser_.expressions().isDefined(plainName("'('"));
  parser_.expressions().expect(")", open, "(");
  return isKnown;
}

bool Directives::holds(const std::string& word) {
  if (word == "ifdef") return isDefined();
  if (word == "ifndef") return !isDefined();
  const auto x = parser_.expressions().condition();
  return x && isTrue(*x);
}

// ('#if' | '#ifdef' | '#ifndef') condition … { '#elseif' condition … } [ '#else' … ] '#end'
void Directives::ifBranch(const Token& directive) {
  const std::uint32_t first = here();
  const std::size_t depth = stream_.frames().size();
  const auto& tokens = stream_.frame().list->tokens;
  std::string word = *directive.text;
  for (std::uint32_t part = first;;) {
    bool isTaken = word == "else";
    try {
      isTaken = isTaken || holds(word);
    } catch (const SyntaxError&) {  // skip all branches
      return abandon(part, depth);
    }
    if (stream_.frames().size() != depth) return;
    if (isTaken) {
      OpenDirective open{OpenDirective::Kind::branch, first};
      open.isLastPart = word == "else";
      stream_.frame().open.push_back(std::move(open));
      return;
    }
    part = skipTo(tokens[part].jump);
    jumpBehind(part);
    if (tokens[part].kind != Token::Kind::directive || *tokens[part].text == "end") return;
    word = *tokens[part].text;
    if (word == "elseif") word = "if";
  }
}

// ---------------------------------------------------------------- loops
// '#while' condition … '#end'
void Directives::whileLoop(const Token&) {
  const std::uint32_t first = here();
  const std::size_t depth = stream_.frames().size();
  const bool isTrue = testWhile(first);
  if (stream_.frames().size() != depth) return;
  if (isTrue)
    stream_.frame().open.push_back({OpenDirective::Kind::whileLoop, first});
  else
    jumpBehind(skipTo(endOf(first)));
}

bool Directives::testWhile(std::uint32_t first) {
  const std::size_t depth = stream_.frames().size();
  stream_.frame().at = first + 1;
  countLoop(stream_.frame().token(first).span);
  try {
    const auto x = parser_.expressions().condition();
    return x && isTrue(*x);
  } catch (const SyntaxError&) {
    abandon(first, depth);
    return false;
  }
}

// '#for' '(' name [','] first [','] last [ [','] step ] ')' … '#end'
void Directives::forLoop(const Token& directive) {
  const std::uint32_t first = here();
  const std::size_t depth = stream_.frames().size();
  try {
    const Span open = stream_.peekRaw().span;
    if (!stream_.acceptRaw("(")) parser_.expressions().unexpected("'(' after #for");
    const Token name = newName(directive);
    if (context_.symbols.isMacro(name.text))
      context_.reporter.syntaxError(
          name.span, "'" + *name.text + "' is a macro: the counter of #for needs another name");
    OpenDirective loop{OpenDirective::Kind::forLoop, first};
    loop.name = name.text;
    loop.counter = context_.symbols.local(name.text);
    *loop.counter = {Numbers(0.0), name.span};  // as in POV-Ray, before the bounds are read
    *loop.counter = {Numbers(loopBound()), name.span};
    loop.last = loopBound();
    stream_.accept(",");
    loop.step = stream_.peek().is(")") ? 1 : loopStep();
    parser_.expressions().expect(")", open, "(");
    if (stream_.frames().size() != depth) return;
    context_.events.declared(name, loop.counter->value);
    loop.body = stream_.frame().at;
    if (isWithin(loop, directive.span))
      stream_.frame().open.push_back(std::move(loop));
    else
      jumpBehind(skipTo(endOf(first)));
  } catch (const SyntaxError&) {
    abandon(first, depth);
  }
}

/// A bound of #for with the comma in front of it, which may be left out as in POV-Ray.
double Directives::loopBound() {
  stream_.accept(",");
  if (stream_.peek().is(")"))
    parser_.expressions().unexpected("',' and the bounds: #for (I, 1, 10)");
  const auto bound = parser_.expressions().evaluate(ExpressionParser::Place::setting);
  const Numbers* n = numbers(bound.value);
  if (n && n->size == 1) return n->v[0];
  if (!isBroken(bound.value))
    context_.reporter.error(bound.span, "#for counts with numbers, found " + describe(bound.value));
  throw SyntaxError{};
}

double Directives::loopStep() {
  const double step = loopBound();
  if (std::abs(step) < kTruth)
    context_.reporter.syntaxError(stream_.last(), "the step of #for is 0: the loop would not end");
  return step;
}

/// The tolerance lets #for (I, 0, 1, 0.1) reach 1, as POV-Ray's does.
bool Directives::isWithin(const OpenDirective& loop, const Span& span) {
  countLoop(span);
  const Numbers* n = numbers(loop.counter->value);
  if (!context_.symbols.find(loop.name)) {
    context_.reporter.error(span, "the counter of this #for has been forgotten by #undef");
    return false;
  }
  if (!n || n->size != 1) {
    context_.reporter.error(span,
                            "the counter of this #for has become " + describe(loop.counter->value));
    return false;
  }
  return loop.step > 0 ? n->v[0] < loop.last + kTruth : n->v[0] > loop.last - kTruth;
}

// ---------------------------------------------------------------- #switch
// '#switch' condition … { ('#case' '(' x ')' | '#range' '(' low [','] high ')') … } [ '#else' … ]
// '#end'                      the text in front of the first #case is read, as in POV-Ray
void Directives::choice(const Token&) {
  const std::uint32_t first = here();
  const std::size_t depth = stream_.frames().size();
  try {
    const auto x = parser_.expressions().condition();
    if (stream_.frames().size() != depth) return;
    if (!x) return jumpBehind(skipTo(endOf(first)));
    OpenDirective open{OpenDirective::Kind::choice, first};
    open.value = *x;
    open.isBeforeCases = true;
    stream_.frame().open.push_back(std::move(open));
  } catch (const SyntaxError&) {
    abandon(first, depth);
  }
}

/// Continues behind the part of a #switch that its value chooses, from this part on.
void Directives::choose(std::uint32_t part) {
  const std::size_t depth = stream_.frames().size();
  const auto& tokens = stream_.frame().list->tokens;
  const OpenDirective open = stream_.frame().open.back();
  stream_.frame().open.pop_back();
  try {
    const std::string& word = *tokens[part].text;
    if (word != "case" && word != "range")
      context_.reporter.syntaxError(stream_.frame().token(open.first).span,
                                    "this #switch has no #case and no #range");
    for (;; part = skipTo(tokens[part].jump)) {
      if (stream_.frames().size() != depth) return;
      jumpBehind(part);
      if (tokens[part].kind != Token::Kind::directive || *tokens[part].text == "end") return;
      if (!caseMatches(*tokens[part].text, open.value)) continue;
      if (stream_.frames().size() == depth)
        stream_.frame().open.push_back({OpenDirective::Kind::choice, open.first});
      return;
    }
  } catch (const SyntaxError&) {
    abandon(open.first, depth);
  }
}

bool Directives::caseMatches(const std::string& word, double x) {
  if (word == "else") return true;
  if (word == "elseif")
    context_.reporter.syntaxError(stream_.last(), "#elseif belongs to #if: a #switch has #case");
  const Span open = stream_.peek().span;
  if (!stream_.accept("(")) parser_.expressions().unexpected("'(' after #" + word);
  double bounds[2] = {};
  for (int i = 0; i < (word == "range" ? 2 : 1); ++i) {
    if (i > 0) stream_.accept(",");
    if (i > 0 && stream_.peek().is(")"))
      parser_.expressions().unexpected("two bounds, as in #range (1, 2)");
    const auto bound = parser_.expressions().evaluate(ExpressionParser::Place::parentheses);
    const Numbers* n = numbers(bound.value);
    if (!n || n->size != 1) {
      if (!isBroken(bound.value))
        context_.reporter.error(bound.span,
                                "#" + word + " takes a number, found " + describe(bound.value));
      throw SyntaxError{};
    }
    bounds[i] = n->v[0];
  }
  parser_.expressions().expect(")", open, "(");
  return word == "case" ? std::abs(x - bounds[0]) <= kTruth : x >= bounds[0] && x <= bounds[1];
}

// ---------------------------------------------------------------- reached in reading
/// The next part of a construct: of an #if, the branch that was taken is over; of a #switch, the
/// case falls through, as in POV-Ray.
void Directives::nextPart(const Token& directive) {
  const std::uint32_t part = here();
  auto& open = stream_.frame().open;
  if (!isOpen(part)) {  // already reported: skips what follows it
    context_.reporter.fail();
    throw SyntaxError{};
  }
  if (open.back().isBeforeCases) return choose(part);
  if (open.back().kind != OpenDirective::Kind::choice) {
    if (open.back().isLastPart)
      context_.reporter.error(directive.span,
                              "#" + *directive.text + " behind the #else of the same #if");
    open.pop_back();
    skipParts(part);
    return;
  }
  if (*directive.text == "else") {
    context_.reporter.warning(directive.span, "a #case without #break falls through into #else");
    return;
  }
  caseMatches(*directive.text, 0);
}

void Directives::end(const Token&) {
  const std::uint32_t at = here();
  if (!isOpen(at)) return context_.reporter.fail();
  if (stream_.frame().open.back().isBeforeCases) return choose(at);
  const std::size_t depth = stream_.frames().size();
  const OpenDirective top = stream_.frame().open.back();
  bool again = false;
  if (top.kind == OpenDirective::Kind::whileLoop) {
    again = testWhile(top.first);
    if (stream_.frames().size() != depth) return;
  } else if (top.kind == OpenDirective::Kind::forLoop) {
    if (Numbers* n = std::get_if<Numbers>(&top.counter->value)) n->v[0] += top.step;
    again = isWithin(top, stream_.frame().token(top.first).span);
    if (again) jumpBehind(top.body - 1);
  }
  if (again) return;
  stream_.frame().open.pop_back();
  jumpBehind(at);
}

// '#break' leaves the innermost #switch, loop or macro.
void Directives::leave(const Token& directive) {
  Frame& f = stream_.frame();
  while (!f.open.empty()) {
    const OpenDirective top = f.open.back();
    f.open.pop_back();
    if (top.kind == OpenDirective::Kind::branch) continue;
    if (top.isBeforeCases)
      context_.reporter.error(directive.span, "#break in front of the first #case of its #switch");
    if (top.kind == OpenDirective::Kind::choice)
      skipParts(top.first);
    else
      jumpBehind(endOf(top.first));
    return;
  }
  if (f.kind == Frame::Kind::macro)
    f.at = f.end;
  else
    context_.reporter.error(directive.span, "#break outside a loop, a #switch and a macro");
}

}  // namespace vestige::lang
