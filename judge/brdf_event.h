// SPDX-License-Identifier: Apache-2.0
// Events of the BRDF tests: drawn for every case, compared within rounding; the worst one is kept
// as a reproducible line.
#pragma once
#include <sstream>

#include "judge/brdf_case.h"
#include "judge/trusted_difference.h"
#include "judge/worst_event.h"

namespace vestige::judge {

/// Relative change of a value that depends on both directions, when each changes by a few units of
/// rounding: the unavoidable error at narrow lobes, grazing angles and the edge of total
/// reflection.
template <class F>
double wobble(const ScatterPoint& p, Vec3 toNext, const F& f) {
  constexpr double kRounding = 4 * kEpsilon;
  const double value = std::max(double(f(p, toNext)), 1e-30);
  double most = 0;
  for (int i = 0; i < 4; ++i) {
    const double angle = i * double(kPi) / 2;
    const ScatterPoint q =
        differences::facing(p, turned(p.toPrev, tangent(p.toPrev, angle), kRounding));
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
  const auto f = [&](const ScatterPoint& q, Vec3 d) { return maxComponent(c.brdf->f(q, d)); };
  return (kDouble ? 1e-9 : 1e-3) + 4 * wobble(p, toNext, f);
}

/// Random events of all cases: f(case, point, numbers, random).
template <class F>
void forEvents(const std::vector<BrdfCase>& cases, int eventsPerCase, const F& f,
               unsigned seed = 1) {
  Random r(seed);
  for (const BrdfCase& c : cases)
    for (int i = 0; i < eventsPerCase; ++i) {
      const ScatterPoint p = c.at(aboveSurface(r), i % 2 == 1);
      f(c, p, numbers(r), r);
    }
}

/// An event as text with all digits.
inline Event eventLine(const BrdfCase& c, const ScatterPoint& p, ScatterNumbers n,
                       const std::string& what) {
  std::ostringstream text;
  text.precision(9);
  text << c.title() << "  toPrev " << p.toPrev << (p.behind ? " inside" : " outside") << "  lobe "
       << n.lobe << "  u <" << n.u.x << ", " << n.u.y << ">: " << what;
  std::ostringstream where;
  where.precision(3);
  where << "with " << c.settings << " and toPrev " << std::acos(double(p.toPrev.z)) * 180 / M_PI
        << " degrees from the normal" << (p.behind ? " inside" : "");
  return {text.str(), where.str(), what};
}

}  // namespace vestige::judge
