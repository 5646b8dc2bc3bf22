// SPDX-License-Identifier: Apache-2.0
// Programs on numbers with three derivatives: forward differentiation.
#include <algorithm>
#include <cmath>

#include "lang/program_steps.h"
#include "lang/value.h"

namespace vestige::lang {
namespace {

using Code = Program::Code;

constexpr int kPartials = 3;
constexpr double kHalfTurn = 3.14159265358979323846;

struct Derived {
  double value;
  double d[kPartials];
  Derived() = default;
  explicit Derived(double x) : value(x), d{} {}
};

/// A function of one number with that derivative, which may be infinite where `a` does not move.
Derived chain(double value, double slope, const Derived& a) {
  Derived r(value);
  for (int i = 0; i < kPartials; ++i) r.d[i] = slope == 0 || a.d[i] == 0 ? 0 : slope * a.d[i];
  return r;
}

/// The same of two numbers.
Derived chain(double value, double slope, const Derived& a, double slope2, const Derived& b) {
  Derived r = chain(value, slope, a);
  for (int i = 0; i < kPartials; ++i)
    if (b.d[i] != 0 && slope2 != 0) r.d[i] += slope2 * b.d[i];
  return r;
}

/// x to the power y. A constant exponent needs no logarithm.
Derived power(double value, const Derived& x, const Derived& y) {
  const double slope = y.value == 0 ? 0 : y.value * std::pow(x.value, y.value - 1);
  const bool moves = std::any_of(y.d, y.d + kPartials, [](double d) { return d != 0; });
  return chain(value, slope, x, moves && value != 0 ? value * std::log(x.value) : 0, y);
}

/// atan2(y, x). Far out the square of the distance would not be finite.
Derived angle(double value, const Derived& y, const Derived& x) {
  const double far = std::hypot(x.value, y.value);
  const auto slope = [far](double leg) { return std::isinf(far) ? 0 : leg / far / far; };
  return chain(value, slope(x.value), y, -slope(y.value), x);
}

/// The operand that a step passes on; null: it computes a new value.
const Derived* chosen(Code code, const Derived* a, int n) {
  const auto less = [](const Derived& x, const Derived& y) { return x.value < y.value; };
  switch (code) {
    case Code::choose:
      return &a[isTrue(a[0].value) ? 1 : 2];
    case Code::select:
      return &a[a[0].value < 0 ? 1 : n == 3 || a[0].value == 0 ? 2 : 3];
    case Code::max:
      return std::max_element(a, a + n, less);
    case Code::min:
      return std::min_element(a, a + n, less);
    default:
      return nullptr;
  }
}

/// The derivative of a function of one number; 0 for steps.
double slopeOf(Code code, double x, double value) {
  switch (code) {
    case Code::negate:
      return -1;
    case Code::abs:
      return x < 0 ? -1 : 1;
    case Code::acos:
      return std::abs(x) > 1 ? 0 : -1 / std::sqrt(1 - x * x);
    case Code::acosh:
      return 1 / (std::sqrt(x - 1) * std::sqrt(x + 1));
    case Code::asin:
      return std::abs(x) > 1 ? 0 : 1 / std::sqrt(1 - x * x);
    case Code::asinh:
      return 1 / std::hypot(1, x);
    case Code::atan:
      return 1 / (1 + x * x);
    case Code::atanh:
      return 1 / ((1 - x) * (1 + x));
    case Code::cos:
      return -std::sin(x);
    case Code::cosh:
      return std::sinh(x);
    case Code::degrees:
      return 180 / kHalfTurn;
    case Code::exp:
      return value;
    case Code::ln:
      return x < 0 ? NAN : 1 / x;
    case Code::log:
      return x < 0 ? NAN : 1 / (x * std::log(10.0));
    case Code::radians:
      return kHalfTurn / 180;
    case Code::sin:
      return std::cos(x);
    case Code::sinh:
      return std::cosh(x);
    case Code::sqrt:
      return 0.5 / value;
    case Code::tan:
      return 1 + value * value;
    case Code::tanh:
      return 1 - value * value;
    default:
      return 0;
  }
}

Derived apply(Code code, const Derived* a, int n) {
  if (const Derived* same = chosen(code, a, n)) return *same;
  double operands[Program::kStack];
  for (int i = 0; i < n; ++i) operands[i] = a[i].value;
  bool doubt = false;
  const double value = applyStep(code, operands, n, doubt);
  const double x = operands[0], y = n > 1 ? operands[1] : 0;
  switch (code) {
    case Code::plus:
      return chain(value, 1, a[0], 1, a[1]);
    case Code::minus:
      return chain(value, 1, a[0], -1, a[1]);
    case Code::times:
      return chain(value, y, a[0], x, a[1]);
    case Code::over:
      return chain(value, 1 / y, a[0], -value / y, a[1]);
    case Code::modulo:
    case Code::mod:
      return chain(value, 1, a[0], -std::trunc(x / y), a[1]);
    case Code::atan2:
      return angle(value, a[0], a[1]);
    case Code::pow:
      return power(value, a[0], a[1]);
    default:
      return n == 1 ? chain(value, slopeOf(code, x, value), a[0]) : Derived(value);
  }
}

}  // namespace

double Program::gradient(std::span<const double> args,
                         std::span<double> derivatives) const noexcept {
  Derived given[kStack];
  const int count = std::min(arity_, kStack);
  for (int i = 0; i < count; ++i) given[i] = Derived(args[std::size_t(i)]);
  double value = 0;
  for (int first = 0; first == 0 || first < count; first += kPartials) {
    const int last = std::min(first + kPartials, count);
    for (int i = first; i < last; ++i) given[i].d[i - first] = 1;
    const Derived result = walk(*this, given, apply);
    value = result.value;
    for (int i = first; i < last; ++i) {
      derivatives[std::size_t(i)] = result.d[i - first];
      given[i].d[i - first] = 0;
    }
  }
  return value;
}

}  // namespace vestige::lang
