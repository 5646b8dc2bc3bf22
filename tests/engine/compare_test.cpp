// SPDX-License-Identifier: Apache-2.0
// The measures of difference, against closed forms and against the programs that others publish.
#include <cmath>
#include <cstdlib>

#include "engine/picture/compare.h"
#include "engine/picture/flip.h"
#include "support/catch.h"

using namespace vestige;

namespace {

Image constant(int width, int height, float r, float g, float b) {
  Image image{width, height, {"R", "G", "B"}, {}, {}};
  for (int i = 0; i < width * height; ++i) image.pixels.insert(image.pixels.end(), {r, g, b});
  return image;
}

/// Waves, a chequerboard, and what was done to them: brighter in a window, dimmer, shifted.
Image pattern(bool changed) {
  Image image = constant(96, 64, 0, 0, 0);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 96; ++x) {
      double r = 0.5 + 0.4 * std::sin(0.3 * x + 0.1 * y);
      double g = 0.5 + 0.4 * std::sin(0.05 * x * y / 8);
      if (changed && x > 30 && x < 60 && y > 20 && y < 40) r = std::min(r + 0.2, 1.0);
      if (changed) g *= 0.9;
      const int cell = ((changed ? x + 2 : x) / 8 + y / 8) % 2;
      float* p = image.at(x, y);
      p[0] = float(r), p[1] = float(g), p[2] = float(cell * 0.7 + 0.1);
    }
  return image;
}

}  // namespace

TEST_CASE("equal pictures do not differ", "[compare]") {
  Image difference;
  const Comparison c = compareImages(pattern(false), pattern(false), &difference);
  CHECK(c.rmse == 0);
  CHECK(c.relMse == 0);
  CHECK(c.relMseTrimmed == 0);
  CHECK(c.blockDifference == 0);
  CHECK(c.flip == 0);
  for (const double ratio : c.meanRatio) CHECK(ratio == 1);
  CHECK(difference.width == 96);
  CHECK(difference.height == 64);
  CHECK(difference.pixels[0] == 0);
}

TEST_CASE("constant pictures differ by the formulas", "[compare]") {
  const Comparison c =
      compareImages(constant(40, 33, 1.5f, 0.5f, 0), constant(40, 33, 1, 0.5f, 0.2f), nullptr);
  CHECK(c.rmse == Approx(std::sqrt((0.25 + 0.04) / 3)));
  CHECK(c.relMse == Approx((0.25 / 1.01 + 0.04 / 0.05) / 3));
  CHECK(c.relMseTrimmed == Approx(c.relMse));
  CHECK(c.meanRatio[0] == Approx(1.5));
  CHECK(c.meanRatio[1] == Approx(1));
  CHECK(c.meanRatio[2] == 0);
  CHECK(c.blockDifference == Approx((0.5 + 0.2) / 3 / (1.7 / 3 + 0.01)));
}

TEST_CASE("the ratio of means does not depend on the level", "[compare]") {
  for (const float level : {1e-20f, 1e-12f, 1.f, 1e12f}) {
    const Comparison c = compareImages(constant(4, 4, 3 * level, level, 0),
                                       constant(4, 4, 2 * level, level, level), nullptr);
    CHECK(c.meanRatio[0] == Approx(1.5));
    CHECK(c.meanRatio[1] == Approx(1));
    CHECK(c.meanRatio[2] == 0);
  }
}

TEST_CASE("the worst thousandth of the pixels can be left out", "[compare]") {
  const Image reference = constant(100, 30, 1, 1, 1);
  Image fireflies = constant(100, 30, 1, 1, 1);
  for (const int i : {5, 1700, 2999})
    fireflies.pixels[std::size_t(i) * 3] = 1e4f, fireflies.pixels[std::size_t(i) * 3 + 1] = 1.1f;
  const Comparison three = compareImages(fireflies, reference, nullptr);
  CHECK(three.relMse == Approx(3 * (9999. * 9999 + 0.01) / 1.01 / 3 / 3000).epsilon(1e-4));
  CHECK(three.relMseTrimmed == 0);
  fireflies.pixels[30] = 2;  // one more than a thousandth
  const Comparison four = compareImages(fireflies, reference, nullptr);
  CHECK(four.relMseTrimmed == Approx(1 / 1.01 / 3 / 2997));
}

TEST_CASE("blocks do not see noise", "[compare]") {
  Image board = constant(64, 64, 1, 1, 1);
  for (int i = 0; i < 64 * 64; ++i)
    for (int c = 0; c < 3; ++c)
      board.pixels[std::size_t(i) * 3 + c] = (i + i / 64) % 2 ? 0.5f : 1.5f;
  const Comparison c = compareImages(board, constant(64, 64, 1, 1, 1), nullptr);
  CHECK(c.rmse == Approx(0.5));
  CHECK(c.blockDifference == Approx(0).margin(1e-9));
}

TEST_CASE("what is not finite counts as black", "[compare]") {
  Image broken = constant(16, 16, 1, 1, 1);
  broken.pixels[0] = NAN, broken.pixels[4] = INFINITY;
  const Comparison c = compareImages(broken, constant(16, 16, 1, 1, 1), nullptr);
  CHECK(c.rmse == Approx(std::sqrt(2.0 / 768)));
  CHECK(std::isfinite(c.flip));
}

TEST_CASE("measures agree with NumPy's and with the published FLIP", "[compare]") {
  // numpy 2.4 with the formulas as written in image.h; flip-evaluator 1.7 on the sRGB codes, LDR.
  const Image reference = pattern(false), test = pattern(true);
  const Comparison c = compareImages(test, reference, nullptr);
  CHECK(c.rmse == Approx(0.207567274));
  CHECK(c.relMse == Approx(1.066664213));
  CHECK(c.relMseTrimmed == Approx(1.057955472));
  CHECK(c.meanRatio[0] == Approx(1.03244277));
  CHECK(c.meanRatio[1] == Approx(0.9));
  CHECK(c.meanRatio[2] == Approx(1));
  CHECK(c.blockDifference == Approx(0.046269381));
  CHECK(c.flip == Approx(0.340227).epsilon(1e-4));

  const std::vector<float> seen = flipDifference(reference.pixels, test.pixels, 96, 64);
  const auto at = [&](int y, int x) { return seen[std::size_t(y) * 96 + x]; };
  CHECK(at(0, 0) == Approx(0.28820372).epsilon(1e-3));
  CHECK(at(30, 45) == Approx(0.5409047).epsilon(1e-3));
  CHECK(at(10, 10) == Approx(0.28178006).epsilon(1e-3));
  CHECK(at(63, 95) == Approx(0.87030375).epsilon(1e-3));
  CHECK(at(25, 40) == Approx(0.30570063).epsilon(1e-3));
}

TEST_CASE("black against white differs as much as can be seen", "[compare]") {
  const Comparison c = compareImages(constant(8, 8, 1, 1, 1), constant(8, 8, 0, 0, 0), nullptr);
  CHECK((c.flip > 0.95 && c.flip <= 1));
}

TEST_CASE("8-bit pictures are compared as the codes that they are", "[compare]") {
  // The same two greys, once as light and once as sRGB codes.
  const Image light = constant(8, 8, 0.2158605f, 0.2158605f, 0.2158605f);
  const Image lightOther = constant(8, 8, 0.05f, 0.05f, 0.05f);
  Image code = constant(8, 8, 128 / 255.f, 128 / 255.f, 128 / 255.f);
  Image codeOther = constant(8, 8, 0.24773f, 0.24773f, 0.24773f);
  code.metadata["oiio:ColorSpace"] = codeOther.metadata["oiio:ColorSpace"] = "sRGB";
  CHECK(compareImages(code, codeOther, nullptr).flip ==
        Approx(compareImages(light, lightOther, nullptr).flip).epsilon(1e-3));
}
