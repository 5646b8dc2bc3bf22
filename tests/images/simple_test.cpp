// SPDX-License-Identifier: Apache-2.0
// `simple` estimates the same radiance as `path`.
#include <string>
#include <vector>

#include "picture.h"

namespace vestige::test {
namespace {

constexpr int kSeeds = 5, kBlocks = 3, kSide = 36;

/// Block means of a picture for each seed: [seed][block].
using Blocks = std::vector<std::vector<double>>;

Blocks blocksOf(const std::string& scene, int firstSeed) {
  Blocks result;
  for (int seed = firstSeed; seed < firstSeed + kSeeds; ++seed) {
    const Image p =
        renderText(scene, "--width 36 --height 36 --spp 16 --seed " + std::to_string(seed));
    std::vector<double> sums(kBlocks * kBlocks);
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x)
        sums[std::size_t(y * kBlocks / kSide * kBlocks + x * kBlocks / kSide)] +=
            double(p.at(x, y)[1]);
    result.push_back(sums);
  }
  return result;
}

struct Estimate {
  double mean = 0, variance = 0;  ///< of the mean
};

Estimate estimate(const Blocks& blocks, std::size_t block) {
  double sum = 0, squares = 0;
  for (const auto& seed : blocks) sum += seed[block];
  for (const auto& seed : blocks) squares += std::pow(seed[block] - sum / kSeeds, 2);
  return {sum / kSeeds, squares / (kSeeds * (kSeeds - 1))};
}

/// Compares block means in units of their own noise, over independent seeds.
void checkAgree(const std::string& scene) {
  const Blocks a = blocksOf(scene + "integrator path { depth 6 }\n", 0);
  const Blocks b = blocksOf(scene + "integrator simple { depth 6 }\n", kSeeds);
  double squares = 0;
  for (std::size_t i = 0; i < kBlocks * kBlocks; ++i) {
    const Estimate one = estimate(a, i), two = estimate(b, i);
    const double z = (one.mean - two.mean) / std::sqrt(one.variance + two.variance);
    INFO("block " << i << ": path " << one.mean << ", simple " << two.mean << ", z " << z);
    CHECK(std::abs(z) < 6);
    squares += z * z;
  }
  // Student's t of 8 degrees of freedom has variance 4/3.
  CHECK(squares / (kBlocks * kBlocks) < 3);
}

std::string box(const std::string& content) {
  return "camera pinhole { location <0, 1, -3.2> look_at <0, 1, 0> angle 40 }\n"
         "film { filter \"box\" }\n"
         "#declare White = brdf lambert { diffuse rgb 0.7 };\n"
         "quad { <-1, 0, -1>, <2, 0, 0>, <0, 0, 2> brdf { White } }\n"
         "quad { <-1, 2, -1>, <2, 0, 0>, <0, 0, 2> brdf { White } }\n"
         "quad { <-1, 0, 1>, <2, 0, 0>, <0, 2, 0> brdf { White } }\n"
         "quad { <-1, 0, -1>, <0, 2, 0>, <0, 0, 2> brdf lambert { diffuse rgb 0.3 } }\n"
         "quad { <1, 0, -1>, <0, 2, 0>, <0, 0, 2> brdf lambert { diffuse rgb 0.5 } }\n"
         "light area { <-0.4, 1.98, -0.4>, <0.8, 0, 0>, <0, 0, 0.8> radiance rgb 8 }\n" +
         content;
}

}  // namespace

TEST_CASE("simple agrees with path", "[images][simple]") {
  SECTION("in a box") {
    checkAgree(box("box { <-0.5, 0, -0.2>, <0.2, 0.8, 0.5> brdf { White } }\n"));
  }
  SECTION("with glass, a veil and a sky") {
    checkAgree(
        box("sphere { <-0.4, 0.4, 0>, 0.4 brdf glass { ior 1.5 } }\n"
            "sphere { <0.45, 0.4, 0>, 0.4 brdf rough_dielectric { ior 1.5 alpha 0.3 } }\n"
            "quad { <-1, 0.9, -0.9>, <2, 0, 0>, <0, 1, 0>\n"
            "       brdf lambert { diffuse rgb 0.6 opacity 0.4 } }\n"
            "light environment { radiance rgb 0.5 }\n"));
  }
}

}  // namespace vestige::test
