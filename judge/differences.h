// SPDX-License-Identifier: Apache-2.0
// Derivatives by finite differences of the routine: the reference for those written by hand.
#pragma once
#include <vestige/math.h>

#include <algorithm>
#include <random>

namespace vestige::judge {

/// Step and tolerance (relative to max(1, |value|)) for numbers of order one [MATH 6, A1].
#ifdef VESTIGE_DOUBLE
inline constexpr Real kStep = Real(1e-4), kTolerance = Real(1e-6);
#else
inline constexpr Real kStep = Real(5e-3), kTolerance = Real(2e-3);
#endif

/// d f / d x at 0 by five points; f of a Real, to a Real or a Vec3.
template <class F>
auto difference(const F& f, Real h = kStep) {
  return (Real(8) * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) * (1 / (12 * h));
}

/// Worst relative deviation; `add` also sees a NaN.
struct Worst {
  Real value = 0;
  void add(Real analytic, Real seen) {
    const Real e = std::abs(analytic - seen) / std::max(Real(1), std::abs(seen));
    if (!(e <= value)) value = std::isfinite(e) ? e : kInfinity;
  }
  void add(Vec3 analytic, Vec3 seen) {
    const Real e = length(analytic - seen) / std::max(Real(1), length(seen));
    if (!(e <= value)) value = std::isfinite(e) ? e : kInfinity;
  }
};

/// Far enough from the borders of the unit square and from the seams of the concentric map, where
/// derivatives jump, for differences with step h.
inline bool differsSmoothly(Vec2 u, Real h = kStep) {
  const Real m = 3 * h, a = std::abs(2 * u.x - 1), b = std::abs(2 * u.y - 1);
  return std::max(a, b) < 1 - 2 * m && std::max(a, b) > 2 * m && std::abs(a - b) > 4 * m;
}

/// Uniform numbers, the same in every run.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  Real number() { return std::min(Real(engine_() * 0x1p-32), kOneMinusEpsilon); }
  Real number(Real low, Real high) { return low + (high - low) * number(); }
  Vec2 pair() {
    const Real x = number();
    return {x, number()};
  }
  Vec3 point(Real low, Real high) {
    const Real x = number(low, high), y = number(low, high);
    return {x, y, number(low, high)};
  }

 private:
  std::mt19937 engine_;
};

}  // namespace vestige::judge
