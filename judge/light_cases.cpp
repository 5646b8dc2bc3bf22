// SPDX-License-Identifier: Apache-2.0
#include "judge/harsh.h"
#include "judge/light_tests.h"
#include "judge/plain.h"

namespace vestige::judge {

LightCases lightCases(const Plugin& plugin, int sets, unsigned seed, TriedRows* rows) {
  LightCases cases;
  TriedRows ignored;
  if (!rows) rows = &ignored;
  const bool emits = !(plugin.entry->lacks & kLacksEmission);
  Random r(seed + 21);
  for (int tried = 0; int(cases.size()) < sets && tried < 50 * sets; ++tried) {
    const Settings s = plainSettings(*plugin.schema, r);
    rows->offer(s);
    try {
      const auto light = make<Light>(plugin, s);
      light->setScene(kLightScene);
      cases.push_back({"light " + plugin.name + " {" + textOfSettings(s) + " }", light, emits});
      rows->accept(s);
    } catch (const std::runtime_error&) {
      continue;  // settings that contradict each other
    }
  }
  return cases;
}

Event lightEvent(const LightCase& c, const Receiver& from, Vec2 u, const std::string& what) {
  std::ostringstream line, where;
  line.precision(9), where.precision(3);
  line << c.title << "  from " << from.position << "  normal " << from.normal << "  u " << u << ": "
       << what;
  where << "seen from " << from.position;
  return {line.str(), where.str(), what};
}

}  // namespace vestige::judge
