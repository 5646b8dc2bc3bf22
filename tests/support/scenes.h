// SPDX-License-Identifier: Apache-2.0
// Scene descriptions written by hand, for tests of the engine without the language.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "engine/scene/registry.h"
#include "engine/scene/scene.h"

namespace vestige::test {

using Settings = std::vector<std::pair<std::string, Value>>;

inline Block makeBlock(std::string kind, std::string plugin, Settings settings = {},
                       std::vector<Block> children = {}) {
  Block b;
  b.kind = std::move(kind), b.plugin = std::move(plugin);
  for (auto& [name, value] : settings) b.settings.push_back({name, value, {}});
  b.children = std::move(children);
  return b;
}

inline const Registry& registry() {
  static std::vector<std::string> refused;
  static const Registry r = Registry::load({VESTIGE_PLUGINS}, refused);
  return r;
}

inline Block lambert(double grey) {
  return makeBlock("brdf", "lambert", {{"diffuse", colourValue(grey, grey, grey)}});
}

inline Block quad(Vec3 corner, Vec3 edge1, Vec3 edge2, std::vector<Block> children) {
  const auto v = [](Vec3 p) { return vectorValue({p.x, p.y, p.z}); };
  return makeBlock("shape", "quad",
                   {{"corner", v(corner)}, {"edge1", v(edge1)}, {"edge2", v(edge2)}},
                   std::move(children));
}

/// A closed box of 2 x 2 x 2 around the origin, open to nothing, lit by a square in its ceiling;
/// the camera stands inside. Cornell's idea without its colours.
inline SceneDesc room(double grey, const std::string& integrator, Settings settings = {}) {
  SceneDesc s;
  const std::vector<Block> wall = {lambert(grey)};
  s.blocks = {makeBlock("camera", "pinhole",
                        {{"location", vectorValue({0, 0, -0.99})},
                         {"look_at", vectorValue({0, 0, 1})},
                         {"angle", numberValue(90)}}),
              makeBlock("film", "", {{"resolution", vectorValue({32, 32})}}),
              makeBlock("integrator", integrator, std::move(settings)),
              makeBlock("light", "area",
                        {{"corner", vectorValue({-0.5, 0.99, -0.5})},
                         {"edge1", vectorValue({1, 0, 0})},
                         {"edge2", vectorValue({0, 0, 1})},
                         {"radiance", colourValue(5, 5, 5)}}),
              quad({-1, -1, -1}, {2, 0, 0}, {0, 0, 2}, wall),
              quad({-1, 1, -1}, {2, 0, 0}, {0, 0, 2}, wall),
              quad({-1, -1, -1}, {2, 0, 0}, {0, 2, 0}, wall),
              quad({-1, -1, 1}, {2, 0, 0}, {0, 2, 0}, wall),
              quad({-1, -1, -1}, {0, 2, 0}, {0, 0, 2}, wall),
              quad({1, -1, -1}, {0, 2, 0}, {0, 0, 2}, wall)};
  return s;
}

}  // namespace vestige::test
