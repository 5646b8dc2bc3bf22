// SPDX-License-Identifier: Apache-2.0
// What POV-Ray 3.8 has beyond 3.7, as its documentation describes it: tuples, dictionaries,
// `local.` and `global.`, elements that are forgotten.
#include "support/catch.h"

#include "tests/lang/schemas.h"

namespace vestige::lang::test {
namespace {

/// The value of a number expression behind a text.
std::string valueOf(const std::string& text, const std::string& expression) {
  return debugOf(text + " #debug str(" + expression + ", 0, 0)");
}

}  // namespace

TEST_CASE("a tuple declares several names at once", "[lang]") {
  CHECK(valueOf("#declare (A, B) = (1, 2);", "A*10 + B") == "12");
  CHECK(valueOf("#declare A = 1; #declare B = 2; #declare (A, B) = (B, A);", "A*10 + B") == "21");
  CHECK(valueOf("#macro M() #local (A, B) = (1, 2); #declare C = A + B; #end M()",
                "C + defined(A)") == "3");
  CHECK(debugOf(R"(#declare (A, S, V) = (1, "two", <3, 4>); #debug concat(S, str(V.y, 0, 0)))") ==
        "two4");
}

TEST_CASE("a dictionary has values by key", "[lang]") {
  const std::string d = R"(#declare D = dictionary { ["a"]: 1, .b: <2, 3>, ["c d"]: "text" };)";
  CHECK(valueOf(d, R"(D["a"] + D.b.y + strlen(D["c d"]))") == "8");
  CHECK(valueOf(d + R"(#declare D.e = 5; #declare D["a"] = 6;)", R"(D["e"]*10 + D.a)") == "56");
  CHECK(valueOf(d + R"(#declare K = "b";)", R"(D[concat(K, "")].x)") == "2");
  CHECK(valueOf("#declare D = dictionary; #declare D.x = 7;", "D.x") == "7");
  CHECK(valueOf(d, R"(defined(D.a)*100 + defined(D["b"])*10 + defined(D.none))") == "110");
  CHECK(valueOf(d + "#undef D.a #undef D[\"b\"]", "defined(D.a) + defined(D.b) + defined(D)") ==
        "1");
  CHECK(valueOf(d + "#ifdef (D.a) #declare X = 1; #else #declare X = 2; #end", "X") == "1");
  CHECK(valueOf(d, "(1 ? 5 : D.none)") == "5");
}

TEST_CASE("dictionaries are values", "[lang]") {
  CHECK(valueOf("#declare D = dictionary { .a: 1 } #declare E = D; #declare E.a = 2;",
                "D.a*10 + E.a") == "12");
  CHECK(valueOf("#declare D = dictionary { .a: 1 } #declare E = D; #undef E.a",
                "D.a*10 + defined(E.a)") == "10");
  CHECK(valueOf("#declare D = dictionary { .in: dictionary { .a: 1 }, .list: array[2] { 3, 4 } }"
                "#declare E = D; #declare D.in.a = 5; #declare D.list[1] = 6;",
                "D.in.a*1000 + D.list[1]*100 + E.in.a*10 + E.list[1]") == "5614");
  CHECK(valueOf("#declare A = array[2] { dictionary { .k: 1 }, 4 } #declare B = A;"
                "#declare A[0].k = 5; #declare A[1] = 6;",
                "A[0].k*100 + A[1]*10 + B[0].k") == "561");
  CHECK(valueOf("#declare dictionary = 3;", "dictionary") == "3");
}

TEST_CASE("local and global choose a table", "[lang]") {
  const std::string m = "#declare A = 1; #macro M() #local A = 2; ";
  CHECK(valueOf(m + "#declare R = local.A*10 + global.A; #end M()", "R") == "21");
  CHECK(valueOf(m + "#declare global.A = 5; #declare R = A; #end M()", "R*10 + A") == "25");
  CHECK(valueOf(m + "#declare local.A = 5; #declare R = A; #end M()", "R*10 + A") == "51");
  CHECK(valueOf(m + "#undef local.A #declare R = A; #end M()", "R*10 + A") == "11");
  CHECK(valueOf(m + "#declare R = defined(local.A)*10 + defined(local.M); #end M()", "R") == "10");
  CHECK(valueOf("#declare global = 4;", "global") == "4");
  CHECK(debugOf("#debug str(global.None, 0, 0)") == "error: no global value is called 'None'\n");
}

TEST_CASE("elements are forgotten; arrays may be called mixed", "[lang]") {
  CHECK(valueOf("#declare A = array[2] { 1, 2 } #undef A[0]", "defined(A[0])*10 + A[1]") == "2");
  CHECK(valueOf("#declare A = array mixed { 1, \"s\" }", "A[0] + strlen(A[1])") == "2");
  CHECK(valueOf("#declare A = array[2] mixed { 1, <2, 3> }", "A[1].y") == "3");
  CHECK(valueOf("#declare A = array mixed[2]; #declare A[1] = 4;", "A[1]") == "4");
}

TEST_CASE("optional parameters of macros may be left out", "[lang]") {
  CHECK(valueOf("#macro M(A, optional B) #ifdef (local.B) A + B #else A #end #end",
                "(M(1, 2))*10 + M(3)") == "33");
}

TEST_CASE("dictionaries count against the limits", "[lang]") {
  Options options;
  options.limits.arrayElements = 100;
  CHECK(debugOf(R"(#declare D = dictionary; #for (I, 1, 200) #declare D[str(I, 0, 0)] = I; #end)",
                options)
            .find("--max-array-elements") != std::string::npos);
}

}  // namespace vestige::lang::test
