// SPDX-License-Identifier: Apache-2.0
// Values against the rows of a schema: types, promotion, ranges.
#include <cmath>

#include "lang/builder.h"
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
  Converter(Context& context, const Parameter& row, const Datum& datum, const Span& span)
      : context_(context), row_(row), datum_(datum), span_(span) {}

  std::optional<Value> run() {
    if (isBroken(datum_)) return {};
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
    }
    return {};
  }

 private:
  std::optional<Value> fail(const std::string& message) {
    context_.reporter.error(span_, message);
    return {};
  }
  std::optional<Value> mismatch() {
    return fail("'" + row_.name + "' takes " + expectation(row_) + ", found " + describe(datum_));
  }

  std::optional<Value> number() {
    const Numbers* n = numbers(datum_);
    if (!n || n->size != 1) return mismatch();
    Value value = numberValue(n->v[0]);
    if (row_.type == ValueType::boolean) value.v[0] = isTrue(n->v[0]) ? 1 : 0;
    if (!isInRange(value, 1)) return {};
    if (row_.type == ValueType::integer && value.v[0] != std::floor(value.v[0])) {
      // What a division should have made whole is meant to be whole.
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
    return s ? std::optional(textValue(**s)) : mismatch();
  }

  std::optional<Value> choice() {
    const auto* s = std::get_if<TextPtr>(&datum_);
    if (!s) return mismatch();
    const auto& all = row_.choices;
    if (std::find(all.begin(), all.end(), **s) != all.end()) return textValue(**s);
    return fail("'" + row_.name + "' takes " + expectation(row_) + ", found '" + **s + "'" +
                didYouMean(**s, all));
  }

  bool isInRange(const Value& value, int size) {
    for (int i = 0; i < size; ++i) {
      const double x = value.v[i];
      if (!std::isfinite(x)) {
        fail("'" + row_.name + "' must be finite, found " +
             (std::isnan(x) ? "a number that is none (such as a root of a negative number)"
                            : "an infinite number (such as 1/0)"));
        return false;
      }
      if (x < row_.low || x > row_.high || (row_.openLow && x == row_.low)) {
        fail("'" + row_.name + "' must be " + rangeText(row_) + ", found " + shortest(x));
        return false;
      }
    }
    return true;
  }

  Context& context_;
  const Parameter& row_;
  const Datum& datum_;
  Span span_;
};

}  // namespace

std::optional<Value> convert(Context& context, const Parameter& row, const Datum& datum,
                             const Span& span) {
  return Converter(context, row, datum, span).run();
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
  }
  return {};
}

}  // namespace vestige::lang
