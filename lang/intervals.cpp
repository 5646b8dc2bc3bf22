// SPDX-License-Identifier: Apache-2.0
// Programs on intervals. Arithmetic is rounded as in eval(), which is monotone, so that its results
// lie between those of the ends; results of the C library get some room.
#include <algorithm>
#include <cmath>
#include <limits>

#include "lang/program_steps.h"
#include "lang/value.h"

namespace vestige::lang {
namespace {

using Code = Program::Code;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kHalfTurn = 3.14159265358979323846;
constexpr double kTurn = 2 * kHalfTurn;

struct Range {
  double low, high;
  bool mayBeNaN = false;  ///< besides the numbers between low and high

  Range() = default;
  explicit Range(double x) : low(x), high(x) {
    if (std::isnan(x)) low = -kInfinity, high = kInfinity, mayBeNaN = true;
  }
  Range(double l, double h) : low(l), high(h) {}
  bool isPoint() const { return low == high; }
  bool holds(double x) const { return low <= x && x <= high; }
};

const Range kAll{-kInfinity, kInfinity};
const Range kEither{0, 1};

/// Where infinities met, anything is possible.
Range sound(double low, double high) {
  return {std::isnan(low) ? -kInfinity : low, std::isnan(high) ? kInfinity : high};
}

/// Room for the errors of the C library: some units in the last place.
Range widened(const Range& r) {
  constexpr double kErrors = 8 * std::numeric_limits<double>::epsilon();
  constexpr double kTiniest = std::numeric_limits<double>::denorm_min();
  const auto room = [](double x) { return std::isinf(x) ? 0 : std::abs(x) * kErrors + kTiniest; };
  return sound(r.low - room(r.low), r.high + room(r.high));
}

/// The hull of a function that is extreme at the corners of the box of two operands.
template <class F>
Range corners(const Range& a, const Range& b, F f) {
  const double all[] = {f(a.low, b.low), f(a.low, b.high), f(a.high, b.low), f(a.high, b.high)};
  for (const double x : all)
    if (std::isnan(x)) return kAll;
  return {*std::min_element(all, all + 4), *std::max_element(all, all + 4)};
}

Range hull(const Range& a, const Range& b) {
  return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

/// A monotone function; operands outside its domain have no value.
template <class F>
Range rising(F f, const Range& a, double least = -kInfinity, double most = kInfinity) {
  if (a.high < least || a.low > most) return kAll;
  return widened(sound(f(std::max(a.low, least)), f(std::min(a.high, most))));
}

Range magnitude(const Range& a) {
  const double low = std::abs(a.low), high = std::abs(a.high);
  return {a.holds(0) ? 0 : std::min(low, high), std::max(low, high)};
}

/// Whether an interval holds `at` or differs from it by whole periods; true in doubt.
bool holdsPeriodic(const Range& a, double at, double period) {
  constexpr double kFarthest = 1e7;  // periods are counted exactly enough up to here
  if (!(std::abs(a.low) < kFarthest && std::abs(a.high) < kFarthest)) return true;
  constexpr double kRoom = 1e-7;
  const double first = std::ceil((a.low - kRoom - at) / period) * period + at;
  return first <= a.high + kRoom;
}

/// A sine whose greatest value is at `top`.
template <class F>
Range wave(F f, const Range& a, double top) {
  Range r = widened(corners(a, a, [&](double x, double) { return f(x); }));
  if (holdsPeriodic(a, top, kTurn)) r.high = 1;
  if (holdsPeriodic(a, top + kHalfTurn, kTurn)) r.low = -1;
  return {std::max(r.low, -1.0), std::min(r.high, 1.0)};
}

/// 1 where it is certain, 0 where the contrary is, else either.
Range truth(bool isCertain, bool isImpossible) {
  return isCertain ? Range(1) : isImpossible ? Range(0) : kEither;
}
bool isSurelyTrue(const Range& a) { return a.low > kTruth || a.high < -kTruth; }
bool isSurelyFalse(const Range& a) { return a.low >= -kTruth && a.high <= kTruth; }

Range relation(Code code, const Range& a, const Range& b) {
  const double least = a.low - b.high, most = a.high - b.low;  // of the difference
  const bool areEqual = std::max(std::abs(least), std::abs(most)) <= kTruth ||
                        (a.isPoint() && b.isPoint() && a.low == b.low);
  const bool differ = least > kTruth || most < -kTruth;
  switch (code) {
    case Code::equal:
      return truth(areEqual, differ);
    case Code::notEqual:
      return truth(differ, areEqual);
    case Code::less:
      return truth(a.high < b.low, a.low >= b.high);
    case Code::greater:
      return truth(a.low > b.high, a.high <= b.low);
    case Code::lessEqual:
      return truth(a.high <= b.low || areEqual, least > kTruth);
    default:
      return truth(a.low >= b.high || areEqual, most < -kTruth);
  }
}

Range quotient(const Range& a, const Range& b) {
  if (b.holds(0)) return kAll;
  return corners(a, b, [](double x, double y) { return x / y; });
}

/// The rest has the sign of the dividend and is smaller than the divisor.
Range rest(Code code, const Range& a, const Range& b) {
  const double most = magnitude(b).high;
  const Range r{a.low < 0 ? -std::min(-a.low, most) : 0, a.high > 0 ? std::min(a.high, most) : 0};
  return code == Code::modulo && b.holds(0) ? Range(r.low, kInfinity) : r;
}

Range power(const Range& x, const Range& y) {
  const auto f = [](double a, double b) { return std::pow(a, b); };
  const bool isWhole = y.isPoint() && y.low == std::trunc(y.low) && std::abs(y.low) < 1e9;
  const bool isOdd = isWhole && std::fmod(y.low, 2) != 0;
  if (x.holds(0) && y.low < 0) return kAll;  // -0, too, has a power: minus infinity
  if (x.low >= 0) return widened(corners(x, y, f));
  if (isOdd) return widened(corners(x, y, f));
  Range r = widened(corners(magnitude(x), y, f));
  if (!isWhole) r.low = -r.high;  // values at whole exponents only, of either sign
  return r;
}

Range bits(const Range* a, int n, Code code) {
  const auto isPlain = [](const Range& r) { return r.isPoint() && !r.mayBeNaN; };
  if (std::all_of(a, a + n, isPlain)) {
    double operands[Program::kStack];
    for (int i = 0; i < n; ++i) operands[i] = a[i].low;
    bool doubt = false;
    return Range(applyStep(code, operands, n, doubt));
  }
  return {-2147483648.0, 2147483647.0};
}

Range angle(const Range& y, const Range& x) {
  const bool isCut = x.low <= 0 && y.holds(0);
  if (isCut) return widened({-kHalfTurn, kHalfTurn});
  return widened(corners(y, x, [](double a, double b) { return std::atan2(a, b); }));
}

Range chosen(const Range* a, int n) {
  const Range* const zero = &a[2];
  const Range* const above = n == 3 ? &a[2] : &a[3];
  Range r{kInfinity, -kInfinity};
  if (a[0].low < 0) r = hull(r, a[1]);
  if (a[0].holds(0)) r = hull(r, *zero);
  if (a[0].high > 0) r = hull(r, *above);
  return r.low <= r.high ? r : kAll;
}

Range extreme(Code code, const Range* a, int n) {
  Range r = a[0];
  for (int i = 1; i < n; ++i)
    r = code == Code::max ? Range(std::max(r.low, a[i].low), std::max(r.high, a[i].high))
                          : Range(std::min(r.low, a[i].low), std::min(r.high, a[i].high));
  return r;
}

/// Steps of one number that the C library computes.
Range ofOne(Code code, const Range& a) {
  switch (code) {
    case Code::acos: {
      const Range r = rising([](double x) { return -std::acos(std::clamp(x, -1.0, 1.0)); }, a);
      return {-r.high, -r.low};
    }
    case Code::acosh:
      return rising([](double x) { return std::acosh(x); }, a, 1);
    case Code::asin:
      return rising([](double x) { return std::asin(std::clamp(x, -1.0, 1.0)); }, a);
    case Code::asinh:
      return rising([](double x) { return std::asinh(x); }, a);
    case Code::atan:
      return rising([](double x) { return std::atan(x); }, a);
    case Code::atanh:
      return rising([](double x) { return std::atanh(x); }, a, -1, 1);
    case Code::cos:
      return wave([](double x) { return std::cos(x); }, a, 0);
    case Code::cosh:
      return rising([](double x) { return std::cosh(x); }, magnitude(a));
    case Code::exp:
      return rising([](double x) { return std::exp(x); }, a);
    case Code::ln:
      return rising([](double x) { return std::log(x); }, a, 0);
    case Code::log:
      return rising([](double x) { return std::log10(x); }, a, 0);
    case Code::sin:
      return wave([](double x) { return std::sin(x); }, a, kHalfTurn / 2);
    case Code::sinh:
      return rising([](double x) { return std::sinh(x); }, a);
    case Code::sqrt:
      return rising([](double x) { return std::sqrt(x); }, a, 0);
    case Code::tan:
      return holdsPeriodic(a, kHalfTurn / 2, kHalfTurn)
                 ? kAll
                 : rising([](double x) { return std::tan(x); }, a);
    case Code::tanh:
      return rising([](double x) { return std::tanh(x); }, a);
    default:
      return kAll;
  }
}

/// A step on the numbers of its operands.
Range ofNumbers(Code code, const Range* a, int n) {
  switch (code) {
    case Code::plus:
      return sound(a[0].low + a[1].low, a[0].high + a[1].high);
    case Code::minus:
      return sound(a[0].low - a[1].high, a[0].high - a[1].low);
    case Code::negate:
      return {-a[0].high, -a[0].low};
    case Code::times:
      return corners(a[0], a[1], [](double x, double y) { return x * y; });
    case Code::over:
      return quotient(a[0], a[1]);
    case Code::div: {
      const Range r = quotient(a[0], a[1]);
      return {std::trunc(r.low), std::trunc(r.high)};
    }
    case Code::modulo:
    case Code::mod:
      return rest(code, a[0], a[1]);
    case Code::invert:
      return truth(isSurelyFalse(a[0]), isSurelyTrue(a[0]));
    case Code::both:
      return truth(isSurelyTrue(a[0]) && isSurelyTrue(a[1]),
                   isSurelyFalse(a[0]) || isSurelyFalse(a[1]));
    case Code::either:
      return truth(isSurelyTrue(a[0]) || isSurelyTrue(a[1]),
                   isSurelyFalse(a[0]) && isSurelyFalse(a[1]));
    case Code::equal:
    case Code::notEqual:
    case Code::less:
    case Code::lessEqual:
    case Code::greater:
    case Code::greaterEqual:
      return relation(code, a[0], a[1]);
    case Code::choose:
      return isSurelyTrue(a[0]) ? a[1] : isSurelyFalse(a[0]) ? a[2] : hull(a[1], a[2]);
    case Code::select:
      return chosen(a, n);
    case Code::max:
    case Code::min:
      return extreme(code, a, n);
    case Code::abs:
      return magnitude(a[0]);
    case Code::ceil:
      return {std::ceil(a[0].low), std::ceil(a[0].high)};
    case Code::floor:
      return {std::floor(a[0].low), std::floor(a[0].high)};
    case Code::integer:
      return {std::trunc(a[0].low), std::trunc(a[0].high)};
    case Code::degrees:
      return {a[0].low * (180 / kHalfTurn), a[0].high * (180 / kHalfTurn)};
    case Code::radians:
      return {a[0].low * (kHalfTurn / 180), a[0].high * (kHalfTurn / 180)};
    case Code::atan2:
      return angle(a[0], a[1]);
    case Code::pow:
      return power(a[0], a[1]);
    case Code::bitwiseAnd:
    case Code::bitwiseOr:
    case Code::bitwiseXor:
      return bits(a, n, code);
    default:
      return ofOne(code, a[0]);
  }
}

/// Adds what a step makes of operands that are NaN: comparisons are false, and NaN counts as true.
Range withNaN(Code code, const Range* a, int n, const Range& r) {
  switch (code) {
    case Code::equal:
    case Code::less:
    case Code::lessEqual:
    case Code::greater:
    case Code::greaterEqual:
    case Code::invert:
      return hull(r, Range(0));
    case Code::notEqual:
    case Code::pow:  // of 1, or with the exponent 0
      return hull(r, Range(1));
    case Code::both:
    case Code::either:
      return kEither;
    case Code::choose:
      return a[0].mayBeNaN ? hull(r, a[1]) : r;
    case Code::select:
      return a[0].mayBeNaN ? hull(r, a[n - 1]) : r;
    case Code::max:
    case Code::min: {
      Range all = r;
      for (int i = 0; i < n; ++i) all = hull(all, a[i]);
      return all;
    }
    default:
      return r;
  }
}

/// Whether a step on numbers may give NaN.
bool givesNaN(Code code, const Range* a, int n) {
  for (int i = 0; i < n; ++i)
    if (std::isinf(a[i].low) || std::isinf(a[i].high)) return true;  // inf - inf, 0 * inf, ...
  switch (code) {
    case Code::acosh:
      return a[0].low < 1;
    case Code::atanh:
      return a[0].low < -1 || a[0].high > 1;
    case Code::ln:
    case Code::log:
    case Code::sqrt:
    case Code::pow:
      return a[0].low < 0;
    case Code::mod:
      return a[1].holds(0);
    default:
      return false;
  }
}

Range apply(Code code, const Range* a, int n) {
  Range r = ofNumbers(code, a, n);
  const bool isOperandNaN = std::any_of(a, a + n, [](const Range& x) { return x.mayBeNaN; });
  if (isOperandNaN) r = withNaN(code, a, n, r);
  r.mayBeNaN = isOperandNaN || givesNaN(code, a, n);
  return r;
}

}  // namespace

Interval Program::bounds(std::span<const Interval> args) const noexcept {
  Range given[kStack];
  for (std::size_t i = 0; i < args.size() && i < std::size_t(kStack); ++i)
    given[i] = {args[i].low, args[i].high};
  const Range r = walk(*this, given, apply);
  return {r.low, r.high};
}

}  // namespace vestige::lang
