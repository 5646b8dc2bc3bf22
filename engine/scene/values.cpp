// SPDX-License-Identifier: Apache-2.0
#include "engine/scene/builder.h"

namespace vestige {
namespace {

int sizeOf(ValueType type) {
  switch (type) {
    case ValueType::vec2:
      return 2;
    case ValueType::vec3:
    case ValueType::rgb:
      return 3;
    case ValueType::vec4:
      return 4;
    default:
      return 1;
  }
}

/// POV-Ray's rule: a number stands for a vector of equal components.
Value promoted(const Parameter& row, Value value) {
  const int size = sizeOf(row.type);
  if (value.kind == Value::Kind::number && size > 1) {
    for (int i = 1; i < size; ++i) value.v[i] = value.v[0];
    value.kind = row.type == ValueType::rgb ? Value::Kind::colour : Value::Kind::vector;
    value.size = size;
  }
  const auto isNumber = [](const Entry& e) { return e.value.kind == Value::Kind::number; };
  if (value.list && sizeOf(row.entryType) > 1 &&
      std::any_of(value.list->entries.begin(), value.list->entries.end(), isNumber)) {
    const Parameter entry = row.entry();
    auto list = std::make_shared<List>(*value.list);
    for (Entry& e : list->entries) e.value = promoted(entry, e.value);
    value.list = std::move(list);
  }
  return value;
}

}  // namespace

std::vector<Value> valuesFor(const std::vector<Parameter>& rows, const Block& block) {
  std::vector<Value> values;
  for (const Parameter& row : rows) {
    const Value* given = block.find(row.name);
    values.push_back(promoted(row, given ? *given : row.initial));
  }
  return values;
}

InputValue constantInput(const Parameter& row, const Value& value) {
  const Value v = promoted(row, value.kind == Value::Kind::none ? numberValue(0) : value);
  if (row.type == ValueType::rgb) return {{Real(v.v[0]), Real(v.v[1]), Real(v.v[2]), 1}};
  return {{Real(v.v[0]), 0, 0, 1}};
}

}  // namespace vestige
