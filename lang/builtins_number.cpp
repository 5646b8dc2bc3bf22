// SPDX-License-Identifier: Apache-2.0
// Functions of numbers. Angles in radians; results equal those of POV-Ray 3.7, compared with it.
#include <cmath>

#include "lang/builtins.h"

namespace vestige::lang {
namespace {

constexpr double kPiDouble = 3.14159265358979323846;

template <double (*f)(double)>
Datum plain(const Call& c) {
  return Numbers(f(c.number(0)));
}

/// acos and asin outside [-1, 1]: POV-Ray takes the nearer end and warns.
double intoUnit(const Call& c, const char* name) {
  const double x = c.number(0);
  if (std::abs(x) > 1)
    c.warn(0, std::string(name) + "() has a value only from -1 to 1, found " + shortest(x) +
                  "; the nearer end is taken");
  return std::clamp(x, -1.0, 1.0);
}

Datum logarithm(const Call& c, const char* name, double (*f)(double)) {
  const double x = c.number(0);
  if (!(x > 0))
    return c.complain(0, std::string(name) + "() has a value only above 0, found " + shortest(x));
  return Numbers(f(x));
}

Datum squareRoot(const Call& c) {
  const double x = c.number(0);
  if (x < 0) return c.complain(0, "sqrt() has a value only from 0, found " + shortest(x));
  return Numbers(std::sqrt(x));
}

Datum power(const Call& c) {
  const double x = c.number(0), y = c.number(1), result = std::pow(x, y);
  if (x == 0 && y == 0) return c.complain(0, "pow(0, 0) has no value");
  if (std::isnan(result) && !std::isnan(x) && !std::isnan(y))
    c.warn(0, "pow() of a negative number with a broken exponent has no value");
  return Numbers(result);
}

/// The sign is the dividend's: mod(-5, 3) = -2.
Datum modulo(const Call& c) {
  if (c.number(1) == 0) c.warn(1, "mod() by zero has no value");
  return Numbers(std::fmod(c.number(0), c.number(1)));
}

/// Towards zero; the zero has no sign.
double truncated(double x) { return std::trunc(x) + 0.0; }

/// The truncated quotient: div(-7, 2) = -3, div(7.9, 2.9) = 2.
Datum quotient(const Call& c) {
  if (c.number(1) == 0) return c.complain(1, "div() by zero");
  return Numbers(truncated(c.number(0) / c.number(1)));
}

/// select(a, ifNegative, [ifZero,] ifPositive); two branches: zero counts as positive.
Datum choose(const Call& c) {
  const double a = c.number(0);
  if (a < 0) return c.args[1];
  if (c.args.size() == 3) return c.args[2];
  return a == 0 ? c.args[2] : c.args[3];
}

template <bool takesLarger>
Datum extreme(const Call& c) {
  double best = c.number(0);
  for (std::size_t i = 1; i < c.args.size(); ++i)
    best = takesLarger ? std::max(best, c.number(i)) : std::min(best, c.number(i));
  return Numbers(best);
}

Datum direction(const Call& c) {
  if (c.number(0) == 0 && c.number(1) == 0)
    return c.complain(0, "atan2(0, 0) has no value: no direction has this angle");
  return Numbers(std::atan2(c.number(0), c.number(1)));
}

template <char op>
Datum bitwise(const Call& c) {
  int bits = c.integer(0);
  for (std::size_t i = 1; i < c.args.size(); ++i)
    bits = op == '&' ? bits & c.integer(i) : op == '|' ? bits | c.integer(i) : bits ^ c.integer(i);
  return Numbers(bits);
}

/// Streams are numbered: seed() returns the next number.
Datum seed(const Call& c) {
  c.context.budget.reserveOne(c.span, c.context.streams);
  c.context.streams.push_back(std::uint32_t(c.integer(0)));
  return Numbers(double(c.context.streams.size() - 1));
}

/// POV-Ray's generator: the same seed gives the same scene in both programs.
Datum random(const Call& c) {
  const int i = c.integer(0);
  if (i < 0 || std::size_t(i) >= c.context.streams.size())
    return c.complain(0, "rand() takes a stream that seed() gave, as in '#declare S = seed(1);'");
  std::uint32_t& state = c.context.streams[std::size_t(i)];
  state = state * 1812433253u + 12345u;
  return Numbers(double(state) / 4294967295.0);
}

}  // namespace

std::vector<Builtin> numberBuiltins() {
  return {
      {"abs", "n", plain<std::fabs>},
      {"acos", "n", [](const Call& c) -> Datum { return Numbers(std::acos(intoUnit(c, "acos"))); }},
      {"acosh", "n", plain<std::acosh>},
      {"asin", "n", [](const Call& c) -> Datum { return Numbers(std::asin(intoUnit(c, "asin"))); }},
      {"asinh", "n", plain<std::asinh>},
      {"atan", "n", plain<std::atan>},
      {"atan2", "nn", direction},
      {"atanh", "n", plain<std::atanh>},
      {"bitwise_and", "n+", bitwise<'&'>},
      {"bitwise_or", "n+", bitwise<'|'>},
      {"bitwise_xor", "n+", bitwise<'^'>},
      {"ceil", "n", plain<std::ceil>},
      {"cos", "n", plain<std::cos>},
      {"cosh", "n", plain<std::cosh>},
      {"degrees", "n",
       [](const Call& c) -> Datum { return Numbers(c.number(0) * (180 / kPiDouble)); }},
      {"div", "nn", quotient},
      {"exp", "n", plain<std::exp>},
      {"floor", "n", plain<std::floor>},
      {"int", "n", plain<truncated>},
      {"ln", "n", [](const Call& c) { return logarithm(c, "ln", std::log); }},
      {"log", "n", [](const Call& c) { return logarithm(c, "log", std::log10); }},
      {"max", "n+", extreme<true>},
      {"min", "n+", extreme<false>},
      {"mod", "nn", modulo},
      {"pow", "nn", power},
      {"radians", "n",
       [](const Call& c) -> Datum { return Numbers(c.number(0) * (kPiDouble / 180)); }},
      {"rand", "n", random, false},
      {"seed", "n", seed, false},
      {"select", "nnn|n", choose},
      {"sin", "n", plain<std::sin>},
      {"sinh", "n", plain<std::sinh>},
      {"sqrt", "n", squareRoot},
      {"tan", "n", plain<std::tan>},
      {"tanh", "n", plain<std::tanh>},
  };
}

}  // namespace vestige::lang
