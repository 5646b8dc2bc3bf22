// SPDX-License-Identifier: Apache-2.0
// Every value knows where it came from, and a place is printed so that a reader finds it.
#include "support/catch.h"

#include "lang/source.h"
#include "tests/lang/schemas.h"

namespace vestige::lang::test {
namespace {

std::string excerptOf(const Result& r, const Span& span) { return r.sources->excerpt(span); }

}  // namespace

TEST_CASE("values, names and heads have spans", "[lang]") {
  const Result r =
      read("#declare N = 2;\nsphere { <0, 1, 0>, N * (1 + 2)\n  brdf phong { exponent (40) } }");
  REQUIRE(r.scene.blocks.size() == 1);
  const Block& sphere = r.scene.blocks[0];
  CHECK(excerptOf(r, sphere.span) == "sphere");
  CHECK(excerptOf(r, sphere.find("centre")->span) == "<0, 1, 0>");
  CHECK(excerptOf(r, sphere.find("radius")->span) == "N * (1 + 2)");
  const Block& brdf = *sphere.child("brdf");
  CHECK(excerptOf(r, brdf.span) == "brdf phong");
  CHECK(excerptOf(r, brdf.settings[0].span) == "exponent");
  CHECK(excerptOf(r, brdf.settings[0].value.span) == "(40)");
  const Place place = locate(brdf.settings[0].span, *r.sources);
  CHECK(place.file == "test.scene");
  CHECK(place.line == 3);
  CHECK(place.column == 16);
  CHECK(place.endColumn == 24);
}

TEST_CASE("values from macros know the calls", "[lang]") {
  const Result r =
      read("#macro Ball(R) sphere { 0, R } #end\n#macro Two(R) Ball(R) Ball(R + 1) #end\nTwo(5)");
  REQUIRE(r.scene.blocks.size() == 2);
  const Span span = r.scene.blocks[1].find("radius")->span;
  CHECK(excerptOf(r, span) == "R");
  REQUIRE(span.via >= 0);
  const Expansion& inner = r.sources->expansion(span.via);
  CHECK(*inner.name == "Ball");
  CHECK(excerptOf(r, inner.call) == "Ball(R + 1)");
  const Expansion& outer = r.sources->expansion(inner.call.via);
  CHECK(*outer.name == "Two");
  CHECK(excerptOf(r, outer.call) == "Two(5)");
  CHECK(outer.call.via == -1);
}

TEST_CASE("an expression across a macro's end is seen from outside", "[lang]") {
  const Result r = read("#macro Sum() 1 + 2 #end\nsphere { 0, Sum() * 3 }");
  const Span span = r.scene.blocks[0].find("radius")->span;
  CHECK(excerptOf(r, span) == "Sum() * 3");
  CHECK(span.via == -1);
  CHECK(r.scene.blocks[0].find("radius")->v[0] == 7);
}

TEST_CASE("colour is painted only if asked for", "[lang]") {
  const Result r = read("sphere { 0, -1 }");
  std::ostringstream plain, painted;
  print(plain, r.diagnostics.list()[0], *r.sources, false);
  print(painted, r.diagnostics.list()[0], *r.sources, true);
  CHECK(plain.str().find('\x1b') == std::string::npos);
  CHECK(painted.str().find("\x1b[1;31merror") != std::string::npos);
}

TEST_CASE("long chains of calls are cut in the middle", "[lang]") {
  const std::string s =
      printed(read("#macro M(N) #if (N > 0) M(N - 1) #else sphere { 0, Nothing } #end #end M(50)"));
  CHECK_THAT(s, containsText("... and 41 more"));
  CHECK(std::count(s.begin(), s.end(), '\n') == 14);  // message, line, caret, 10 calls, the cut
}

TEST_CASE("columns count characters, not bytes", "[lang]") {
  const Result r = read("/* \xC3\xA4\xC3\xB6 */ sphere { 0, -1 }");
  CHECK(locate(r.diagnostics.list()[0].span, *r.sources).column == 22);
}

}  // namespace vestige::lang::test
