// SPDX-License-Identifier: Apache-2.0
// The worst event of a test, kept as a line that can be reproduced.
#pragma once
#include <vestige/math.h>

#include <cmath>
#include <ostream>
#include <sstream>
#include <string>

namespace vestige::judge {

inline constexpr bool kDouble = sizeof(Real) == 8;
inline constexpr double kEpsilon = double(std::numeric_limits<Real>::epsilon());

inline double relative(double value, double expected) {
  return std::abs(value - expected) / std::max(std::abs(expected), 1e-30);
}
inline double relative(Rgb value, Rgb expected) {
  const Rgb d = value - expected;
  return maxComponent({std::abs(d.r), std::abs(d.g), std::abs(d.b)}) /
         std::max(double(maxComponent(expected)), 1e-30);
}

inline std::ostream& operator<<(std::ostream& o, Vec3 v) {
  return o << "<" << v.x << ", " << v.y << ", " << v.z << ">";
}
inline std::ostream& operator<<(std::ostream& o, Vec2 v) {
  return o << "<" << v.x << ", " << v.y << ">";
}

inline std::string told(const char* what, double value, double expected) {
  std::ostringstream text;
  text.precision(9);
  text << what << " " << value << ", expected " << expected;
  return text.str();
}

/// One event in words.
struct Event {
  std::string line;   ///< everything needed to reproduce it, with all digits
  std::string where;  ///< for people: "with { alpha 0.3 } and toPrev 40 degrees from the normal"
  std::string what;   ///< what was found there, and expected
};
inline std::ostream& operator<<(std::ostream& o, const Event& e) { return o << e.line; }

/// The largest error of a test and the event that made it.
struct WorstEvent {
  double error = 0;  ///< in units of the tolerance: above 1 is a failure
  Event event;
  int events = 0;

  /// `describe` is called only for a new worst event. NaN is the worst of all.
  template <class Describe>
  void see(double e, const Describe& describe) {
    ++events;
    if (e <= error) return;
    error = std::isnan(e) ? HUGE_VAL : e;
    event = describe();
  }
};

}  // namespace vestige::judge
