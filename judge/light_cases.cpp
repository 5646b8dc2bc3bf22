// SPDX-License-Identifier: Apache-2.0
#include "judge/brdf_case.h"
#include "judge/harsh.h"
#include "judge/light_tests.h"

namespace vestige::judge {
namespace {

/// A value that nobody would wonder at; kind none: leave it out.
Value plainValue(const Parameter& row, Random& r) {
  switch (row.type) {
    case ValueType::vec3: {
      const Vec3 p = r.point(-2, 2);
      return vectorValue({double(p.x), double(p.y), double(p.z)});
    }
    case ValueType::rgb: {
      const double red = r.number(Real(0.5), 3), green = r.number(Real(0.5), 3);
      return colourValue(red, green, double(r.number(Real(0.5), 3)));
    }
    case ValueType::real:
    case ValueType::boolean:
    case ValueType::integer:
    case ValueType::choice:
      break;
    default:
      return {};
  }
  if (row.type != ValueType::real) return harshValue(row, r);
  return std::isfinite(row.low) && std::isfinite(row.high)
             ? valueWithin(row, 0.1 + 0.8 * double(r.number()))
             : numberValue(double(r.number(1, 4)));
}

}  // namespace

LightCases lightCases(const Plugin& plugin, int sets, unsigned seed) {
  LightCases cases;
  Random r(seed + 21);
  for (int tried = 0; int(cases.size()) < sets && tried < 50 * sets; ++tried) {
    Settings s;
    for (const Parameter& row : plugin.schema->params)
      if (const Value v = plainValue(row, r);
          v.kind != Value::Kind::none && (row.required || r.number() < Real(0.7)))
        s[row.name] = v;
    try {
      const auto light = make<Light>(plugin, s);
      light->setScene(kLightScene);
      cases.push_back({"light " + plugin.name + " {" + textOfSettings(s) + " }", light});
    } catch (const std::runtime_error&) {
      continue;  // settings that contradict each other
    }
  }
  return cases;
}

Event lightEvent(const LightCase& c, Vec3 from, Vec2 u, const std::string& what) {
  std::ostringstream line, where;
  line.precision(9), where.precision(3);
  line << c.title << "  from " << from << "  u " << u << ": " << what;
  where << "seen from " << from;
  return {line.str(), where.str(), what};
}

}  // namespace vestige::judge
