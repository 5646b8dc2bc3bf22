// SPDX-License-Identifier: Apache-2.0
// Values that are lists, maps and functions; blocks that hold blocks of their own kind.
#include "support/catch.h"

#include <vestige/plugin.h>

#include <cmath>

#include "lang/builtins.h"
#include "lang/source.h"
#include "tests/lang/schemas.h"

namespace vestige::lang::test {
namespace {

/// Rows of one value each, as a plugin gets them.
Values valuesOf(const Block& block, const char* name, std::vector<Value>& rows) {
  const Value* value = block.find(name);
  REQUIRE(value);
  rows = {*value};
  return Values(rows, {});
}

std::shared_ptr<const vestige::Function> functionOf(const std::string& text) {
  const SceneDesc s = scene("#declare F = " + text + "; isosurface { function F }");
  const Value* value = s.blocks[0].find("function");
  REQUIRE(value->kind == Value::Kind::function);
  return value->function;
}

double at(const std::string& body, double x, double y = 0, double z = 0) {
  const double args[] = {x, y, z};
  return functionOf("function { " + body + " }")->eval(args);
}

}  // namespace

TEST_CASE("a list is written in brackets or braces, or named as an array", "[lang]") {
  for (const char* text :
       {"lathe { profile [<0, 0> <1, 2>, <1, 3>] }", "lathe { profile { <0, 0>, <1, 2>, <1, 3> } }",
        "lathe { [<0, 0> <1, 2> <1, 3>,] }", "lathe { profile array { <0, 0>, <1, 2>, <1, 3> } }",
        "#declare P = array[3] { <0, 0>, <1, 2>, <1, 3> }; lathe { profile P }",
        "#declare P = array { 0, <1, 2>, <1, 3> }; lathe { P }",
        "lathe { profile [ #for (I, 0, 2) <min(I, 1), I + (I > 0)> #end ] }"}) {
    INFO(text);
    const SceneDesc s = scene(text);
    std::vector<Value> rows;
    const Values v = valuesOf(s.blocks[0], "profile", rows);
    REQUIRE(v.size(0) == 3);
    CHECK(v.vec2(0, 0).x == 0);
    CHECK(v.vec2(0, 1).x == 1);
    CHECK(v.vec2(0, 1).y == 2);
    CHECK(v.vec2(0, 2).y == 3);
  }
}

TEST_CASE("a map has keys, and values of more than one sort", "[lang]") {
  for (const char* text :
       {"colour_map { [0 rgb 1] [0.25, pigment checker { }] [0.25 Spot] [1 <1, 0, 0.5>] }",
        "colour_map [0 1] [0.25 pigment checker] [0.25 Spot] [1 rgb <1, 0, 0.5>]"}) {
    INFO(text);
    const SceneDesc s = scene(
        "#declare Spot = pigment image { \"a.png\" };"
        "sphere { 0, 1 brdf lambert { diffuse pigment ramp { " +
        std::string(text) + " scale 2 } } }");
    const Block& ramp = *s.blocks[0].child("brdf")->find("diffuse")->block;
    std::vector<Value> rows;
    const Values v = valuesOf(ramp, "colour_map", rows);
    REQUIRE(v.size(0) == 4);
    CHECK(v.key(0, 1) == 0.25);
    CHECK(v.rgb(0, 0).g == 1);
    CHECK(v.rgb(0, 3).b == 0.5);
    REQUIRE(v.block(0, 1));
    CHECK(v.block(0, 1)->plugin == "checker");
    CHECK(v.block(0, 2)->plugin == "image");
    CHECK(v.block(0, 2)->world.m[0][0] == 2);  // moved with what holds it
    CHECK(!v.block(0, 0));
  }
}

TEST_CASE("an array of pairs gives a map", "[lang]") {
  const SceneDesc s = scene(
      "#declare M = array[2][2] { { 0, rgb 1 }, { 0.5, pigment checker { } } };"
      "sphere { 0, 1 brdf lambert { diffuse pigment ramp { colour_map M } } }");
  std::vector<Value> rows;
  const Values v = valuesOf(*s.blocks[0].child("brdf")->find("diffuse")->block, "colour_map", rows);
  REQUIRE(v.size(0) == 2);
  CHECK(v.key(0, 1) == 0.5);
  CHECK(v.block(0, 1)->plugin == "checker");
}

TEST_CASE("every entry has its span", "[lang]") {
  const Result r = read(
      "lathe { profile [<0, 0>\n <1, 2>] }\n"
      "sphere { 0, 1 brdf lambert { diffuse pigment ramp { colour_map { [0 1] [ 0.5 rgb 1 ] } } } "
      "}");
  REQUIRE(!r.diagnostics.hasErrors());
  const auto excerpt = [&](Span span) { return r.sources->excerpt(span); };
  std::vector<Value> rows;
  const Values profile = valuesOf(r.scene.blocks[0], "profile", rows);
  CHECK(excerpt(profile.span(0, 1)) == "<1, 2>");
  CHECK(excerpt(profile.span(0)) == "[<0, 0>\n <1, 2>]");
  std::vector<Value> others;
  const Values map =
      valuesOf(*r.scene.blocks[1].child("brdf")->find("diffuse")->block, "colour_map", others);
  CHECK(excerpt(map.span(0, 1)) == "[ 0.5 rgb 1 ]");
  CHECK(excerpt(map.value(0, 1).span) == "rgb 1");
}

TEST_CASE("lists hold texts, numbers and blocks", "[lang]") {
  const SceneDesc s = scene(
      "#declare A = pigment image { \"a.png\" };"
      "lathe { [0 1] files [\"a\" \"b\"] weights [1 2+3 -4] }"
      "sphere { 0, 1 brdf lambert { diffuse pigment layers {"
      "  parts [A pigment checker { rgb 1 } checker pigment { A wrap clamp }] } } }");
  std::vector<Value> rows;
  CHECK(valuesOf(s.blocks[0], "files", rows).text(0, 1) == "b");
  const Values weights = valuesOf(s.blocks[0], "weights", rows);
  REQUIRE(weights.size(0) == 2);  // 1, then 2 + 3 - 4: a comma says otherwise
  CHECK(weights.real(0, 1) == 1);
  const Values parts = valuesOf(*s.blocks[1].child("brdf")->find("diffuse")->block, "parts", rows);
  REQUIRE(parts.size(0) == 4);
  const char* plugins[] = {"image", "checker", "checker", "image"};
  for (int i = 0; i < 4; ++i) CHECK(parts.block(0, i)->plugin == plugins[i]);
}

TEST_CASE("what a list says is part of the scene's hash", "[lang]") {
  const auto hash = [](const std::string& text) { return scene(text).hash; };
  CHECK(hash("lathe { [0 1 2] }") == hash("lathe { profile { 0, 1, <2, 2> } }"));
  CHECK(hash("lathe { [0 1 2] }") != hash("lathe { [0 1 3] }"));
  CHECK(hash("lathe { [0 1 2] }") != hash("lathe { [0 1] }"));
  const std::string head = "#declare F = function(a) { ", tail = " }; lathe { [0 1] bend F }";
  CHECK(hash(head + "a * 2" + tail) == hash(head + "(a*2)" + tail));
  CHECK(hash(head + "a * 2" + tail) != hash(head + "a * 3" + tail));
  CHECK(hash(head + "a * 2" + tail) != hash(head + "a + 2" + tail));
}

// ---------------------------------------------------------------- functions
TEST_CASE("a function reaches the plugin in four spellings", "[lang]") {
  for (const char* text :
       {"isosurface { function { x*x + y - z } }",
        "isosurface { function function { x*x + y - z } }",
        "isosurface { function (a, b, c) { a*a + b - c } }",
        "#declare F = function(p, q, r) { p*p + q - r }; isosurface { function F }"}) {
    INFO(text);
    std::vector<Value> rows;
    const auto f = valuesOf(scene(text).blocks[0], "function", rows).function(0);
    REQUIRE(f);
    CHECK(f->arity() == 3);
    const double args[] = {3, 4, 5};
    CHECK(f->eval(args) == 8);
  }
}

TEST_CASE("functions compute what their expressions say", "[lang]") {
  CHECK(at("-x + 2*y/4 - z % 3", 1, 2, 5) == -2);
  CHECK(at("(x > y ? x : y) + (x = 1) + !z", 1, 7, 0) == 9);
  CHECK(at("select(x, 1, 2, 3)", -1) == 1);
  CHECK(at("select(x, 1, 2, 3)", 0) == 2);
  CHECK(at("max(x, y, z, 4)", 1, 2, 3) == 4);
  CHECK(std::isinf(at("1 / x", 0)));
  CHECK(std::isnan(at("sqrt(x)", -1)));
  const auto ball = functionOf("function { sqrt(x*x + y*y + z*z) - 1 }");
  const double on[] = {2.0 / 3, -1.0 / 3, 2.0 / 3};
  CHECK(std::abs(ball->eval(on)) < 1e-15);
}

TEST_CASE("functions call others, and hold constants of every sort", "[lang]") {
  const SceneDesc s = scene(
      "#declare K = 2; #declare V = <3, 4>; #declare A = array[2] { 5, 6 };"
      "#declare Square = function(a) { a*a };"
      "#declare F = function { Square(x) * K + vlength(V) + A[1] + V.y };"
      "#declare K = 100;"
      "isosurface { function F }");
  const double args[] = {3, 0, 0};
  CHECK(s.blocks[0].find("function")->function->eval(args) == 18 + 5 + 6 + 4);
}

/// The language's own evaluation was held against POV-Ray's: see povray_test.cpp.
TEST_CASE("every function of numbers is the same in a block", "[lang]") {
  const double samples[] = {-2.5, -1, -0.4, 0, 0.3, 1, 1.7, 3};
  int seen = 0;
  for (const std::string& name : builtinNames()) {
    const Builtin& b = *findBuiltin(name);
    std::string letters = b.signature;
    if (name == "chr" || name == "str") continue;  // these give texts
    if (!b.isPure || letters.find_first_of("vsa") != std::string::npos) continue;
    std::erase_if(letters, [](char c) { return c != 'n'; });
    if (std::string(b.signature).find('+') != std::string::npos) letters = "nnn";
    ++seen;
    std::string list;
    for (std::size_t i = 0; i < letters.size(); ++i)
      list += std::string(i ? ", " : "") + "xyz"[i % 3];
    const auto f = functionOf("function { " + name + "(" + list + ") }");
    for (const double x : samples)
      for (const double y : samples) {
        const double args[] = {x, y, 2};
        std::string text = "#declare R = function { " + name + "(" + list + ") };#debug str(R(" +
                           shortest(x) + ", " + shortest(y) + ", 2), 0, 12)";
        const std::string said = debugOf(text);
        INFO(name << " " << x << " " << y << ": " << said);
        if (said.find("error") != std::string::npos) {
          CHECK(!std::isfinite(f->eval(args)));
          continue;
        }
        const double expected = std::stod(said), found = f->eval(args);
        if (std::isnan(expected))
          CHECK(std::isnan(found));
        else
          CHECK((found == expected || std::abs(found - expected) <= 1e-11));
      }
  }
  CHECK(seen >= 30);
}

// ---------------------------------------------------------------- blocks in blocks
TEST_CASE("children of one kind keep their order", "[lang]") {
  const SceneDesc s = scene(
      "#declare Gloss = brdf phong { exponent 7 };"
      "#declare Both = brdf mix { Gloss brdf lambert { } amount 0.3 };"
      "sphere { 0, 1 brdf mix { Both brdf lambert { } Gloss amount 0.1 } }"
      "sphere { 0, 1 brdf { Both amount 0.9 } }");
  const Block& mix = *s.blocks[0].child("brdf");
  const auto parts = mix.childrenOf("brdf");
  REQUIRE(parts.size() == 3);
  CHECK(parts[0]->plugin == "mix");
  CHECK(parts[1]->plugin == "lambert");
  CHECK(parts[2]->plugin == "phong");
  REQUIRE(parts[0]->childrenOf("brdf").size() == 2);
  CHECK(parts[0]->childrenOf("brdf")[0]->plugin == "phong");
  const Block& changed = *s.blocks[1].child("brdf");
  CHECK(changed.find("amount")->v[0] == 0.9);
  CHECK(changed.childrenOf("brdf").size() == 2);
}

TEST_CASE("a brdf stands in a parameter of a brdf", "[lang]") {
  const auto base = [](const std::string& text) {
    const Result r =
        read("#declare Tiles = brdf lambert { diffuse rgb 0.3 };\nsphere { 0, 1 brdf coat { " +
             text + " } }");
    INFO(text << '\n' << printed(r));
    REQUIRE(!r.diagnostics.hasErrors());
    const Value& value = *r.scene.blocks[0].child("brdf")->find("base");
    return std::pair(*value.block, r.sources->excerpt(value.span));
  };
  for (const char* text :
       {"base brdf lambert { diffuse rgb 0.3 }", "base lambert { diffuse rgb 0.3 }",
        "base { lambert diffuse rgb 0.3 }", "base brdf { lambert diffuse rgb 0.3 }",
        "base { Tiles }", "base Tiles", "base brdf { Tiles }", "base brdf Tiles"}) {
    CHECK(base(text).first.plugin == "lambert");
    CHECK(base(text).first.find("diffuse")->v[0] == 0.3);
  }
  CHECK(base("base brdf lambert { }").second == "brdf lambert");
  CHECK(base("base lambert { }").second == "lambert");
  CHECK(base("base Tiles").second == "Tiles");
  CHECK(base("base { Tiles diffuse rgb 0.5 }").first.find("diffuse")->v[0] == 0.5);
  CHECK(base("base brdf mix { Tiles brdf phong { } }").first.childrenOf("brdf").size() == 2);
}

TEST_CASE("pigments hold pigments", "[lang]") {
  const SceneDesc s = scene(
      "#declare A = array[2] { pigment checker { }, rgb 0.5 };"
      "sphere { 0, 1 brdf lambert { diffuse pigment tiles { pigment checker { } first A[0] "
      "second pigment { tiles 1, 0.5 } } } }");
  const Block& tiles = *s.blocks[0].child("brdf")->find("diffuse")->block;
  CHECK(tiles.find("first")->block->plugin == "checker");
  CHECK(tiles.find("second")->block->plugin == "tiles");
}

TEST_CASE("a plugin's constructor blames an entry of a list", "[lang]") {
  struct NoFiles final : Host {
    std::string find(const std::string&, Span, std::string&) override { return ""; }
    std::shared_ptr<const Texture> texture(const TextureRequest&, std::string&) override {
      return nullptr;
    }
    void warn(Span, const std::string&) override {}
  };
  struct Refuses {
    explicit Refuses(const Values& v) {
      if (v.real(0, 1) < v.real(0, 0)) throw PluginError(0, 1, "it falls");
      throw PluginError(0, "all of it");
    }
  };
  NoFiles host;
  const auto refused = [&](double first, double second) {
    const std::vector<Value> rows = {listValue({numberValue(first), numberValue(second)})};
    const Values values(rows, {});
    VestigeError error{"", -7, -7};
    CHECK(!vestige::detail::create<Refuses, Refuses>(&values, static_cast<Host*>(&host), &error));
    CHECK(error.input == 0);
    return error.entry;
  };
  CHECK(refused(2, 1) == 1);
  CHECK(refused(1, 2) == -1);
}

// ---------------------------------------------------------------- sharing
TEST_CASE("copies of a block share what they do not change", "[lang]") {
  const SceneDesc s = scene(
      "#declare S = sphere { 0, 1 brdf lambert { diffuse rgb 0.5 } };"
      "#declare M = mesh { \"a very long name of a file, which no short string holds.ply\" };"
      "object { S } object { S } object { S translate x } object { S radius 2 }"
      "object { M } object { M brdf phong { } scale 2 } object { M file \"b.ply\" }"
      "#declare N = \"c.ply\"; mesh { N } mesh { N }");
  const auto& b = s.blocks;
  CHECK(b[0].settings.sharesWith(b[1].settings));
  CHECK(b[0].children.sharesWith(b[1].children));
  CHECK(b[0].settings.sharesWith(b[2].settings));
  CHECK(!b[0].children.sharesWith(b[2].children));  // they have another place
  CHECK(b[0].child("brdf")->settings.sharesWith(b[2].child("brdf")->settings));
  CHECK(b[2].child("brdf")->world.m[0][3] == 1);
  CHECK(b[1].child("brdf")->world.m[0][3] == 0);
  CHECK(b[3].find("radius")->v[0] == 2);
  CHECK(b[0].find("radius")->v[0] == 1);
  CHECK(&b[4].find("file")->text.str() == &b[5].find("file")->text.str());
  CHECK(&b[7].find("file")->text.str() == &b[8].find("file")->text.str());
  CHECK(b[6].find("file")->text == "b.ply");
  CHECK(b[4].find("file")->text != "b.ply");
}

}  // namespace vestige::lang::test
