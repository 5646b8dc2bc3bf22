// SPDX-License-Identifier: Apache-2.0
// Loops, choices, macros and arrays against POV-Ray 3.7.0.10 itself: rows as in povray_test.cpp.
#include "support/catch.h"

#include "tests/lang/oracle.h"

namespace vestige::lang::test {
namespace {

const Row kChoicesAndLoops[] = {
    // clang-format off
    // #for: the counter is 0 when its bounds are read, and the first bound when the others are
    {"#declare I=5; #for(I,I,I+2) P(I) #end P(I)", "0.000000000000|1.000000000000|2.000000000000|3.000000000000"},
    {"#for(I,I,2) P(I) #end", "0.000000000000|1.000000000000|2.000000000000"},
    {"#declare I=5; #for(I,1,I) P(I) #end", "1.000000000000"},
    {"#declare I=5; #for(I,1,9,I+3) P(I) #end", "1.000000000000|5.000000000000|9.000000000000"},
    {"#declare I=5; #macro M() #for(I,I,I+1) P(I) #end #end M() P(I)", "0.000000000000|1.000000000000|5.000000000000"},
    {"#for(I,1,0.9999999999) P(I) #end P(9)", "9.000000000000"},
    {"#for(I,1,0.99999999991) P(I) #end P(9)", "1.000000000000|9.000000000000"},
    {"#for(I,0,1-1e-11,0.1) #end P(I)", "1.100000000000"},
    {"#declare N=0; #for(I,0,1e-9,1e-10) #declare N=N+1; #end P(N)", "12.000000000000"},
    {"#for(I 1 3) P(I) #end", "1.000000000000|2.000000000000|3.000000000000"},
    {"#for(I,10,1 -3) P(I) #end P(I)", "10.000000000000"},
    {"#for(I,10,1,-3) P(I) #end P(I)", "10.000000000000|7.000000000000|4.000000000000|1.000000000000|-2.000000000000"},
    {R"(#declare I="a"; #for(I,1,2) P(I) #end)", "1.000000000000|2.000000000000"},
    {"#for(I,1,3) P(I) #for(I,1,2) #end #end P(I)", "1.000000000000|4.000000000000"},
    {"#macro M(A) #for(I,1,A) P(I) #end #end M(2) P(defined(I))", "1.000000000000|2.000000000000|0.000000000000"},
    // #switch: the text in front of the first #case is read
    {"#switch(1) P(5) #case(1) P(1) #break #end", "5.000000000000|1.000000000000"},
    {"#switch(2) P(5) #case(1) P(1) #break #end P(7)", "5.000000000000|7.000000000000"},
    {"#switch(2) P(5) #range(1,3) P(1) #break #else P(6) #end P(7)", "5.000000000000|1.000000000000|7.000000000000"},
    {"#switch(2) P(5) #case(1) P(1) #break #else P(6) #end P(7)", "5.000000000000|6.000000000000|7.000000000000"},
    {"#switch(2) #declare W=4; #case(W-2) P(1) #break #end P(W)", "1.000000000000|4.000000000000"},
    {"#switch(1) #if(1) P(4) #end #case(1) P(1) #end", "4.000000000000|1.000000000000"},
    {"#switch(1) #switch(2) P(7) #case(2) P(8) #break #end #case(1) P(1) #end", "7.000000000000|8.000000000000|1.000000000000"},
    {"#switch(1) #case(2>1) P(2) #break #end P(4)", "2.000000000000|4.000000000000"},
    {"#switch(1) #range(0 2) P(2) #break #end P(4)", "2.000000000000|4.000000000000"},
    {"#switch(1) #range(2,0) P(2) #break #end P(4)", "4.000000000000"},
    {"#switch(1) #range(0,1-1e-11) P(2) #break #end P(4)", "4.000000000000"},
    {"#switch(1) #case(1.00000000009) P(2) #break #end P(4)", "2.000000000000|4.000000000000"},
    {"#switch(1) #case(1.00000000011) P(2) #break #end P(4)", "4.000000000000"},
    {"#switch(1) #case(1) P(1) #range(5,6) P(2) #break P(4) #end P(3)", "1.000000000000|2.000000000000|3.000000000000"},
    {"#switch(1) #case(2) #switch(2) #case(1) P(22) #break #else P(9) #end #break #else P(2) #end P(4)", "2.000000000000|4.000000000000"},
    {"#for(I,1,3) #switch(I) #case(2) #break #else P(I) #end #end", "1.000000000000|3.000000000000"},
    {"#while(1) #switch(1) #case(1) #break #end P(1) #break #end P(2)", "1.000000000000|2.000000000000"},
    {"#macro M() #break #end #while(1) M() P(1) #break #end P(2)", "1.000000000000|2.000000000000"},
    // only a name has a value
    {R"(#ifdef("A") P(1) #else P(2) #end)", "2.000000000000"},
    {"#ifndef(5) P(1) #else P(2) #end", "1.000000000000"},
    // clang-format on
};

// Of texts that POV-Ray refuses: what it wrote before.
const Row kRefused[] = {
    // clang-format off
    {"P(1) #if(0) P(2) #else P(3) #else P(4) #end P(5)", "1.000000000000|3.000000000000"},
    {"P(1) #if(0) P(2) #else P(3) #elseif(1) P(4) #end P(5)", "1.000000000000|3.000000000000"},
    {"P(1) #if(1) P(2) #end #end P(3)", "1.000000000000|2.000000000000"},
    {"P(1) #else P(2)", "1.000000000000"},
    {"P(1) #case(1) P(2)", "1.000000000000"},
    {"P(1) #if(1) P(2)", "1.000000000000|2.000000000000"},
    {"P(1) #switch(1) P(4) #end P(3)", "1.000000000000|4.000000000000"},
    {"P(1) #switch(1) P(4) #else P(5) #end P(3)", "1.000000000000|4.000000000000"},
    {"P(1) #switch(1) #case(1) P(2) #elseif(1) P(3) #end P(4)", "1.000000000000|2.000000000000"},
    {"P(1) #switch(1) #case(1) P(2)", "1.000000000000|2.000000000000"},
    {"P(1) #break P(2)", "1.000000000000"},
    {"P(1) #for(I,1,2,1e-11) P(I) #end P(3)", "1.000000000000"},
    {"P(1) #for(I,1,3) #undef I P(2) #end P(3)", "1.000000000000|2.000000000000"},
    {"P(1) #for(I,1,3) #declare I=x; P(2) #end P(3)", "1.000000000000|2.000000000000"},
    {"P(1) #declare A=B; P(2)", "1.000000000000"},
    {"P(1) #declare sin=1; P(2)", "1.000000000000"},
    {"P(1) #undef 5 P(2)", "1.000000000000"},
    {"P(1) #declare clock=1; P(clock)", "1.000000000000"},
    {"P(1) #local now=3; P(now)", "1.000000000000"},
    {"P(1) #declare Z=array[3]{1,2,3}; P(Z[-0.5])", "1.000000000000"},
    {"P(1) #declare Z=array[3]{1,2,3}; P(Z[-1e-9])", "1.000000000000"},
    {"P(1) #declare Z=array[3]{1,2,3}; P(Z[3-1e-11])", "1.000000000000"},
    {"P(1) #declare deprecated = 5; P(deprecated)", "1.000000000000"},
    {"P(1) #junk P(2)", "1.000000000000"},
    // clang-format on
};

}  // namespace

TEST_CASE("loops and choices give POV-Ray's results", "[lang]") { checkRows(kChoicesAndLoops); }

TEST_CASE("arguments of macros: elements by reference, commas may be left out", "[lang]") {
  // clang-format off
  const Row rows[] = {
      {"#macro M(Z) #local Z=9; #end #declare A=array[3]{1,2,3}; M(A[1]) P(A[1])", "9.000000000000"},
      {"#macro M(Z) #declare Z=Z+1; #end #declare A=array[2][2]{{1,2},{3,4}}; #for(I,0,1) M(A[I][1]) M(A[I][1]) #end P(A[0][1]) P(A[1][1])", "4.000000000000|6.000000000000"},
      {"#macro N(Y) #declare Y=7; #end #macro M(Z) N(Z) #end #declare A=array[2]{1,2}; M(A[1]) P(A[1])", "7.000000000000"},
      {"#declare A=array[2]{array[2]{1,2},array[2]{3,4}}; #macro M(Z) #declare Z[1]=9; #end M(A[1]) P(A[1][1])", "9.000000000000"},
      {"#macro M(Z) P(Z) #end #declare A=array[2]{1,2}; M(A[1]+1) M(A[0]*2) M(-A[1])", "3.000000000000|2.000000000000|-2.000000000000"},
      {"#declare A=array[2]{1,2}; #declare B=A; #macro M(Z) #declare Z=8; #end M(A[1]) P(A[1]) P(B[1])", "8.000000000000|2.000000000000"},
      {"#declare A=array[2]{x,y}; #macro M(Z) #declare Z=z; #end M(A[1]) Q(A[1])", "0.000000000,0.000000000,1.000000000"},
      {"#declare A=array[2]{1,2}; #macro M(Z) #undef Z #end M(A[1]) P(A[1])", "2.000000000000"},
      {"#declare Z=array[3]{1,2,3}; #macro M() #local Z[1]=9; P(Z[1]) #end M() P(Z[1])", "2.000000000000|2.000000000000"},
      {"#macro N() #local Z[1]=9; #end #macro M() #local Z=array[3]{1,2,3}; N() P(Z[1]) #end M()", "2.000000000000"},
      {"#macro M(Z) #local Z[1]=9; #end #declare A=array[3]{1,2,3}; M(A) P(A[1])", "9.000000000000"},
      {"#macro M(A B) P(A+B) #end M(1 2)", "3.000000000000"},
      {"#macro M(A,B) P(A+B) #end M(1 2)", "3.000000000000"},
      {"#macro M(A,B) P(A-B) #end M(1,2,)", "-1.000000000000"},
      {"#macro M(A B) #declare A=5; #end #declare X=1; #declare Y=2; M(X Y) P(X)", "1.000000000000"},
      {"#macro M(A B) #declare B=5; #end #declare X=1; #declare Y=2; M(X Y) P(Y)", "5.000000000000"},
      {"#macro M(A B) #declare A=5; #end #declare X=array[2]{1,2}; #declare Y=2; M(X[0] Y) P(X[0])", "1.000000000000"},
      {"#macro M(A B) P(A-B) #end M((1) (2))", "-1.000000000000"},
      {"#macro M(A B) Q(A+B) #end M(<1,2,3> <4,5,6>)", "5.000000000,7.000000000,9.000000000"},
      {"#macro M(A B) S(concat(A,B)) #end M(\"a\" \"b\")", "ab"},
      {"#macro M(A B C) P(A+B+C) #end M(1 2,3)", "6.000000000000"},
  };
  // clang-format on
  checkRows(rows);
}

TEST_CASE("in functions u and v are x and y", "[lang]") {
  const Row rows[] = {{"#declare F=function{u+2*v+x} P(F(1,2,3))", "6.000000000000"},
                      {"#declare F=function(x,y){u+2*v} P(F(1,2))", "5.000000000000"},
                      {"#declare F=function(u,v){x+2*y} P(F(1,2))", "5.000000000000"},
                      {"#declare F=function(a,x){u} P(F(1,2))", "2.000000000000"},
                      {"#declare F=function(x,u){x+10*u} P(F(1,2))", "22.000000000000"},
                      {"#declare F=function(u){x} P(F(4))", "4.000000000000"}};
  checkRows(rows);
}

TEST_CASE("indices are rounded down with POV-Ray's tolerance", "[lang]") {
  const Row rows[] = {
      {"#declare Z=array[3]{1,2,3}; P(Z[1-1e-9]) P(Z[1-1e-11]) P(Z[-1e-11]) P(Z[2.999])",
       "1.000000000000|2.000000000000|1.000000000000|3.000000000000"},
      {"#declare Z=array[3]{1,2,3}; #declare Z[1.9999999999999]=7; P(Z[2])", "7.000000000000"}};
  checkRows(rows);
}

/// The warnings are POV-Ray's in number and place.
TEST_CASE("a deprecated name warns where it is used", "[lang]") {
  const auto warnings = [](const std::string& text) {
    std::string all;
    const Result r = read(text);
    for (const Diagnostic& d : r.diagnostics.list())
      all += std::to_string(d.span.begin) + ":" + d.message + "|";
    return all;
  };
  CHECK(warnings("#declare deprecated A = 5; #declare B = A;") == "40:'A' is deprecated|");
  CHECK(warnings("#declare deprecated once \"m\" A = 5; #declare B = A; #declare C = A;") ==
        "49:m|");
  CHECK(warnings("#local deprecated \"m\" A = 5; #declare B = A; #declare C = A;") == "42:m|58:m|");
  CHECK(warnings("#declare deprecated A = 5; #declare A = 6;") == "36:'A' is deprecated|");
  CHECK(warnings("#declare deprecated once A = 5;") == "");
  CHECK(warnings("#declare deprecated S = sphere { 0, 1 } object { S }") ==
        "49:'S' is deprecated|");
}

TEST_CASE("after an error #debug is silent, as POV-Ray has stopped", "[lang]") {
  for (const Row& row : kRefused) {
    INFO(row.text);
    std::string said;
    Options options;
    options.debug = [&](const std::string& text) { said += text; };
    const Result result =
        readSceneText("test.scene", std::string(kPrelude) + row.text, schemas(), options);
    CHECK(joined(said) == row.expected);
    CHECK(result.diagnostics.hasErrors());
  }
}

}  // namespace vestige::lang::test
