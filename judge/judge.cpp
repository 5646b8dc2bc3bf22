// SPDX-License-Identifier: Apache-2.0
#include "judge/judge.h"

#include <vestige/integrator.h>
#include <vestige/pigment.h>
#include <vestige/shape.h>

#include <set>

#include "judge/plain.h"

namespace vestige::judge {
namespace {

/// A promise that is independent of events.
void see(Finding& f, bool kept, const std::string& what) {
  f.worst.see(kept ? 0 : HUGE_VAL, [&] { return Event{what, "", what}; });
}

/// Rows have unique names, documentation, and defaults within their ranges.
Finding schemaIsSound(const Plugin& plugin) {
  Finding f{"the schema is sound", "schema()"};
  const Schema& schema = *plugin.schema;
  see(f, schema.kind == plugin.kind && schema.name == plugin.name,
      "it is named " + schema.kind + " '" + schema.name + "', the library " + plugin.kind + " '" +
          plugin.name + "'");
  see(f, int(schema.inputs.size()) + 2 <= kMaxInputs,
      "it declares more inputs than " + std::to_string(kMaxInputs - 2));
  std::set<std::string> names;
  for (const auto* rows : {&schema.params, &schema.inputs})
    for (const Parameter& row : *rows) {
      see(f, !row.name.empty() && names.insert(row.name).second,
          "two parameters are called '" + row.name + "'");
      see(f, row.low <= row.high, "the range of '" + row.name + "' is empty");
      if (row.initial.kind == Value::Kind::number)
        see(f, row.initial.v[0] >= row.low && row.initial.v[0] <= row.high,
            "the default of '" + row.name + "' is outside of its range");
    }
  return f;
}

/// Whether the plugin can be created with its defaults. If required rows have none, it may refuse
/// with a message.
template <class Interface>
Finding isCreated(const Plugin& plugin) {
  Finding f{"it is created with its defaults", "the constructor"};
  bool needs = false;
  for (const Parameter& row : plugin.schema->params) needs = needs || row.required;
  try {
    if (!needs) make<Interface>(plugin);
    see(f, true, "");
  } catch (const std::runtime_error& e) {
    see(f, std::string(e.what()).size() > 3, "it refuses its defaults without a reason");
  }
  return f;
}

Finding isCreatedAsItsKind(const Plugin& plugin) {
  if (plugin.kind == "brdf") return isCreated<Brdf>(plugin);
  if (plugin.kind == "light") return isCreated<Light>(plugin);
  if (plugin.kind == "camera") return isCreated<Camera>(plugin);
  if (plugin.kind == "pigment") return isCreated<Pigment>(plugin);
  if (plugin.kind == "shape") return isCreated<Shape>(plugin);
  return isCreated<Integrator>(plugin);
}

void addSentence(std::string& text, const std::string& more) {
  text += (text.empty() || more.empty() ? "" : "\n") + more;
}

/// Drops findings about the engine's finite differences, which replace missing derivatives: they
/// are slow, and wrong at the seams of a map.
void dropDifferences(Judgement& j, std::uint32_t lacks) {
  const auto isDropped = [&](const Verdict& v) {
    const auto names = [&](const char* word) { return v.test.find(word) != v.test.npos; };
    const bool ofSample = names("|du.c0 x du.c1|") || names("du is") || names("dPrev is") ||
                          names("dFrom is") || names("sampleDerivatives() are") ||
                          names("|dDirection[0] x");
    return ((lacks & kLacksSampleDerivatives) && ofSample) ||
           ((lacks & kLacksLogGradient) && names("logGradient()")) ||
           ((lacks & (kLacksEmission | kLacksEmissionDerivatives)) &&
            names("emissionDerivatives()")) ||
           ((lacks & kLacksEmission) && names("emit() brings"));
  };
  std::erase_if(j.verdicts, isDropped);
  if (lacks & kLacksDerivatives)
    addSentence(
        j.unchecked,
        "the plugin leaves derivatives to the engine's finite differences: they were not judged");
  if (lacks & kLacksEmission)
    addSentence(j.unchecked, "the light has no emit(): integrators that start at lights omit it");
  if (lacks & kLacksPdf)
    addSentence(j.unchecked, "the camera has no pdf(): the density of its rays was not judged");
}

/// Parameters that were not tried, for the user; "": none.
std::string leftAlone(const Plugin& plugin, const std::string& rows) {
  return rows.empty() ? "" : "left at their defaults, of " + plugin.name + ": " + rows;
}

/// A BRDF is judged by its inputs.
std::string paramsOf(const Schema& schema) {
  std::string names;
  for (const Parameter& row : schema.params) names += (names.empty() ? "" : ", ") + row.name;
  return names;
}

template <class Cases>
std::string noCases(const Cases& cases) {
  return cases.empty() ? "the plugin refused all parameters that were tried: no method was judged"
                       : "";
}

void judgeByKind(const Plugin& plugin, const Effort& effort, Judgement& j) {
  TriedRows rows;
  const auto untried = [&] {
    std::string names = rowsLeftAlone(*plugin.schema);
    if (const std::string refused = rows.refused(*plugin.schema); !refused.empty())
      names += (names.empty() ? "" : ", ") + refused;
    return leftAlone(plugin, names);
  };
  if (plugin.kind == "brdf") {
    j = judgeBrdf(brdfCases(plugin, 4, effort.seed), plugin.schema, effort);
    dropDifferences(j, plugin.entry->lacks);
    addSentence(j.unchecked, leftAlone(plugin, paramsOf(*plugin.schema)));
  } else if (plugin.kind == "light") {
    const LightCases cases = lightCases(plugin, 6, effort.seed, &rows);
    j = judgeLight(cases, effort);
    dropDifferences(j, plugin.entry->lacks);
    addSentence(j.unchecked, noCases(cases));
    addSentence(j.unchecked, untried());
  } else if (plugin.kind == "camera") {
    const CameraCases cases = cameraCases(plugin, 6, effort.seed, &rows);
    j = judgeCamera(cases, effort);
    dropDifferences(j, plugin.entry->lacks);
    addSentence(j.unchecked, noCases(cases));
    addSentence(j.unchecked, untried());
  } else {
    j.unchecked = std::string("there are no tests for the methods of a") +
                  (plugin.kind == "integrator" ? "n " : " ") + plugin.kind +
                  ": only its schema and its creation were checked";
  }
}

}  // namespace

Judgement judgePlugin(const Plugin& plugin, const Effort& effort) {
  Judgement j;
  const auto first = {verdictOf(schemaIsSound(plugin)), verdictOf(isCreatedAsItsKind(plugin))};
  judgeByKind(plugin, effort, j);
  j.verdicts.insert(j.verdicts.begin(), first.begin(), first.end());
  return j;
}

}  // namespace vestige::judge
