// SPDX-License-Identifier: Apache-2.0
// Tests whether samples have a given density: Pearson's chi-square test over the sphere, with
// adaptive bins for narrow lobes.
//
// [PTVF07] Press et al. Numerical recipes, 3rd ed. 2007. 6.2 (incomplete gamma), 14.3 (chi-square)
#pragma once
#include <vestige/math.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

namespace vestige::judge {

/// Q(a, x) = Gamma(a, x) / Gamma(a), the upper incomplete gamma function [PTVF07 6.2]. a > 0.
inline double gammaQ(double a, double x) {
  if (x <= 0) return 1;
  const double front = std::exp(a * std::log(x) - x - std::lgamma(a));
  if (x < a + 1) {  // series for P
    double term = 1 / a, sum = term;
    for (int n = 1; n < 10000 && term > sum * 1e-16; ++n) sum += term *= x / (a + n);
    return 1 - front * sum;
  }
  double b = x + 1 - a, c = 1e300, d = 1 / b, h = d;  // continued fraction, Lentz
  for (int i = 1; i < 10000; ++i) {
    const double an = -i * (i - a);
    b += 2;
    d = 1 / (an * d + b), c = b + an / c;
    h *= d * c;
    if (std::abs(d * c - 1) < 1e-15) break;
  }
  return front * h;
}

/// Probability of a chi-square at least this large, if the hypothesis is true.
inline double chiSquareTail(double chiSquare, int degrees) {
  return gammaQ(degrees / 2.0, chiSquare / 2);
}

/// Level of each of n tests so that all together err with probability `overall` [Sidak 1967].
inline double sidakLevel(double overall, std::size_t n) {
  return 1 - std::pow(1 - overall, 1.0 / double(std::max<std::size_t>(n, 1)));
}

/// p-value of counts against expectations. Bins that expect fewer than 5 are pooled, smallest
/// first, since the statistic is only then near its distribution.
inline double chiSquareTest(const std::vector<double>& expected, const std::vector<double>& seen) {
  std::vector<std::size_t> order(expected.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return expected[a] < expected[b]; });
  double chiSquare = 0, pooledExpected = 0, pooledSeen = 0;
  int cells = 0;
  for (const std::size_t i : order) {
    pooledExpected += expected[i], pooledSeen += seen[i];
    if (pooledExpected < 5) continue;
    const double d = pooledSeen - pooledExpected;
    chiSquare += d * d / pooledExpected;
    ++cells, pooledExpected = pooledSeen = 0;
  }
  if (pooledSeen > 0 && pooledExpected < 1e-3) return 0;  // where there can be nothing
  return cells > 1 ? chiSquareTail(chiSquare, cells - 1) : 1;
}

/// Seen for each expected, in the bin where they differ by most standard deviations.
inline double worstRatio(const std::vector<double>& expected, const std::vector<double>& seen) {
  double most = 0, ratio = 1;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const double e = std::max(expected[i], 1.0), deviations = std::abs(seen[i] - e) / std::sqrt(e);
    if (deviations > most) most = deviations, ratio = seen[i] / e;
  }
  return ratio;
}

/// The sphere cut into cells of about equal probability, at the medians of a first set of samples
/// along alternating axes: a lobe of any width gets its share. The axes are longitude and height,
/// in which area is solid angle.
class SpherePartition {
 public:
  /// Up to 2^depth cells, cut further for integration until a few of `samples` are left in each;
  /// `samples` must not be those that are counted later.
  SpherePartition(const std::vector<Vec3>& samples, int depth) : depth_(depth) {
    Vec3 mean;
    for (const Vec3 d : samples) mean += d;
    if (!samples.empty()) middle_ = std::atan2(double(mean.y), double(mean.x));
    std::vector<Point> points;
    for (const Vec3 d : samples) points.push_back(pointOf(d));
    nodes_.push_back({{{-kPi_, 0}, {kPi_, 2}}, -1, -1, 0, 0});
    grow(0, points, 0);
  }

  std::size_t cells() const { return cells_; }

  std::size_t cellOf(Vec3 direction) const {
    const Point p = pointOf(direction);
    for (int node = 0, cell = -1;;) {
      const Node& n = nodes_[std::size_t(node)];
      if (n.cell >= 0) cell = n.cell;
      if (n.child < 0) return std::size_t(cell);
      node = p[n.axis] < n.cut ? n.child : n.child + 1;
    }
  }

  /// Integral of a density (1/sr) over each cell.
  template <class Density>
  std::vector<double> integrate(const Density& density) const {
    std::vector<double> sums(cells_, 0);
    addNode(0, -1, density, sums);
    return sums;
  }

 private:
  /// Longitude in [-pi, pi], from the samples' mean so that lobes stay clear of the seam; height
  /// 1 + z in [0, 2].
  using Point = std::array<double, 2>;
  struct Box {
    Point low, high;
  };
  struct Node {
    Box box;
    int cell;   ///< index of the cell that this box is, or -1
    int child;  ///< first of two, or -1
    std::size_t axis;
    double cut;
  };
  static constexpr double kPi_ = 3.14159265358979323846;
  static constexpr std::size_t kLeaf = 4;  ///< samples in a box of integration

  /// Height by z, but near the poles by x^2 + y^2: about the normal a narrow lobe's 1 - z has no
  /// digits left in a float.
  Point pointOf(Vec3 d) const {
    const double x = d.x, y = d.y, z = std::abs(double(d.z)), s = x * x + y * y;
    const double cap = z < 0.5 ? 1 - z : s / (1 + std::sqrt(std::max(0.0, 1 - s)));  // 1 - |z|
    return {std::remainder(std::atan2(y, x) - middle_, 2 * kPi_), d.z < 0 ? cap : 2 - cap};
  }
  Vec3 directionOf(Point p) const {
    const double r = std::sqrt(std::max(0.0, p[1] * (2 - p[1])));
    const double phi = p[0] + middle_;
    return {Real(r * std::cos(phi)), Real(r * std::sin(phi)), Real(p[1] - 1)};
  }

  /// Medians, until a few samples are left in each box, or only equal ones.
  void grow(int node, std::vector<Point>& points, int level) {
    std::size_t axis = level == 0 ? 1 : std::size_t(level % 2);
    double at = 1;  // first at the horizon, where densities jump
    bool last = points.size() <= kLeaf;
    if (level > 0 && !last) {
      if (!medianOf(points, axis, at)) axis = 1 - axis, last = !medianOf(points, axis, at);
    }
    if (level == depth_ || (level < depth_ && last)) nodes_[std::size_t(node)].cell = int(cells_++);
    if (last) return trim(node, points);
    std::vector<Point> below, above;
    for (const Point& p : points) (p[axis] < at ? below : above).push_back(p);
    const int child = cut(node, axis, at);
    points = {};
    grow(child, below, level + 1), grow(child + 1, above, level + 1);
  }

  /// The cut that gives both halves samples; false if all samples are equal along the axis.
  static bool medianOf(std::vector<Point>& points, std::size_t axis, double& at) {
    const auto less = [&](const Point& a, const Point& b) { return a[axis] < b[axis]; };
    std::sort(points.begin(), points.end(), less);
    const auto next = std::upper_bound(points.begin(), points.end(), points.front(), less);
    if (next == points.end()) return false;
    at = (*std::max(next, points.begin() + std::ptrdiff_t(points.size() / 2)))[axis];
    return true;
  }

  /// Halves off what is empty around a few samples, the relatively widest margin first: boxes at
  /// the rim of a narrow lobe reach far beyond it, and their integral must not be taken from points
  /// that all miss it.
  void trim(int node, const std::vector<Point>& points) {
    if (points.empty()) return;
    Point low = points[0], high = points[0];
    for (const Point& p : points)
      for (const std::size_t axis : {0, 1})
        low[axis] = std::min(low[axis], p[axis]), high[axis] = std::max(high[axis], p[axis]);
    for (int step = 0; step < 200; ++step) {
      const Box& box = nodes_[std::size_t(node)].box;
      std::size_t axis = 0;
      bool below = false;
      double widest = 2, at = 0;  // in extents of the samples
      for (const std::size_t a : {0, 1})
        for (const bool lower : {false, true}) {
          const double end = lower ? box.low[a] : box.high[a], near = lower ? low[a] : high[a];
          const double margin = std::abs(end - near) / std::max(high[a] - low[a], 1e-12);
          if (margin > widest) widest = margin, axis = a, below = lower, at = (end + near) / 2;
        }
      if (widest <= 2) return;
      node = cut(node, axis, at) + (below ? 1 : 0);
    }
  }

  /// Makes two children and returns the first, which is the lower one.
  int cut(int node, std::size_t axis, double at) {
    const int child = int(nodes_.size());
    Node& n = nodes_[std::size_t(node)];
    n.child = child, n.axis = axis, n.cut = at;
    Box low = n.box, high = n.box;
    low.high[axis] = high.low[axis] = at;
    nodes_.push_back({low, -1, -1, 0, 0}), nodes_.push_back({high, -1, -1, 0, 0});
    return child;
  }

  template <class Density>
  void addNode(int node, int cell, const Density& density, std::vector<double>& sums) const {
    const Node& n = nodes_[std::size_t(node)];
    if (n.cell >= 0) cell = n.cell;
    if (n.child < 0) {
      sums[std::size_t(cell)] += adaptive(n.box, gauss(n.box, density), density, 6);
      return;
    }
    addNode(n.child, cell, density, sums), addNode(n.child + 1, cell, density, sums);
  }

  /// Quarters a box until its quarters agree with it to a thousandth; a large one in any case,
  /// since all its points may miss a strip of density.
  template <class Density>
  double adaptive(const Box& b, double whole, const Density& density, int levels) const {
    const Point m = {(b.low[0] + b.high[0]) / 2, (b.low[1] + b.high[1]) / 2};
    const Box parts[4] = {{b.low, m},
                          {{m[0], b.low[1]}, {b.high[0], m[1]}},
                          {{b.low[0], m[1]}, {m[0], b.high[1]}},
                          {m, b.high}};
    double part[4], sum = 0;
    for (int i = 0; i < 4; ++i) sum += part[i] = gauss(parts[i], density);
    const double area = (b.high[0] - b.low[0]) * (b.high[1] - b.low[1]);
    const bool agrees = area < 0.02 && std::abs(sum - whole) <= 1e-3 * sum + 1e-8;
    if (levels == 0 || agrees) return sum;
    sum = 0;
    for (int i = 0; i < 4; ++i) sum += adaptive(parts[i], part[i], density, levels - 1);
    return sum;
  }

  /// 3 x 3 points of Gauss and Legendre.
  template <class Density>
  double gauss(const Box& b, const Density& density) const {
    constexpr double at[3] = {-0.7745966692414834, 0, 0.7745966692414834};
    constexpr double weight[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
    const auto place = [&](int axis, int i) {
      return (b.low[axis] + b.high[axis]) / 2 + at[i] * (b.high[axis] - b.low[axis]) / 2;
    };
    double sum = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        sum += weight[i] * weight[j] * double(density(directionOf({place(0, i), place(1, j)})));
    return sum * (b.high[0] - b.low[0]) * (b.high[1] - b.low[1]);
  }

  int depth_;
  double middle_ = 0;
  std::size_t cells_ = 0;
  std::vector<Node> nodes_;
};

}  // namespace vestige::judge
