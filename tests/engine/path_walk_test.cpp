// SPDX-License-Identifier: Apache-2.0
#include <vestige/tools/path_walk.h>

#include "support/catch.h"
#include "support/scenes.h"

using namespace vestige;
using namespace vestige::test;

TEST_CASE("a walk that meets layers without end says so", "[engine]") {
  SceneDesc description = room(0, "path");
  description.blocks.resize(3);  // without the room
  const Block clear = makeBlock("brdf", "lambert", {{"opacity", numberValue(0)}});
  for (int z = 0; z < 10; ++z)
    description.blocks.push_back(quad({-1, -1, Real(z)}, {2, 0, 0}, {0, 2, 0}, {clear}));
  description.blocks.push_back(
      makeBlock("light", "environment", {{"radiance", colourValue(1, 1, 1)}}));
  Diagnostics diagnostics;
  const auto scene = buildScene(description, registry(), {}, diagnostics);
  REQUIRE(scene);
  Counters counters;
  PathContext c{.scene = scene->view(),
                .sampler = Sampler(0, 0, 0, 1),
                .ray = {{0, 0, -1}, {0, 0, 1}, 0, kInfinity},
                .jacobian = {},
                .counters = counters};
  const auto walked = [&](std::uint32_t maxLayers) {
    EyePath path(c);
    Vertex v;
    Rgb radiance;
    CHECK_FALSE(walk(c, path, v, radiance, {.maxLayers = maxLayers}));
    return radiance.g;
  };
  // Ten layers, and the eleventh ray escapes.
  CHECK(walked(11) == Approx(1));
  CHECK(counters.rays == 11);
  CHECK(std::isnan(walked(10)));
}
