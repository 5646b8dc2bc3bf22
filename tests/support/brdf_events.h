// SPDX-License-Identifier: Apache-2.0
// Events of the BRDF suite: drawn for every case, compared within what rounding allows, and the
// worst of them kept as a line that can be reproduced.
#pragma once
#include <sstream>

#include "support/brdf_cases.h"
#include "support/catch.h"
#include "support/trusted_difference.h"

namespace vestige::test {

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

/// How much a number that depends on both directions changes, relatively, when each moves by a few
/// units of rounding: what narrow lobes, grazing angles and the edge of total reflection do to the
/// best of implementations.
template <class F>
double wobble(const ScatterPoint& p, Vec3 toNext, const F& f) {
  constexpr double kRounding = 4 * kEpsilon;
  const double value = std::max(double(f(p, toNext)), 1e-30);
  double most = 0;
  for (int i = 0; i < 4; ++i) {
    const double angle = i * double(kPi) / 2;
    const ScatterPoint q = {turned(p.toPrev, tangent(p.toPrev, angle), kRounding), p.inside,
                            p.inputs};
    const Vec3 d = turned(toNext, tangent(toNext, angle), kRounding);
    most = std::max(most, std::abs(double(f(q, toNext)) - value) / value);
    most = std::max(most, std::abs(double(f(p, d)) - value) / value);
  }
  return most;
}
inline double pdfTolerance(const BrdfCase& c, const ScatterPoint& p, Vec3 toNext) {
  const auto pdf = [&](const ScatterPoint& q, Vec3 d) { return c.brdf->pdf(q, d); };
  return (kDouble ? 1e-9 : 1e-3) + 4 * wobble(p, toNext, pdf);
}
inline double evalTolerance(const BrdfCase& c, const ScatterPoint& p, Vec3 toNext) {
  const auto f = [&](const ScatterPoint& q, Vec3 d) { return maxComponent(c.brdf->eval(q, d)); };
  return (kDouble ? 1e-9 : 1e-3) + 4 * wobble(p, toNext, f);
}

inline std::string told(const char* what, double value, double expected) {
  std::ostringstream text;
  text.precision(9);
  text << what << " " << value << ", expected " << expected;
  return text.str();
}

/// Random events of all cases: f(case, point, numbers, random).
template <class F>
void forEvents(const std::vector<BrdfCase>& cases, int eventsPerCase, const F& f) {
  Random r(1);
  for (const BrdfCase& c : cases)
    for (int i = 0; i < eventsPerCase; ++i) {
      const ScatterPoint p = c.at(aboveSurface(r), i % 2 == 1);
      f(c, p, numbers(r), r);
    }
}

/// Every case at 2000 events, and 10^4 more events of each plugin: 1000 sets of random parameters,
/// ten events each.
template <class F>
void forConfigurations(const F& f) {
  forEvents(brdfCases(), 2000, f);
  forEvents(randomBrdfCases(1000), 10, f);
}

/// The largest error of a test and the event that made it.
struct WorstEvent {
  double error = 0;  ///< in units of what is allowed: above 1 is a failure
  std::string event;
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

inline std::ostream& operator<<(std::ostream& o, Vec3 v) {
  return o << "<" << v.x << ", " << v.y << ", " << v.z << ">";
}

/// An event as text with all digits.
inline std::string eventLine(const BrdfCase& c, const ScatterPoint& p, ScatterNumbers n,
                             const std::string& what) {
  std::ostringstream text;
  text.precision(9);
  text << c.title() << "  toPrev " << p.toPrev << (p.inside ? " inside" : " outside") << "  lobe "
       << n.lobe << "  u <" << n.u.x << ", " << n.u.y << ">: " << what;
  return text.str();
}

inline void check(const WorstEvent& worst) {
  INFO(worst.event);
  CHECK(worst.events > 0);
  CHECK(worst.error <= 1);
}

}  // namespace vestige::test
