// SPDX-License-Identifier: Apache-2.0
// Plugins of the build, made with settings that nobody would write but the schema allows.
#pragma once
#include "judge/harsh.h"
#include "support/plugins.h"

namespace vestige::test {

/// A plugin that was made with harsh settings.
template <class Interface>
struct HarshCase {
  std::string title;
  std::shared_ptr<Interface> made;
};

/// `count` of every plugin of a kind that the registry's folder holds. What the plugin refuses is
/// not counted: settings that contradict each other.
template <class Interface>
std::vector<HarshCase<Interface>> harshCases(const std::string& kind, int count, Random& r) {
  std::vector<HarshCase<Interface>> cases;
  for (const LoadedPlugin& plugin : pluginsOfKind(kind))
    for (int made = 0, tried = 0; made < count && tried < 20 * count; ++tried) {
      const Settings s = harshSettings(*plugin.schema, r);
      try {
        cases.push_back({kind + " " + plugin.name + textOfSettings(s), make<Interface>(plugin, s)});
        ++made;
      } catch (const std::runtime_error&) {
        continue;
      }
    }
  return cases;
}

}  // namespace vestige::test
