// SPDX-License-Identifier: Apache-2.0
// The `footprint` block of the scene language:
//     integrator path { footprint gradient { limit 0.5 } }
// An integrator includes this header only where it reads its parameters.
#pragma once
#include <vestige/footprint/settings.h>
#include <vestige/scene_desc.h>
#include <vestige/schema.h>

#include <string>
#include <utility>
#include <vector>

namespace vestige {

/// One schema for each bound: the engine puts them into its registry.
inline std::vector<Schema> footprintSchemas() {
  const std::pair<const char*, const char*> bounds[] = {
      {"none", "textures are looked up at points"},
      {"pixel", "the film's numbers alone: Igehy's ray differentials"},
      {"local", "1/sqrt of the samples drawn at each event (Suykens and Willems, 3.1)"},
      {"global",
       "N_eff^(-1/M): all numbers of a path share its samples (Suykens and Willems, 3.1)"},
      {"safe", "shrinks with the sample's own index: never worse than none, the default"},
      {"gradient", "the paper's bound for this integrator, with limit 0.7"},
      {"paper", "the paper's bound, its representative vectors and its filter for pictures"},
      {"cone_roughness", "for comparison: a cone, max(spread, roughness) at every scattering"},
      {"cone_density", "for comparison: a cone, max(spread, 1/(8 sqrt(pdf))) at every scattering"}};
  std::vector<Schema> all;
  for (const auto& [name, summary] : bounds) {
    Schema s{.kind = "footprint", .name = name, .summary = summary, .isMovable = false};
    if (s.name != "none")
      s.params = {real("limit", 0)
                      .unset()
                      .range(0, 1e6)
                      .doc("largest relative change of the contribution over a footprint; none "
                           "unless given"),
                  choice("of", {"contribution", "score"})
                      .unset()
                      .doc("whose change is limited: that of F or of F/p, what importance sampling "
                           "leaves (Suykens and Willems, 3.4)"),
                  choice("light", {"constant", "exact"})
                      .unset()
                      .doc("with a limit: whether the light that a path is joined to counts as "
                           "change too, and what the surface reflects of it"),
                  choice("shape", {"covariance", "representative"})
                      .unset()
                      .doc("ellipse with the vectors' second moments, or the paper's two vectors"),
                  real("scale", 1).range(0, 1000).doc("multiplies the bound"),
                  real("exponent", 0)
                      .unset()
                      .range(0, 8)
                      .doc("of the sample count in global (1/M) and safe (2/3)")};
    all.push_back(std::move(s));
  }
  return all;
}

/// Settings from a block; `fallback` where there is none. `native` is the paper's bound for the
/// calling integrator: local where paths split, global where they do not.
inline FootprintSettings footprintSettings(const Block* block, Bound native,
                                           FootprintSettings fallback = {}) {
  if (!block) return fallback;
  FootprintSettings s;
  const std::string& word = block->plugin;
  s.deltas.bound = word == "none"             ? Bound::none
                   : word == "pixel"          ? Bound::pixel
                   : word == "local"          ? Bound::local
                   : word == "global"         ? Bound::global
                   : word == "safe"           ? Bound::safe
                   : word == "cone_roughness" ? Bound::roughness
                   : word == "cone_density"   ? Bound::density
                                              : native;
  if (word == "gradient") s.deltas.limit = kDefaultLimit;
  if (word == "paper") {
    s.shape = RegionShape::representative;
    s.alongMajor = true;
  }
  const auto number = [&](const char* name, Real& into) {
    if (const Value* v = block->find(name)) into = Real(v->v[0]);
  };
  number("limit", s.deltas.limit);
  number("scale", s.deltas.scale);
  number("exponent", s.deltas.exponent);
  if (const Value* v = block->find("of"))
    s.limited = v->text == "score" ? Limited::score : Limited::contribution;
  if (const Value* v = block->find("light"))
    s.light = v->text == "exact" ? LightTerm::exact : LightTerm::constant;
  if (const Value* v = block->find("shape"))
    s.shape = v->text == "representative" ? RegionShape::representative : RegionShape::covariance;
  return s;
}

}  // namespace vestige
