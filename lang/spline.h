// SPDX-License-Identifier: Apache-2.0
// Curves through points at given times, POV-Ray's splines.
#pragma once
#include <array>
#include <vector>

#include "lang/value.h"
#include "lang/words.h"

namespace vestige::lang {

struct Spline {
  using Point = std::array<double, 5>;

  Word kind = Word::linearSpline;  ///< linear_spline ... natural_spline
  int size = 2;                    ///< components of a point
  std::vector<double> times;       ///< ascending, at least one
  std::vector<Point> points;       ///< at the times
  std::vector<Point> bends = {};   ///< second derivatives of the natural spline, see finish()
  Share bytes = {};

  /// Bytes of a point, its time and its bend.
  static constexpr std::size_t kPointBytes = sizeof(double) + 2 * sizeof(Point);

  /// Sorts by time. Of points at one time the first counts, as in POV-Ray. Call it once.
  void finish();
  /// Before the first and after the last time the curve stays at its end. `as`: another kind, or
  /// Word::none.
  Numbers at(double t, Word as) const;

 private:
  std::size_t segment(double t) const;
  Point linear(double t) const;
  Point quadratic(double t) const;
  Point cubic(double t) const;
  Point natural(double t) const;
  Point slope(std::size_t i) const;
};

}  // namespace vestige::lang
