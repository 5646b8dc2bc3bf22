// SPDX-License-Identifier: Apache-2.0
// The part of the expression parser for functions of objects.
#include "lang/builtins.h"
#include "lang/expressions.h"

namespace vestige::lang {

/// Whether the program can answer what this function asks; all but those of objects need no answer.
bool ExpressionParser::isAnswered(const Builtin& builtin) const {
  return builtin.letter(0) != 'o' || context_.options.measure;
}

// target := name { '[' sum ']' | '.' key }
/// The fourth argument of trace(), which is assigned to.
Operand ExpressionParser::target(Target& target) {
  const Token name = stream_.nextRaw();
  if (!name.isName())
    context_.reporter.syntaxError(name.span, "expected the name of a declared vector, found " +
                                                 describe(name, context_.sources));
  target.cell = context_.symbols.find(name.text);
  if (!target.cell) {
    undeclared(name, "vector");
    throw SyntaxError{};
  }
  context_.used(name);
  target.place = context_.placeBehind(*target.cell);
  return {target.place ? *target.place : Datum(), context_.sources.join(name.span, stream_.last())};
}

}  // namespace vestige::lang
