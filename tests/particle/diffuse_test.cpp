// SPDX-License-Identifier: Apache-2.0
// Where light is kept: a diffuse part never gets lost, however much of its object looks black and
// whatever the object's shape offers.
#include <fstream>

#include "particle/picture.h"
#include "support/small_png.h"
#include "support/temp_folder.h"

using namespace vestige;
using namespace vestige::particle;

namespace {

/// A square grey image, raw: `bright` says where it is white, by uv in [0,1]^2.
template <class Bright>
std::string image(const test::TempFolder& folder, const std::string& name, int size,
                  Bright bright) {
  std::vector<int> codes;
  for (int y = size - 1; y >= 0; --y)  // PNG begins with the top row, v with the bottom one
    for (int x = 0; x < size; ++x)
      codes.push_back(bright((x + 0.5) / size, (y + 0.5) / size) ? 255 : 0);
  test::writePng(folder / name, size, size, 1, 8, codes);
  return "pigment image { \"" + folder / name + "\" color_space \"raw\" }";
}

/// In front of the back wall, across most of the view.
std::string board(const std::string& brdf) {
  return "quad { <0.2, 0.2, 1.6>, <1.6, 0, 0>, <0, 1.6, 0> brdf " + brdf + " }\n";
}

/// A grid of n x n squares in the plane z = 0, from <0, 0> to <1, 1>, row by row.
std::string grid(const test::TempFolder& folder, int n) {
  const std::string file = folder / "grid.obj";
  std::ofstream out(file);
  for (const char* kind : {"v", "vt"})
    for (int y = 0; y <= n; ++y)
      for (int x = 0; x <= n; ++x) {
        out << kind << ' ' << double(x) / n << ' ' << double(y) / n;
        out << (kind[1] ? "\n" : " 0\n");
      }
  const auto corner = [&](int x, int y) {
    const std::string i = std::to_string(y * (n + 1) + x + 1);
    return ' ' + i + '/' + i;
  };
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      out << 'f' << corner(x, y) << corner(x + 1, y) << corner(x + 1, y + 1) << '\n';
      out << 'f' << corner(x, y) << corner(x + 1, y + 1) << corner(x, y + 1) << '\n';
    }
  return file;
}

void checkAgainstPaths(const std::string& name, const std::string& text,
                       const std::string& settings = "") {
  const Picture paths = pictureOf(text, "path { depth 30 }", 64);
  const Picture p = pictureOf(text, "particle { particles 60000 depth 30 " + settings + " }", 16);
  std::printf("diffuse;%s;particles over paths;%.4f\n", name.c_str(), p.mean / paths.mean);
  INFO(name);
  CHECK(p.mean == Approx(paths.mean).epsilon(0.03));
}

}  // namespace

TEST_CASE("an object whose first points look black keeps its light", "[particle]") {
  const test::TempFolder folder;
  const auto isLeft = [](double u, double v) { return u < 0.65 && v < 0.5; };
  const std::string corner =
      image(folder, "corner.png", 20, [&](double u, double v) { return !isLeft(u, v); });
  const std::string metal = image(folder, "metal.png", 20, isLeft);
  const std::string framed = image(folder, "framed.png", 40, [](double u, double v) {
    return std::min({u, v, 1 - u, 1 - v}) > 0.075;
  });
  checkAgainstPaths("quad with a black corner",
                    kWalls + board("lambert { diffuse " + corner + " }"));
  checkAgainstPaths(
      "quad with a metal corner",
      kWalls + board("principled { base_color rgb 0.8 roughness 0.4 metallic " + metal + " }"));
  checkAgainstPaths("mesh with a black border", kWalls + "mesh { \"" + grid(folder, 40) +
                                                    "\" brdf lambert { diffuse " + framed +
                                                    " } scale 1.6 translate <0.2, 0.2, 1.6> }\n");
}

TEST_CASE("what looks black wherever it is looked at is left to rays", "[particle]") {
  const test::TempFolder folder;
  // One texel of 1024 is white. The picture shows it and little else.
  const std::string speck = image(folder, "speck.png", 32, [](double u, double v) {
    return int(u * 32) == 8 && int(v * 32) == 20;
  });
  std::string text = kWalls + board("lambert { diffuse " + speck + " }");
  const std::size_t end = text.find('\n');
  text = "camera pinhole { location <0.6, 1.2, 0.1> look_at <0.625, 1.225, 1.6> angle 2 }" +
         text.substr(end);
  const auto scene = test::sceneOf(text);
  Surface s;
  REQUIRE(scene->view().intersect({{Real(0.625), Real(1.225), 1}, {0, 0, 1}, 0, kInfinity}, s));
  InputBuffer inputs;
  const Interaction x = scene->view().shade(s, {0, 0, -1}, {}, inputs);
  REQUIRE(x.brdf->diffuse(x.point).albedo.r > 0.5);
  REQUIRE_FALSE(Hierarchy(scene->view(), HierarchySettings{}).keeps(patchPointOf(s, {0, 0, -1})));
  for (const char* settings : {"", "show \"gather\"", "glossy off"})
    checkAgainstPaths(std::string("a white speck ") + settings, text, settings);
}

TEST_CASE("a shape without patches is lit by rays", "[particle]") {
  std::vector<std::string> refused;
  const Registry plugins = Registry::load({VESTIGE_PLUGINS, VESTIGE_FACELESS}, refused);
  REQUIRE(refused.empty());
  // Written last: its number is greater than that of any object with patches.
  const std::string text =
      kWalls + "faceless { <0.3, 0.5, 0.6>, 1.3 brdf lambert { diffuse rgb 0.7 } }\n";
  const Picture paths = pictureOf(text, "path { depth 30 }", 64, 2, plugins);
  for (const char* show : {"smooth", "gather"}) {
    const Picture p =
        pictureOf(text, "particle { particles 60000 depth 30 show \"" + std::string(show) + "\" }",
                  16, 2, plugins);
    INFO(show);
    CHECK(p.mean == Approx(paths.mean).epsilon(0.03));
  }
}

TEST_CASE("a scene without any patch is lit by rays", "[particle]") {
  std::vector<std::string> refused;
  const Registry plugins = Registry::load({VESTIGE_PLUGINS, VESTIGE_FACELESS}, refused);
  const std::string text =
      "camera pinhole { location <1, 3, 1> look_at <1, 0, 1.1> angle 20 }\n"
      "light point { <1, 2, 1> intensity rgb 3 }\n"
      "faceless { <0, 0, 0>, 2 brdf lambert { diffuse rgb 0.7 } }\n";
  const Picture paths = pictureOf(text, "path { }", 16, 2, plugins);
  const Picture p = pictureOf(text, "particle { particles 2000 }", 16, 2, plugins);
  REQUIRE(paths.mean > 0.1);
  CHECK(p.mean == Approx(paths.mean).epsilon(0.01));
}

TEST_CASE("a dark scene has a picture and AOVs", "[particle]") {
  const Picture p = pictureOf(box("brdf lambert { diffuse rgb 0.5 }"), "particle { }", 1);
  CHECK(p.mean == 0);
  for (const double level : p.level) CHECK(level == 0);
}
