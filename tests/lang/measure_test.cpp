// SPDX-License-Identifier: Apache-2.0
// trace(), inside(), min_extent() and max_extent(). The geometry is a stub for spheres, by closed
// forms; what the functions make of it is what POV-Ray 3.7.0.10 wrote for the same texts, as in
// povray_test.cpp.
#include "tests/lang/oracle.h"
#include "tests/lang/spheres.h"

namespace vestige::lang::test {
namespace {

std::string errorOf(const std::string& text) {
  Spheres spheres;
  return debugOf(text, with(spheres));
}

}  // namespace

TEST_CASE("functions of objects give POV-Ray's results", "[lang]") {
  // clang-format off
  const Row rows[] = {
      {"#declare S=sphere{<0,1,0>,1} #declare N=<0,0,0>; Q(trace(S,<0,1,-5>,z,N)) Q(N) Q(trace(S,<0,1,-5>,2*z+0.1*y,N)) Q(N) Q(trace(S,<0,5,-5>,z,N)) Q(N)", "0.000000000,1.000000000,-1.000000000|0.000000000,0.000000000,-1.000000000|0.000000000,1.201020650,-0.979587004|0.000000000,0.201020650,-0.979587004|0.000000000,0.000000000,0.000000000|0.000000000,0.000000000,0.000000000", 1e-8},
      {"#declare S=sphere{<0,1,0>,1} Q(trace(S,<0,1,0>,z)) Q(min_extent(S)) Q(max_extent(S)) P(inside(S,<0,1,0>)) P(inside(S,<0,3,0>)) P(inside(S,<0,2,0>))", "0.000000000,1.000000000,1.000000000|-1.000000000,0.000000000,-1.000000000|1.000000000,2.000000000,1.000000000|1.000000000000|0.000000000000|0.000000000000"},
      {"#declare S=sphere{<0,1,0>,1} #declare N=<1,2,3>; Q(trace(S,<0,1,-5>,<0,0,0>,N)) Q(N)", "0.000000000,0.000000000,0.000000000|0.000000000,0.000000000,0.000000000"},
      {"#declare S=plane{y,1} Q(min_extent(S)) Q(max_extent(S))", "-10000000000.000000000,-10000000000.000000000,-10000000000.000000000|10000000000.000000000,10000000000.000000000,10000000000.000000000"},
      {"#declare S=sphere{<0,1,0>,1} P(inside(S,0.2)) Q(trace(S,0,1))", "1.000000000000|0.666666667,0.666666667,0.666666667", 1e-8},
      {"#declare A=array[1]{sphere{0,1}} Q(min_extent(A[0])) Q(trace(A[0],-z*3,z))", "-1.000000000,-1.000000000,-1.000000000|0.000000000,0.000000000,-1.000000000"},
      {"#declare S=sphere{<0,1,0>,1} #declare N=array[1]{x} Q(trace(S,<0,1,-5>,z,N[0])) Q(N[0])", "0.000000000,1.000000000,-1.000000000|0.000000000,0.000000000,-1.000000000"},
      {"#declare S=sphere{<0,1,0>,1} #macro M(V) #local K=trace(S,<0,1,-5>,z,V); #end #declare N=y; M(N) Q(N)", "0.000000000,0.000000000,-1.000000000"},
      {"#declare S=sphere{<0,1,0>,1} #declare N=<0,0,0>; Q(trace(S,<0,1,-5> z N))", "0.000000000,1.000000000,-1.000000000"},
      {"#declare S=union{sphere{<0,1,0>,1} sphere{<3,0,0>,2 scale 2} translate <1,2,3>} Q(min_extent(S)) Q(max_extent(S))", "0.000000000,-2.000000000,-1.000000000|11.000000000,6.000000000,7.000000000"},
      {"#declare S=sphere{0,1} #declare T=object{S scale 2 translate 5*x} #declare N=y; Q(trace(T,<0,1,0>,x,N)) Q(N) P(inside(T,<6.9,0,0>)) P(inside(T,<2,0,0>))", "3.267949192,1.000000000,0.000000000|-0.866025404,0.500000000,0.000000000|1.000000000000|0.000000000000", 1e-8},
      {"#declare S=sphere{0,1} #declare N=y; Q(trace(S,0,x,N)) Q(N)", "1.000000000,0.000000000,0.000000000|1.000000000,0.000000000,0.000000000"},
  };
  // clang-format on
  Spheres spheres;
  checkRows(rows, with(spheres));
}

TEST_CASE("the normal of trace() goes to a declared vector", "[lang]") {
  const std::string sphere = "#declare S = sphere { 0, 1 } #declare P = ";
  CHECK_THAT(errorOf(sphere + "trace(S, -3*z, z, N);"), containsText("no vector is called 'N'"));
  CHECK_THAT(errorOf("#declare N = 3; " + sphere + "trace(S, -3*z, z, N);"),
             containsText("takes the name of a vector <x, y, z> here, found the number 3"));
  CHECK_THAT(errorOf("#declare N = <1, 2>; " + sphere + "trace(S, -3*z, z, N);"),
             containsText("found the vector <1, 2>"));
  CHECK_THAT(errorOf("#declare N = rgb 1; " + sphere + "trace(S, -3*z, z, N);"),
             containsText("found the colour"));
  CHECK_THAT(errorOf(sphere + "trace(S, -3*z, z, <1, 2, 3>);"),
             containsText("expected the name of a declared vector, found '<'"));
  CHECK_THAT(errorOf("#declare N = array[1] { y }; " + sphere + "trace(S, -3*z, z, N[1]);"),
             containsText("index"));
  Spheres spheres;
  const std::string shows = "#debug vstr(3, N, \" \", 0, 0) ";
  CHECK(debugOf("#declare D = dictionary { .n: y, .m: y }; #declare C = D; " + sphere +
                    "trace(S, -3*z, z, D.n); #declare N = C.n; " + shows +
                    "#declare N = D[\"n\"]; " + shows,
                with(spheres)) == "0 1 00 0 -1");  // the copy is another one
  // The branch that is not taken assigns nothing.
  CHECK(debugOf("#declare N = y; " + sphere + "(1 ? x : trace(S, -3*z, z, N)); " + shows,
                with(spheres)) == "0 1 0");
}

TEST_CASE("functions of objects take shapes and unions", "[lang]") {
  CHECK_THAT(errorOf("#declare A = 3; #declare B = min_extent(A);"),
             containsText("min_extent() takes a declared shape or union here, found the number 3"));
  CHECK_THAT(errorOf("#declare A = brdf lambert { } #declare B = inside(A, 0);"),
             containsText("found the block 'brdf lambert'"));
  CHECK_THAT(errorOf("#declare B = max_extent(sphere { 0, 1 });"), containsText("found 'sphere'"));
  CHECK_THAT(errorOf("#declare A = box { 0, 1 } #declare B = min_extent(A);"),
             containsText("the shape 'box' cannot be measured: it is no sphere"));
  CHECK_THAT(errorOf("#declare A = sphere { 0, 1 } #declare B = trace(A, 0);"),
             containsText("trace() takes 3 to 4 arguments, found 2"));
  CHECK_THAT(errorOf("#declare A = sphere { 0, 1 } #declare F = function { inside(A, x) };"),
             containsText("inside() cannot stand inside a function"));
}

TEST_CASE("without a program that measures, functions of objects are words of POV-Ray's",
          "[lang]") {
  for (const char* call : {"trace(S, 0, z)", "inside(S, 0)", "min_extent(S)", "max_extent(S)"})
    CHECK_THAT(
        debugOf("#declare S = sphere { 0, 1 } #declare A = " + std::string(call) + ";"),
        containsText("is a word of POV-Ray's: Vestige cannot measure objects while it reads"));
}

TEST_CASE("questions about objects count as steps", "[lang]") {
  Spheres spheres;
  Options options = with(spheres);
  options.limits.expandedTokens = 100'000;
  CHECK_THAT(
      debugOf("#declare S = sphere { 0, 1 } #while (1) #declare A = inside(S, 0); #end", options),
      containsText("--max-tokens"));
  CHECK(spheres.questions < 1000);
}

}  // namespace vestige::lang::test
