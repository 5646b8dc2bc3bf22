// SPDX-License-Identifier: Apache-2.0
// Values against the rows of a schema: types, promotion, ranges.
#include <cmath>

#include "lang/builder.h"
#include "lang/function.h"
#include "lang/vocabulary.h"

namespace vestige::lang {
namespace {

std::string withUnit(const Parameter& row) { return row.unit.empty() ? "" : " " + row.unit; }

/// "between 0 and 180 degrees", "greater than 0", "0 or more".
std::string rangeText(const Parameter& row) {
  const std::string low = shortest(row.low), high = shortest(row.high);
  if (std::isinf(row.low)) return high + withUnit(row) + " or less";
  if (std::isinf(row.high))
    return row.openLow ? "greater than " + low + withUnit(row) : low + withUnit(row) + " or more";
  return std::string(row.openLow ? "greater than " : "between ") + low +
         (row.openLow ? " and at most " : " and ") + high + withUnit(row);
}

class Converter {
 public:
  Converter(Context& context, const Parameter& row, const Datum& datum, const Span& span,
            std::string who)
      : context_(context), row_(row), datum_(datum), span_(span), who_(std::move(who)) {
    if (who_.empty()) who_ = "'" + row.name + "'";
  }

  std::optional<Value> run() {
    if (isBroken(datum_)) return {};
    if (const auto* b = std::get_if<BlockPtr>(&datum_); b && takes(**b)) return block(*b);
    switch (row_.type) {
      case ValueType::real:
      case ValueType::integer:
      case ValueType::boolean:
        return number();
      case ValueType::rgb:
        return colour();
      case ValueType::vec2:
        return vector(2);
      case ValueType::vec3:
        return vector(3);
      case ValueType::vec4:
        return vector(4);
      case ValueType::text:
      case ValueType::file:
        return text();
      case ValueType::choice:
        return choice();
      case ValueType::block:
        return mismatch();
      case ValueType::list:
      case ValueType::map:
        return list();
      case ValueType::function:
        return function();
    }
    return {};
  }

 private:
  std::optional<Value> fail(const std::string& message) {
    context_.reporter.error(span_, message);
    return {};
  }
  std::optional<Value> mismatch() {
    return fail(who_ + " takes " + expectation(row_) + ", found " + describe(datum_));
  }

  bool takes(const Block& b) const {
    if (row_.type == ValueType::block) return b.kind == row_.blockKind;
    return row_.texturable && !row_.isList() && b.kind == "pigment";
  }
  std::optional<Value> block(const BlockPtr& given) {
    countBlocks(context_, *given, span_);
    Value value;
    value.kind = Value::Kind::block;
    value.block = given;
    return value;
  }

  /// A list from an array of entries, or a map from an array of rows {key, value}.
  std::optional<Value> list() {
    const bool isMap = row_.type == ValueType::map;
    const auto* found = std::get_if<ArrayPtr>(&datum_);
    const std::vector<int> sizes = found ? (*found)->sizes : std::vector<int>();
    if (sizes.size() != (isMap ? 2 : 1) || (isMap && sizes[1] != 2)) return mismatch();
    const std::vector<Datum>& data = (*found)->data;
    const Parameter row = row_.entry();
    List list;
    for (std::size_t i = 0; i < std::size_t(sizes[0]); ++i) {
      context_.step(span_);
      const std::string who = entryName(row_, i);
      const Datum& datum = data[isMap ? 2 * i + 1 : i];
      if (isBroken(datum) || (isMap && isBroken(data[2 * i]))) return unset(who);
      const double* before = i > 0 ? &list.entries.back().key : nullptr;
      const auto key = isMap ? keyOf(context_, row_, data[2 * i], span_, before) : 0;
      auto value = convert(context_, row, datum, span_, who);
      if (!key || !value) return {};
      value->span = span_;
      context_.budget.reserveOne(span_, list.entries);
      list.entries.push_back({*key, std::move(*value), span_});
    }
    return listOf(context_, row_, std::move(list), span_);
  }
  std::optional<Value> unset(const std::string& who) {
    return fail(who + " has no value yet in this array");
  }

  std::optional<Value> function() {
    const auto* f = std::get_if<FunctionPtr>(&datum_);
    if (!f) return mismatch();
    const std::size_t count = (*f)->parameters.size();
    if ((*f)->body && count != std::size_t(row_.arity))
      return fail(who_ + " takes " + expectation(row_) + ", found one of " + std::to_string(count));
    Value value;
    value.kind = Value::Kind::function;
    value.function = programOf(context_, **f, span_);
    return value.function ? std::optional(value) : std::nullopt;
  }

  std::optional<Value> number() {
    const Numbers* n = numbers(datum_);
    if (!n || n->size != 1) return mismatch();
    Value value = numberValue(n->v[0]);
    if (row_.type == ValueType::boolean) value.v[0] = isTrue(n->v[0]) ? 1 : 0;
    if (!isInRange(value, 1)) return {};
    if (row_.type == ValueType::integer && value.v[0] != std::floor(value.v[0])) {
      // Forgives rounding: 3*(1/3) counts as the whole number 1.
      const double whole = std::round(value.v[0]);
      if (std::abs(value.v[0] - whole) > 1e-9 * std::max(1.0, std::abs(whole))) return mismatch();
      value.v[0] = whole;
    }
    return value;
  }

  std::optional<Value> vector(int size) {
    const Numbers* n = numbers(datum_);
    if (!n || n->isColour || n->size > size) return mismatch();
    Value value;
    value.kind = Value::Kind::vector;
    value.size = size;
    for (int i = 0; i < size; ++i) value.v[i] = n->at(i);
    return isInRange(value, size) ? std::optional(value) : std::nullopt;
  }

  std::optional<Value> colour() {
    const Numbers* n = numbers(datum_);
    if (!n || n->size == 2) return mismatch();
    Value value = colourValue(n->at(0), n->at(1), n->at(2));
    if (n->size > 1)
      for (int i = 3; i < 5; ++i) value.v[i] = n->at(i);
    return isInRange(value, 3) ? std::optional(value) : std::nullopt;
  }

  std::optional<Value> text() {
    const auto* s = std::get_if<TextPtr>(&datum_);
    return s ? std::optional(textOf(*s)) : mismatch();
  }

  /// Shares the text among all blocks.
  static Value textOf(const TextPtr& text) {
    Value value;
    value.kind = Value::Kind::text;
    value.text = text;
    return value;
  }

  std::optional<Value> choice() {
    const auto* s = std::get_if<TextPtr>(&datum_);
    if (!s) return mismatch();
    const auto& all = row_.choices;
    if (std::find(all.begin(), all.end(), **s) != all.end()) return textOf(*s);
    const std::string near = nearestWord(**s, all);
    return fail(who_ + " takes " + expectation(row_) + ", found '" + **s + "'" +
                (near.empty() ? near : "; did you mean '" + near + "'?"));
  }

  bool isInRange(const Value& value, int size) {
    for (int i = 0; i < size; ++i) {
      const double x = value.v[i];
      if (!std::isfinite(x)) {
        fail(who_ + " must be finite, found " +
             (std::isnan(x) ? "a number that is none (such as a root of a negative number)"
                            : "an infinite number (such as 1/0)"));
        return false;
      }
      if (x < row_.low || x > row_.high || (row_.openLow && x == row_.low)) {
        fail(who_ + " must be " + rangeText(row_) + ", found " + shortest(x));
        return false;
      }
    }
    return true;
  }

  Context& context_;
  const Parameter& row_;
  const Datum& datum_;
  Span span_;
  std::string who_;  ///< the value's name in messages
};

/// The entries of a list in the plural, for messages.
std::string entriesText(const Parameter& row) {
  const Parameter entry = row.entry();
  switch (entry.type) {
    case ValueType::real:
      return "numbers";
    case ValueType::integer:
      return "whole numbers";
    case ValueType::rgb:
      return "colours" + std::string(entry.texturable ? " or pigments" : "");
    case ValueType::vec2:
      return "pairs <a, b>";
    case ValueType::vec3:
      return "vectors <a, b, c>";
    case ValueType::block:
      return "blocks of kind " + entry.blockKind;
    default:
      return "values";
  }
}

}  // namespace

std::optional<Value> convert(Context& context, const Parameter& row, const Datum& datum,
                             const Span& span, const std::string& who) {
  return Converter(context, row, datum, span, who).run();
}

std::optional<Value> listOf(Context& context, const Parameter& row, List list, const Span& span) {
  const int found = int(list.entries.size()), from = row.minEntries, to = row.maxEntries;
  if (found < from || found > to) {
    const std::string count = from == to     ? std::to_string(from)
                              : found < from ? "at least " + std::to_string(from)
                                             : "at most " + std::to_string(to);
    const bool isOne = found < from ? from == 1 : to == 1;
    const Span place = found > to ? list.entries[std::size_t(to)].span : span;
    context.reporter.error(place, "'" + row.name + "' takes " + count +
                                      (isOne ? " entry" : " entries") + ", found " +
                                      std::to_string(found));
    return {};
  }
  for (const Entry& e : list.entries) list.holdsBlocks |= e.value.kind == Value::Kind::block;
  const Share share(context.elements, found);
  context.checkElements(span);
  Value value;
  value.kind = Value::Kind::list;
  value.list = std::shared_ptr<const List>(new List(std::move(list)),
                                           [share](const List* dead) { delete dead; });
  return value;
}

std::string entryName(const Parameter& row, std::size_t index) {
  return "entry " + std::to_string(index + 1) + " of '" + row.name + "'";
}

std::optional<double> keyOf(Context& context, const Parameter& row, const Datum& datum,
                            const Span& span, const double* before) {
  Parameter key = real(row.name, 0).range(row.lowKey, row.highKey);
  const std::string who = "a key of '" + row.name + "'";
  const auto value = convert(context, key, datum, span, who);
  if (!value) return {};
  const double x = value->v[0];
  if (!before || x >= *before) return x;
  context.reporter.error(span, who + " must not be less than the one before, " + shortest(*before) +
                                   ", found " + shortest(x));
  return {};
}

std::string expectation(const Parameter& row) {
  const std::string unit = row.unit.empty() ? "" : " (" + row.unit + ")";
  const std::string pigment = row.texturable ? " or a pigment" : "";
  switch (row.type) {
    case ValueType::real:
      return "a number" + unit + pigment;
    case ValueType::integer:
      return "a whole number" + unit;
    case ValueType::boolean:
      return "true or false";
    case ValueType::rgb:
      return "a colour" + unit + pigment;
    case ValueType::vec2:
      return "two numbers <a, b>" + unit + pigment;
    case ValueType::vec3:
      return "a vector <a, b, c>" + unit + pigment;
    case ValueType::vec4:
      return "four numbers <a, b, c, d>" + unit + pigment;
    case ValueType::text:
      return "a \"string\"";
    case ValueType::file:
      return "a \"file name\"";
    case ValueType::choice:
      return orList(row.choices);
    case ValueType::block:
      return "a " + row.blockKind;
    case ValueType::list:
      return "a list [...] of " + entriesText(row);
    case ValueType::map:
      return "entries [key value] of " + entriesText(row);
    case ValueType::function:
      return "a function of " + std::to_string(row.arity) +
             (row.arity == 1 ? " number" : " numbers");
  }
  return {};
}

}  // namespace vestige::lang
