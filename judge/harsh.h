// SPDX-License-Identifier: Apache-2.0
// Numbers, directions and parameters that break formulas: the ends of intervals, grazing angles,
// and settings that nobody would write but the schema allows.
#pragma once
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

/// Some value that the row takes; kind none for files, blocks and texts.
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

/// What a set of settings is called in a message.
inline std::string textOfSettings(const Settings& settings) {
  std::ostringstream text;
  text.precision(9);
  for (const auto& [name, value] : settings) {
    text << " " << name << " ";
    if (value.kind == Value::Kind::text) text << value.text.str();
    if (value.kind == Value::Kind::block) text << "{ " << value.block->plugin << " }";
    const int size = value.kind == Value::Kind::number   ? 1
                     : value.kind == Value::Kind::colour ? 3
                     : value.kind == Value::Kind::vector ? value.size
                                                         : 0;
    for (int i = 0; i < size; ++i) text << (i ? "," : "") << value.v[i];
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
