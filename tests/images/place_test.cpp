// SPDX-License-Identifier: Apache-2.0
// A picture does not depend on where its scene stands, nor on the unit of length.
//
// [Lam60] Lambert. Photometria. 1760: irradiance from a polygon of even radiance.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <vector>

#include "images/picture.h"

namespace vestige::test {
namespace {

struct Move {
  double shift = 0, scale = 1;
};
std::string text(const Move& p) {
  // Not along an axis, nor by numbers of few bits.
  const double d = p.shift * p.scale;
  return fmt::format("scale {} translate <{}, {}, {}>", p.scale, d, -0.37 * d, 0.73 * d);
}
std::string moved(const std::string& block, const Move& p) { return block + text(p) + " }\n"; }

constexpr double kSize = 10;  ///< of the rooms below, scene units

std::string lightText(int light, const Move& p) {
  const double intensity = p.scale * p.scale;
  switch (light) {
    case 0:
      return moved("light area { <-1, 4, -1>, <2, 0, 0>, <0, 0, 2> radiance rgb 3 ", p);
    case 1:
      return moved(fmt::format("light point {{ <-3, 3, -2> intensity rgb {} ", 8 * intensity), p);
    case 2:
      return moved(fmt::format("light spot {{ <3, 4, -3> intensity rgb {} point_at <0, 0, 0> "
                               "radius 20 falloff 35 ",
                               15 * intensity),
                   p);
    case 3:
      return moved("light distant { direction <1, -2, 0.5> irradiance rgb 0.7 ", p);
    default:
      return "light environment { \"" + source("examples/assets/studio.hdr").string() +
             "\" radiance rgb 0.3 }\n";
  }
}
constexpr int kLights = 5;

std::string shapeText(int shape, const std::string& material) {
  switch (shape) {
    case 0:
      return "sphere { <-2.2, 1, 1>, 1 " + material + " }\n";
    case 1:
      return "box { <-0.8, 0.1, 0.5>, <0.6, 1.5, 1.5> " + material + " }\n";
    case 2:
      return "cylinder { <2.2, 0.2, 1>, <2.2, 2, 1.4>, 0.6 " + material + " }\n";
    case 3:
      return "disc { <-1.9, 0.6, -1.6>, <0.2, -1, 0.3>, 0.8 " + material + " }\n";
    case 4:
      return "torus { 0.7, 0.25 " + material + " translate <0.2, 0.6, -1.5> }\n";
    default:
      return "mesh { \"" + source("examples/assets/spot/spot_triangulated.obj").string() + "\" " +
             material + " rotate <0, 130, 0> translate <2.2, 0.8, -1.4> }\n";
  }
}
constexpr int kShapes = 6;

std::string cameraText(const Move& p) {
  return moved("camera pinhole { location <0.3, 4, -8> look_at <0, 0.8, 0> angle 50 ", p) +
         "film { resolution <48, 36> filter \"box\" }\n";
}

/// A patterned floor, a wall with a pattern, and these shapes between them.
std::string roomText(const std::string& shapes, const Move& p) {
  return moved(
      "union {\n plane { y, 0 brdf lambert { diffuse pigment checker { rgb 0.8, rgb 0.3 } "
      "} }\n quad { <-5, 0, 4>, <10, 0, 0>, <0, 6, 0> brdf lambert { diffuse pigment bozo "
      "{ } } }\n" +
          shapes,
      p);
}

Image picture(const std::string& scene, int samples) {
  return renderText("integrator path { depth 3 }\n" + scene, fmt::format("--spp {}", samples));
}

/// Blocks of 12 x 12 pixels: the largest difference of their means, relative to the expected one
/// (to a tenth of the picture's mean, where a block is darker).
double difference(const Image& is, const Image& expected) {
  constexpr int kBlock = 12;
  double worst = 0;
  const double floor = 0.1 * mean(expected, 1);
  for (int y = 0; y + kBlock <= is.height; y += kBlock)
    for (int x = 0; x + kBlock <= is.width; x += kBlock) {
      double a = 0, b = 0;
      for (int k = 0; k < kBlock * kBlock; ++k) {
        a += double(is.at(x + k % kBlock, y + k / kBlock)[1]) / (kBlock * kBlock);
        b += double(expected.at(x + k % kBlock, y + k / kBlock)[1]) / (kBlock * kBlock);
      }
      worst = std::max(worst, std::abs(a - b) / std::max(b, floor));
    }
  return worst;
}

/// `scene` says what stands at a place. Its random numbers are the same everywhere, so few samples
/// tell.
template <class Scene>
void checkEverywhere(const Scene& scene, int samples, const std::vector<Move>& moves) {
  const Image expected = picture(scene(Move{}), samples);
  REQUIRE(mean(expected, 1) > 0.01);
  for (const Move& p : moves) {
    INFO("shift " << p.shift << ", scale " << p.scale);
    CHECK(difference(picture(scene(p), samples), expected) < 0.005);
  }
}

const std::vector<Move> kFew = {{1e4 * kSize, 1}, {100 * kSize, 1e-3}, {0, 1e3}};
std::vector<Move> allMoves() {
  std::vector<Move> all;
  for (const double shift : {0.0, 100.0, 1e4})
    for (const double scale : {1e-3, 1.0, 1e3})
      if (shift != 0 || scale != 1) all.push_back({shift * kSize, scale});
  return all;
}

std::string shining(int shape) { return shapeText(shape, "emission rgb 2"); }
std::string dull(int shape) {
  return shapeText(shape, "brdf lambert { diffuse pigment granite { } }");
}

struct Corner {
  double x, y, z;
};
/// [Lam60] Irradiance at the origin of a floor, normal +y, by a polygon above it of radiance 1;
/// corners run round so that it is positive where the polygon shines down.
double polygonIrradiance(const std::vector<Corner>& corners) {
  double sum = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Corner &a = corners[i], &b = corners[(i + 1) % corners.size()];
    const Corner n{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    const double across = std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
    sum += std::atan2(across, a.x * b.x + a.y * b.y + a.z * b.z) * n.y / across;
  }
  return std::abs(sum) / 2;
}

/// A lamp of half a square unit, 1 above the floor, radiance 1, seen from <x, 0, z>.
double lampIrradiance(double x, double z) {
  return polygonIrradiance({{-0.5 - x, 1, -0.25 - z},
                            {0.5 - x, 1, -0.25 - z},
                            {0.5 - x, 1, 0.25 - z},
                            {-0.5 - x, 1, 0.25 - z}});
}

/// The floor beside that lamp, to `reach` along x in one row of pixels, against the closed form:
/// the largest relative error of a pixel.
double floorError(double reach, const std::string& floor, const std::string& at) {
  constexpr int kPixels = 40;
  constexpr double kRadiance = 1e7;
  const Image row = renderText(
      fmt::format("camera orthographic {{ location <{0}, 0.5, 0> look_at <{0}, 0, 0> sky z "
                  "width {1} {2} }}\n"
                  "film {{ resolution <{3}, 1> filter \"box\" }}\n"
                  "integrator path {{ depth 2 }}\n"
                  "light area {{ <-0.5, 1, -0.25>, <1, 0, 0>, <0, 0, 0.5> radiance rgb {4} {2} }}\n"
                  "{5} {2} }}\n",
                  reach / 2, reach, at, kPixels, kRadiance, floor),
      "--spp 1024");
  double worst = 0;
  const double side = reach / kPixels;
  // The first pixel, right under the lamp, varies too much within.
  for (int i = 1; i < kPixels; ++i) {
    double sum = 0;
    constexpr int n = 64;
    for (int k = 0; k < n * n; ++k)
      sum += lampIrradiance((i + (k % n + 0.5) / n) * side, ((k / n + 0.5) / n - 0.5) * side);
    const double expected = 0.5 / kPi * kRadiance * sum / (n * n);
    worst = std::max(worst, std::abs(double(row.at(i, 0)[1]) / expected - 1));
  }
  return worst;
}

const std::string kPlane = "plane { y, 0 brdf lambert { diffuse rgb 0.5 }";
const std::string kFloor =
    "quad { <-300, 0, -300>, <0, 0, 600>, <600, 0, 0> brdf lambert { diffuse rgb 0.5 }";

}  // namespace

TEST_CASE("five lights shine the same wherever their scene stands", "[images]") {
  checkEverywhere(
      [](const Move& p) {
        std::string scene = cameraText(p);
        for (int l = 0; l < kLights; ++l) scene += lightText(l, p);
        std::string shapes;
        for (int s = 0; s < kShapes; ++s) shapes += dull(s);
        return scene + roomText(shapes, p);
      },
      16, kFew);
}

TEST_CASE("six shining shapes shine the same wherever their scene stands", "[images]") {
  checkEverywhere(
      [](const Move& p) {
        std::string shapes;
        for (int s = 0; s < kShapes; ++s) shapes += shining(s);
        return cameraText(p) + roomText(shapes, p);
      },
      16, kFew);
}

TEST_CASE("each light and shining shape is the same wherever its scene stands", "[images][slow]") {
  for (int l = 0; l < kLights; ++l)
    for (int s = 0; s < kShapes; ++s) {
      INFO("light " << l << ", shape " << s);
      checkEverywhere(
          [&](const Move& p) { return cameraText(p) + lightText(l, p) + roomText(dull(s), p); }, 64,
          allMoves());
    }
  for (int s = 0; s < kShapes; ++s) {
    INFO("shining shape " << s);
    checkEverywhere([&](const Move& p) { return cameraText(p) + roomText(shining(s), p); }, 64,
                    allMoves());
  }
}

TEST_CASE("a floor under a lamp is lit to 200 times the lamp's height", "[images]") {
  CHECK(floorError(200, kPlane, "") < 0.01);
  CHECK(floorError(200, kFloor, "") < 0.01);
  CHECK(floorError(10, kFloor, "translate <100, 0, 0>") < 0.01);
  CHECK(floorError(10, kFloor, "translate <1000, 500, 0>") < 0.01);
  CHECK(floorError(200, kPlane, "translate <1e4, 1e4, 1e4>") < 0.01);
  CHECK(floorError(200, kPlane, "scale 1e-3 translate <3, 0, 3>") < 0.01);
}

TEST_CASE("a room whose walls shine is lit by all of them, whatever its coordinates", "[images]") {
  // From every point all directions meet a wall: radiance e, then e (1 + reflectance).
  const std::string wall =
      " emission rgb 1 emission_sides \"both\" brdf lambert { diffuse rgb 0.5 } }\n";
  for (const double far : {0.0, 100.0, 3000.0}) {
    const std::string x = fmt::format("{}", far), more = fmt::format("{}", far + 1);
    const std::string shapes[] = {
        fmt::format("sphere {{ <{0}, {0}, {0}>, 1 {1}", x, wall),
        fmt::format("box {{ <{0}, {0}, {0}>, <{2}, {2}, {2}> {1}", x, wall, more),
        fmt::format("box {{ <0, 0, 0>, <1, 1, 1> rotate <20, 30, 0> translate <{0}, {0}, {0}> {1}",
                    x, wall)};
    for (const std::string& shape : shapes) {
      INFO(shape);
      const Image image =
          renderText(fmt::format("camera pinhole {{ location <{0}, {0}, {0}> look_at <{1}, {0}, "
                                 "{2}> angle 120 }}\n"
                                 "integrator path {{ depth 2 }}\n{3}",
                                 far + 0.31, far + 0.9, far + 0.55, shape),
                     "--width 16 --height 16 --spp 64");
      CHECK(mean(image, 1) == Approx(1.5).epsilon(0.005));
    }
  }
}

TEST_CASE("what stands close to a lamp does not change its light", "[images]") {
  struct Case {
    const char* what;
    std::string block;
    double share;
  };
  // A wall behind the lamp, almost touching; a shade around it that lets half of the light through.
  const Case cases[] = {
      {"wall", "quad { <-9, 1.0001, -9>, <18, 0, 0>, <0, 0, 18> brdf lambert { diffuse rgb 0 }", 1},
      {"shade", "sphere { <0, 1, 0>, 0.8 brdf lambert { diffuse rgb 0 opacity 0.5 }", 0.5}};
  for (const std::string at : {"", "translate <1000, 0, 1000>", "scale 1e-3 translate <9, 9, 0>"})
    for (const Case& c : cases) {
      INFO(c.what << " " << at);
      const Image image = renderText(
          fmt::format("camera orthographic {{ location <2, 0.1, 0> look_at <2, 0, 0> sky z "
                      "width 0.001 {0} }}\n"
                      "integrator path {{ depth 2 }}\n"
                      "light area {{ <-0.5, 1, -0.25>, <1, 0, 0>, <0, 0, 0.5> radiance rgb 10 {0} "
                      "}}\n{1} {0} }}\n{2} {0} }}\n",
                      at, kFloor, c.block),
          "--width 16 --height 16 --spp 256");
      CHECK(mean(image, 1) ==
            Approx(c.share * 10 * 0.5 / kPi * lampIrradiance(2, 0)).epsilon(0.005));
    }
}

}  // namespace vestige::test
