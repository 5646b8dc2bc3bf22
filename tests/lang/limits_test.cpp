// SPDX-License-Identifier: Apache-2.0
// Hostile text costs bounded time and memory, and no text at all crashes the reader.
#include "support/catch.h"

#include <random>

#include "tests/lang/schemas.h"

namespace vestige::lang::test {
namespace {

std::string repeated(const std::string& s, int n) {
  std::string all;
  for (int i = 0; i < n; ++i) all += s;
  return all;
}

std::string errorsOf(const std::string& text, const Options& options) {
  std::string all;
  const Result r = read(text, options);
  for (const Diagnostic& d : r.diagnostics.list())
    if (d.severity == Severity::error) all += d.message + '\n';
  return all;
}

}  // namespace

TEST_CASE("each limit has its message and its flag", "[lang]") {
  Options o;
  o.limits = {};
  o.limits.macroDepth = 20;
  o.limits.loopIterations = 1000;
  o.limits.expandedTokens = 100'000;
  o.limits.stringLength = 1000;
  o.limits.nesting = 50;
  o.limits.blocks = 3000;
  o.limits.arrayElements = 1000;
  o.limits.errors = 5;
  o.limits.memory = 600'000;
  struct Row {
    std::string text;
    const char* flag;
  };
  const Row rows[] = {
      {"#macro M() M() #end M()", "--max-macro-depth"},
      {"#while (1) #end", "--max-loop-iterations"},
      {"#for (I, 1, 1e18) #end", "--max-loop-iterations"},
      {"#for (I, 1, 100) #for (J, 1, 100) #end #end", "--max-loop-iterations"},
      {"#macro A() x x x x #end #macro B() A() A() A() A() A() A() #end #declare V = <1, "
       "2>; #for (I, 1, 900) #declare V = vdot(" +
           repeated("x+", 200) + "y, y); #end",
       "--max-tokens"},
      {"#declare S = \"xxxxxxxxxx\"; #for (I, 1, 60) #declare S = concat(S, S); #end",
       "--max-string-length"},
      {"#declare A = " + repeated("(", 1000), "--max-nesting"},
      {"#declare A = " + repeated("-", 1000) + "1;", "--max-nesting"},
      {"#declare A = " + repeated("<", 1000), "--max-nesting"},
      {repeated("#declare A = ", 1000), "--max-nesting"},
      {repeated("union { ", 1000), "--max-nesting"},
      {"sphere { 0, 1 " + repeated("transform { ", 1000), "--max-nesting"},
      {"#declare A = union { sphere { 0, 1 } } #for (I, 1, 500) #declare A = union { object { A } "
       "} "
       "#end",
       "--max-nesting"},
      {"#declare A = sphere { 0, 1 } #for (I, 1, 40) #declare A = union { object { A } object { A "
       "} } #end",
       "--max-blocks"},
      {"#declare A = array[1e9];", "--max-array-elements"},
      {"#declare S = str(1, 250, 0); #declare S = concat(S, S, S, S); #declare A = array[900]; "
       "#for (I, 0, 899) #declare A[I] = "
       "strupr(S); #end",
       "--max-memory"},
      {"#declare A = array[1000]; #declare B = array[1];", "--max-array-elements"},
      {repeated("@ sphere { 0, 1 }\n", 100), "--max-errors"},
      {repeated("#if (1)\n", 100), "--max-errors"},
  };
  for (const Row& row : rows) {
    INFO(row.text.substr(0, 80));
    CHECK_THAT(errorsOf(row.text, o), containsText(row.flag));
  }
}

TEST_CASE("long lists and dear functions are refused", "[lang]") {
  Options o;
  o.limits.arrayElements = 1000;
  o.limits.blocks = 3000;
  const std::string flag = "--max-array-elements";
  CHECK_THAT(errorsOf("lathe { profile [" + repeated("0 ", 1001) + "] }", o), containsText(flag));
  CHECK_THAT(errorsOf("#for (I, 1, 3) lathe { profile [" + repeated("0 ", 400) + "] } #end", o),
             containsText(flag));
  CHECK_THAT(
      errorsOf("#declare P = array[600] { " + repeated("0 ", 600) + "}; lathe { profile P }", o),
      containsText(flag));
  // Copies share the list.
  CHECK(errorsOf("#declare L = lathe { profile [" + repeated("0 ", 900) +
                     "] }; #for (I, 1, 100) object { L translate I } #end",
                 o)
            .empty());
  CHECK_THAT(errorsOf("#declare P = pigment checker { };" +
                          std::string("#declare L = pigment layers "
                                      "{ parts [") +
                          repeated("P ", 100) + "] };" +
                          repeated("sphere { 0, 1 brdf lambert { diffuse L } }", 100),
                      o),
             containsText("--max-blocks"));
  std::string text = "#declare F0 = function { x + 1 };";
  for (int i = 1; i < 30; ++i) {
    const std::string f = std::to_string(i), g = std::to_string(i - 1);
    text += "#declare F" + f + " = function { F" + g + "(x, y, z) + F" + g + "(x, y, z) };";
  }
  CHECK(errorsOf(text + "isosurface { function F10 }", {}).empty());
  CHECK_THAT(errorsOf(text + "#declare W = function { max(" + repeated("F10(x, y, z), ", 200) +
                          "x) }; isosurface { function W }",
                      {}),
             containsText("calls too many"));
  CHECK_THAT(errorsOf(text + "isosurface { function F29 }", {}), containsText("calls too many"));
  CHECK_THAT(errorsOf("isosurface { function { max(" + repeated("x, ", 300) + "y) } }", {}),
             containsText("too long"));
}

TEST_CASE("what lived before does not count against the arrays", "[lang]") {
  Options o;
  o.limits.arrayElements = 1000;
  CHECK(errorsOf("#for (I, 1, 100) #declare A = array[400]; #declare A[0] = I; #end", o).empty());
}

TEST_CASE("work is bounded also inside functions", "[lang]") {
  std::string text = "#declare F0 = function(a) { a + 1 };";
  for (int i = 1; i < 60; ++i) {
    const std::string f = std::to_string(i), g = std::to_string(i - 1);
    text += "#declare F" + f + " = function(a) { F" + g + "(a) + F" + g + "(a) };";
  }
  Options o;
  o.limits.expandedTokens = 100'000;
  CHECK_THAT(errorsOf(text + "#declare X = F59(1);", o), containsText("--max-tokens"));
}

TEST_CASE("any soup of tokens is read to its end", "[lang]") {
  const std::vector<std::string> words = {"sphere",
                                          "box",
                                          "union",
                                          "brdf",
                                          "phong",
                                          "lambert",
                                          "camera",
                                          "pinhole",
                                          "{",
                                          "}",
                                          "{",
                                          "}",
                                          "(",
                                          ")",
                                          "(",
                                          ")",
                                          "<",
                                          ">",
                                          ">=",
                                          "[",
                                          "]",
                                          ",",
                                          ";",
                                          "+",
                                          "-",
                                          "*",
                                          "/",
                                          "=",
                                          "&",
                                          "|",
                                          "?",
                                          ":",
                                          ".",
                                          "1",
                                          "0",
                                          "2.5",
                                          "\"s\"",
                                          "x",
                                          "y",
                                          "rgb",
                                          "color",
                                          "red",
                                          "A",
                                          "B",
                                          "M",
                                          "N",
                                          "I",
                                          "#declare",
                                          "#local",
                                          "#macro",
                                          "#end",
                                          "#end",
                                          "#end",
                                          "#if",
                                          "#else",
                                          "#elseif",
                                          "#while",
                                          "#for",
                                          "#switch",
                                          "#case",
                                          "#break",
                                          "#ifdef",
                                          "#undef",
                                          "#include",
                                          "#debug",
                                          "#version",
                                          "function",
                                          "array",
                                          "transform",
                                          "translate",
                                          "rotate",
                                          "scale",
                                          "matrix",
                                          "object",
                                          "pigment",
                                          "checker",
                                          "image",
                                          "diffuse",
                                          "exponent",
                                          "radius",
                                          "inverse",
                                          "light",
                                          "area",
                                          "sin",
                                          "vdot",
                                          "concat",
                                          "str",
                                          "defined",
                                          "texture",
                                          "footprint",
                                          "local",
                                          "integrator",
                                          "path",
                                          "film",
                                          "filter",
                                          "@",
                                          "\"",
                                          "/*",
                                          "*/",
                                          "//",
                                          "\n",
                                          "\xC3\xA4",
                                          "#",
                                          "1e999",
                                          "#declare A = ",
                                          "#declare B = 2;",
                                          "#macro M(A, B)",
                                          "M(",
                                          "#for (I, 1, 3)",
                                          "#if (1)",
                                          "sphere { 0, 1 ",
                                          "brdf phong {",
                                          "#declare N = union {",
                                          "array[2] {",
                                          "lathe { profile [",
                                          "pigment ramp { colour_map [",
                                          "isosurface { function {",
                                          "base brdf coat {",
                                          "brdf mix {",
                                          "parts [",
                                          "A[0]"};
  Options o;
  o.limits.loopIterations = 200;
  o.limits.expandedTokens = 20'000;
  std::mt19937 random(1);
  for (int round = 0; round < 400; ++round) {  // ./test fuzz goes on
    std::string text;
    const int length = 1 + int(random() % 120);
    for (int i = 0; i < length; ++i) text += words[random() % words.size()] + ' ';
    INFO(text);
    const Result r = read(text, o);
    for (const Diagnostic& d : r.diagnostics.list()) CHECK(!d.message.empty());
    printed(r);
  }
}

TEST_CASE("a good scene with pieces cut out or doubled is read to its end", "[lang]") {
  const std::string good = R"(
#declare Gold = brdf phong { specular rgb <0.9, 0.7, 0.3> exponent 80 };
#macro Piece(Where, Stuff)
  union { sphere { <0, 1, 0>, 0.6 brdf { Stuff } } box { 0, 1 scale 0.5 } translate Where }
#end
#declare F = function(a, b) { (a > b ? a : b) * 2 };
#for (I, 0, 4)
  #if (mod(I, 2) = 0) Piece(<2*I - 4, 0, 0>, Gold) #else Piece(I*x, brdf lambert { diffuse rgb 1 }) #end
#end
#declare A = array[2][2] { { 1, 2 }, { 3, F(4, 5) } };
#while (A[0][0] < 5) #declare A[0][0] = A[0][0] + 1; #end
#switch (A[1][1]) #case (1) #break #range (5, 20) sphere { 0, 1 transform { rotate 90*y inverse } } #break #else #debug "x" #end
camera { pinhole location <0, 2, -5> look_at 0 angle 40 }
light area { <-1, 5, -1>, <2, 0, 0>, <0, 0, 2> radiance rgb 10 }
)";
  Options o;
  o.limits.loopIterations = 1000;
  o.limits.expandedTokens = 100'000;
  REQUIRE(!read(good, o).diagnostics.hasErrors());
  std::mt19937 random(2);
  for (int round = 0; round < 200; ++round) {
    std::string text = good;
    for (int cut = 0; cut < 1 + int(random() % 3); ++cut) {
      const std::size_t at = random() % text.size(), n = random() % 12;
      if (random() % 2)
        text.erase(at, n);
      else
        text.insert(random() % text.size(), text.substr(at, n));
    }
    INFO(text);
    const Result r = read(text, o);
    printed(r);
    CHECK(r.scene.blocks.size() < 1000);
  }
}

}  // namespace vestige::lang::test
