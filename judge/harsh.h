// SPDX-License-Identifier: Apache-2.0
// Numbers, directions and parameters that break formulas: the ends of intervals, grazing angles,
// and unusual settings that the schema allows.
#pragma once
#include <algorithm>
#include <cctype>
#include <sstream>

#include "judge/differences.h"
#include "judge/made.h"

namespace vestige::judge {

/// Numbers that a sampler may draw, the ends of the interval often.
inline Real harsh(Random& r) {
  switch (int(r.number() * 8)) {
    case 0:
      return 0;
    case 1:
      return kOneMinusEpsilon;
    case 2:
      return Real(0.5);
    case 3:
      return Real(1e-7);
    default:
      return r.number();
  }
}
inline Vec2 harshPair(Random& r) {
  const Real x = harsh(r);
  return {x, harsh(r)};
}

inline bool isFinite(const Mat3& m) {
  return isFinite(m.c[0]) && isFinite(m.c[1]) && isFinite(m.c[2]);
}
inline bool isFinite(const Mat3x2& m) { return isFinite(m.c[0]) && isFinite(m.c[1]); }
inline bool isFinite(const RayJacobian& j) {
  bool finite = true;
  for (int k = 0; k < 4; ++k)
    finite = finite && isFinite(j.dOrigin[k]) && isFinite(j.dDirection[k]);
  return finite;
}
inline bool isColour(Rgb c) { return isFinite(c) && c.r >= 0 && c.g >= 0 && c.b >= 0; }
inline bool isDensity(Real x) { return std::isfinite(x) && x >= 0; }
inline bool isUnit(Vec3 d) { return std::abs(length(d) - 1) < Real(1e-3); }

/// A value that the row accepts; kind none for files, blocks and texts.
inline Value harshValue(const Parameter& row, Random& r) {
  const auto within = [&](double low, double high) {
    low = std::max(low, row.low), high = std::min(high, row.high);
    return low + (high - low) * double(harsh(r));
  };
  switch (row.type) {
    case ValueType::real:
      return numberValue(within(-10, r.number() < Real(0.3) ? 1e4 : 10));
    case ValueType::integer:
      return numberValue(std::floor(within(-10, 10)));
    case ValueType::boolean:
      return numberValue(r.number() < Real(0.5));
    case ValueType::rgb: {
      const double red = within(0, 10), green = within(0, 10);
      return colourValue(red, green, within(0, 10));
    }
    case ValueType::vec3: {
      const double x = within(-3, 3), y = within(-3, 3);
      return vectorValue({x, y, within(-3, 3)});
    }
    case ValueType::choice:
      return textValue(row.choices[std::size_t(r.number() * Real(row.choices.size()))]);
    default:
      return {};
  }
}

/// A setting in the scene language. `name`: name of the row.
inline void writeValue(std::ostream& text, const std::string& name, const Value& value) {
  const auto isWord = [](const std::string& t) {
    return !t.empty() && std::all_of(t.begin(), t.end(), [](char c) {
      return std::islower(static_cast<unsigned char>(c)) || c == '_';
    });
  };
  const auto list = [&](int size) {
    text << "<";
    for (int i = 0; i < size; ++i) text << (i ? ", " : "") << value.v[i];
    text << ">";
  };
  if (value.kind == Value::Kind::number) text << value.v[0];
  if (value.kind == Value::Kind::vector) list(value.size);
  if (value.kind == Value::Kind::colour) {
    text << "rgb ";
    list(3);
  }
  if (value.kind == Value::Kind::text && isWord(value.text)) text << value.text.str();
  if (value.kind == Value::Kind::text && !isWord(value.text))
    text << '"' << value.text.str() << '"';
  if (value.kind != Value::Kind::block) return;
  if (value.block->plugin != name) text << value.block->plugin << " ";
  text << "{";
  for (const Setting& s : value.block->settings) {
    text << " " << s.name << " ";
    writeValue(text, s.name, s.value);
  }
  text << " }";
}

/// A set of settings for a message: can be pasted into a scene.
inline std::string textOfSettings(const Settings& settings) {
  std::ostringstream text;
  text.precision(9);
  for (const auto& [name, value] : settings) {
    text << " " << name << " ";
    writeValue(text, name, value);
  }
  return text.str();
}

/// A set of them for a schema's params.
inline Settings harshSettings(const Schema& schema, Random& r) {
  Settings s;
  for (const Parameter& row : schema.params) {
    const Value v = harshValue(row, r);
    if (v.kind != Value::Kind::none && (row.required || r.number() < Real(0.7))) s[row.name] = v;
  }
  return s;
}

}  // namespace vestige::judge
