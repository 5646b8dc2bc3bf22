// SPDX-License-Identifier: Apache-2.0
// What stands around a '.' in names: `local.Name` and `global.Name`, as in POV-Ray 3.8, and keys.
#include "lang/expressions.h"

namespace vestige::lang {

/// If `name` is local or global in front of a '.': the table. `name` becomes the name behind it.
std::optional<std::size_t> ExpressionParser::scope(Token& name) {
  const bool isGlobal = name.word() == Word::global;
  if (!isGlobal && name.word() != Word::local) return {};
  if (declared(name) || stream_.rawSign() != signCode(".")) return {};
  stream_.nextRaw();
  name = stream_.nextRaw();
  if (!name.isName())
    context_.reporter.syntaxError(
        name.span, "expected a name after '.', found " + describe(name, context_.sources));
  return isGlobal ? 0 : context_.symbols.innermost();
}

Datum ExpressionParser::keyBehindDot() {
  const Token key = stream_.nextRaw();
  if (!key.isName())
    context_.reporter.syntaxError(
        key.span, "expected a key after '.', found " + describe(key, context_.sources));
  return textDatum(*key.text);
}

/// The value of a name in one table; nothing after an error.
Operand ExpressionParser::scoped(const Token& name, std::size_t table) {
  const Cell cell = context_.symbols.findIn(table, name.text);
  if (cell) {
    context_.events.used(name, *context_.symbols.declarationIn(table, name.text));
    const Datum& value = valueOf(*cell);
    const bool isFunction = std::holds_alternative<FunctionPtr>(value);
    return isFunction && stream_.peekRaw().is("(") ? call(name, value) : Operand{value, name.span};
  }
  context_.reporter.error(name.span, std::string(table == 0 ? "no global" : "no local") +
                                         " value is called '" + *name.text + "'");
  return {{}, name.span};
}

}  // namespace vestige::lang
