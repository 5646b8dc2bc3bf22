// SPDX-License-Identifier: Apache-2.0
// The plugin's pictures beside those of paths: of what is diffuse, glossy, let through, seen in
// mirrors, under open sky.
#include <fstream>

#include "particle/picture.h"
#include "particle/solve.h"
#include "support/temp_folder.h"

using namespace vestige;
using namespace vestige::particle;

namespace {

/// Its normals lean by up to 55 degrees: what arrives is not what the flat face would say.
std::string octahedron() {
  static const test::TempFolder folder;
  const std::string file = folder / "octahedron.obj";
  std::ofstream(file) << "v 1 0 0\nv -1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nv 0 0 -1\n"
                         "f 1 3 5\nf 3 2 5\nf 2 4 5\nf 4 1 5\n"
                         "f 3 1 6\nf 2 3 6\nf 4 2 6\nf 1 4 6\n";
  return file;
}

const std::pair<const char*, std::string> kScenes[] = {
    {"a diffuse ball", kWalls + "sphere { <1, 0.6, 1.2>, 0.5 }\n"},
    {"screens that let light through", kWalls + "quad { <0.2, 0.2, 1>, <1.6, 0, 0>, <0, 1.6, 0> "
                                                "brdf lambert { diffuse rgb 0.8 opacity 0.4 } }\n"
                                                "quad { <0.4, 0.4, 1.3>, <1.2, 0, 0>, <0, 1.2, 0> "
                                                "brdf lambert { diffuse rgb 0.2 opacity 0.6 } }\n"},
    {"paint", kWalls +
                  "sphere { <1, 0.6, 1.2>, 0.5 brdf principled { base_color rgb <0.7, 0.2, 0.1> "
                  "roughness 0.4 } }\n"},
    {"a mirror", kWalls + "quad { <0.2, 0.2, 1.9>, <1.6, 0, 0>, <0, 1.6, 0> brdf mirror { } }\n"},
    {"a black checker on a wide board",
     kWalls +
         "box { <0.3, 0.3, 1>, <1.7, 1.2, 1.5> brdf lambert { diffuse pigment checker { rgb 0, "
         "rgb 0.9 scale 0.05 } } }\n"},
    {"under open sky",
     "camera pinhole { location <0, 2, -6> look_at <0, 0.5, 0> angle 60 }\n"
     "light distant { direction <0.3, -1, 0.4> irradiance rgb 2 }\n"
     "light environment { radiance rgb <0.2, 0.3, 0.4> }\n"
     "plane { y, 0 brdf lambert { diffuse rgb 0.5 } }\nsphere { <0, 1, 0>, 1 }\n"},
    {"an octahedron with smooth normals",
     kWalls + "mesh { \"" + octahedron() +
         "\" smooth true smooth_angle 180 "
         "brdf lambert { diffuse rgb 0.7 } scale 0.7 translate <1, 0.8, 1.1> }\n"},
    {"a mesh with smooth normals",
     kWalls + "mesh { \"" VESTIGE_SOURCE_DIR "/examples/assets/spot/spot_triangulated.obj\" smooth "
              "true brdf lambert { diffuse rgb 0.7 } scale 0.7 translate <1, 0.7, 1.1> }\n"}};

}  // namespace

TEST_CASE("particles and paths agree on pictures", "[particle]") {
  for (const auto& [name, text] : kScenes) {
    const Picture paths = pictureOf(text, "path { depth 60 }", 64);
    for (const char* show : {"smooth", "elements", "gather"}) {
      const Picture p = pictureOf(
          text, "particle { particles 100000 depth 60 show \"" + std::string(show) + "\" }", 16);
      std::printf("picture;%s;%s;particles over paths;%.4f\n", name, show, p.mean / paths.mean);
      INFO(name << ", " << show);
      CHECK(p.mean == Approx(paths.mean).epsilon(0.03));
      double albedo = 0, wanted = 0;
      for (std::size_t i = 0; i < p.albedo.size(); ++i)
        albedo += p.albedo[i], wanted += paths.albedo[i];
      // A bent normal refuses some of the directions that paths draw.
      const bool isBent = std::string(name).find("smooth normals") != std::string::npos;
      CHECK(albedo == Approx(wanted).epsilon(isBent ? 0.1 : 0.03));
    }
  }
}

TEST_CASE("clusters keep all flux, and keep it on diffuse surfaces", "[particle]") {
  // Mirrors and lamps lie in one plane with diffuse tiles, a carpet on the floor.
  std::string tiles = kWalls;
  for (int i = 0; i < 16; ++i) {
    const std::string x = std::to_string(0.5 * (i % 4)), z = std::to_string(0.5 * (i / 4));
    tiles += "quad { <" + x + ", 0.01, " + z + ">, <0, 0, 0.5>, <0.5, 0, 0> brdf " +
             (i % 3 ? "lambert { diffuse rgb 0.5 }" : "mirror { }") + " }\n";
  }
  HierarchySettings how = settings(Oracle::footprint, true);
  how.edges = false;
  for (const std::string& text : {kWalls, tiles}) {
    const Solution s = solve(text, 3000, how);
    double clustered = 0, deposited = 0;
    for (ElementId e = s.hierarchy->firstCluster(); e < s.hierarchy->clusterEnd(); ++e)
      clustered += double(s.hierarchy->elements()[e].sum()[0]);
    for (ElementId e = 1; e < s.hierarchy->elements().size(); ++e)
      deposited += double(s.hierarchy->elements()[e].sum()[0]);
    if (&text != &kWalls && text.size() > kWalls.size()) CHECK(clustered > 0);
    const Irradiance light(s.scene->view(), *s.hierarchy, 1);
    double seen = 0;
    const auto patches = s.scene->view().patches();
    for (std::size_t i = 0; i < patches.size(); ++i)
      for (const bool back : {false, true})
        for (int k = 0; k < 4096 && s.hierarchy->keeps({int(i), back, {Real(0.5), Real(0.25)}});
             ++k)  // finer than the elements, but for a few
        {
          const Vec2 uv = {(Real(k % 64) + Real(0.5)) / 64, (Real(k / 64) + Real(0.5)) / 64};
          seen += double(light.at({int(i), back, uv}, false).r) * double(patches[i].area) / 4096;
        }
    CHECK(seen == Approx(deposited).epsilon(0.01));
  }
}

TEST_CASE("a picture by particles is the same for any number of threads", "[particle]") {
  const std::string by = "particle { particles 20000 }";
  CHECK(pictureOf(kScenes[0].second, by, 2, 1).grey == pictureOf(kScenes[0].second, by, 2, 3).grey);
}

TEST_CASE("what is glossy stays black where rays are not wanted", "[particle]") {
  const std::string text = kScenes[3].second;  // the mirror covers the middle
  const std::size_t middle = 16 * 32 + 16;
  CHECK(pictureOf(text, "particle { particles 20000 glossy off }", 4).grey[middle] == 0);
  CHECK(pictureOf(text, "particle { particles 20000 }", 4).grey[middle] > 0.1);
}

TEST_CASE("wires are where elements end", "[particle]") {
  const std::string text = kScenes[0].second;
  const Picture bare = pictureOf(text, "particle { particles 50000 show \"elements\" }", 4);
  const Picture wires =
      pictureOf(text, "particle { particles 50000 show \"elements\" wires on }", 4);
  int darker = 0;
  for (std::size_t i = 0; i < bare.grey.size(); ++i) {
    CHECK(wires.grey[i] <= bare.grey[i] * 1.0001);
    darker += wires.grey[i] < 0.9 * bare.grey[i];
  }
  CHECK(darker > 50);
  CHECK(darker < 32 * 32);
  double level = 0;
  for (const double l : bare.level) level += l;
  CHECK(level > 32 * 32);
}
