// SPDX-License-Identifier: Apache-2.0
// The macros of the library that measure objects: what POV-Ray 3.7.0.10 wrote for the same texts
// with its own files, as in library_test.cpp.
#include "tests/lang/oracle.h"
#include "tests/lang/solids.h"
#include "tests/lang/spheres.h"

namespace vestige::lang::test {

TEST_CASE("the library's macros of objects give POV-Ray's results", "[lang]") {
  const std::string begin =
      "#include \"rand.inc\"\n#include \"shapes.inc\"\n#include \"transforms.inc\"\n"
      "#declare S=sphere{<1,2,3>,0.5} ";
  // clang-format off
  const Row rows[] = {
      {"#declare R=seed(4); Q(VRand_In_Obj(S,R)) Q(VRand_In_Obj(S,R)) Q(VRand_In_Obj(S,R)) P(rand(R))", "1.187962878,2.048793739,3.416374176|1.389901923,2.260338410,2.961565220|1.322965984,2.145295020,3.248871632|0.498809126322"},
      {"#declare T=object{S Center_Trans(S,x)} Q(min_extent(T)) #declare T=object{S Center_Trans(S,x+y+z)} Q(min_extent(T)) #declare T=object{S Center_Trans(S,y+z)} Q(max_extent(T)) #declare T=object{S Center_Trans(S,2*y)} Q(max_extent(T)) #declare T=object{S Center_Trans(S,-y)} Q(max_extent(T))", "-0.500000000,1.500000000,2.500000000|-0.500000000,-0.500000000,-0.500000000|1.500000000,0.500000000,0.500000000|1.500000000,-1.500000000,3.500000000|1.500000000,4.500000000,3.500000000"},
      {"#declare T=object{S Align_Trans(S,x,<10,20,30>)} Q(min_extent(T)) Q(max_extent(T)) #declare T=object{S Align_Trans(S,-x+y,<10,20,30>)} Q(min_extent(T)) Q(max_extent(T)) #declare T=object{S Align_Trans(S,<0.5,-0.2,0>,<10,20,30>)} Q(min_extent(T)) Q(max_extent(T)) #declare T=object{S Align_Trans(S,<-3,0,2>,<10,20,30>)} Q(min_extent(T)) Q(max_extent(T))", "9.000000000,1.500000000,2.500000000|10.000000000,2.500000000,3.500000000|10.000000000,19.000000000,2.500000000|11.000000000,20.000000000,3.500000000|0.500000000,1.500000000,2.500000000|1.500000000,2.500000000,3.500000000|10.000000000,1.500000000,29.000000000|11.000000000,2.500000000,30.000000000"},
      {"#for(I,-0.6,-0.4,0.1) #declare T=object{S Align_Trans(S,I*x,<10,20,30>)} #debug concat(str(min_extent(T).x,0,1),\" \") #end", "10.0 0.5 0.5 "},
      {"#declare T=Center_Object(S,x+z) Q(min_extent(T)) #declare T=Align_Object(S,y,<0,1,0>) Q(min_extent(T)) Q(max_extent(T))", "-0.500000000,1.500000000,-0.500000000|0.500000000,0.000000000,2.500000000|1.500000000,1.000000000,3.500000000"},
      {"#declare A=0; #declare B=0; Extents(S,A,B) Q(A) Q(B)", "0.500000000,1.500000000,2.500000000|1.500000000,2.500000000,3.500000000"},
      {"#declare U=sphere{0,1} #declare O=<9,9,9>; P(Isect(-3*z,z,U,O)) Q(O) P(Isect(<5,0,0>,z,U,O)) Q(O)", "1.000000000000|0.000000000,0.000000000,-1.000000000|0.000000000000|0.000000000,0.000000000,-1.000000000"},
  };
  // clang-format on
  for (const Row& row : rows) {
    Spheres spheres;
    Options options = with(spheres);
    options.includePaths = {std::string(VESTIGE_SOURCE_DIR) + "/library"};
    const std::string text = begin + row.text;
    const Row whole[] = {{text.c_str(), row.expected, 1e-8}};
    checkRows(whole, options, solids());
  }
}

}  // namespace vestige::lang::test
