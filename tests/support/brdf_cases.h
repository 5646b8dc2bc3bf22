// SPDX-License-Identifier: Apache-2.0
// Every BRDF of the build with the parameter sets that the judge asks for.
#pragma once
#include "judge/brdf_case.h"
#include "support/plugins.h"

namespace vestige::test {

/// Every BRDF found, ours or not, with all its parameter sets.
inline std::vector<BrdfCase> brdfCases(int randomSets = 4) {
  std::vector<BrdfCase> cases;
  for (const LoadedPlugin& plugin : pluginsOfKind("brdf"))
    for (BrdfCase& c : judge::brdfCases(plugin, randomSets)) cases.push_back(std::move(c));
  return cases;
}
/// Every BRDF found with `sets` sets of random values.
inline std::vector<BrdfCase> randomBrdfCases(int sets) {
  std::vector<BrdfCase> cases;
  Random r(7);
  for (const LoadedPlugin& plugin : pluginsOfKind("brdf"))
    for (BrdfCase& c : judge::randomBrdfCases(plugin, sets, r)) cases.push_back(std::move(c));
  return cases;
}
inline BrdfCase brdfCase(const std::string& name, const Settings& s) {
  return judge::brdfCase(pluginNamed("brdf", name), s);
}

}  // namespace vestige::test
