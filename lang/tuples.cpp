// SPDX-License-Identifier: Apache-2.0
// Several names declared at once, as in POV-Ray 3.8.
#include "lang/directives.h"

namespace vestige::lang {

// ('#declare' | '#local') '(' name { ',' name } ')' '=' '(' value { ',' value } ')' [';']
// All values are read before the first is assigned, so that names can be exchanged.
void Directives::declareTuple(const Token& directive) {
  const Span open = stream_.nextRaw().span;
  std::vector<Token> names;
  do {
    context_.budget.need(open, double(names.size() * sizeof(Token)));
    names.push_back(newName(directive));
  } while (stream_.acceptRaw(","));
  if (!stream_.acceptRaw(")")) parser_.expressions().expect(")", open, "(");
  if (!stream_.acceptRaw("="))
    parser_.expressions().unexpected("'=' and the values in parentheses");
  const Span values = stream_.peekRaw().span;
  if (!stream_.acceptRaw("(")) parser_.expressions().unexpected("'(' and a value for each name");
  std::vector<Datum> all;
  do {
    context_.budget.need(values, double(all.size() * sizeof(Datum)));
    all.push_back(parser_.value(ExpressionParser::Place::parentheses).value);
  } while (stream_.accept(","));
  if (!stream_.acceptRaw(")")) parser_.expressions().expect(")", values, "(");
  const Span whole = context_.sources.join(values, stream_.last());
  stream_.acceptRaw(";");
  if (all.size() != names.size())
    context_.reporter.error(whole, std::to_string(names.size()) +
                                       " names take as many values, found " +
                                       std::to_string(all.size()));
  all.resize(names.size());
  const bool isLocal = *directive.text == "local";
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Cell cell =
        isLocal ? context_.symbols.local(names[i].text) : context_.symbols.declare(names[i].text);
    context_.events.declared(names[i], all[i]);
    assign(*cell, std::move(all[i]), names[i].span);
  }
}

}  // namespace vestige::lang
