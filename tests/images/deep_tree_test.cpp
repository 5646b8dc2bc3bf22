// SPDX-License-Identifier: Apache-2.0
// `distributed` behind several mirrors: the samples of a pixel must still be independent there.
#include "picture.h"

namespace vestige::test {
namespace {

/// A floor under a shining rectangle that a board half hides, seen in the fifth edge, after four
/// reflections between two parallel mirrors.
const char* const kZigzag =
    "camera orthographic { location <0.5, 4, 0> look_at <1.5, 3, 0> width 0.001 }\n"
    "film { resolution <8, 8> filter \"box\" }\n"
    "#declare Silver = brdf mirror { specular rgb 1 };\n"
    "quad { <0, 0, -2>, <0, 6, 0>, <0, 0, 4> brdf { Silver } }\n"
    "quad { <1, 0, -2>, <0, 0, 4>, <0, 6, 0> brdf { Silver } }\n"
    "quad { <-4, -0.001, -4>, <8, 0, 0>, <0, 0, 8> brdf lambert { diffuse rgb 0.5 } }\n"
    "light area { <0, 1.5, 1>, <1, 0, 0>, <0, 0, 1> radiance rgb 1 }\n"
    "light area { <0, 1.5, -2>, <1, 0, 0>, <0, 0, 1> radiance rgb 3 }\n"
    "integrator distributed { split 256 depth 6 }\n";

/// Variance between pixels, which all see the same, over the square of their mean.
double relativeVariance(const std::string& arguments) {
  const Image p = renderText(kZigzag, arguments);
  const double m = mean(p, 1);
  REQUIRE(m > 0);
  double squares = 0;
  for (int y = 0; y < p.height; ++y)
    for (int x = 0; x < p.width; ++x) squares += std::pow(double(p.at(x, y)[1]) / m - 1, 2);
  return squares / (p.width * p.height);
}

}  // namespace

TEST_CASE("samples of a tree stay independent behind mirrors", "[images][distributed]") {
  const double one = relativeVariance("--spp 1"), many = relativeVariance("--spp 16");
  INFO("relative variance of 1 sample " << one << ", of 16 " << many);
  // 1/16 if independent; two variances of 64 pixels each are known to a factor of 2.
  CHECK(many < one / 6);
}

}  // namespace vestige::test
