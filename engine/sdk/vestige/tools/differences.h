// SPDX-License-Identifier: Apache-2.0
// Finite differences, for plugins without derivatives of their own. They are slower and less exact
// than a formula: about three digits in float, nine in double.
#pragma once
#include <vestige/math.h>
#include <optional>

namespace vestige::differences {

/// First step, in the units of the argument; functions are assumed to be smooth on the scale of 1.
inline constexpr Real kStep = sizeof(Real) == 8 ? Real(1e-3) : Real(8e-3);
/// An estimated relative error this small ends the search for a better step.
inline constexpr Real kGoodEnough = sizeof(Real) == 8 ? Real(1e-6) : Real(1e-3);
/// Number of steps tried, each a quarter of the one before.
inline constexpr int kTries = 5;

inline Real magnitude(Real x) noexcept { return std::abs(x); }
inline Real magnitude(Vec3 x) noexcept { return length(x); }

/// A derivative with its estimated error.
template <class Value>
struct Slope {
  Value value{};
  Real error = kInfinity;  ///< infinite: there is none

  void keepBetter(Value v, Real e) noexcept {
    if (e < error) value = v, error = e;
  }
};

/// The derivative from one step. `map` takes a Real to an optional Value (nullopt: no value, or
/// another branch of the map); `here` is map(0). The difference of two orders of one stencil
/// estimates the error. At a seam, where the orders or the slopes of both sides disagree, the side
/// without the seam is used.
template <class Map, class Value>
Slope<Value> slopeWithStep(const Map& map, Value here, Real h) noexcept {
  Slope<Value> best;
  const auto back2 = map(-2 * h), back = map(-h), next = map(h), next2 = map(2 * h);
  const auto quadratic = [&](const Value& a, const Value& b, Real step) {
    return (Real(4) * a - Real(3) * here - b) * (1 / (2 * step));
  };
  if (back2 && back && next && next2) {
    const Value near = (*next - *back) * (1 / (2 * h)), far = (*next2 - *back2) * (1 / (4 * h));
    // The far slope has four times the error of the near one, with the same sign.
    const Value central = (Real(4) * near - far) * (Real(1) / 3);
    const Value kink = quadratic(*next, *next2, h) - quadratic(*back, *back2, -h);
    best.keepBetter(central, std::max(magnitude(central - near), magnitude(kink)));
    if (best.error <= kGoodEnough * magnitude(central)) return best;
  }
  const auto oneSided = [&](const auto& a, const auto& b, Real step) {
    if (!a || !b) return;
    const auto c = map(3 * step);
    if (!c) return;
    const Value cubic =
        (Real(18) * *a - Real(11) * here - Real(9) * *b + Real(2) * *c) * (1 / (6 * step));
    best.keepBetter(cubic, magnitude(cubic - quadratic(*a, *b, step)));
  };
  oneSided(next, next2, h), oneSided(back, back2, -h);
  return best;
}

/// d map / d x at 0, from steps `h` and below; zero if no estimate is possible. `noise`: magnitude
/// of the values that the map rounds.
template <class Map, class Value>
Value derivative(const Map& map, Value here, Real h, Real noise = 1) noexcept {
  Slope<Value> best;
  for (int k = 0; k < kTries; ++k, h /= 4) {
    Slope<Value> s = slopeWithStep(map, here, h);
    s.error += 4 * noise * std::numeric_limits<Real>::epsilon() / h;
    best.keepBetter(s.value, s.error);
    if (best.error <= kGoodEnough * magnitude(best.value)) break;
  }
  return std::isfinite(magnitude(best.value)) ? best.value : Value{};
}

/// v rotated by the smallest rotation that takes unit a to unit b, b != -a.
inline Vec3 carried(Vec3 a, Vec3 b, Vec3 v) noexcept {
  const Vec3 w = cross(a, b);
  return v + cross(w, v) + cross(w, cross(w, v)) / std::max(1 + dot(a, b), Real(1e-6));
}

/// A unit vector rotated by an angle towards a unit tangent.
inline Vec3 turned(Vec3 unit, Vec3 along, Real angle) noexcept {
  return std::cos(angle) * unit + std::sin(angle) * along;
}

}  // namespace vestige::differences
