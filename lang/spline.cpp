// SPDX-License-Identifier: Apache-2.0
#include "lang/spline.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vestige::lang {
namespace {

using Point = Spline::Point;

/// The sum of points, each times its weight.
template <std::size_t n>
Point combined(const std::array<const Point*, n>& points, const std::array<double, n>& weights) {
  Point sum{};
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += weights[k] * (*points[k])[i];
  return sum;
}

/// Second derivatives of the natural cubic spline at its knots: a tridiagonal system, which forward
/// elimination and back substitution solve [Pre92, 3.3].
std::vector<Point> bendsOf(const std::vector<double>& t, const std::vector<Point>& p) {
  const std::size_t n = t.size();
  std::vector<Point> bends(n, Point{});
  std::vector<double> upper(n, 0);
  for (std::size_t k = 1; k + 1 < n; ++k) {
    const double before = t[k] - t[k - 1], after = t[k + 1] - t[k];
    const double pivot = 2 * (before + after) - before * upper[k - 1];
    upper[k] = after / pivot;
    for (std::size_t i = 0; i < p[k].size(); ++i) {
      const double turn = (p[k + 1][i] - p[k][i]) / after - (p[k][i] - p[k - 1][i]) / before;
      bends[k][i] = (6 * turn - before * bends[k - 1][i]) / pivot;
    }
  }
  for (std::size_t k = n - 1; k-- > 1;)
    for (std::size_t i = 0; i < p[k].size(); ++i) bends[k][i] -= upper[k] * bends[k + 1][i];
  return bends;
}

}  // namespace

void Spline::finish() {
  std::vector<std::size_t> order(times.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return times[a] < times[b]; });
  std::vector<double> sortedTimes;
  std::vector<Point> sortedPoints;
  for (const std::size_t k : order) {
    if (!sortedTimes.empty() && sortedTimes.back() == times[k]) continue;
    sortedTimes.push_back(times[k]);
    sortedPoints.push_back(points[k]);
  }
  times = std::move(sortedTimes), points = std::move(sortedPoints);
  bends = times.size() > 1 ? bendsOf(times, points) : std::vector<Point>(1, Point{});
}

Numbers Spline::at(double t, Word as) const {
  const Word shape = as == Word::none ? kind : as;
  const bool isCubic = shape == Word::cubicSpline;
  Numbers r;
  r.size = size;
  if (times.size() == 1 || std::isnan(t))
    r.v = points[0];
  else if (isCubic)
    r.v = cubic(t);
  else if (t <= times.front())
    r.v = points.front();
  else if (t >= times.back())
    r.v = points.back();
  else if (shape == Word::naturalSpline)
    r.v = natural(t);
  else
    r.v = shape == Word::quadraticSpline && times.size() > 2 ? quadratic(t) : linear(t);
  return r;
}

/// The last knot before t or at it, but not the last of all.
std::size_t Spline::segment(double t) const {
  const auto next = std::upper_bound(times.begin() + 1, times.end() - 1, t);
  return std::size_t(next - times.begin()) - 1;
}

Point Spline::linear(double t) const {
  const std::size_t k = segment(t);
  const double u = (t - times[k]) / (times[k + 1] - times[k]);
  return combined<2>({&points[k], &points[k + 1]}, {1 - u, u});
}

/// The parabola through both ends of the segment and the knot before it.
Point Spline::quadratic(double t) const {
  const std::size_t k = std::max<std::size_t>(segment(t), 1);
  const double a = times[k - 1], b = times[k], c = times[k + 1];
  return combined<3>(
      {&points[k - 1], &points[k], &points[k + 1]},
      {(t - b) * (t - c) / ((a - b) * (a - c)), (t - a) * (t - c) / ((b - a) * (b - c)),
       (t - a) * (t - b) / ((c - a) * (c - b))});
}

/// The mean slope of the segments beside a knot.
Point Spline::slope(std::size_t k) const {
  const double before = 0.5 / (times[k] - times[k - 1]), after = 0.5 / (times[k + 1] - times[k]);
  return combined<3>({&points[k - 1], &points[k], &points[k + 1]},
                     {-before, before - after, after});
}

/// Hermite's cubic between the second knot and the last but one; of two knots the mean, as in
/// POV-Ray.
Point Spline::cubic(double t) const {
  const std::size_t n = times.size();
  if (n == 2) return combined<2>({&points[0], &points[1]}, {0.5, 0.5});
  if (t <= times[1]) return points[1];
  if (t >= times[n - 2]) return points[n - 2];
  const std::size_t k = segment(t);
  const double h = times[k + 1] - times[k], u = (t - times[k]) / h, v = 1 - u;
  const Point begin = slope(k), end = slope(k + 1);
  return combined<4>({&points[k], &points[k + 1], &begin, &end},
                     {v * v * (1 + 2 * u), u * u * (1 + 2 * v), h * u * v * v, -h * u * u * v});
}

Point Spline::natural(double t) const {
  const std::size_t k = segment(t);
  const double h = times[k + 1] - times[k], u = (t - times[k]) / h, v = 1 - u;
  return combined<4>({&points[k], &points[k + 1], &bends[k], &bends[k + 1]},
                     {v, u, (v * v * v - v) * h * h / 6, (u * u * u - u) * h * h / 6});
}

}  // namespace vestige::lang
