// SPDX-License-Identifier: Apache-2.0
// Calls of functions while the text is read: by their programs, and by their trees where there is
// something to report. Choices evaluate one branch only.
#include "support/catch.h"

#include <cmath>

#include "tests/lang/schemas.h"

namespace vestige::lang::test {
namespace {

/// The messages of a text, errors and warnings, in their order.
std::string messages(const std::string& text) {
  std::string all;
  const Result result = read(text);
  for (const Diagnostic& d : result.diagnostics.list()) all += d.message + "\n";
  return all;
}

/// What `#debug` writes of an expression.
std::string debugged(const std::string& before, const std::string& expression) {
  std::string seen;
  Options options;
  options.debug = [&](const std::string& s) { seen += s; };
  const Result result = read(before + "#debug " + expression, options);
  for (const Diagnostic& d : result.diagnostics.list()) seen += "[" + d.message + "]";
  return seen;
}

}  // namespace

/// As in POV-Ray, & and | bind equally.
TEST_CASE("a call of a function gives what C++ computes", "[lang]") {
  const auto bodies = std::vector<std::pair<std::string, double (*)(double, double)>>{
      {"x*y - x/(y + 10) + x % 3",
       [](double x, double y) { return x * y - x / (y + 10) + std::fmod(x, 3); }},
      {"sqrt(x*x + y*y) - 1 + sin(x*3)*0.1",
       [](double x, double y) { return std::sqrt(x * x + y * y) - 1 + std::sin(x * 3) * 0.1; }},
      {"x > 0 ? (y > 0 ? 1 : 2) : (y > 0 ? 3 : 4)",
       [](double x, double y) { return x > 0 ? (y > 0 ? 1.0 : 2.0) : (y > 0 ? 3.0 : 4.0); }},
      {"-x + !y + (x <= y) + 2*(x != y | x & y)",
       [](double x,
          double y) { return -x + (y == 0) + (x <= y) + 2 * ((x != y || x != 0) && y != 0); }},
      {"max(x, y, 0.5) + pow(2, min(x, y)) + int(x) + floor(y)", [](double x, double y) {
         return std::max({x, y, 0.5}) + std::pow(2, std::min(x, y)) + std::trunc(x) + std::floor(y);
       }}};
  for (const auto& [body, expected] : bodies)
    for (const double x : {-2.5, -1.0, 0.0, 0.25, 3.0})
      for (const double y : {-1.5, 0.0, 2.0}) {
        const std::string call =
            "str(F(" + std::to_string(x) + ", " + std::to_string(y) + "), 0, 12)";
        INFO(body << " at " << x << ", " << y);
        CHECK(std::abs(std::stod(debugged("#declare F = function(x, y) { " + body + " }", call)) -
                       expected(x, y)) < 1e-11);
      }
}

TEST_CASE("a call reports what its expression would", "[lang]") {
  const auto of = [](const std::string& body, const std::string& x) {
    return messages("#declare F = function { " + body + " } #declare A = F(" + x + ", 0, 0);");
  };
  CHECK(of("1/x", "2") == "");
  CHECK(of("1/x", "0") == "division by zero\n");
  CHECK(of("1/(1/x)", "0") == "division by zero\n");  // though the result is a plain 0
  CHECK(of("x = 0 ? 5 : 1/x", "0") == "");
  CHECK(of("x = 0 ? 1/x : 5", "0") == "division by zero\n");
  CHECK(of("sqrt(x) < 1", "-1").find("sqrt()") == 0);
  CHECK(of("acos(x)", "2").find("acos()") == 0);
  CHECK(of("ln(x)", "0").find("ln()") == 0);
  CHECK(of("mod(x, 0)", "1").find("mod()") == 0);
}

TEST_CASE("functions of other values than numbers are called by their trees", "[lang]") {
  CHECK(debugged("#declare F = function(n) { concat(\"a\", str(n, 0, 0)) }", "F(7)") == "a7");
  CHECK(debugged("#declare F = function(n) { <n, 2, 3> }", "str(F(7).x, 0, 0)") == "7");
  CHECK(debugged("#declare G = function(n) { <n, 2, 3> }"
                 "#declare F = function(n) { G(n).y + n }",
                 "str(F(7), 0, 0)") == "9");
  CHECK(debugged("#declare G = function(n) { n*n }"
                 "#declare F = function(n) { concat(str(G(n + 1), 0, 0), str(n, 0, 0)) }",
                 "F(7)") == "647");
}

TEST_CASE("a choice evaluates the branch that is taken, and reads the other", "[lang]") {
  const std::string array = "#declare A = array[2] { 4, 5 };";
  CHECK(debugged(array, "str(1 > 2 ? A[7] : A[1], 0, 0)") == "5");
  CHECK(debugged(array, "str(1 < 2 ? A[1] : 1/0, 0, 0)") == "5");
  CHECK(debugged(array, "(1 < 2 ? \"yes\" : A[7])") == "yes");
  CHECK(debugged("", "str(0 ? 1/0 : 1 ? 2 : 1/0, 0, 0)") == "2");
  CHECK(debugged("#declare S = seed(1); #declare T = seed(1); #declare A = (0 ? rand(S) : 1);",
                 "str(rand(S) - rand(T), 0, 0)") == "0");
  CHECK(debugged("", "str(<1, 2> ? 1 : 2, 0, 0)").find("the condition of '?'") == 1);
}

TEST_CASE("functions that call each other through constants are bounded", "[lang]") {
  std::string text =
      "#declare F = function(x) { x } #for (I, 1, 3500) "
      "#declare F = function(x) { vlength(<F(1), 0, 0>) + x } #end ";
  const std::string found = messages(text + "#declare A = F(1);");
  CHECK(found.find("these functions are nested more than") != std::string::npos);
}

TEST_CASE("a branch that is not taken reports nothing", "[lang]") {
  const std::string f = "#declare F = function(x) { x > 0 ? 1 : strlen(3) } ";
  CHECK(debugged(f, "str(F(1), 0, 0)") == "1");
  CHECK(debugged(f, "str(F(-1), 0, 0)").find("strlen() takes a string") != std::string::npos);
}

/// Without the count of what was executed: 3 to the 9th steps each, a hundred times.
TEST_CASE("a call costs the steps that it executes", "[lang]") {
  std::string text = "#declare F0 = function(x) { x } ";
  for (int i = 1; i <= 9; ++i) {
    const std::string inner = std::string("F").append(std::to_string(i - 1));
    text += "#declare F" + std::to_string(i) + " = function(x) { x > 100 ? " + inner + "(x) + " +
            inner + "(x + 1) + " + inner + "(x + 2) : 1 } ";
  }
  Options few;
  few.limits.expandedTokens = 300'000;
  CHECK(read(text + "#for (I, 1, 100) #declare A = F9(I); #end", few).diagnostics.errors() == 0);
}

TEST_CASE("programs of functions that are forgotten leave no memory behind", "[lang]") {
  Options small;
  small.limits.memory = 8 << 20;
  const Result r =
      read("#for (I, 1, 100000) #declare F = function(x) { x*x + 2*x + 1 } #declare A = F(I); #end",
           small);
  CHECK(r.diagnostics.errors() == 0);
}

TEST_CASE("the arguments of nested calls are counted together", "[lang]") {
  Options small;
  small.limits.memory = 4 << 20;
  std::string text = "#declare A = ";
  for (int i = 0; i < 50; ++i) {
    text += "max(";
    for (int k = 0; k < 1000; ++k) text += "1,";
  }
  const Result r = read(text, small);
  REQUIRE(r.diagnostics.errors() == 1);
  CHECK(r.diagnostics.list()[0].message.find("--max-memory") != std::string::npos);
}

}  // namespace vestige::lang::test
