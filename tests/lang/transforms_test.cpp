// SPDX-License-Identifier: Apache-2.0
// Where things stand. Numbers marked POV-Ray were printed by POV-Ray 3.7.0.10 through
// `#declare F = function { transform { ... } }` and `F(x, y, z)`.
#include "support/catch.h"

#include "tests/lang/schemas.h"

namespace vestige::lang::test {
namespace {

struct Point {
  double x, y, z;
};

Point apply(const Affine& a, Point p) {
  const auto row = [&](int i) {
    return a.m[i][0] * p.x + a.m[i][1] * p.y + a.m[i][2] * p.z + a.m[i][3];
  };
  return {row(0), row(1), row(2)};
}

void check(Point found, Point expected) {
  CHECK(found.x == Approx(expected.x).margin(1e-9));
  CHECK(found.y == Approx(expected.y).margin(1e-9));
  CHECK(found.z == Approx(expected.z).margin(1e-9));
}

Block ball(const std::string& transforms) {
  return scene("sphere { 0, 1 " + transforms + " }").blocks[0];
}

}  // namespace

TEST_CASE("transforms are POV-Ray's", "[lang]") {
  struct Row {
    const char* text;
    Point p, q;
  };
  const Row rows[] = {
      // POV-Ray
      {"rotate 90*y translate 2*x", {1, 0, 0}, {2, 0, -1}},
      {"rotate 90*z", {1, 0, 0}, {0, 1, 0}},
      {"rotate 90*x", {0, 1, 0}, {0, 0, 1}},
      {"matrix <1,2,3, 4,5,6, 7,8,10, 11,12,13>", {1, 2, 3}, {41, 48, 58}},
      {"rotate <10,20,30> scale <1,2,3> translate <4,5,6>",
       {1, 2, 3},
       {5.067425379, 9.578118965, 14.281744243}},
      {"transform { rotate <10,20,30> translate <4,5,6> inverse }",
       {1, 2, 3},
       {-2.824871545, -1.814311260, -3.965901588}},
      {"translate x scale 2 transform { rotate 90*z inverse } translate y", {1, 2, 3}, {4, -3, 6}},
      {"scale <2, 0, 2>", {1, 1, 1}, {2, 1, 2}},
  };
  for (const Row& row : rows) {
    INFO(row.text);
    check(apply(ball(row.text).world, row.p), row.q);
    check(apply(ball(row.text).own, row.p), row.q);
    check(apply(ball("transform { " + std::string(row.text) + " }").world, row.p), row.q);
  }
}

TEST_CASE("transforms are named and used", "[lang]") {
  const std::string declared = "#declare T = transform { rotate 90*y translate 2*x };";
  for (const char* use : {"transform T", "transform { T }"})
    check(apply(scene(declared + "sphere { 0, 1 " + use + " }").blocks[0].world, {1, 0, 0}),
          {2, 0, -1});
  check(apply(scene(declared + "sphere { 0, 1 transform { T inverse } }").blocks[0].world,
              {2, 0, -1}),
        {1, 0, 0});
}

TEST_CASE("a transform moves what stands before it", "[lang]") {
  const Block b = ball(
      "translate x brdf lambert { diffuse pigment checker { rgb 1, rgb 0 scale 2 } translate z } "
      "translate 10*y");
  check(apply(b.world, {0, 0, 0}), {1, 10, 0});
  const Block* brdf = b.child("brdf");
  REQUIRE(brdf);
  check(apply(brdf->world, {0, 0, 0}), {0, 10, 1});  // not x: written before it
  check(apply(brdf->own, {0, 0, 0}), {0, 0, 1});
  const Block& pigment = *brdf->find("diffuse")->block;
  check(apply(pigment.world, {1, 1, 1}), {2, 12, 3});  // its own scale, then z, then y
  check(apply(pigment.own, {1, 1, 1}), {2, 2, 2});
}

TEST_CASE("a union moves its parts, whose own transforms stay theirs", "[lang]") {
  const Block u =
      scene(
          "union { sphere { 0, 1 scale 2 } box { 0, 1 } translate x sphere { 0, 3 } rotate 90*z }")
          .blocks[0];
  REQUIRE(u.children.size() == 3);
  check(apply(u.children[0].world, {1, 0, 0}), {0, 3, 0});
  check(apply(u.children[0].own, {1, 0, 0}), {2, 0, 0});
  check(apply(u.children[1].world, {0, 0, 0}), {0, 1, 0});
  CHECK(u.children[1].own.isIdentity());
  check(apply(u.children[2].world, {1, 0, 0}), {0, 1, 0});  // after the translate
}

TEST_CASE("copies of a declared block move apart", "[lang]") {
  const SceneDesc s = scene(
      "#declare Look = brdf lambert { diffuse pigment checker { rgb 1, rgb 0 } };"
      "#declare Ball = sphere { 0, 1 brdf { Look } translate x };"
      "object { Ball translate y } object { Ball translate z }");
  check(apply(s.blocks[0].world, {0, 0, 0}), {1, 1, 0});
  check(apply(s.blocks[1].world, {0, 0, 0}), {1, 0, 1});
  check(apply(s.blocks[1].own, {0, 0, 0}), {1, 0, 1});  // inherited braces count as its own
  const auto pigment = [&](std::size_t i) {
    return s.blocks[i].child("brdf")->find("diffuse")->block->world;
  };
  check(apply(pigment(0), {0, 0, 0}), {1, 1, 0});
  check(apply(pigment(1), {0, 0, 0}), {1, 0, 1});
}

}  // namespace vestige::lang::test
