// SPDX-License-Identifier: Apache-2.0
// The rest of the parser: values that are lists, maps and functions.
#include "lang/parser.h"

namespace vestige::lang {

// list := '[' { value [','] } ']' | '{' { value [','] } '}'
// map  := entry { entry } | '{' { entry [','] } '}'
// Anything else is an expression, which gives an array, or 'array' itself.
bool Parser::listSetting(BlockBuilder& b, const Parameter& row, const Span& nameSpan) {
  const Token t = stream_.peek();
  if (t.isWord("array")) {
    const Declared given = array();
    b.set(row, nameSpan, given.value, given.span);
    return true;
  }
  if (!t.is("[") && !t.is("{")) return false;
  const Nested nested(context_, t.span);
  List entries = row.type == ValueType::map ? map(row) : list(row);
  b.setList(row, nameSpan, std::move(entries), context_.sources.join(t.span, stream_.last()));
  return true;
}

List Parser::list(const Parameter& row) {
  const Token open = stream_.next();
  const char* close = open.is("[") ? "]" : "}";
  const Parameter entry = row.entry();
  List all;
  while (!stream_.peek().is(close)) {
    Value value = entryValue(entry, entryName(row, all.entries.size()));
    const Span span = value.span;
    addEntry(all, {0, std::move(value), span});
    stream_.accept(",");
  }
  stream_.next();
  return all;
}

List Parser::map(const Parameter& row) {
  const Token open = stream_.peek();
  const bool isBraced = stream_.accept("{");
  const Parameter entry = row.entry();
  List all;
  while (stream_.peek().is("[")) {
    addEntry(all, mapEntry(row, entry, all));
    if (isBraced) stream_.accept(",");
  }
  if (isBraced) expressions_.expect("}", open.span, "{");
  return all;
}

// entry := '[' key [','] value ']'
Entry Parser::mapEntry(const Parameter& row, const Parameter& entry, const List& before) {
  const Span open = stream_.next().span;
  Entry made;
  const std::vector<Entry>& all = before.entries;
  const double* last = all.empty() ? nullptr : &all.back().key;
  if (!expressions_.begins(stream_.peek()))
    expressions_.unexpected("the key of an entry of '" + row.name + "'");
  const auto key = expressions_.evaluate(ExpressionParser::Place::setting);
  made.key = keyOf(context_, row, key.value, key.span, last).value_or(last ? *last : row.lowKey);
  stream_.accept(",");
  made.value = entryValue(entry, entryName(row, all.size()));
  expressions_.expect("]", open, "[");
  made.span = context_.sources.join(open, stream_.last());
  return made;
}

/// One value of a list, with its span; of kind none if an error was reported.
Value Parser::entryValue(const Parameter& entry, const std::string& who) {
  const Token t = stream_.peek();
  const bool isBlock = t.kind == Token::Kind::name && words_.isKind(*t.text);
  const bool isOther = isBlock && *t.text != entry.blockKind;
  if (entry.type == ValueType::block && !isOther) return blockValue(blockOf(entry, t.span));
  if (entry.texturable)
    if (std::optional<Block> given = pigment()) {
      const Span span = context_.sources.join(t.span, given->span);
      Value value = blockValue(std::move(*given));
      value.span = span;
      return value;
    }
  const bool isChoice = entry.type == ValueType::choice && t.kind == Token::Kind::name &&
                        !context_.symbols.find(t.text);
  ExpressionParser::Result given;
  if (isChoice) {
    stream_.next();
    given = {textDatum(*t.text), t.span};
  } else if (isBlock) {
    const BlockPtr found = std::make_shared<const Block>(block());
    given = {found, found->span};
  } else {
    if (t.kind != Token::Kind::name && !expressions_.begins(t))
      expressions_.unexpected(expectation(entry) + " as " + who);
    given = expressions_.evaluate(ExpressionParser::Place::setting);
  }
  Value value = convert(context_, entry, given.value, given.span, who).value_or(Value{});
  value.span = given.span;
  return value;
}

void Parser::addEntry(List& list, Entry entry) {
  context_.budget.reserveOne(entry.span, list.entries);
  list.entries.push_back(std::move(entry));
  if (std::int64_t(list.entries.size()) + *context_.elements >
      std::int64_t(context_.options.limits.arrayElements))
    context_.stopAtElements(list.entries.back().span);
}

// function value := 'function' ... | ['(' parameters ')'] '{' expression '}' | name
bool Parser::functionSetting(BlockBuilder& b, const Parameter& row, const Span& nameSpan) {
  const Token t = stream_.peek();
  const bool isBare = t.is("(") || t.is("{");
  if (!isBare && !t.isWord("function")) return false;
  const Declared given = isBare ? functionBehind(t.span) : function();
  b.set(row, nameSpan, given.value, given.span);
  return true;
}

}  // namespace vestige::lang
