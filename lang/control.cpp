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
  const Token& last = f.token(endOf(part));
  return !f.open.empty() && last.kind == Token::Kind::directive && *last.text == "end" &&
         last.jump == f.open.back().first;
}

void Directives::countLoop(const Span& span) {
  if (++loops_ > context_.options.limits.loopIterations)
    context_.reporter.stop(span, "the loops have run more than " +
                                     std::to_string(context_.options.limits.loopIterations) +
                                     " times: does this one ever end? --max-loop-iterations raises "
                                     "the limit");
}

// ---------------------------------------------------------------- #if
// '(' name { '[' sum ']' } ')'
bool Directives::isDefined() {
  const Span open = stream_.peekRaw().span;
  if (!stream_.acceptRaw("(")) parser_.expressions().unexpected("'(' and a name");
  const bool isKnown = parser_.expressions().isDefined(plainName("'('"));
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
      stream_.frame().open.push_back({OpenDirective::Kind::branch, first});
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

// '#for' '(' name ',' first ',' last [ ',' step ] ')' … '#end'
void Directives::forLoop(const Token& directive) {
  const std::uint32_t first = here();
  const std::size_t depth = stream_.frames().size();
  try {
    const Span open = stream_.peekRaw().span;
    if (!stream_.acceptRaw("(")) parser_.expressions().unexpected("'(' after #for");
    const Token name = newName(directive);
    double bounds[3] = {0, 0, 1};
    int given = 0;
    for (; given < 3 && stream_.accept(","); ++given) {
      const auto bound = parser_.expressions().evaluate(ExpressionParser::Place::setting);
      const Numbers* n = numbers(bound.value);
      if (!n || n->size != 1) {
        if (!isBroken(bound.value))
          context_.reporter.error(bound.span,
                                  "#for counts with numbers, found " + describe(bound.value));
        throw SyntaxError{};
      }
      bounds[given] = n->v[0];
      if (given == 2 && n->v[0] == 0)
        context_.reporter.syntaxError(bound.span, "the step of #for is 0: the loop would not end");
    }
    if (given < 2) parser_.expressions().unexpected("',' and the bounds: #for (I, 1, 10)");
    parser_.expressions().expect(")", open, "(");
    if (stream_.frames().size() != depth) return;
    OpenDirective loop{OpenDirective::Kind::forLoop,
                       first,
                       context_.symbols.local(name.text),
                       bounds[1],
                       bounds[2],
                       stream_.frame().at};
    *loop.counter = {Numbers(bounds[0]), name.span};
    context_.events.declared(name, loop.counter->value);
    if (isWithin(loop, directive.span))
      stream_.frame().open.push_back(std::move(loop));
    else
      jumpBehind(skipTo(endOf(first)));
  } catch (const SyntaxError&) {
    abandon(first, depth);
  }
}

/// The tolerance lets #for (I, 0, 1, 0.1) reach 1, as POV-Ray's does.
bool Directives::isWithin(const OpenDirective& loop, const Span& span) {
  countLoop(span);
  const Numbers* n = numbers(loop.counter->value);
  if (!n || n->size != 1) {
    context_.reporter.error(span,
                            "the counter of this #for has become " + describe(loop.counter->value));
    return false;
  }
  return loop.step > 0 ? n->v[0] <= loop.last + kTruth : n->v[0] >= loop.last - kTruth;
}

// ---------------------------------------------------------------- #switch
// '#switch' condition { ('#case' '(' x ')' | '#range' '(' low ',' high ')') … } [ '#else' … ]
// '#end'
void Directives::choice(const Token&) {
  const std::uint32_t first = here();
  const std::size_t depth = stream_.frames().size();
  const auto& tokens = stream_.frame().list->tokens;
  try {
    const auto x = parser_.expressions().condition();
    for (std::uint32_t part = x ? tokens[first].jump : endOf(first);; part = tokens[part].jump) {
      if (stream_.frames().size() != depth) return;
      jumpBehind(skipTo(part));
      if (tokens[part].kind != Token::Kind::directive || *tokens[part].text == "end") return;
      if (!caseMatches(*tokens[part].text, *x)) continue;
      if (stream_.frames().size() == depth)
        stream_.frame().open.push_back({OpenDirective::Kind::choice, first});
      return;
    }
  } catch (const SyntaxError&) {
    abandon(first, depth);
  }
}

bool Directives::caseMatches(const std::string& word, double x) {
  if (word == "else") return true;
  const Span open = stream_.peek().span;
  if (!stream_.accept("(")) parser_.expressions().unexpected("'(' after #" + word);
  double bounds[2] = {};
  for (int i = 0; i < (word == "range" ? 2 : 1); ++i) {
    if (i > 0 && !stream_.accept(",")) parser_.expressions().unexpected("','");
    const auto bound = parser_.expressions().evaluate(ExpressionParser::Place::setting);
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
  if (!isOpen(part)) throw SyntaxError{};  // already reported: skips what follows it
  if (open.back().kind != OpenDirective::Kind::choice) {
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
  if (!isOpen(at)) return;
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
