// SPDX-License-Identifier: Apache-2.0
// Pictures that another renderer has made of the same scenes: refs/SOURCES.md says which and how.
// The fast cases have tolerances of about five standard deviations of their own noise.
#include "engine/picture/compare.h"
#include "images/picture.h"

using namespace vestige;
using namespace vestige::test;

namespace {

Comparison againstReference(const std::string& name, const std::string& arguments) {
  const Image picture = renderFile(source("examples/" + name + ".scene"), arguments);
  const Image reference = read(source("tests/images/refs/" + name + ".exr"));
  REQUIRE(picture.width == reference.width);
  REQUIRE(picture.height == reference.height);
  return compareImages(picture, reference, nullptr);
}

double worstMeanError(const Comparison& c) {
  double worst = 0;
  for (const double ratio : c.meanRatio) worst = std::max(worst, std::abs(ratio - 1));
  return worst;
}

}  // namespace

TEST_CASE("cornell agrees with its reference", "[images]") {
  const Comparison c = againstReference("cornell", "--spp 32");
  CHECK(worstMeanError(c) <= 0.001);
  CHECK(c.blockDifference <= 0.01);
  CHECK(c.relMseTrimmed <= 0.012);  // 0.0066 is what plain random numbers give at this many
}

TEST_CASE("a path one edge too short shows in the mean of cornell", "[images]") {
  CHECK(worstMeanError(againstReference("cornell", "--spp 32 -D Depth=7")) > 0.001);
}

TEST_CASE("pieces agrees with its reference", "[images]") {
  const Comparison c = againstReference("pieces", "--spp 32");
  CHECK(worstMeanError(c) <= 0.008);  // the caustic's fireflies
  CHECK(c.relMseTrimmed <= 0.1);
}

TEST_CASE("cornell converges to its reference", "[images][slow]") {
  const Comparison c = againstReference("cornell", "--spp 1024 -D Split=1");
  CHECK(worstMeanError(c) <= 0.001);
  CHECK(c.blockDifference <= 0.005);
  CHECK(c.relMseTrimmed <= 0.0004);
  CHECK(worstMeanError(againstReference("cornell", "--spp 1024 -D Split=1 -D Depth=7")) > 0.001);
}

TEST_CASE("pieces converges to its reference", "[images][slow]") {
  const Comparison c = againstReference("pieces", "--spp 1024");
  CHECK(worstMeanError(c) <= 0.004);
  CHECK(c.relMseTrimmed <= 0.0045);
}
