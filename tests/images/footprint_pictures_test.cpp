// SPDX-License-Identifier: Apache-2.0
// What footprints do to pictures, and what they must not do.
#include <cmath>
#include <vector>

#include "images/picture.h"

using namespace vestige;
using namespace vestige::test;

namespace {

/// A small sky with a bright spot, as a file.
std::string sky() {
  Image image{16, 8, {"R", "G", "B"}, {}, {}};
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 16; ++x)
      for (int c = 0; c < 3; ++c)
        image.pixels.push_back(0.3f + 0.1f * float(c) + (x == 5 && y == 2 ? 3.f : 0.f));
  const std::string file = (scratch() / "sky.exr").string();
  std::string error;
  INFO(error);
  REQUIRE(writeImage(file, image, {}, error));
  return file;
}

/// Balls of all kinds of lobes over a floor that shows them a pattern.
std::string balls(const std::string& pigment, const std::string& integrator,
                  const std::string& light) {
  return "camera pinhole { location <0, 1.6, -5> look_at <0, 0.9, 0> angle 40 }\n"
         "film { resolution <48, 32> }\n"
         "integrator " +
         integrator + "\n" + light + "\nplane { y, 0 brdf lambert { diffuse pigment " + pigment +
         " } }\n"
         "sphere { <-1.3, 0.9, 0>, 0.8 brdf phong { specular rgb 0.8 exponent 40 } }\n"
         "sphere { <0.4, 0.7, -0.6>, 0.6 brdf glass { ior 1.5 } }\n"
         "sphere { <1.6, 0.9, 0.6>, 0.8 brdf rough_conductor { alpha 0.2 } }\n";
}
const std::string kSun =
    "light distant { direction <0.3, -1, 0.4> irradiance rgb 2 }\n"
    "light environment { radiance rgb 0.4 }";
/// One light that is not chosen among others and not sampled: noise is that of the textures.
const std::string kNoiseless = "light distant { direction <0.3, -1, 0.4> irradiance rgb 2 }";
const std::string kChecker = "checker { rgb 0.1, rgb 0.9 scale 0.25 }";

bool isSame(const Image& a, const Image& b) {
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x)
      for (int c = 0; c < 3; ++c)
        if (a.at(x, y)[c] != b.at(x, y)[c]) return false;
  return a.width == b.width && a.height == b.height;
}

/// Squares above `most` count as that: a few paths by way of glass and sun outshine all others.
double meanSquare(const Image& a, const Image& b, double most = 1e30) {
  double sum = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x)
      for (int c = 0; c < 3; ++c)
        sum += std::min(std::pow(double(a.at(x, y)[c]) - double(b.at(x, y)[c]), 2), most);
  return sum / (3.0 * a.width * a.height);
}

double meanOf(const Image& a) { return (mean(a, 0) + mean(a, 1) + mean(a, 2)) / 3; }

}  // namespace

TEST_CASE("asking for AOVs does not change the picture", "[footprint]") {
  const std::string lit = "light environment { map \"" + sky() + "\" }";
  for (const char* pigment : {"checker { rgb 0.1, rgb 0.9 scale 0.25 }", "solid"}) {
    std::string scene = balls(pigment, "path { depth 12 }", lit);
    if (std::string(pigment) == "solid")  // nothing but the sky is looked up
      scene.replace(scene.find("pigment solid"), 13, "rgb 0.5");
    const Image plain = renderText(scene, "--spp 2");
    for (const char* aov : {"footprint", "footprint.texels", "gradient", "normal", "all"})
      CHECK(isSame(plain, renderText(scene, std::string("--spp 2 --aov ") + aov)));
  }
}

TEST_CASE("where nothing is textured footprints change no bit", "[footprint]") {
  const std::string scene = "--spp 2 --width 48 --height 48 --footprint ";
  const Image none = renderFile(source("examples/cornell.scene"), scene + "none");
  for (const char* bound : {"pixel", "local", "global", "safe", "gradient", "paper"})
    CHECK(isSame(none, renderFile(source("examples/cornell.scene"), scene + bound)));
}

TEST_CASE("ray trees give the same picture as paths", "[footprint]") {
  const Image path = renderText(balls(kChecker, "path { depth 5 }", kSun), "--spp 1024");
  for (const char* tree :
       {"distributed { split 4 depth 5 } ", "distributed { split 6 depth 5 light_samples 2 }",
        "distributed { split 1 depth 5 }"}) {
    // As many rays for each: 256 camera rays of a tree with four, 96 with six, 1024 without.
    const char* spp = std::string(tree).find("split 1") != std::string::npos   ? "--spp 1024"
                      : std::string(tree).find("split 4") != std::string::npos ? "--spp 64"
                                                                               : "--spp 32";
    for (const char* bound : {"none", "safe"}) {
      const Image found =
          renderText(balls(kChecker, tree, kSun), std::string(spp) + " --footprint " + bound);
      INFO(tree << ", " << bound);
      for (int c = 0; c < 3; ++c) CHECK(mean(found, c) == Approx(mean(path, c)).epsilon(0.006));
      CHECK(std::sqrt(meanSquare(found, path)) < 0.12 * meanOf(path));
    }
  }
}

TEST_CASE("filtered pictures are the same for any number of threads", "[footprint]") {
  for (const char* integrator : {"path { depth 8 }", "distributed { split 4 depth 4 }"}) {
    const std::string scene = balls(kChecker, integrator, kSun);
    CHECK(
        isSame(renderText(scene, "--spp 3 --threads 1"), renderText(scene, "--spp 3 --threads 2")));
  }
}

TEST_CASE("a limit heeds the light if the scene says so", "[footprint]") {
  const std::string spot =
      "light spot { location <0, 3, 0> point_at <0, 0, 0> radius 2 falloff 40 intensity rgb 20 }";
  for (const char* integrator : {"path { depth 4", "distributed { depth 3"}) {
    const auto picture = [&](const std::string& footprint) {
      return renderText(
          balls(kChecker, std::string(integrator) + " footprint " + footprint + " }", spot),
          "--spp 16");
    };
    INFO(integrator);
    const Image constant = picture("gradient { light constant }");
    CHECK(isSame(picture("gradient { }"), constant));
    const Image exact = picture("gradient { light exact }");
    CHECK(!isSame(exact, constant));
    CHECK(meanOf(exact) == Approx(meanOf(constant)).epsilon(0.01));
    CHECK(isSame(picture("safe"), picture("safe { light exact }")));  // no limit, no matter
  }
}

TEST_CASE("few samples of a fine texture are quieter when filtered", "[footprint]") {
  const std::string fine = "checker { rgb 0.1, rgb 0.9 scale 0.05 }";
  const Image reference =
      renderText(balls(fine, "path { depth 5 }", kNoiseless), "--spp 4096 --footprint none");
  const auto error = [&](const std::string& integrator, const std::string& bound) {
    double sum = 0;
    for (int seed = 1; seed <= 4; ++seed)
      sum +=
          meanSquare(renderText(balls(fine, integrator, kNoiseless),
                                "--spp 1 --footprint " + bound + " --seed " + std::to_string(seed)),
                     reference, 0.3);
    return sum / 4;
  };
  const std::string tree = "distributed { split 4 depth 4 }";
  const double none = error(tree, "none");
  for (const char* bound : {"local", "safe", "gradient"}) {
    INFO(bound);
    CHECK(error(tree, bound) < 0.7 * none);
  }
  CHECK(error("path { depth 5 }", "safe") < 0.9 * error("path { depth 5 }", "none"));
}
