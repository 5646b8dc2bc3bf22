// SPDX-License-Identifier: Apache-2.0
// library/shapes.inc: the extents of what its macros make, against min_extent() and max_extent() of
// POV-Ray 3.7.0.10's objects of the same names.
#include "tests/lang/solids.h"

namespace vestige::lang::test {
namespace {

Result readShapes(const std::string& text) {
  Options options;
  options.includePaths = {std::string(VESTIGE_SOURCE_DIR) + "/library"};
  options.debug = [](const std::string&) {};
  return readSceneText("test.scene", "#include \"shapes.inc\"\n" + text, solids(), options);
}

}  // namespace

TEST_CASE("shapes.inc: extents are POV-Ray's", "[lang]") {
  struct Row {
    const char* text;
    double low[3], high[3];
  };
  // clang-format off
  const Row rows[] = {
      {"object { Sphere }", {-1, -1, -1}, {1, 1, 1}},
      {"object { Ellipsoid }", {-1, -1, -1}, {1, 1, 1}},
      {"object { UnitBox }", {-1, -1, -1}, {1, 1, 1}},
      {"object { Cube }", {-1, -1, -1}, {1, 1, 1}},
      {"object { Disk_X }", {-1, -1, -1}, {1, 1, 1}},
      {"object { Disk_Y }", {-1, -1, -1}, {1, 1, 1}},
      {"object { Disk_Z }", {-1, -1, -1}, {1, 1, 1}},
      {"object { Cone_X }", {-1, -1, -1}, {1, 1, 1}},
      {"object { Cone_Y }", {-1, -1, -1}, {1, 1, 1}},
      {"object { Cone_Z }", {-1, -1, -1}, {1, 1, 1}},
      {"object { Spheroid(<1,2,3>,<4,5,6>) }", {-3, -3, -3}, {5, 7, 9}},
      {"object { Connect_Spheres(<0,0,0>,1,<0,4,0>,0.5) }", {-0.992156744, 0.125, -0.992156744}, {0.992156744, 4.0625, 0.992156744}},
      {"object { Wire_Box(<0,0,0>,<1,2,3>,.1,0) }", {0, 0, 0}, {1, 2, 3}},
      {"object { Round_Box(<0,0,0>,<1,2,3>,.1,0) }", {0, 0, 0}, {1, 2, 3}},
      {"object { Round_Cylinder(<0,0,0>,<0,2,0>,1,.1,0) }", {-1, 0, -1}, {1, 2, 1}},
      {"object { Round_Cone(<0,0,0>,1,<0,2,0>,.5,.1,0) }", {-0.971922338, 0, -0.971922338}, {0.971922338, 2, 0.971922338}},
      {"object { Round_Cone2(<0,0,0>,1,<0,2,0>,.5,0) }", {-1, -1, -1}, {1, 2.5, 1}},
      {"object { Round_Cone3(<0,0,0>,1,<0,2,0>,.5,0) }", {-1.030776381, -1.280776381, -1.030776381}, {1.030776381, 2.390388012, 1.030776381}},
  };
  // clang-format on
  for (const Row& row : rows) {
    const Result r = readShapes(row.text);
    INFO(row.text);
    INFO(printed(r));
    REQUIRE(r.diagnostics.list().empty());
    Extents e;
    for (const Block& b : r.scene.blocks) add(e, b);
    for (int i = 0; i < 3; ++i) {
      CHECK(std::abs(e.low[i] - row.low[i]) < 2e-7);  // POV-Ray's boxes are in single precision
      CHECK(std::abs(e.high[i] - row.high[i]) < 2e-7);
    }
  }
}

TEST_CASE("shapes.inc: included twice; quads and tables are unions", "[lang]") {
  const Result r = readShapes(
      "#include \"shapes.inc\"\nTable(<-1, -1, -1>, <1, 1, 1>, 0.1) "
      "Quad(<0, 0, 0>, <1, 0, 0>, <1, 1, 0>, <0, 1, 0>)");
  INFO(printed(r));
  CHECK(r.diagnostics.list().empty());
  REQUIRE(r.scene.blocks.size() == 2);
  CHECK(r.scene.blocks[0].children.size() == 5);
  CHECK(r.scene.blocks[1].children.size() == 2);
}

TEST_CASE("shapes.inc: what is not available is one clear error", "[lang]") {
  const auto message = [](const std::string& text) {
    const Result r = readShapes(text);
    std::string all;
    for (const Diagnostic& d : r.diagnostics.list())
      if (d.severity == Severity::error) all += d.message + '\n';
    return all;
  };
  CHECK_THAT(message("Wedge(30)"), containsText("Wedge() is not available"));
  CHECK_THAT(message("Circle_Text(\"f\", \"s\", 1, 0, 1, 2, 0, Align_Left, 0)"),
             containsText("Circle_Text() is not available"));
  CHECK_THAT(message("Round_Box(0, 1, 0.1, 1)"), containsText("use the union, UseMerge 0"));
}

}  // namespace vestige::lang::test
