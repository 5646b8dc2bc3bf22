// SPDX-License-Identifier: Apache-2.0
// What blocks mean: kinds, positional values, types, names, overrides.
#include "support/catch.h"

#include "tests/lang/schemas.h"

namespace vestige::lang::test {
namespace {

double number(const Block& b, const char* name) {
  const Value* v = b.find(name);
  REQUIRE(v);
  CHECK(v->kind == Value::Kind::number);
  return v->v[0];
}

void checkColour(const Block& b, const char* name, double red, double green, double blue) {
  const Value* v = b.find(name);
  REQUIRE(v);
  CHECK(v->kind == Value::Kind::colour);
  CHECK(v->v[0] == Approx(red));
  CHECK(v->v[1] == Approx(green));
  CHECK(v->v[2] == Approx(blue));
}

}  // namespace

TEST_CASE("a plugin's word stands before or behind the brace", "[lang]") {
  for (const char* text : {"camera pinhole { angle 40 }", "camera { pinhole angle 40 }"}) {
    const SceneDesc s = scene(text);
    REQUIRE(s.blocks.size() == 1);
    CHECK(s.blocks[0].kind == "camera");
    CHECK(s.blocks[0].plugin == "pinhole");
    CHECK(number(s.blocks[0], "angle") == 40);
  }
}

TEST_CASE("a shape's plugin is a keyword, and values stand in the order of its rows", "[lang]") {
  for (const char* text : {"sphere { <0, 1, 0>, 2 }", "sphere { y 2 }", "sphere { y radius 2 }",
                           "sphere { radius 2 centre y }", "sphere { <0,1,0> 2, }"}) {
    INFO(text);
    const SceneDesc s = scene(text);
    REQUIRE(s.blocks.size() == 1);
    CHECK(s.blocks[0].kind == "shape");
    CHECK(s.blocks[0].plugin == "sphere");
    CHECK(s.blocks[0].find("centre")->v[1] == 1);
    CHECK(s.blocks[0].find("centre")->size == 3);
    CHECK(number(s.blocks[0], "radius") == 2);
  }
}

TEST_CASE("numbers become vectors, vectors become colours", "[lang]") {
  const Block box = scene("box { 0, 1 }").blocks[0];
  for (int i = 0; i < 3; ++i) CHECK(box.find("high")->v[i] == 1);
  const Block light = scene("light point { location <1, 2> intensity 3 }").blocks[0];
  CHECK(light.find("location")->v[2] == 0);
  checkColour(light, "intensity", 3, 3, 3);
  checkColour(scene("light point { location 0 intensity <1, 2, 3> }").blocks[0], "intensity", 1, 2,
              3);
  checkColour(scene("#declare C = rgbt <1, 2, 3, 0.5>; light point { location 0 intensity C * 2 }")
                  .blocks[0],
              "intensity", 2, 4, 6);
  // IEC 61966-2-1: 0.5 decodes to 0.21404.
  checkColour(scene("light point { location 0 intensity srgb <0.5, 0, 1> }").blocks[0], "intensity",
              0.2140411, 0, 1);
}

TEST_CASE("a channel behind a colour belongs to it, a setting of that name does not", "[lang]") {
  const SceneDesc s = scene(
      "light point { location 0 intensity rgb 1 red 3 }"
      "light point { location 0 intensity green 2 blue 4 }"
      "light slide { radiance rgb 1 filter \"linear\" }"
      "light slide { radiance rgb 1 filter linear }");
  checkColour(s.blocks[0], "intensity", 3, 1, 1);
  checkColour(s.blocks[1], "intensity", 0, 2, 4);
  for (const std::size_t i : {2u, 3u}) {
    CHECK(s.blocks[i].find("filter")->text == "linear");
    checkColour(s.blocks[i], "radiance", 1, 1, 1);
  }
}

TEST_CASE("a flag may stand alone", "[lang]") {
  const char* head = "light area { 0, x, z ";
  CHECK(number(scene(std::string(head) + "two_sided }").blocks[0], "two_sided") == 1);
  CHECK(number(scene(std::string(head) + "two_sided off }").blocks[0], "two_sided") == 0);
  CHECK(number(scene(std::string(head) + "two_sided radiance 1 }").blocks[0], "two_sided") == 1);
}

TEST_CASE("choices are words or strings", "[lang]") {
  CHECK(scene("film { filter gaussian }").blocks[0].find("filter")->text == "gaussian");
  CHECK(scene("film { filter \"box\" }").blocks[0].find("filter")->text == "box");
  CHECK(scene("#declare F = \"box\"; film { filter F }").blocks[0].find("filter")->text == "box");
}

TEST_CASE("an integer that a division made is an integer", "[lang]") {
  CHECK(number(scene("integrator path { samples 0.3 / 0.1 * 100 }").blocks[0], "samples") == 300);
}

TEST_CASE("a block is named, used and overridden", "[lang]") {
  const SceneDesc s = scene(
      "#declare Brass = brdf phong { specular rgb 0.5 exponent 80 };"
      "sphere { 0, 1 brdf { Brass exponent 20 } }"
      "sphere { 0, 1 brdf { Brass } }"
      "sphere { 0, 1 brdf Brass }"
      "sphere { 0, 1 Brass }"
      "sphere { 0, 1 brdf phong { Brass exponent 3 } }");
  const double exponents[] = {20, 80, 80, 80, 3};
  for (std::size_t i = 0; i < 5; ++i) {
    const Block* brdf = s.blocks[i].child("brdf");
    REQUIRE(brdf);
    CHECK(brdf->plugin == "phong");
    CHECK(number(*brdf, "exponent") == exponents[i]);
    checkColour(*brdf, "specular", 0.5, 0.5, 0.5);
  }
}

TEST_CASE("object stands for a declared shape or union, with what is added", "[lang]") {
  const SceneDesc s = scene(
      "#declare Ball = sphere { 0, 1 brdf lambert { } };"
      "#declare Pair = union { object { Ball } object { Ball translate x } };"
      "object { Ball radius 3 brdf phong { } } object { Pair } object { sphere { 0, 5 } }");
  REQUIRE(s.blocks.size() == 3);
  CHECK(number(s.blocks[0], "radius") == 3);
  CHECK(s.blocks[0].child("brdf")->plugin == "phong");  // the later one
  CHECK(s.blocks[0].children.size() == 2);
  CHECK(s.blocks[1].kind == "union");
  CHECK(s.blocks[1].children.size() == 2);
  CHECK(number(s.blocks[2], "radius") == 5);
}

TEST_CASE("pigments stand where a constant could", "[lang]") {
  const SceneDesc s = scene(
      "#declare Check = pigment checker { rgb 1, rgb 0 };"
      "sphere { 0, 1 brdf lambert { diffuse pigment image { \"a.png\" wrap clamp } } }"
      "sphere { 0, 1 brdf lambert { diffuse Check } }"
      "sphere { 0, 1 brdf lambert { diffuse pigment { Check scale 2 } } }"
      "sphere { 0, 1 brdf phong { exponent pigment { checker 10, 20 } ior 1.3 } }");
  const auto diffuse = [&](std::size_t i) { return s.blocks[i].child("brdf")->find("diffuse"); };
  CHECK(diffuse(0)->kind == Value::Kind::block);
  CHECK(diffuse(0)->block->plugin == "image");
  CHECK(diffuse(0)->block->find("file")->text == "a.png");
  CHECK(diffuse(0)->block->find("wrap")->text == "clamp");
  CHECK(diffuse(1)->block->plugin == "checker");
  CHECK(diffuse(2)->block->world.m[0][0] == 2);
  CHECK(s.blocks[3].child("brdf")->find("exponent")->block->plugin == "checker");
}

TEST_CASE("block rows take a plugin with or without braces", "[lang]") {
  const auto footprint = [](const std::string& text) {
    const SceneDesc s = scene("integrator path { " + text + " samples 4 }");
    CHECK(number(s.blocks[0], "samples") == 4);
    return *s.blocks[0].find("footprint")->block;
  };
  CHECK(footprint("footprint pixel").plugin == "pixel");
  CHECK(number(footprint("footprint local { limit 0.7 }"), "limit") == 0.7);
  CHECK(number(footprint("footprint { local limit 0.7 }"), "limit") == 0.7);
  CHECK(number(footprint("footprint local { scale 2 }"), "scale") == 2);  // a row, no transform
  // A row called like a plugin means it.
  const Block sky = scene("light environment { image { \"sky.exr\" rotate 90*y } }").blocks[0];
  CHECK(sky.find("image")->block->plugin == "image");
  const Block other = scene("light environment { image pigment checker { } }").blocks[0];
  CHECK(other.find("image")->block->plugin == "checker");
}

TEST_CASE("a parameter's name goes before a declared one, but not behind a comma", "[lang]") {
  const SceneDesc s = scene(
      "#declare radius = 3; #declare angle = 20;"
      "sphere { 0, radius } camera pinhole { angle angle }");
  CHECK(number(s.blocks[0], "radius") == 3);
  CHECK(number(s.blocks[1], "angle") == 20);
}

TEST_CASE("of two cameras the last one counts", "[lang]") {
  const Result r = read("camera pinhole { angle 10 } sphere { 0, 1 } camera pinhole { angle 20 }");
  CHECK(!r.diagnostics.hasErrors());
  REQUIRE(r.diagnostics.list().size() == 1);
  CHECK(r.diagnostics.list()[0].severity == Severity::warning);
  REQUIRE(r.scene.blocks.size() == 2);
  CHECK(number(r.scene.blocks[1], "angle") == 20);
}

TEST_CASE("directives stand anywhere, also inside a block and a vector", "[lang]") {
  const SceneDesc s = scene(
      "#declare Big = 1;"
      "union { #for (I, 1, 3) sphere { <I, #if (Big) 2 #else 3 #end, 0>, I } #end }"
      "sphere { 0, #ifdef (Big) 7 #else 8 #end }");
  REQUIRE(s.blocks[0].children.size() == 3);
  CHECK(s.blocks[0].children[2].find("centre")->v[0] == 3);
  CHECK(s.blocks[0].children[2].find("centre")->v[1] == 2);
  CHECK(number(s.blocks[1], "radius") == 7);
}

TEST_CASE("blocks are arguments, array elements and macro results", "[lang]") {
  const SceneDesc s = scene(
      "#macro Ball(R, Stuff) sphere { 0, R brdf { Stuff } } #end"
      "#declare Looks = array[2] { brdf lambert { }, brdf phong { exponent 5 } };"
      "#declare Named = Ball(4, Looks[1])"
      "object { Named } Ball(2, brdf phong { exponent 9 })");
  REQUIRE(s.blocks.size() == 2);
  CHECK(number(s.blocks[0], "radius") == 4);
  CHECK(number(*s.blocks[0].child("brdf"), "exponent") == 5);
  CHECK(number(*s.blocks[1].child("brdf"), "exponent") == 9);
}

TEST_CASE("definitions come before the scene", "[lang]") {
  Options options;
  options.definitions = {{"Radius", "2*3"}, {"Name", "\"a.ply\""}};
  const Result r = read(
      "#ifndef (Radius) #declare Radius = 1; #end sphere { 0, Radius } mesh { Name }", options);
  INFO(printed(r));
  REQUIRE(r.scene.blocks.size() == 2);
  CHECK(number(r.scene.blocks[0], "radius") == 6);
  CHECK(r.scene.blocks[1].find("file")->text == "a.ply");
  options.definitions = {{"Radius", "2 +"}};
  CHECK_THAT(printed(read("", options)), containsText("-D Radius:1:"));
}

TEST_CASE("the hash is of the meaning", "[lang]") {
  const auto hash = [](const char* text) { return scene(text).hash; };
  CHECK(hash("sphere { 0, 1 }") == hash("// a ball\n  sphere{<0,0,0>, 2 / 2}"));
  CHECK(hash("sphere { 0, 1 }") != hash("sphere { 0, 1.0000001 }"));
  CHECK(hash("sphere { 0, 1 }") != hash("sphere { 0, 1 translate x }"));
  CHECK(hash("sphere { 0, 1 } box { 0, 1 }") != hash("box { 0, 1 } sphere { 0, 1 }"));
}

}  // namespace vestige::lang::test
