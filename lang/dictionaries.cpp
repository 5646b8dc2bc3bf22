// SPDX-License-Identifier: Apache-2.0
// Dictionaries: read, assigned to and forgotten by key.
#include "lang/dictionary.h"

#include "lang/directives.h"
#include "lang/dismantle.h"

namespace vestige::lang {
namespace {

/// Sets an entry and counts it.
void put(Context& context, Dictionary& d, const std::string& key, Datum value, const Span& span) {
  const auto [entry, isNew] = d.entries.try_emplace(key);
  entry->second = std::move(value);
  if (!isNew) return;
  d.share = Share(context.elements, std::int64_t(d.entries.size()));
  context.checkElements(span);
  if (d.bytes.isEmpty()) d.bytes = context.budget.take(span, sizeof d);
  context.budget.need(span, double(Dictionary::kEntry + key.size()));
  d.bytes.grow(std::int64_t(Dictionary::kEntry + key.size()));
}

}  // namespace

// dictionary := 'dictionary' [ '{' [ key ':' value { [','] key ':' value } ] '}' ]
// key := '[' string ']' | '.' name
Parser::Declared Parser::dictionary() {
  const Span word = stream_.next().span;
  const Nested nested(context_, word);
  auto d = makeHolder<Dictionary>();
  if (stream_.peekRaw().is("{")) {
    const Span open = stream_.next().span;
    while (!stream_.peek().is("}")) {
      const Selector key = selector();
      if (key.isKey && !stream_.accept(":"))
        expressions_.unexpected("':' and the value of '" + key.key + "'");
      if (!key.isKey)
        context_.reporter.syntaxError(
            key.span, "a key of a dictionary is a string, found " + shortest(key.index));
      Datum entry = value(ExpressionParser::Place::setting).value;
      put(context_, *d, key.key, std::move(entry), key.span);
      stream_.accept(",");
    }
    expressions_.expect("}", open, "{");
  }
  return {DictionaryPtr(std::move(d)), context_.sources.join(word, stream_.last())};
}

// selector := '.' name | '[' (string | number) ']'
Parser::Selector Parser::selector() {
  Selector s;
  const Span open = stream_.peekRaw().span;
  if (stream_.acceptRaw(".")) {
    const Token name = stream_.nextRaw();
    if (!name.isName())
      context_.reporter.syntaxError(
          name.span, "expected a key after '.', found " + describe(name, context_.sources));
    return {true, *name.text, 0, name.span};
  }
  if (!stream_.acceptRaw("[")) expressions_.unexpected("'[\"key\"]' or '.key'");
  const auto key = expressions_.evaluate(ExpressionParser::Place::setting);
  expressions_.expect("]", open, "[");
  const auto* text = std::get_if<TextPtr>(&key.value);
  const Numbers* n = numbers(key.value);
  if (text) return {true, **text, 0, key.span};
  if (n && n->size == 1) return {false, "", n->v[0], key.span};
  if (!isBroken(key.value))
    context_.reporter.error(key.span,
                            "a key is a string or a number, found " + describe(key.value));
  throw SyntaxError{};
}

std::vector<Parser::Selector> Parser::selectors() {
  std::vector<Selector> all;
  while (stream_.peekRaw().is("[") || stream_.peekRaw().is(".")) {
    context_.budget.need(stream_.last(), double(all.size() * sizeof(Selector)));
    all.push_back(selector());
  }
  return all;
}

// ---------------------------------------------------------------- assigning
/// The place that selectors lead to; a new entry where the last one is a key. Null if an error was
/// reported. Values with other owners are copied on the way.
Datum* Directives::placeOf(Datum& whole, const std::vector<Parser::Selector>& path, bool makes) {
  Datum* place = &whole;
  for (std::size_t next = 0; next < path.size();) {
    const Parser::Selector& s = path[next];
    if (auto* dictionary = std::get_if<DictionaryPtr>(place); dictionary && s.isKey) {
      if (dictionary->use_count() > 1) {
        context_.budget.copy(s.span, (*dictionary)->entries.size() * Dictionary::kEntry);
        context_.budget.need(s.span, double((*dictionary)->entries.size() * Dictionary::kEntry));
        *dictionary = makeHolder<const Dictionary>(**dictionary);
        context_.checkElements(s.span);
      }
      auto& own = const_cast<Dictionary&>(**dictionary);
      const bool isLast = next + 1 == path.size();
      if (makes && isLast && own.entries.count(s.key) == 0) put(context_, own, s.key, {}, s.span);
      const auto entry = own.entries.find(s.key);
      if (entry == own.entries.end()) {
        context_.reporter.error(s.span, "this dictionary has no entry '" + s.key + "'");
        return nullptr;
      }
      place = &entry->second;
      ++next;
    } else if (auto* array = std::get_if<ArrayPtr>(place); array && !s.isKey) {
      std::vector<double> indices;
      std::vector<Span> spans;
      for (; indices.size() < (*array)->sizes.size() && next < path.size(); ++next)
        indices.push_back(path[next].index), spans.push_back(path[next].span);
      const auto at = elementAt(context_, **array, indices, spans);
      if (!at) return nullptr;
      if (array->use_count() > 1) *array = copied(s.span, **array);
      place = &const_cast<Array&>(**array).data[*at];
    } else {
      if (!isBroken(*place))
        context_.reporter.error(s.span, std::string(s.isKey ? "a key follows a dictionary"
                                                            : "an index follows an array") +
                                            ", found " + describe(*place));
      return nullptr;
    }
  }
  return place;
}

/// Whether an entry of a dictionary follows '#declare', not a new value for its name. The
/// dictionary may be an element of an array: then a '.' is behind the indices.
bool Directives::isDictionary(const Token& name) {
  const Datum* value = context_.symbols.value(name.text);
  if (!value || isBroken(*value)) return false;
  constexpr int kUsual = 32;
  int ahead = 0;
  const auto next = [&] { return stream_.peekRaw(ahead); };
  if (std::holds_alternative<DictionaryPtr>(*value)) return next().is("[") || next().is(".");
  if (!std::holds_alternative<ArrayPtr>(*value)) return false;
  while (next().is("[")) {
    int depth = 0;
    do {
      depth += next().is("[") ? 1 : next().is("]") ? -1 : 0;
      if (next().kind == Token::Kind::end) return false;
      if (++ahead > kUsual) context_.step(name.span);  // the others are read next, and count then
    } while (depth > 0);
  }
  return ahead > 0 && next().is(".");
}

// ('#declare' | '#local') name selector { selector } '=' value [';']
void Directives::assignEntry(const Token& directive, const Token& name) {
  context_.used(name);
  const Cell cell = context_.symbols.find(name.text);
  const auto path = parser_.selectors();
  if (!stream_.acceptRaw("=")) {
    const Token found = stream_.peekRaw();
    context_.reporter.syntaxError(found.span, "expected '=' in '#" + *directive.text + "', found " +
                                                  describe(found, context_.sources));
  }
  Datum value = parser_.value(ExpressionParser::Place::declaration).value;
  needSemicolon(numbers(value) != nullptr, *name.text);
  if (Datum* place = placeOf(targetOf(*cell), path, true)) *place = std::move(value);
}

/// #undef of an element or an entry.
void Directives::forget(const Token& name) {
  const Cell cell = context_.symbols.find(name.text);
  auto path = parser_.selectors();
  if (!cell) {
    context_.reporter.warning(name.span, "'" + *name.text + "' has no value to forget");
    return;
  }
  const Parser::Selector last = path.back();
  if (!last.isKey) {
    if (Datum* place = placeOf(targetOf(*cell), path, false)) *place = {};
    return;
  }
  path.pop_back();
  Datum* place = placeOf(targetOf(*cell), path, false);
  auto* dictionary = place ? std::get_if<DictionaryPtr>(place) : nullptr;
  if (!dictionary) {
    if (place && !isBroken(*place))
      context_.reporter.error(last.span, "a key follows a dictionary, found " + describe(*place));
    return;
  }
  if ((*dictionary)->entries.count(last.key) == 0) {
    context_.reporter.warning(last.span, "there is no entry '" + last.key + "' to forget");
    return;
  }
  auto copy = makeHolder<Dictionary>(**dictionary);
  context_.budget.copy(last.span, copy->entries.size() * Dictionary::kEntry);
  copy->entries.erase(last.key);
  copy->share = Share(context_.elements, std::int64_t(copy->entries.size()));
  *place = DictionaryPtr(std::move(copy));
}

}  // namespace vestige::lang
