// SPDX-License-Identifier: Apache-2.0
// Scenes and blocks, by recursive descent. Read from top to bottom, the comments above the
// functions are the grammar; expressions.cpp and declarations.cpp go on where this file ends.
// Tokens arrive with macros expanded and directives obeyed (stream.h), so neither appears here.
#include "lang/parser.h"

#include "lang/predefined.h"

namespace vestige::lang {

// scene := { block }
void Parser::scene(SceneDesc& scene) {
  for (;;) {
    const auto before = stream_.taken();
    const int level = stream_.braces();
    try {
      if (stream_.peek().kind == Token::Kind::end) return;
      statement(scene);
    } catch (const SyntaxError&) {
      if (stream_.taken() == before) stream_.nextRaw();
      skipToStatement(level);
    }
  }
}

void Parser::statement(SceneDesc& scene) {
  const Token t = stream_.peek();
  if (t.kind == Token::Kind::name && words_.opensBlock(*t.text)) {
    addToScene(scene, block());
  } else if (stream_.accept(";")) {
    return;  // harmless after a block
  } else if (t.is("}") && assumedBraces_ > 0) {
    stream_.next();
    --assumedBraces_;
  } else if (t.kind != Token::Kind::name) {
    expressions_.unexpected("a camera, a light, a shape or a directive");
  } else if (const BlockPtr declared = declaredBlock(t)) {
    context_.reporter.syntaxError(
        t.span, "expected a block, found the name of one: write 'object { " + *t.text + " }'");
  } else if (const char* instead = insteadOf(*t.text)) {
    context_.reporter.syntaxError(t.span, "'" + *t.text + "' is a word of POV-Ray's: " + instead);
  } else {
    std::vector<std::string> known = context_.symbols.names();
    for (const std::string& w : words_.blockWords()) known.push_back(w);
    context_.reporter.syntaxError(
        t.span, "expected a camera, a light, a shape or a directive, found '" + *t.text + "'" +
                    context_.suggest(t.span, *t.text, known));
  }
}

void Parser::addToScene(SceneDesc& scene, Block block) {
  const Schema& schema = *words_.find(block.kind, block.plugin);
  if (!schema.standsAlone) {
    const std::vector<std::string> holders = words_.holders(block.kind);
    context_.reporter.error(block.span,
                            "a " + block.kind + " cannot stand alone: write it inside a " +
                                (holders.empty() ? "block that uses it" : orList(holders)) +
                                ", or '#declare Name = " + block.kind + " ...'");
    return;
  }
  if (schema.isSingle) {
    context_.step(block.span, std::int64_t(scene.blocks.size()));
    const auto before = std::find_if(scene.blocks.begin(), scene.blocks.end(),
                                     [&](const Block& b) { return b.kind == block.kind; });
    if (before != scene.blocks.end()) {
      context_.reporter.warning(block.span, "a second " + block.kind + ": this one counts")
          .notes.push_back({before->span, "the first one"});
      scene.blocks.erase(before);
    }
  }
  if (block.kind == "film") noteFilm(context_, block);
  context_.budget.reserveOne(block.span, scene.blocks);
  scene.blocks.push_back(std::move(block));
}

// ---------------------------------------------------------------- blocks
// block := kind [plugin] '{' [plugin | name] item* '}'
//        | shape '{' item* '}'                          a shape's plugin is a keyword of its own
//        | 'object' '{' (name | block) item* '}'
Block Parser::block() {
  const Token word = stream_.next();
  const Nested nested(context_, word.span);
  countBlocks(context_, Block{}, word.span);
  if (word.isWord("object")) return objectBlock();
  const bool isShape = words_.isShape(*word.text) && !words_.isKind(*word.text);
  Head start{isShape ? words_.find("shape", *word.text) : nullptr, word.span};
  if (isShape && !start.schema) unknownPlugin("shape", word);
  return finishBlock(head(isShape ? std::string("shape") : std::string(*word.text), start),
                     Braces::needed);
}

Block Parser::objectBlock() {
  Head start{nullptr, stream_.last()};
  if (!stream_.accept("{")) expressions_.unexpected("'{' after 'object'");
  start.isOpen = true, start.brace = stream_.last();
  const Token t = stream_.peek();
  if (t.kind == Token::Kind::name && words_.opensBlock(*t.text)) {
    start.base = std::make_shared<const Block>(block());
  } else if ((start.base = declaredBlock(t))) {
    context_.used(t);
    stream_.next();
    start.span = context_.sources.join(start.span, t.span);
  } else if (t.kind == Token::Kind::name && !context_.symbols.find(t.text)) {
    expressions_.undeclared(t, "object");
    throw SyntaxError{};
  } else {
    expressions_.unexpected("the name of a declared shape or union");
  }
  start.schema = words_.find(start.base->kind, start.base->plugin);
  if (!start.schema->standsAlone)
    context_.reporter.syntaxError(t.span, "'object' takes a shape or a union, found " +
                                              describe(Datum(start.base)) + ": write '" +
                                              start.base->kind + " { " + *t.text + " }'");
  return finishBlock(std::move(start), Braces::needed);
}

Block Parser::finishBlock(Head head, Braces braces) {
  BlockBuilder b(context_, *head.schema, head.span);
  context_.events.block(*head.schema, head.span);
  if (head.base) b.inherit(*head.base);
  if (!head.isOpen && stream_.peek().is("{")) {
    head.isOpen = true;
    head.brace = stream_.next().span;
  }
  if (head.isOpen)
    items(b, head.brace);
  else if (braces == Braces::needed && !head.base)
    expressions_.unexpected("'{' after '" + b.title() + "'");
  return b.finish();
}

// [plugin] before '{', or as the first word behind it; a declared name stands for its plugin.
Parser::Head Parser::head(const std::string& kind, Head head) {
  if (!head.schema) head.schema = words_.find(kind, "");
  if (!head.schema && !headName(kind, head) && !stream_.peek().is("{"))
    unknownPlugin(kind, stream_.peek(), head.after);
  if (head.base || !stream_.accept("{")) return head;
  head.isOpen = true, head.brace = stream_.last();
  headName(kind, head);
  if (!head.schema) unknownPlugin(kind, stream_.peek(), head.after);
  return head;
}

/// Reads the plugin's word, or the name of a declared block of that kind.
bool Parser::headName(const std::string& kind, Head& head) {
  const Token t = stream_.peek();
  if (t.kind != Token::Kind::name) return false;
  const Schema* named = words_.find(kind, *t.text);
  const BlockPtr declared = named ? nullptr : declaredBlock(t);
  if (!named && !(declared && declared->kind == kind)) return false;
  if (head.schema && (named || head.schema->name != declared->plugin)) {
    const auto& rows = head.schema->params;
    const bool isPart = std::any_of(rows.begin(), rows.end(),
                                    [&](const Parameter& p) { return p.blockKind == kind; });
    if (named || isPart || head.schema->children.size() > 0) return false;  // an item: see there
    context_.reporter.syntaxError(t.span, "'" + *t.text + "' is a " + declared->kind + " " +
                                              declared->plugin + ", not a " + head.schema->kind +
                                              " " + head.schema->name);
  }
  // `brdf mix { Gloss ... }`: a part of it, though it may be a mixture itself.
  const auto& parts = head.schema ? head.schema->children : std::vector<std::string>();
  if (std::find(parts.begin(), parts.end(), kind) != parts.end()) return false;
  stream_.next();
  if (declared) context_.used(t);
  head.base = declared;
  head.schema = named ? named : words_.find(kind, declared->plugin);
  head.span = context_.sources.join(head.span, t.span);
  return true;
}

void Parser::unknownPlugin(const std::string& kind, const Token& found, const std::string& after) {
  std::vector<std::string> known = words_.plugins(kind);
  std::sort(known.begin(), known.end());
  const std::string list = orList(known);
  if (found.kind != Token::Kind::name && !after.empty())
    expressions_.unexpected("a " + kind + " (" + list + ", or a declared one) after '" + after +
                            "'");
  if (found.kind != Token::Kind::name) expressions_.unexpected(list + " after '" + kind + "'");
  const std::vector<std::string> plugins = known;
  for (const std::string& name : context_.symbols.names()) known.push_back(name);
  if (const Cell cell = context_.symbols.find(found.text)) {
    if (isBroken(valueOf(*cell))) throw SyntaxError{};  // already reported where it was declared
    context_.reporter.syntaxError(found.span, "expected a " + kind + ", found " +
                                                  describe(valueOf(*cell)) + ", which '" +
                                                  *found.text + "' stands for");
  }
  const std::string near = context_.suggest(found.span, *found.text, known);
  Diagnostic& d = context_.reporter.error(
      found.span, "no " + kind + " is called '" + *found.text + "'" +
                      (near.empty() ? ": expected " + list + ", or a declared one" : near));
  words_.explain(d, kind, *found.text);
  throw SyntaxError{};
}

// ---------------------------------------------------------------- items
// items := { item [','] } '}'
void Parser::items(BlockBuilder& b, const Span& brace) {
  const int level = stream_.braces();
  for (;;) {
    const auto before = stream_.taken();
    try {
      if (stream_.accept("}")) return;
      if (stream_.peek().kind == Token::Kind::end) return neverClosed(b, brace);
      const bool afterComma = stream_.accept(",");
      if (item(b, afterComma) == Next::closed) return;
    } catch (const SyntaxError&) {
      b.forgiveMissing();
      if (stream_.taken() == before && !stream_.peekRaw().is("}")) stream_.nextRaw();
      skipToItem(b, level);
    }
  }
}

void Parser::neverClosed(BlockBuilder& b, const Span& brace) {
  b.forgiveMissing();
  ++assumedBraces_;
  try {
    expressions_.expect("}", brace, "{");
  } catch (const SyntaxError&) {  // nothing is left to skip
  }
}

// item := value | parameter value | transform | block | name
Parser::Next Parser::item(BlockBuilder& b, bool afterComma) {
  const Token t = stream_.peek();
  if (t.is("}") || t.is(",")) {  // POV-Ray is lax about commas
    return Next::more;
  } else if (isValue(b, t, afterComma)) {
    positional(b);
  } else if (t.kind != Token::Kind::name) {
    expressions_.unexpected("'}' or a parameter of '" + b.title() + "'");
  } else if (const Parameter* row = b.row(*t.text)) {
    setting(b, *row);
  } else if (isTransformWord(*t.text)) {
    if (!b.schema().isMovable)
      context_.reporter.syntaxError(t.span, "'" + b.title() + "' has no place in space, so '" +
                                                *t.text + "' cannot stand in it");
    b.move(transform());
  } else if (words_.opensBlock(*t.text)) {
    return nested(b, t);
  } else if (const BlockPtr declared = declaredBlock(t)) {
    declaredItem(b, t, *declared);
  } else {
    unknownItem(b, t);
  }
  return Next::more;
}

/// Whether a positional value begins here. A parameter's name has precedence over a declared name
/// of the same spelling, unless a comma precedes it.
bool Parser::isValue(const BlockBuilder& b, const Token& t, bool afterComma) const {
  const Parameter* next = b.nextPositional();
  if (next && next->isList() && t.is("[")) return true;
  if (t.kind != Token::Kind::name) return expressions_.begins(t);
  if (next && next->type == ValueType::choice)
    for (const std::string& word : next->choices)
      if (word == *t.text) return true;
  if (b.row(*t.text) && !(afterComma && next)) return false;
  if (isTransformWord(*t.text) || words_.opensBlock(*t.text)) return false;
  const Cell cell = context_.symbols.find(t.text);
  if (cell && std::holds_alternative<AffinePtr>(valueOf(*cell))) return false;
  const bool isMeant = afterComma && next && !cell && !insteadOf(*t.text);  // misspelt, perhaps
  return (expressions_.begins(t) && !declaredBlock(t)) || isMeant;
}

// value := expression                              in the order of the schema's positional rows
void Parser::positional(BlockBuilder& b) {
  const Parameter* row = b.nextPositional();
  const Token t = stream_.peek();
  if (row) context_.events.setting(b.schema(), *row, t.span);
  if (row && row->type == ValueType::choice && choiceSetting(b, *row, t.span)) return;
  if (row && row->isList() && listSetting(b, *row, t.span)) return;
  const auto result = expressions_.evaluate(ExpressionParser::Place::setting);
  if (row) {
    b.set(*row, result.span, result.value, result.span);
    return;
  }
  std::vector<std::string> names;
  for (const auto* rows : {&b.schema().params, &b.schema().inputs})
    for (const Parameter& p : *rows)
      if (p.positional) names.push_back(p.name);
  context_.reporter.error(
      result.span,
      names.empty() ? "'" + b.title() + "' takes no value without the name of a parameter"
                    : "one value too many: '" + b.title() + "' takes " +
                          std::to_string(names.size()) + " without names (" + orList(names) + ")");
}

// parameter value := name (expression | word | pigment | block | list | function)
void Parser::setting(BlockBuilder& b, const Parameter& row) {
  const Token name = stream_.next();
  context_.events.setting(b.schema(), row, name.span);
  if (row.type == ValueType::block) return blockSetting(b, row, name.span);
  if (row.texturable && pigmentSetting(b, row, name.span)) return;
  if (row.type == ValueType::choice && choiceSetting(b, row, name.span)) return;
  if (row.isList() && listSetting(b, row, name.span)) return;
  if (row.type == ValueType::function && functionSetting(b, row, name.span)) return;
  const Token ahead = stream_.peek();
  const bool isName = ahead.kind == Token::Kind::name;
  if (isName && row.type != ValueType::boolean && words_.isKind(*ahead.text) &&
      !b.mayContain(*ahead.text) && !words_.standsAlone(*ahead.text)) {  // meant as the value
    const BlockPtr given = std::make_shared<const Block>(block());
    b.set(row, name.span, given, given->span);
    return;
  }
  const bool isItem = isName && !context_.symbols.find(ahead.text) &&
                      (b.row(*ahead.text) || isTransformWord(*ahead.text));
  const bool isMissing = isItem || (isName && words_.opensBlock(*ahead.text)) ||
                         (!isName && !expressions_.begins(ahead));
  if (isMissing && row.type == ValueType::boolean) {  // `two_sided` alone
    b.set(row, name.span, Numbers(1), name.span);
    return;
  }
  if (isMissing) expressions_.unexpected(expectation(row) + " after '" + row.name + "'");
  const auto result = expressions_.evaluate(ExpressionParser::Place::setting);
  b.set(row, name.span, result.value, result.span);
}

// word := one of the row's choices, bare
bool Parser::choiceSetting(BlockBuilder& b, const Parameter& row, const Span& nameSpan) {
  const Token t = stream_.peek();
  const auto& all = row.choices;
  const bool isChoice =
      t.kind == Token::Kind::name && std::find(all.begin(), all.end(), *t.text) != all.end();
  if (!isChoice && (t.kind != Token::Kind::name || expressions_.begins(t))) return false;
  stream_.next();
  b.setWord(row, nameSpan, *t.text, t.span);
  return true;
}

// pigment := 'pigment' ... | name of a declared pigment
bool Parser::pigmentSetting(BlockBuilder& b, const Parameter& row, const Span& nameSpan) {
  std::optional<Block> given = pigment();
  if (given) b.setBlock(row, nameSpan, std::move(*given));
  return given.has_value();
}

std::optional<Block> Parser::pigment() {
  const Token t = stream_.peek();
  if (t.isWord("pigment")) {
    stream_.next();
    const Nested nested(context_, t.span);
    countBlocks(context_, Block{}, t.span);
    return finishBlock(head("pigment", {nullptr, t.span}), Braces::optional);
  }
  const BlockPtr declared = declaredBlock(t);
  if (!declared || declared->kind != "pigment") return {};
  context_.used(t);
  stream_.next();
  countBlocks(context_, *declared, t.span);
  return *declared;
}

// block := [kind] plugin ['{' item* '}'] | '{' plugin item* '}' | name
// A parameter named like a plugin creates that plugin: `image { "sky.exr" }`.
void Parser::blockSetting(BlockBuilder& b, const Parameter& row, const Span& nameSpan) {
  b.setBlock(row, nameSpan, blockOf(row, nameSpan));
}

Block Parser::blockOf(const Parameter& row, const Span& nameSpan) {
  const std::string& kind = row.blockKind;
  const Nested nested(context_, nameSpan);
  countBlocks(context_, Block{}, nameSpan);
  Head start{nullptr, nameSpan};
  if (row.name != kind) start.after = row.name;
  const bool hasName = stream_.peek().kind == Token::Kind::name;
  if (row.name != kind && hasName) start.span = stream_.peek().span;  // the block's own head
  if (row.name != kind && isAhead(kind.c_str())) {
    stream_.next();
    start.after.clear();
  }
  const Token inside = stream_.peek().is("{") ? stream_.peekRaw(1) : Token{};
  const bool isPlugin = inside.kind == Token::Kind::name && words_.find(kind, *inside.text);
  if (stream_.peek().is("{") && !isPlugin) start.schema = words_.find(kind, row.name);
  if (!words_.isKind(kind))
    context_.reporter.syntaxError(nameSpan, "no plugin of kind '" + kind + "' is installed");
  return finishBlock(head(kind, start), Braces::optional);
}

// A block inside a block. If it may not stand here but may stand outside, a '}' is missing.
Parser::Next Parser::nested(BlockBuilder& b, const Token& t) {
  const bool isShape = words_.isShape(*t.text) && !words_.isKind(*t.text);
  const std::string kind = isShape ? std::string("shape") : std::string(*t.text);
  const bool isObject = t.isWord("object");
  if (b.mayContain(kind) || (isObject && (b.mayContain("shape") || b.mayContain("union")))) {
    b.add(block());
    return Next::more;
  }
  const Parameter* next = b.nextPositional();
  if (next && next->texturable && kind == "pigment") {
    context_.events.setting(b.schema(), *next, t.span);
    pigmentSetting(b, *next, t.span);
    return Next::more;
  }
  if (!isObject && !words_.standsAlone(kind)) misplaced(b, t, "a " + kind, kind);
  b.forgiveMissing();
  ++assumedBraces_;
  context_.reporter.error(
      t.span, "expected '}' (to close '{' of '" + b.title() + "' at line " +
                  std::to_string(context_.sources.lineOf(b.head().file, b.head().begin) + 1) +
                  "), found '" + *t.text + "'");
  return Next::closed;
}

void Parser::declaredItem(BlockBuilder& b, const Token& t, const Block& declared) {
  if (!b.mayContain(declared.kind)) {
    const Datum found = std::make_shared<const Block>(declared);
    misplaced(b, t, "'" + *t.text + "' is " + describe(found) + ", which", declared.kind);
  }
  context_.used(t);
  stream_.next();
  countBlocks(context_, declared, t.span);
  b.add(declared);
}

/// Adds a note with the parameter that accepts such a block, if there is one.
void Parser::misplaced(const BlockBuilder& b, const Token& found, const std::string& what,
                       const std::string& kind) {
  std::string advice;
  const bool isPigment = kind == "pigment";
  for (const auto* rows : {&b.schema().inputs, &b.schema().params})
    for (const Parameter& p : *rows)
      if (advice.empty() && !p.isList() &&
          (isPigment ? p.texturable : p.type == ValueType::block && p.blockKind == kind))
        advice = " by itself: write the parameter that it is for, as in '" + p.name + " " + kind +
                 " ...'";
  if (isPigment && b.mayContain("brdf"))
    advice = " by itself: write it in a brdf, as in 'brdf lambert { diffuse pigment ... }'";
  else if (isPigment && advice.empty())
    advice = ": none of its parameters takes a pigment";
  context_.reporter.syntaxError(found.span, what + " cannot stand in '" + b.title() + "'" + advice);
}

void Parser::unknownItem(BlockBuilder& b, const Token& t) {
  if (const char* instead = insteadOf(*t.text))
    context_.reporter.syntaxError(t.span, "'" + *t.text + "' is a word of POV-Ray's: " + instead);
  std::vector<std::string> rows;
  for (const auto* part : {&b.schema().params, &b.schema().inputs})
    for (const Parameter& p : *part) rows.push_back(p.name);
  std::vector<std::string> known = rows;
  for (const std::string& kind : b.schema().children) known.push_back(kind);
  for (const std::string& name : context_.symbols.names()) known.push_back(name);
  const std::string near = context_.suggest(t.span, *t.text, known);
  Diagnostic& d = context_.reporter.error(
      t.span, "'" + b.title() + "' has no parameter '" + *t.text + "'" + near);
  if (near.empty() && !rows.empty()) d.notes.push_back({{}, "it has " + orList(rows)});
  throw SyntaxError{};
}

// ---------------------------------------------------------------- going on after an error
/// Takes tokens up to one that satisfies `stopsAt` outside all braces beyond `level`; directives
/// are obeyed, so that an #end finds its #if.
template <class StopsAt>
void Parser::skip(int level, StopsAt stopsAt, bool stopsAfterBraces) {
  for (;;) {
    const Token t = stream_.peekRaw();
    const bool isOutside = stream_.braces() <= level;
    if (t.kind == Token::Kind::end) return;
    if (t.kind == Token::Kind::directive) {
      if (isOutside) return;
      stream_.onDirective(stream_.nextRaw());
      continue;
    }
    if (isOutside && stopsAt(t)) return;
    stream_.nextRaw();
    if (t.is("}") && stream_.braces() <= level && stopsAfterBraces) return;
  }
}

void Parser::skipToStatement(int level) {
  skip(
      level,
      [&](const Token& t) { return t.kind == Token::Kind::name && words_.opensBlock(*t.text); },
      true);
}

void Parser::skipToItem(const BlockBuilder& b, int level) {
  skip(
      level,
      [&](const Token& t) {
        if (t.is("}")) return true;
        return t.kind == Token::Kind::name &&
               (b.row(*t.text) || isTransformWord(*t.text) || words_.opensBlock(*t.text));
      },
      false);
}

BlockPtr Parser::declaredBlock(const Token& name) const {
  if (name.kind != Token::Kind::name) return nullptr;
  const Cell cell = context_.symbols.find(name.text);
  const auto* block = cell ? std::get_if<BlockPtr>(&valueOf(*cell)) : nullptr;
  return block ? *block : nullptr;
}

}  // namespace vestige::lang
