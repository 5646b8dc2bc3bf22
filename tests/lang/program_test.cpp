// SPDX-License-Identifier: Apache-2.0
// The forms of a function's program against the plain one: eight lanes have its bits, intervals
// hold its values, derivatives are its differences.
#include "support/catch.h"

#include <cmath>
#include <random>

#include "lang/builtins.h"
#include "lang/program.h"
#include "tests/lang/schemas.h"

namespace vestige::lang::test {
namespace {

using FunctionPtr = std::shared_ptr<const vestige::Function>;

FunctionPtr functionOf(const std::string& body) {
  const SceneDesc s = scene(
      "#declare Inf = pow(10, 400); #declare NaN = Inf - Inf;"
      "#declare F = function { " +
      body + " }; isosurface { function F }");
  return s.blocks[0].find("function")->function;
}

/// Random expressions of x, y and z: every operator and every function of numbers.
class Expressions {
 public:
  explicit Expressions(unsigned seed) : random_(seed) {
    for (const std::string& name : builtinNames())
      if (Program::codeOf(name) != Program::Code::unknown) functions_.push_back(name);
  }

  std::string make(int depth) {
    if (depth == 0 || below(6) == 0) return leaf();
    switch (below(4)) {
      case 0: {
        static const char* const signs[] = {
            "+", "-", "*", "/", "%", "<", "<=", "=", ">", ">=", "!=", "&", "|"};
        return "(" + make(depth - 1) + " " + signs[below(13)] + " " + make(depth - 1) + ")";
      }
      case 1:
        return below(2) ? "(-" + make(depth - 1) + ")" : "(!" + make(depth - 1) + ")";
      case 2:
        return "(" + make(depth - 1) + " ? " + make(depth - 1) + " : " + make(depth - 1) + ")";
      default:
        return call(functions_[std::size_t(below(int(functions_.size())))], depth);
    }
  }
  double number() { return std::uniform_real_distribution<double>(-3, 3)(random_); }
  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(random_); }

 private:
  std::string leaf() {
    static const char* const all[] = {"x",  "y",  "z",   "0", "1", "2", "0",   "0.5",    "-1.5",
                                      "-3", "pi", "NaN", "x", "y", "z", "Inf", "(-Inf)", "(-0)"};
    return all[below(18)];
  }
  std::string call(const std::string& name, int depth) {
    const Builtin& b = *findBuiltin(name);
    const std::size_t count =
        std::min(b.least + std::size_t(below(2)), std::min<std::size_t>(b.most, 4));
    std::string s = name + "(";
    for (std::size_t i = 0; i < count; ++i) s += (i ? ", " : "") + make(depth - 1);
    return s + ")";
  }

  std::mt19937 random_;
  std::vector<std::string> functions_;
};

bool isSame(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

}  // namespace

TEST_CASE("eight lanes have the bits of one", "[lang]") {
  Expressions random(1);
  for (int round = 0; round < 300; ++round) {
    const std::string body = random.make(4);
    const FunctionPtr f = functionOf(body);
    double args[3 * 8], values[8];
    for (double& x : args) x = random.number();
    f->evalLanes(args, values);
    for (int k = 0; k < 8; ++k) {
      const double point[] = {args[k], args[8 + k], args[16 + k]};
      INFO(body << " at " << point[0] << ", " << point[1] << ", " << point[2]);
      CHECK(isSame(values[k], f->eval(point)));
    }
  }
}

TEST_CASE("bounds hold every value", "[lang]") {
  Expressions random(2);
  int tight = 0;
  for (int round = 0; round < 1500; ++round) {
    const std::string body = random.make(1 + round % 4);
    const FunctionPtr f = functionOf(body);
    Interval box[3];
    for (Interval& i : box) {
      const double size = std::pow(10, -random.below(5));
      i.low = random.below(4) ? random.number() : std::round(random.number());
      i.high = i.low + (random.below(8) ? std::abs(random.number()) * size : 0);
    }
    const Interval bounds = f->bounds(box);
    tight += bounds.high - bounds.low < 1;
    for (int sample = 0; sample < 60; ++sample) {
      double point[3];
      for (int i = 0; i < 3; ++i) {
        const double t = std::clamp(random.number() / 2, 0.0, 1.0);  // often an end
        point[i] = std::clamp(box[i].low + t * (box[i].high - box[i].low), box[i].low, box[i].high);
      }
      const double value = f->eval(point);
      if (std::isnan(value) || (bounds.low <= value && value <= bounds.high)) continue;
      INFO(body << " at " << point[0] << ", " << point[1] << ", " << point[2] << " is " << value
                << ", bounds " << bounds.low << " to " << bounds.high);
      CHECK(false);
    }
  }
  CHECK(tight > 400);
}

TEST_CASE("bounds are exact where a function is monotone or periodic", "[lang]") {
  const auto bounds = [](const std::string& body, double low, double high) {
    const Interval box[] = {{low, high}, {0, 0}, {0, 0}};
    return functionOf(body)->bounds(box);
  };
  const auto is = [](const Interval& i, double low, double high) {
    return std::abs(i.low - low) < 1e-12 && std::abs(i.high - high) < 1e-12;
  };
  CHECK(is(bounds("sin(x)", 0, 1), 0, std::sin(1)));
  CHECK(is(bounds("sin(x)", 1, 5), -1, 1));
  CHECK(is(bounds("cos(x)", -1, 2), std::cos(2), 1));
  CHECK(is(bounds("pow(x, 2)", -1, 3), 0, 9));
  CHECK(is(bounds("x > 2 ? 5 : 7", 0, 1), 7, 7));
  CHECK(is(bounds("sqrt(x*x + y*y + z*z) - 1", 2, 3), 1, 2));
  CHECK(std::isinf(bounds("1/x", -1, 1).high));
}

TEST_CASE("derivatives are differences", "[lang]") {
  Expressions random(3);
  int compared = 0;
  for (int round = 0; round < 600; ++round) {
    const std::string body = random.make(1 + round % 3);
    const FunctionPtr f = functionOf(body);
    const double at[] = {random.number(), random.number(), random.number()};
    double derivatives[3];
    const double value = f->gradient(at, derivatives);
    INFO(body << " at " << at[0] << ", " << at[1] << ", " << at[2]);
    CHECK(isSame(value, f->eval(at)));
    for (int i = 0; i < 3; ++i) {
      const auto difference = [&](double h) {
        double below[] = {at[0], at[1], at[2]}, above[] = {at[0], at[1], at[2]};
        below[i] -= h, above[i] += h;
        return (f->eval(above) - f->eval(below)) / (2 * h);
      };
      const double coarse = difference(1e-4), fine = difference(1e-5);
      const double scale = 1 + std::abs(fine);
      if (!(std::abs(coarse - fine) < 1e-5 * scale && scale < 1e5)) continue;  // a kink or a pole
      ++compared;
      INFO("component " << i);
      CHECK(std::abs(derivatives[i] - fine) < 1e-4 * scale);
    }
  }
  CHECK(compared > 1000);
}

TEST_CASE("a function of many arguments has all derivatives", "[lang]") {
  const SceneDesc s = scene(
      "#declare G = function(a, b, c, d) { a*b + c*d*d }"
      "#declare F = function { G(x, 2, y, z) + G(z, z, 1, x) }; isosurface { function F }");
  const double at[] = {3, 5, 7};
  double d[3];
  CHECK(s.blocks[0].find("function")->function->gradient(at, d) == 6 + 5 * 49 + 49 + 9);
  CHECK(d[0] == 2 + 2 * 3);
  CHECK(d[1] == 49);
  CHECK(d[2] == 2 * 5 * 7 + 2 * 7);
}

}  // namespace vestige::lang::test
