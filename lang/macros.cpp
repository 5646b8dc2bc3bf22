// SPDX-License-Identifier: Apache-2.0
// Macros: a call makes the stream read the body's tokens, under the names of the caller.
#include "lang/directives.h"

namespace vestige::lang {

// '#macro' name '(' [ parameter { ',' parameter } ] ')' body '#end'
void Directives::macro(const Token& directive) {
  const std::uint32_t first = here();
  const std::size_t depth = stream_.frames().size();
  auto m = std::make_shared<Macro>();
  try {
    const Token name = newName(directive);
    m->name = name.text;
    m->declared = name.span;
    m->list = stream_.frame().list;
    m->end = endOf(first);
    macroParameters(*m);
    if (stream_.frames().size() != depth) return;  // ran past the end of its text
    m->begin = stream_.frame().at;
    context_.events.declared(name, MacroPtr(m));
    for (const auto& p : m->parameters) context_.events.parameter(*p.name, p.declared);
    *context_.symbols.declare(name.text) = {MacroPtr(m), name.span};
    jumpBehind(m->end);
  } catch (const SyntaxError&) {
    abandon(first, depth);  // the body must not run
  }
}

// { ['optional'] name ['=' sum] [','] }
void Directives::macroParameters(Macro& m) {
  const Span open = stream_.peekRaw().span;
  if (!stream_.acceptRaw("("))
    context_.reporter.syntaxError(open,
                                  "expected '(' and the parameters after '#macro " + *m.name + "'");
  while (!stream_.peekRaw().is(")")) {
    const bool isOptional =
        stream_.peekRaw().isWord("optional") && stream_.peekRaw(1).kind == Token::Kind::name;
    if (isOptional) stream_.nextRaw();
    const Token name = plainName("'(' or ','");
    Macro::Parameter p{name.text, name.span, isOptional};
    if (stream_.acceptRaw("=")) {
      p.isOptional = true;
      p.initial = parser_.value(ExpressionParser::Place::setting).value;
    }
    m.parameters.push_back(std::move(p));
    if (!stream_.acceptRaw(",") && !stream_.peekRaw().isName()) break;  // as in POV-Ray
  }
  if (!stream_.acceptRaw(")")) {
    const Token found = stream_.peekRaw();
    context_.reporter.syntaxError(found.span, "expected ',' or ')' in the parameters of macro '" +
                                                  *m.name + "', found " +
                                                  describe(found, context_.sources));
  }
}

/// Bytes of an argument that is no name.
constexpr std::int64_t kArgumentBytes = sizeof(Symbol) + 64;

// call := name '(' [ argument { [','] argument } ] ')'
// A faulty call expands to nothing.
void Directives::expand(const Token& name) {
  const MacroPtr m = std::get<MacroPtr>(*context_.symbols.value(name.text));
  const Nested nested(context_, name.span);
  context_.used(name);
  checkMacroDepth(name);
  if (!stream_.peekRaw().is("("))
    context_.reporter.syntaxError(name.span, "'" + *name.text +
                                                 "' is a macro: its arguments "
                                                 "follow in parentheses, as in " +
                                                 *name.text + "(...)");
  const Span open = stream_.nextRaw().span;
  std::vector<Cell> cells;
  Share held = context_.budget.take(open, 0);
  while (!stream_.peek().is(")")) {
    held.grow(kArgumentBytes);
    cells.push_back(argument(*name.text));
    if (!stream_.accept(",") && !isArgumentAhead()) break;  // as in POV-Ray
  }
  parser_.expressions().expect(")", open, "(");
  const Span call = context_.sources.join(name.span, stream_.last());
  if (!takes(*m, cells.size(), call)) return;
  context_.events.call(*name.text, call);
  readBody(*m, cells, call);
}

bool Directives::takes(const Macro& m, std::size_t arguments, const Span& call) {
  const std::size_t most = m.parameters.size();
  const auto least = std::size_t(std::count_if(m.parameters.begin(), m.parameters.end(),
                                               [](const auto& p) { return !p.isOptional; }));
  if (arguments >= least && arguments <= most) return true;
  context_.reporter
      .error(call, "the macro '" + *m.name + "' takes " + std::to_string(most) +
                       (most == 1 ? " argument" : " arguments") + ", found " +
                       std::to_string(arguments))
      .notes.push_back({m.declared, "it is declared here"});
  return false;
}

/// Makes the stream continue with the body; its parameters are names in a new table.
void Directives::readBody(const Macro& m, const std::vector<Cell>& arguments, const Span& call) {
  const int via = context_.sources.expand(Expansion::Kind::macro, m.name, call);
  stream_.push({Frame::Kind::macro, m.list, m.begin, m.end, via, -1});
  for (std::size_t i = 0; i < m.parameters.size(); ++i) {
    const auto& p = m.parameters[i];
    if (i < arguments.size())
      context_.symbols.bind(p, arguments[i]);
    else if (!isBroken(p.initial))
      context_.symbols.bind(p, std::make_shared<Symbol>(Symbol{p.initial, m.declared}));
  }
}

bool Directives::isArgumentAhead() {
  const Token& t = stream_.peek();
  return t.isName() || parser_.expressions().begins(t);
}

/// Whether the argument ahead is an element of an array, and nothing behind it: A[1], A[I][2].
bool Directives::isElementAhead() const {
  constexpr int kLongest = 100;  // tokens looked at; longer indices give the element's value
  int depth = 0;
  for (int i = 1; i < kLongest; ++i) {
    const Token t = stream_.peekRaw(i);
    if (depth == 0 && !t.is("[")) return i > 1 && (t.is(",") || t.is(")"));
    if (t.is("[")) ++depth;
    if (t.is("]")) --depth;
    if (t.kind == Token::Kind::end || t.kind == Token::Kind::directive) return false;
  }
  return false;
}

// argument := name | element | value        a name or an element is handed over itself, not its
// value
Cell Directives::argument(const std::string& macro) {
  const Token t = stream_.peek();
  const Token after = stream_.peekRaw(1);
  if (t.kind == Token::Kind::name && (after.is(",") || after.is(")")))
    if (Cell cell = context_.symbols.find(t.text)) {
      stream_.next();
      context_.used(t);
      return cell;
    }
  if (const Datum* whole = t.isName() && after.is("[") ? context_.symbols.value(t.text) : nullptr;
      whole && std::holds_alternative<ArrayPtr>(*whole) && isElementAhead()) {
    stream_.next();
    return elementArgument(t);
  }
  if (!isArgumentAhead())
    parser_.expressions().unexpected("an argument of the macro '" + macro + "' or ')'");
  auto value = parser_.value(ExpressionParser::Place::setting);
  return std::make_shared<Symbol>(Symbol{std::move(value.value), value.span});
}

void Directives::checkMacroDepth(const Token& name) {
  if (stream_.macroDepth() >= context_.options.limits.macroDepth)
    context_.reporter.stop(name.span, "macros call each other more than " +
                                          std::to_string(context_.options.limits.macroDepth) +
                                          " deep: does '" + *name.text +
                                          "' ever end? --max-macro-depth raises the limit");
}

}  // namespace vestige::lang
