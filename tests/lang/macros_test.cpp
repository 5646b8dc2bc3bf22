// SPDX-License-Identifier: Apache-2.0
// Scopes, macros, includes and messages beyond the rows of povray_test.cpp.
#include "support/catch.h"

#include <filesystem>
#include <fstream>

#include "tests/lang/schemas.h"

namespace vestige::lang::test {
namespace {

namespace fs = std::filesystem;

/// A folder that is gone after the test.
struct Folder {
  fs::path path;
  Folder() {
    path = fs::temp_directory_path() /
           ("vestige_lang_" + std::to_string(reinterpret_cast<std::uintptr_t>(this)));
    fs::create_directories(path / "sub");
  }
  ~Folder() { fs::remove_all(path); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path / name) << text;
  }
  std::string said(const Options& given = {}) const {
    Options options = given;
    std::string all;
    options.debug = [&](const std::string& s) { all += s; };
    const Result r = readScene((path / "main.scene").string(), schemas(), options);
    for (const Diagnostic& d : r.diagnostics.list())
      if (d.severity == Severity::error) all += "error: " + d.message;
    return all;
  }
};

}  // namespace

TEST_CASE("parameters of macros may be called like constants", "[lang]") {
  CHECK(debugOf("#macro P(n, v, t) #debug str(v + t*n, 0, 0) #end P(2, 3, 4)") == "11");
  CHECK(debugOf("#macro P(u) #local u = u + 1; #debug str(u, 0, 0) #end P(+2)") == "3");
}

TEST_CASE("arguments may be left out where the macro says so", "[lang]") {
  const std::string m = "#macro M(A, B = 5) #debug str(A + B, 0, 0) #end ";
  CHECK(debugOf(m + "M(1)") == "6");
  CHECK(debugOf(m + "M(1, 2)") == "3");
  CHECK(debugOf("#macro M(optional A) #ifdef (A) #debug \"given\" #else #debug \"none\" #end #end "
                "M() M(1)") == "nonegiven");
}

TEST_CASE("a macro's text continues around its call", "[lang]") {
  CHECK(debugOf("#macro V() <1, 2, 3> #end #debug str(V().y, 0, 0)") == "2");
  CHECK(debugOf("#macro Op() * #end #debug str(3 Op() 4, 0, 0)") == "12");
  CHECK(debugOf("#macro Fact(N) #if (N <= 1) 1 #else N * Fact(N - 1) #end #end "
                "#debug str(Fact(10), 0, 0)") == "3628800");
}

TEST_CASE("what a macro declares with #local is gone at its end", "[lang]") {
  CHECK(debugOf("#macro M() #local L = 1; #end M() #debug str(defined(L), 0, 0)") == "0");
  CHECK(debugOf("#declare A = array[2] { 1, 2 }; #macro M(B) #local B[0] = 9; #end M(A) "
                "#debug str(A[0], 0, 0)") == "9");
  CHECK(debugOf("#declare A = array[2] { 1, 2 }; #declare B = A; #declare B[0] = 9; "
                "#debug str(A[0], 0, 0)") == "1");
}

TEST_CASE("#debug speaks at once, in order, with or without a line end", "[lang]") {
  CHECK(debugOf("#debug \"a\" #debug concat(\"b\", \"c\")\n#declare S = \"d\"; #debug S "
                "#if (1) #debug \"e\" #end") == "abcde");
}

TEST_CASE("extensions where POV-Ray only refuses", "[lang]") {
  CHECK(debugOf("#declare A = 1 < 2; #debug str(A, 0, 0)") == "1");
  CHECK(debugOf("#debug str((1 == 1 && 2 != 3 || 0), 0, 0)") == "1");
  CHECK(debugOf("#debug str(7 % 4, 0, 0)") == "3");
  CHECK(debugOf("#declare A = array { 1, 2, 3 }; #debug str(dimension_size(A, 1), 0, 0)") == "3");
  CHECK(debugOf("#debug str(max(1 < 2, 0), 0, 0)") == "1");
  CHECK(debugOf("#debug str(tau / pi, 0, 0)") == "2");
}

TEST_CASE("long sums and texts do not need a deep stack", "[lang]") {
  CHECK(debugOf("#declare S = 0 #for (I, 1, 20000) + I #end ; #debug str(S, 0, 0)") == "200010000");
}

TEST_CASE("includes are looked for beside the file that asks", "[lang]") {
  const Folder f;
  f.write("main.scene", "#include \"sub/a.inc\" #debug str(A, 0, 0) #debug str(defined(L), 0, 0)");
  f.write("sub/a.inc", "#local L = 1; #include \"b.inc\"");
  f.write("sub/b.inc", "#declare A = 7;");
  CHECK(f.said() == "70");
}

TEST_CASE("heads that run past the end of their file do no harm", "[lang]") {
  const Folder f;
  const std::string rest = " A, 1, 2) x (1) 1) = 1; sphere { 0, 1 } #end #else #end ";
  for (const char* head : {"#macro M(", "#for (", "#if (", "#while (1", "#switch (", "#ifdef (",
                           "#declare", "#macro", "#for (I, 1,", "sphere {", "#declare X =", "/*",
                           "#switch (1) #case (", "#if (0) #elseif (", "function("}) {
    INFO(head);
    f.write("main.scene", "#include \"sub/a.inc\"" + rest + rest);
    f.write("sub/a.inc", "#declare A = 1; " + std::string(head));
    CHECK_THAT(f.said(), containsText("error"));
    f.write("main.scene", "#macro Q() " + std::string(head) + " #end Q()" + rest + rest);
    CHECK_THAT(f.said(), containsText("error"));
  }
}

TEST_CASE("include paths come last, in their order", "[lang]") {
  const Folder f, first, second;
  f.write("main.scene", "#include \"x.inc\"#include \"y.inc\"");
  first.write("y.inc", "#debug \"first\"");
  second.write("x.inc", "#debug \"x\"");
  second.write("y.inc", "#debug \"second\"");
  Options options;
  options.includePaths = {first.path.string(), second.path.string()};
  CHECK(f.said(options) == "xfirst");
}

TEST_CASE("--sandbox keeps includes below the scene and the include paths", "[lang]") {
  const Folder f, outside;
  outside.write("x.inc", "#debug \"x\"");
  f.write("main.scene", "#include \"" + (outside.path / "x.inc").string() + "\"");
  Options options;
  CHECK(f.said(options) == "x");
  options.sandbox = true;
  CHECK_THAT(f.said(options), containsText("--sandbox forbids"));
  options.includePaths = {outside.path.string()};
  CHECK(f.said(options) == "x");
  f.write("main.scene", "#include \"sub/../../" + outside.path.filename().string() + "/x.inc\"");
  options.includePaths = {};
  CHECK_THAT(f.said(options), containsText("--sandbox forbids"));
}

TEST_CASE("a name from an include file that is missing is pointed at", "[lang]") {
  Options options;
  options.includePaths = {std::string(VESTIGE_SOURCE_DIR) + "/library"};
  CHECK_THAT(printed(read("sphere { 0, 1 brdf lambert { diffuse Red } }", options)),
             containsText("no value is called 'Red': it is declared in 'colors.inc', which is not "
                          "included"));
}

TEST_CASE("the library's files can be read together", "[lang]") {
  Options options;
  options.includePaths = {std::string(VESTIGE_SOURCE_DIR) + "/library"};
  const Result r = read(
      "#include \"colors.inc\"\n#include \"consts.inc\"\n"
      "sphere { 0, 1 brdf lambert { diffuse Red } }"
      "sphere { 0, 1 brdf lambert { diffuse Gray50 } }",
      options);
  INFO(printed(r));
  CHECK(r.diagnostics.list().empty());
  REQUIRE(r.scene.blocks.size() == 2);
  CHECK(r.scene.blocks[0].child("brdf")->find("diffuse")->v[0] == 1);
  CHECK(r.scene.blocks[1].child("brdf")->find("diffuse")->v[0] == Approx(0.5));
}

TEST_CASE("a macro between parentheses may be an operator, behind strings too", "[lang]") {
  const SceneDesc s = scene(
      "#macro Eq() = #end #declare A = 0;"
      "#if (concat(\"a\", \"b\") Eq() \"ab\") #declare A = 1; #end sphere { A, 1 }");
  CHECK(s.blocks[0].find("centre")->v[0] == 1);
}

}  // namespace vestige::lang::test
