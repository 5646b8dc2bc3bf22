// SPDX-License-Identifier: Apache-2.0
// Short texts that ask for hours or for all memory. Each is read in a process of its own: at most
// 30 s and 1 GB more than the program itself, and an error with its place.
#include "support/catch.h"

#include "tests/lang/measured.h"
#include "tests/lang/schemas.h"

namespace vestige::lang::test {
namespace {

std::string times(int n, const std::string& s) {
  std::string all;
  all.reserve(std::size_t(n) * s.size());
  for (int i = 0; i < n; ++i) all += s;
  return all;
}

/// `before` N `after`, for N from 1.
std::string counted(int n, const std::string& before, const std::string& after) {
  std::string all;
  for (int i = 1; i <= n; ++i) all += before + std::to_string(i) + after;
  return all;
}

/// A loop that takes as many turns as the limits allow.
std::string forever(const std::string& body) { return "#while (1) " + body + " #end"; }

/// Declares S, a string of 2^log2 letters.
std::string longString(int log2) {
  return "#declare S = \"x\"; #for (I, 1, " + std::to_string(log2) +
         ") #declare S = concat(S, S); #end ";
}

/// Declares the macros M0 to Mlevels; each calls the one before twice.
std::string doubling(int levels, const std::string& atEnd, const std::string& between,
                     const std::string& open = "", const std::string& close = "") {
  std::string all = "#macro M0() " + atEnd + " #end ";
  for (int i = 1; i <= levels; ++i) {
    const std::string call = std::string("M").append(std::to_string(i - 1)) + "()";
    all += "#macro M" + std::to_string(i) + "() " + open + call + between + call + close + " #end ";
  }
  return all;
}

const char* const kTokens = "--max-tokens";
const char* const kMemory = "--max-memory";

struct Row {
  const char* name;
  std::string (*text)();
  const char* error;  ///< part of the message
};

/// Those that take less than a second or so.
const Row kQuick[] = {
    {"h01: a misspelt name of 30,000 letters",
     [] {
       return "#declare " + times(30'000, "a") + " = 1; #declare B = " + times(30'000, "b") + ";";
     },
     "no value is called"},
    {"h02: concat of 12,000 long strings",
     [] { return longString(20) + "#declare T = concat(S" + times(12'000, ", S") + ");"; },
     "raises the limit"},
    {"h03: substr of a long string, kept in an array",
     [] {
       return longString(20) +
              "#declare A = array[4000000]; #for (I, 0, 3999999) #declare A[I] = substr(S, 1, "
              "1048576); #end";
     },
     kMemory},
    {"h04: strupr, kept in an array",
     [] {
       return longString(20) +
              "#declare A = array[100000]; #for (I, 0, 99999) #declare A[I] = strupr(S); #end";
     },
     kMemory},
    {"h08: a #switch that falls through 300,000 parts",
     [] { return "#switch (1) " + times(300'000, "#case (1) ") + "#end #error \"the end\""; },
     "the end"},
    {"a #switch of 300,000 parts without an end",
     [] { return "#switch (1) " + times(300'000, "#case (1) "); }, kTokens},
    {"h14: terminal escapes", [] { return std::string("#error \"\x1b[2J\x1b]0;title\x07\""); },
     "title"},
    {"100,000 open braces", [] { return times(100'000, "union { "); }, "--max-nesting"},
    {"a million open parentheses", [] { return "#declare A = " + times(1'000'000, "("); },
     "--max-nesting"},
    {"a million minus signs", [] { return "#declare A = " + times(1'000'000, "-") + "1;"; },
     "--max-nesting"},
    {"an array of 1e9 elements", [] { return std::string("#declare A = array[1e9];"); },
     "--max-array-elements"},
    {"300,000 arrays inside each other",
     [] {
       return std::string(
           "#declare A = array[1] { 0 } #for (I, 1, 300000) #declare A = array[1] "
           "{ A } #end #error \"the end\"");
     },
     "the end"},
    {"300,000 dictionaries inside each other",
     [] {
       return std::string(
           "#declare A = dictionary; #for (I, 1, 300000) #declare A = dictionary { "
           ".a: A } #end #error \"the end\"");
     },
     "the end"},
    {"300,000 functions inside each other",
     [] {
       return std::string(
           "#declare F = function(a) { a } #for (I, 1, 300000) #declare F = "
           "function(a) { F(a) } #end #error \"the end\"");
     },
     "the end"},
    {"a million indices",
     [] { return "#declare A = array[2]; #declare B = A" + times(1'000'000, "[1]") + ";"; },
     "no value yet"},
    {"300,000 open #if", [] { return times(300'000, "#if (1) "); }, "has no #end"},
    {"300,000 #elseif",
     [] { return "#if (0) " + times(300'000, "#elseif (0) ") + "#end #error \"the end\""; },
     "the end"},
    {"10 MB of open comments", [] { return times(5'000'000, "/*"); }, "never closed"},
    {"NUL and broken UTF-8", [] { return std::string("\0\xff\xfe\xc3(\xed\xa0\x80 sphere", 15); },
     "means nothing here"},
    {"a name of a megabyte", [] { return times(1 << 20, "n") + " = 1;"; }, "expected"},
    {"a resolution of 1e9", [] { return std::string("film { resolution <1e9, 1e9> }"); },
     "must be"},
    {"1e18 samples", [] { return std::string("integrator path { samples 1e18 }"); }, "must be"},
    {"own: a literal of 100 kB, kept in an array",
     [] {
       return "#declare A = array[100000]; #for (I, 0, 99999) #declare A[I] = \"" +
              times(100'000, "x") + "\"; #end";
     },
     kMemory},
    {"own: comparing strings of a megabyte",
     [] { return longString(20) + forever("#declare A = strcmp(S, S);"); }, kTokens},
    {"own: asking for a file at each turn",
     [] { return forever("#declare A = file_exists(\"nothing\");"); }, kTokens},
    {"own: an undeclared name at each turn", [] { return forever("#declare A = B + 1;"); },
     "no value is called"},
    {"own: a syntax error at each turn", [] { return forever("#declare A = ) ;"); },
     "expected a value"},
    {"own: a film behind each of many spheres", [] { return forever("sphere { 0, 1 } film { }"); },
     kTokens},
    {"own: a separator of a megabyte",
     [] { return longString(19) + "#declare T = vstr(5, <1, 2, 3, 4, 5>, S, 0, 1);"; },
     "--max-string-length"},
    {"own: a message that quotes a long name",
     [] { return "sphere { 0, 1 " + times(100'000, "name") + " 1 }"; }, "has no parameter"},
    {"own: macros that call each other without end",
     [] { return std::string("#macro A() B() #end #macro B() A() #end A()"); },
     "--max-macro-depth"},
    {"own: blocks of a name inside itself, doubled",
     [] {
       return "#declare A = sphere { 0, 1 } " + times(60,
                                                      "#declare A = union { object { A } "
                                                      "object { A } } ");
     },
     "--max-blocks"},
};

/// The others.
const Row kSlow[] = {
    {"own: an array copied at each turn",
     [] {
       return std::string("#declare A = array[1000000]; ") +
              forever("#declare B = A; #declare B[0] = 1;");
     },
     kTokens},
    {"own: a large array made at each turn", [] { return forever("#declare A = array[1500000];"); },
     kTokens},
    {"h12: str of the greatest width",
     [] {
       return std::string(
           "#declare A = array[4000000]; #for (I, 0, 3999999) #declare A[I] = str(I, 1000, 1000); "
           "#end");
     },
     "raises the limit"},
    {"h05: warnings of a megabyte",
     [] { return longString(19) + forever("#warning concat(S, str(rand(seed(1)), 0, 9))"); },
     kTokens},
    {"a list of 2^31 entries",
     [] { return "lathe { profile [" + doubling(0, "", "") + times(4'100'000, "0 ") + "] }"; },
     "raises the limit"},
    {"own: many strings of 200 letters",
     [] {
       return longString(7) +
              "#declare A = array[4000000]; #for (I, 0, 3999999) #declare A[I] = concat(S, "
              "str(I, 0, 0)); #end";
     },
     kMemory},
    {"own: #debug of a megabyte", [] { return longString(20) + forever("#debug S"); }, kTokens},
    {"own: a misspelt name among 100,000",
     [] { return counted(100'000, "#declare Name", " = 1;") + forever("#undef Nome123456"); },
     kTokens},
    {"own: a large union moved many times",
     [] {
       return "#declare U = union { " + times(2000, "sphere { 0, 1 } ") +
              "} union { object { U } " + times(100'000, "translate x ") + "}";
     },
     kTokens},
    {"h06: a long string in each of many blocks",
     [] {
       return longString(20) + "#declare M = lathe { profile [0 0] files [S S S S S S S S] }; " +
              forever("object { M }");
     },
     ""},
    {"h07: expansions of a macro with a long name",
     [] {
       const std::string name = times(10'000, "n");
       return doubling(24, name + "()", " ") + "#macro " + name + "() #end M24()";
     },
     kTokens},
    {"h09: a #for whose head has 200,000 tokens",
     [] { return "#for (I, 1, 1e7" + times(100'000, " + 0") + ") #end #error \"the end\""; },
     "--max-loop-iterations"},
    {"h10: a function of 200,000 operands, called a million times",
     [] {
       return "#declare F = function { max(" + times(200'000, "x, ") +
              "y) }; #for (I, 1, 1e6) #declare A = F(I, 2, 3); #end";
     },
     kTokens},
    {"h13: a copy of a sphere at each turn",
     [] {
       return "#declare M = sphere { 0, 1 brdf lambert { diffuse 1 } }; " +
              forever("object { M translate x }");
     },
     "raises the limit"},
    {"h18: as many steps as are allowed",
     [] {
       return forever("#declare A = sin(1)*2 + 3/4 - max(1, 5) + vlength(<1, 2, 3>) " +
                      times(500, " + cos(2)") + ";");
     },
     kTokens},
    {"an endless #while that declares macros", [] { return forever("#macro M() 1 #end"); },
     "raises the limit"},
    {"own: arguments without end, from macros",
     [] { return doubling(30, "1", ", ") + "#macro N() #end N(M30())"; }, "raises the limit"},
    {"own: operands without end, from macros",
     [] { return doubling(30, "1", ", ") + "#declare A = max(M30());"; }, "raises the limit"},
    {"own: a balanced tree of 2^40 operands",
     [] { return doubling(40, "1", " + ", "(", ")") + "#declare A = M40();"; }, "raises the limit"},
    {"own: a function of 2^40 operands",
     [] { return doubling(40, "x", " + ", "(", ")") + "#declare F = function { M40() };"; },
     "raises the limit"},
    {"own: functions kept in an array",
     [] {
       return "#declare A = array[4000000]; #for (I, 0, 3999999) #declare A[I] = function { max(" +
              times(1000, "x, ") + "y) }; #end";
     },
     kMemory},
    {"own: blocks with long functions",
     [] {
       const std::string sum = "max(" + times(100, "x, ") + "y)";
       return forever("isosurface { function { max(" + times(100, sum + ", ") + "z) } }");
     },
     "raises the limit"},
    {"own: functions that call each other twice",
     [] {
       std::string all = "#declare F0 = function(a) { a + 1 }; ";
       for (int i = 1; i < 60; ++i) {
         const std::string g = std::string("F").append(std::to_string(i - 1)) + "(a)";
         all += "#declare F" + std::to_string(i) + " = function(a) { " + g + " + " + g + " }; ";
       }
       return all + "#declare A = F59(1);";
     },
     kTokens},
    {"own: 10,000 local names at each of 200 levels",
     [] { return "#macro M() " + counted(10'000, "#local N", " = 1; ") + "M() #end M()"; },
     "raises the limit"},
    {"own: spheres without end", [] { return forever("sphere { 0, 1 }"); }, "raises the limit"},
    {"own: two million names", [] { return counted(2'000'000, "#declare N", " = 1;\n"); }, kMemory},
    {"own: 40 million numbers", [] { return times(40'000'000, "1 "); }, kMemory},
    {"own: 50 million lines", [] { return times(50'000'000, "\n") + "oops"; }, "found 'oops'"},
    {"own: random streams without end", [] { return forever("#declare A = seed(1);"); },
     "raises the limit"},
    {"own: long lists inside each other",
     [] { return forever("lathe { profile [" + times(10'000, "0 ") + "] }"); }, "raises the limit"},
    {"own: a map of a million entries",
     [] {
       return forever("sphere { 0, 1 brdf lambert { diffuse pigment ramp { colour_map {" +
                      times(100'000, "[0 rgb 1]") + "} } } }");
     },
     "raises the limit"},
    {"own: a chain of 300,000 #elseif in a loop",
     [] { return forever("#if (0) " + times(300'000, "#elseif (0) ") + "#end"); }, kTokens},
    {"own: a #switch of 300,000 parts in a loop",
     [] { return forever("#switch (1) " + times(300'000, "#case (1) ") + "#end"); }, kTokens},
    {"own: a misspelt block among 200,000 names",
     [] { return counted(200'000, "#declare Name", " = 1;") + forever("nome123456 { }"); },
     "found 'nome123456'"},
};

void check(const Row& row) {
  const Measured m = measured(row.text());
  INFO(row.name);
  INFO(m.errors.substr(0, 300));
  INFO(m.megabytes << " MB, " << m.seconds << " s");
  CHECK(m.signal == 0);
  CHECK(m.megabytes < kMostMegabytes);
  CHECK_THAT(m.errors, containsText(row.error));
  CHECK(m.errors.substr(0, 2) != "0:");
  CHECK(!m.errors.empty());
}

}  // namespace

TEST_CASE("hostile texts are refused with an error, quickly and in little memory", "[lang]") {
  for (const Row& row : kQuick) check(row);
}

TEST_CASE("hostile texts that cost more are bounded, too", "[lang][slow]") {
  for (const Row& row : kSlow) check(row);
}

}  // namespace vestige::lang::test
