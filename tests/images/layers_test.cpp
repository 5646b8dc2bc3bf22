// SPDX-License-Identifier: Apache-2.0
// Any number of transparent layers before a light, for every integrator that follows paths.
#include "picture.h"

namespace vestige::test {
namespace {

/// Looks through black layers, one behind the other, at a surface of radiance 1.
std::string layersBeforeLight(int layers, const std::string& opacity,
                              const std::string& integrator) {
  std::string text =
      "camera orthographic { location <0, 0, -1> look_at <0, 0, 0> width 1 }\n"
      "film { resolution <16, 16> filter \"box\" }\n"
      "integrator " +
      integrator +
      "\n"
      "quad { <-1, -1, 11>, <0, 2, 0>, <2, 0, 0> emission rgb 1 brdf lambert { diffuse rgb 0 } }\n"
      "#declare Film = brdf lambert { diffuse rgb 0 opacity " +
      opacity + " };\n";
  for (int i = 0; i < layers; ++i)
    text +=
        "quad { <-1, -1, " + std::to_string(0.01 * i) + ">, <2, 0, 0>, <0, 2, 0> brdf { Film } }\n";
  return text;
}

}  // namespace

TEST_CASE("a thousand transparent layers let through what they should", "[images]") {
  constexpr int kLayers = 1000, kSamples = 16 * 16 * 16;
  const double expected = std::pow(1 - 0.002, kLayers);
  const double deviation = std::sqrt(expected * (1 - expected) / kSamples);
  for (const char* integrator :
       {"path { depth 2 }", "simple { depth 2 }", "distributed { depth 2 split 1 }",
        "particle { particles 1000 depth 2 }"}) {
    INFO(integrator);
    const Image picture = renderText(layersBeforeLight(kLayers, "0.002", integrator), "--spp 16");
    CHECK(std::abs(mean(picture, 1) - expected) < 4 * deviation);
  }
}

}  // namespace vestige::test
