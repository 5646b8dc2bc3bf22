// SPDX-License-Identifier: Apache-2.0
#include <vestige/path_walk.h>

#include "support/text_scene.h"

using namespace vestige;
using namespace vestige::test;

TEST_CASE("a walk that meets layers without end says so", "[engine]") {
  std::string text = "camera pinhole { location <0, 0, -1> look_at <0, 0, 0> }\n";
  for (int z = 0; z < 10; ++z)
    text += "quad { <-1, -1, " + std::to_string(z) +
            ">, <2, 0, 0>, <0, 2, 0> brdf lambert { diffuse rgb 0 opacity 0 } }\n";
  const auto scene = sceneOf(text + "light environment { radiance rgb 1 }\n");
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
