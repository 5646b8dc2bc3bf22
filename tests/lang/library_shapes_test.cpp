// SPDX-License-Identifier: Apache-2.0
// library/shapes.inc: the extents of what its macros make, against min_extent() and max_extent() of
// POV-Ray 3.7.0.10's objects of the same names.
#include "support/catch.h"

#include <cmath>

#include "tests/lang/schemas.h"

namespace vestige::lang::test {
namespace {

const SchemaSource& solids() {
  static const vestige::test::SchemaList all = [] {
    const auto point = [](const char* name) { return vec3(name, {}).need().place(); };
    const auto length = [](const char* name) { return real(name, 1).need().place(); };
    std::vector<Schema> s;
    s.push_back({"shape", "sphere", "", {point("a"), length("r")}});
    s.push_back({"shape", "box", "", {point("a"), point("b")}});
    s.push_back({"shape", "cylinder", "", {point("a"), point("b"), length("r")}});
    s.push_back({"shape", "cone", "", {point("a"), length("r"), point("b"), length("s")}});
    s.push_back({"shape", "torus", "", {length("big"), length("r")}});
    s.push_back({"shape", "plane", "", {point("normal"), real("distance", 0).place()}});
    s.push_back({"shape", "triangle", "", {point("a"), point("b"), point("c")}});
    s.push_back({"union", "", "", {}, {}, {"shape", "union"}});
    for (Schema& each : s) each.standsAlone = each.isMovable = true;
    return vestige::test::SchemaList(s);
  }();
  return all;
}

struct Extents {
  double low[3] = {1e30, 1e30, 1e30}, high[3] = {-1e30, -1e30, -1e30};
};

double number(const Block& b, const char* name) { return b.find(name) ? b.find(name)->v[0] : 0; }

/// Grows by a disc, a ball (no normal) or a point, around a place in the block's own space.
void grow(Extents& e, const Block& b, const double* at, const double* normal, double radius,
          double pad) {
  const auto& m = b.world.m;
  double n[3] = {0, 0, 0}, length = 0;
  for (int i = 0; i < 3 && normal; ++i) {
    for (int k = 0; k < 3; ++k) n[i] += m[std::size_t(i)][std::size_t(k)] * normal[k];
    length += n[i] * n[i];
  }
  for (int i = 0; i < 3; ++i) {
    const auto& row = m[std::size_t(i)];
    const double c = row[0] * at[0] + row[1] * at[1] + row[2] * at[2] + row[3];
    const double scale = std::hypot(row[0], row[1], row[2]);
    const double cosine2 = length > 0 ? n[i] * n[i] / length : 0;
    const double r = radius * std::sqrt(std::max(0.0, 1 - cosine2)) * scale + pad * scale;
    e.low[i] = std::min(e.low[i], c - r), e.high[i] = std::max(e.high[i], c + r);
  }
}

void add(Extents& e, const Block& b) {
  for (const Block& child : b.children) add(e, child);
  if (b.kind != "shape") return;
  const double origin[3] = {0, 0, 0}, up[3] = {0, 1, 0};
  if (b.plugin == "torus") return grow(e, b, origin, up, number(b, "big"), number(b, "r"));
  const bool isRound = b.plugin == "cylinder" || b.plugin == "cone";
  double axis[3] = {0, 0, 0};
  for (int i = 0; i < 3 && isRound; ++i) axis[i] = b.find("b")->v[i] - b.find("a")->v[i];
  const double* const normal = isRound ? axis : nullptr;
  const double last = b.plugin == "cone" ? number(b, "s") : number(b, "r");
  grow(e, b, b.find("a")->v, normal, number(b, "r"), 0);
  if (b.find("b")) grow(e, b, b.find("b")->v, normal, last, 0);
  if (b.find("c")) grow(e, b, b.find("c")->v, nullptr, 0, 0);
}

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
