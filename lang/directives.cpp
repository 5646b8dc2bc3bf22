// SPDX-License-Identifier: Apache-2.0
// Names and texts; macros are in macros.cpp, loops and choices in control.cpp.
#include "lang/directives.h"

#include <iostream>
#include <map>

#include "lang/dismantle.h"
#include "lang/predefined.h"
#include "lang/printable.h"

namespace vestige::lang {

Directives::Handler Directives::handlerOf(const std::string& word) {
  static const std::map<std::string, Handler> all = {
      {"declare", &Directives::declare}, {"local", &Directives::declare},
      {"undef", &Directives::undefine},  {"if", &Directives::ifBranch},
      {"ifdef", &Directives::ifBranch},  {"ifndef", &Directives::ifBranch},
      {"while", &Directives::whileLoop}, {"for", &Directives::forLoop},
      {"switch", &Directives::choice},   {"else", &Directives::nextPart},
      {"elseif", &Directives::nextPart}, {"case", &Directives::nextPart},
      {"range", &Directives::nextPart},  {"end", &Directives::end},
      {"break", &Directives::leave},     {"macro", &Directives::macro},
      {"include", &Directives::include}, {"debug", &Directives::message},
      {"render", &Directives::message},  {"statistics", &Directives::message},
      {"warning", &Directives::message}, {"error", &Directives::message},
      {"fopen", &Directives::openFile},  {"fclose", &Directives::closeFile},
      {"read", &Directives::readFile},   {"write", &Directives::writeFile},
      {"version", &Directives::version}};
  const auto found = all.find(word);
  return found == all.end() ? nullptr : found->second;
}

Directives::Handler Directives::handlerFor(const Name& word) {
  if (word.id >= handlers_.size()) handlers_.resize(std::size_t(word.id) + 1);
  Handler& known = handlers_[word.id];
  if (!known) known = handlerOf(word);
  return known;
}

void Directives::obey(const Token& directive) {
  const Nested nested(context_, directive.span);
  const int level = stream_.braces();
  const auto handler = handlerFor(*directive.text);
  try {
    if (handler) {
      (this->*handler)(directive);
      return;
    }
    static const std::vector<std::string> known = {
        "#declare", "#local",  "#undef",   "#if",     "#ifdef",   "#ifndef", "#while",
        "#for",     "#switch", "#else",    "#elseif", "#case",    "#range",  "#end",
        "#break",   "#macro",  "#include", "#debug",  "#warning", "#error",  "#version"};
    const char* instead = insteadOf("#" + *directive.text);
    context_.reporter.syntaxError(
        directive.span,
        "no directive is called '#" + *directive.text + "'" +
            (instead ? std::string(": ") + instead
                     : context_.suggest(directive.span, "#" + *directive.text, known)));
  } catch (const SyntaxError&) {
    skipStatement(directive, level);
  }
}

/// Recovers from an error: skips to the next ';', directive or line.
void Directives::skipStatement(const Token& directive, int level) {
  const Span& last = stream_.last();
  const bool hasTaken = last.file == directive.span.file && last.via == directive.span.via &&
                        last.begin > directive.span.begin;
  const Span from = hasTaken ? last : directive.span;
  for (;;) {
    const Token t = stream_.peekRaw();
    const bool isOutside = stream_.braces() <= level;
    if (t.kind == Token::Kind::end || t.kind == Token::Kind::directive) return;
    if (t.span.via != from.via || t.span.file != from.file) return;
    const bool isNewLine = context_.sources.lineOf(t.span.file, t.span.begin) >
                           context_.sources.lineOf(from.file, from.begin);
    if (isOutside && (isNewLine || t.is("}"))) return;
    stream_.nextRaw();
    if (isOutside && t.is(";")) return;
    if (t.is("}") && stream_.braces() <= level) return;
  }
}

// ---------------------------------------------------------------- names
Token Directives::plainName(const std::string& before) {
  const Token name = stream_.nextRaw();
  if (name.kind == Token::Kind::name) return name;
  context_.reporter.syntaxError(
      name.span, "expected a name after " + before + ", found " + describe(name, context_.sources));
}

/// Whether a directive is that of a -D.
bool Directives::isGiven(const Token& directive) const {
  const int file = directive.span.file;
  return file >= 0 && context_.sources.text(file).name.starts_with(kDefinition);
}

/// A name that may be declared. `scope`: the table if it is given; null: may not be given.
Token Directives::newName(const Token& directive, std::optional<std::size_t>* scope) {
  Token name = plainName("#" + *directive.text);
  if (scope) *scope = parser_.expressions().scope(name);
  const std::string& word = *name.text;
  if (isSetting(name.word()) && !isGiven(directive))
    context_.reporter.syntaxError(name.span, "'" + word +
                                                 "' has its value from the program: give it " +
                                                 "there, as in '-D " + word + "=0.5'");
  if (context_.symbols.find(name.text)) return name;
  if (const char* instead = insteadOf(word))
    context_.reporter.syntaxError(name.span, "'" + word + "' is a word of POV-Ray's: " + instead);
  const bool isTaken = isExpressionWord(*name.text) || isTransformWord(*name.text) ||
                       parser_.words().opensBlock(*name.text);
  // (Parameters of macros may be called like u and v, and then be assigned to: found above.)
  if (isTaken && !isSetting(name.word()))
    context_.reporter.syntaxError(name.span, "'" + word +
                                                 "' is a word of the language and cannot "
                                                 "be declared; a name with a capital "
                                                 "letter never is");
  return name;
}

// [ 'deprecated' [ 'once' ] [ string ] ]
std::optional<Deprecation> Directives::deprecated() {
  if (!stream_.peekRaw().isWord("deprecated")) return {};
  stream_.nextRaw();
  Deprecation found;
  found.isOnce = stream_.peekRaw().isWord("once");
  if (found.isOnce) stream_.nextRaw();
  const Token t = stream_.peekRaw();
  if (t.kind == Token::Kind::string)
    found.message = *stream_.nextRaw().text;
  else if (t.isName())
    found.message = "'" + *t.text + "' is deprecated";
  context_.budget.keep(std::int64_t(sizeof(found) + found.message.size()));
  return found;
}

// ('#declare' | '#local') [deprecated] name { '[' sum ']' } '=' value [';']
void Directives::declare(const Token& directive) {
  if (stream_.peekRaw().is("(")) return declareTuple(directive);
  std::optional<std::size_t> scope;
  std::optional<Deprecation> deprecation = deprecated();
  const Token name = newName(directive, &scope);
  if (isDictionary(name)) return assignEntry(directive, name);
  if (stream_.peekRaw().is("[")) return assignElement(directive, name);
  if (!stream_.acceptRaw("=")) {
    const Token found = stream_.peekRaw();
    context_.reporter.syntaxError(found.span, "expected '=' after '#" + *directive.text + " " +
                                                  *name.text + "', found " +
                                                  describe(found, context_.sources));
  }
  // Chosen before the value is read: a macro that the value ends with may have locals of this name.
  const std::size_t table = scope                        ? *scope
                            : *directive.text == "local" ? context_.symbols.innermost()
                                                         : context_.symbols.tableOf(name.text);
  const auto assign = [&](Datum value) {
    context_.events.declared(name, value);
    this->assign(*context_.symbols.in(table, name.text), std::move(value), name.span);
    if (deprecation) context_.deprecations[name.text] = *std::exchange(deprecation, {});
  };
  context_.warnOfDeprecation(name);
  try {
    Datum value = parser_.value(ExpressionParser::Place::declaration).value;
    const bool isNumbers = numbers(value) != nullptr;
    assign(std::move(value));
    needSemicolon(isNumbers, *name.text);
  } catch (const SyntaxError&) {
    assign({});  // declared with an error: no second report where it is used
    throw;
  }
}

/// POV-Ray requires ';' after numbers, vectors and colours only.
void Directives::needSemicolon(bool isNumbers, const std::string& name) {
  if (stream_.acceptRaw(";") || !isNumbers) return;
  context_.reporter.offer(stream_.behindLast(), ";");
  context_.reporter.error(stream_.behindLast(), "expected ';' after the value of '" + name + "'");
}

// { '[' sum ']' }
Directives::Indices Directives::indices() {
  Indices all;
  while (stream_.peekRaw().is("[")) {
    const Span open = stream_.nextRaw().span;
    const auto index = parser_.expressions().evaluate(ExpressionParser::Place::setting);
    const Numbers* n = numbers(index.value);
    if (!n || n->size != 1) {
      if (!isBroken(index.value))
        context_.reporter.error(index.span, "an index is a number, found " + describe(index.value));
      throw SyntaxError{};
    }
    context_.budget.need(open, double(all.values.size() * (sizeof(double) + sizeof(Span))));
    all.values.push_back(n->v[0]);
    all.spans.push_back(index.span);
    parser_.expressions().expect("]", open, "[");
  }
  return all;
}

/// The place in the data of an array that the next of its indices lead to; nothing if an error was
/// reported. `next`: moves behind them.
std::optional<std::size_t> Directives::placeIn(const Datum& whole, const Indices& indices,
                                               std::size_t& next) {
  const auto* array = std::get_if<ArrayPtr>(&whole);
  if (!array) {
    context_.reporter.error(indices.spans[next], "'[' follows an array, found " + describe(whole));
    return {};
  }
  const std::size_t count = std::min((*array)->sizes.size(), indices.values.size() - next);
  const auto some = [&](auto& all) {
    const auto from = all.begin() + std::ptrdiff_t(next);
    return std::decay_t<decltype(all)>(from, from + std::ptrdiff_t(count));
  };
  const auto at = elementAt(context_, **array, some(indices.values), some(indices.spans));
  next += count;
  return at;
}

/// The argument of a macro that is an element of an array: the parameter stands for it.
Cell Directives::elementArgument(const Token& name) {
  auto element = std::make_shared<ElementOf>();
  element->array = context_.symbols.find(name.text);
  context_.used(name);
  const Indices all = indices();
  const Span span = context_.sources.join(name.span, stream_.last());
  const Datum* place = &valueOf(*element->array);
  for (std::size_t next = 0; next < all.values.size();) {
    const auto at = placeIn(*place, all, next);
    if (!at) return std::make_shared<Symbol>(Symbol{{}, span});
    element->places.push_back(*at);
    place = &std::get<ArrayPtr>(*place)->data[*at];
  }
  if (isBroken(*place)) context_.reporter.error(span, "this element of the array has no value yet");
  return std::make_shared<Symbol>(Symbol{*place, span, std::move(element)});
}

void Directives::assignElement(const Token& directive, const Token& name) {
  context_.used(name);
  const Cell cell = context_.symbols.find(name.text);
  const Indices all = indices();
  if (!stream_.acceptRaw("=")) {
    const Token found = stream_.peekRaw();
    context_.reporter.syntaxError(found.span, "expected '=' in '#" + *directive.text + "', found " +
                                                  describe(found, context_.sources));
  }
  Datum value = parser_.value(ExpressionParser::Place::declaration).value;
  needSemicolon(numbers(value) != nullptr, *name.text);
  if (cell && isBroken(valueOf(*cell))) return;
  if (!cell || !std::holds_alternative<ArrayPtr>(valueOf(*cell))) {
    context_.reporter.error(name.span, "'" + *name.text + "' is not an array: write '#declare " +
                                           *name.text + " = array[10];' first");
    return;
  }
  if (*directive.text == "local" &&
      !context_.symbols.findIn(context_.symbols.innermost(), name.text)) {
    context_.reporter.warning(name.span, "'" + *name.text +
                                             "' is not local here, so this changes nothing, as in "
                                             "POV-Ray: write '#declare'");
    return;
  }
  // Arrays are values: other owners keep the old element. Without other owners no copy is made.
  Datum* place = &targetOf(*cell);
  for (std::size_t next = 0; next < all.values.size();) {
    const auto at = placeIn(*place, all, next);
    if (!at) return;
    auto& array = std::get<ArrayPtr>(*place);
    if (array.use_count() > 1) array = copied(name.span, *array);
    place = &const_cast<Array&>(*array).data[*at];
  }
  *place = std::move(value);
}

/// Where the value of a name is kept. Arrays with other owners are copied on the way to an element.
Datum& Directives::targetOf(Symbol& symbol) {
  if (!symbol.element) return symbol.value;
  Datum* place = &targetOf(*symbol.element->array);
  for (const std::size_t i : symbol.element->places) {
    auto* array = std::get_if<ArrayPtr>(place);
    if (!array || i >= (*array)->data.size()) {  // the array has got another value
      symbol.element = nullptr;
      return symbol.value;
    }
    if (array->use_count() > 1) *array = copied(symbol.declared, **array);
    place = &const_cast<Array&>(**array).data[i];
  }
  return *place;
}

void Directives::assign(Symbol& symbol, Datum value, const Span& declared) {
  targetOf(symbol) = std::move(value);
  symbol.declared = declared;
}

ArrayPtr Directives::copied(const Span& span, const Array& array) {
  const std::size_t bytes = array.data.size() * sizeof(Datum);
  context_.budget.need(span, double(bytes));
  context_.budget.copy(span, bytes);
  ArrayPtr copy = makeHolder<const Array>(array);
  context_.checkElements(span);
  return copy;
}

// '#undef' name
void Directives::undefine(const Token& directive) {
  Token name = plainName("#" + *directive.text);
  const auto scope = parser_.expressions().scope(name);
  const auto declaration = scope ? context_.symbols.declarationIn(*scope, name.text)
                                 : context_.symbols.declaration(name.text);
  if (declaration) context_.events.used(name, *declaration);
  if (!scope && (stream_.peekRaw().is("[") || stream_.peekRaw().is("."))) {
    forget(name);
  } else if (!(scope ? context_.symbols.undefineIn(*scope, name.text)
                     : context_.symbols.undefine(name.text))) {
    context_.reporter.warning(
        name.span, "'" + *name.text + "' has no value to forget" +
                       context_.suggest(name.span, *name.text, context_.symbols.names()));
  }
  stream_.acceptRaw(";");
}

// ---------------------------------------------------------------- texts
/// A string is copied, cleaned and written, which takes longer than one copy.
constexpr std::size_t kCopies = 8;

/// The string after a directive, read without lookahead.
std::optional<std::string> Directives::text(const Token& directive, Span& span) {
  const auto result = parser_.expressions().operand();
  span = result.span;
  if (const auto* s = std::get_if<TextPtr>(&result.value)) {
    context_.budget.copy(span, kCopies * (*s)->size());
    return **s;
  }
  if (!isBroken(result.value))
    context_.reporter.error(
        span, "#" + *directive.text + " takes a string, found " + describe(result.value));
  return {};
}

// '#include' string
void Directives::include(const Token& directive) {
  Span span;
  const auto name = text(directive, span);
  if (!name) return;
  context_.step(span, kFileSteps);
  std::vector<std::string> tried;
  const std::string path = includes_.find(*name, directive.span.file, tried);
  if (path.empty()) return includes_.missing("no file '" + *name + "' to include", span, tried);
  if (!includes_.isAllowed(path)) {
    context_.reporter.error(span, Includes::outside(path));
    return;
  }
  std::string why;
  const auto file = includes_.load(path, why);
  if (!file) {
    context_.reporter.error(span, "the include '" + path + "' " + why);
    return;
  }
  if (refuseInclude(path, file->file, span)) return;
  stream_.push(
      {Frame::Kind::file, file->tokens, 0, std::uint32_t(file->tokens->tokens.size() - 1),
       context_.sources.expand(Expansion::Kind::include, context_.names.intern(path), span),
       file->file});
}

bool Directives::refuseInclude(const std::string& path, int file, const Span& span) {
  int depth = 0;
  for (const Frame& f : stream_.frames()) {
    if (f.kind != Frame::Kind::file) continue;
    if (f.file == file) {
      context_.reporter.error(span,
                              "'" + path + "' includes itself, directly or through another file");
      return true;
    }
    ++depth;
  }
  if (depth > context_.options.limits.includeDepth)
    context_.reporter.stop(span, "includes are nested more than " +
                                     std::to_string(context_.options.limits.includeDepth) +
                                     " deep: --max-include-depth raises the limit");
  return false;
}

// ('#debug' | '#warning' | '#error') string      after an error #debug is silent: what it would
// write is made of values that went wrong.
void Directives::message(const Token& directive) {
  Span span;
  const auto shown = text(directive, span);
  if (!shown) return;
  std::string line = *shown;
  if (*directive.text == "error" || *directive.text == "warning")
    while (!line.empty() && line.back() == '\n') line.pop_back();
  if (*directive.text == "error") context_.reporter.stop(directive.span, line);
  if (*directive.text == "warning")
    context_.reporter.warning(directive.span, line);
  else if (context_.reporter.hasFailed())
    return;  // its values may be what an error has left
  else if (context_.options.debug)
    context_.options.debug(debugText(line));
  else
    std::cerr << debugText(line) << std::flush;
}

// '#version' number [';']
void Directives::version(const Token&) {
  const auto result = parser_.expressions().operand();
  if (const Numbers* n = numbers(result.value))
    context_.version = n->v[0];
  else if (!isBroken(result.value))
    context_.reporter.error(result.span,
                            "#version takes a number, found " + describe(result.value));
  stream_.acceptRaw(";");
}

}  // namespace vestige::lang
