// SPDX-License-Identifier: Apache-2.0
// Inside ground glass a path is reflected and refracted, both for certain: the same light, less
// noise than by choosing one.
#include <vector>

#include "picture.h"

namespace vestige::test {
namespace {

/// Reflected inside the ball, one ray in thirty brings all of the lamp behind the camera.
std::string ballUnderLamp(const std::string& integrator) {
  return "camera orthographic { location <0, 0, -3> look_at <0, 0, 0> width 1 }\n"
         "film { resolution <24, 24> filter \"box\" }\n"
         "light area { <-1, 2, -6>, <2, 0, 0>, <0, 2, 0> radiance rgb 30 }\n"
         "sphere { <0, 0, 0>, 1 brdf rough_dielectric { alpha 0.1 ior 1.5 } }\n"
         "integrator " +
         integrator + "\n";
}

struct Noise {
  double mean, variance;
};

/// Of a pixel, over seeds.
Noise noise(const std::string& integrator) {
  constexpr int kSeeds = 32;
  std::vector<Image> pictures;
  for (int seed = 0; seed < kSeeds; ++seed)
    pictures.push_back(
        renderText(ballUnderLamp(integrator), "--spp 16 --seed " + std::to_string(seed)));
  Noise sum{0, 0};
  const int pixels = pictures[0].width * pictures[0].height;
  for (int i = 0; i < pixels; ++i) {
    double mean = 0, squares = 0;
    for (const Image& p : pictures) {
      const double value = double(p.at(i % p.width, i / p.width)[1]);
      mean += value / kSeeds, squares += value * value / kSeeds;
    }
    sum.mean += mean / pixels;
    sum.variance += (squares - mean * mean) / pixels;
  }
  return sum;
}

}  // namespace

TEST_CASE("inside ground glass a path goes both ways", "[images]") {
  const Noise both = noise("path { depth 4 }"), one = noise("distributed { split 1 depth 4 }");
  INFO("both ways " << both.mean << ", variance " << both.variance << "; one " << one.mean << ", "
                    << one.variance);
  const double error = std::sqrt((both.variance + one.variance) / (32 * 24 * 24));
  CHECK(std::abs(both.mean - one.mean) < 4 * error);
  CHECK(both.variance < 0.5 * one.variance);
}

}  // namespace vestige::test
