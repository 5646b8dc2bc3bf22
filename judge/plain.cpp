// SPDX-License-Identifier: Apache-2.0
#include "judge/plain.h"

#include "judge/brdf_case.h"
#include "judge/harsh.h"

namespace vestige::judge {
namespace {

const char* const kFile = "picture.exr";

double within(const Parameter& row, double x) { return std::clamp(x, row.low, row.high); }

Value plainVector(const Parameter& row, int size, Random& r) {
  Value v;
  v.kind = Value::Kind::vector, v.size = size;
  for (int i = 0; i < size; ++i) v.v[i] = within(row, double(r.number(-2, 2)));
  return v;
}

/// Over the range if it is short; else around the default, or around 1.
Value plainNumber(const Parameter& row, Random& r) {
  if (row.high - row.low <= 1000) return valueWithin(row, 0.1 + 0.8 * double(r.number()));
  const bool hasSize = row.initial.kind == Value::Kind::number && row.initial.v[0] != 0;
  const double about = hasSize ? row.initial.v[0] : 1;
  return numberValue(within(row, about * double(r.number(Real(0.5), Real(1.5)))));
}

Value plainColour(Random& r) {
  const double red = r.number(Real(0.5), 3), green = r.number(Real(0.5), 3);
  return colourValue(red, green, double(r.number(Real(0.5), 3)));
}

/// image { "picture.exr" }
Value imageValue() {
  auto block = std::make_shared<Block>();
  block->kind = "pigment", block->plugin = "image";
  block->settings.push_back({"file", textValue(kFile), {}});
  Value v;
  v.kind = Value::Kind::block, v.block = block;
  return v;
}

bool isImage(const Parameter& row) {
  return row.type == ValueType::file ||
         (row.type == ValueType::block && row.blockKind == "pigment");
}

/// A number that does nothing unless given: a tilt.
bool isSwitchedOff(const Parameter& row) {
  return row.type == ValueType::real && row.initial.kind == Value::Kind::number &&
         row.initial.v[0] == 0;
}

}  // namespace

Value plainValue(const Parameter& row, Random& r) {
  switch (row.type) {
    case ValueType::real:
      return plainNumber(row, r);
    case ValueType::vec2:
      return plainVector(row, 2, r);
    case ValueType::vec3:
      return plainVector(row, 3, r);
    case ValueType::vec4:
      return plainVector(row, 4, r);
    case ValueType::rgb:
      return plainColour(r);
    case ValueType::file:
      return textValue(kFile);
    case ValueType::block:
      return isImage(row) ? imageValue() : Value{};
    default:
      return harshValue(row, r);
  }
}

Settings plainSettings(const Schema& schema, Random& r) {
  Settings s;
  for (const Parameter& row : schema.params)
    if (const Value v = plainValue(row, r);
        v.kind != Value::Kind::none && (row.required || r.number() < Real(0.7)))
      s[row.name] = v;
  return s;
}

Settings shownSettings(const Schema& schema, Random& r, bool withImage) {
  Settings s;
  bool hasImage = !withImage;
  for (const Parameter& row : schema.params) {
    if (!row.required && !isSwitchedOff(row) && (hasImage || !isImage(row))) continue;
    if (const Value v = plainValue(row, r); v.kind != Value::Kind::none) s[row.name] = v;
    hasImage = hasImage || isImage(row);
  }
  return s;
}

std::string rowsLeftAlone(const Schema& schema) {
  std::string names;
  Random r(1);
  for (const Parameter& row : schema.params)
    if (plainValue(row, r).kind == Value::Kind::none)
      names += (names.empty() ? "" : ", ") + row.name +
               (row.type == ValueType::block ? " (" + row.blockKind + " block)" : " (text)");
  return names;
}

}  // namespace vestige::judge
