// SPDX-License-Identifier: Apache-2.0
// A density over the unit square that is constant in each cell of a grid: draws a row by its sum,
// then a cell within the row.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <vestige/math.h>

namespace vestige {

class GridDistribution {
 public:
  /// A drawn point and the densities of its coordinates: the marginal density of p.y, and that of
  /// p.x given the row. Their product is the density per unit of the square; d(p.x)/d(u.x) is
  /// 1/density.x and d(p.y)/d(u.y) is 1/density.y; the other two derivatives are zero inside a
  /// cell.
  struct Sample {
    Vec2 p, density;
  };

  GridDistribution() = default;
  /// Weights >= 0, finite, row after row from v = 0. Sums are taken in double: one cell may hold
  /// nearly everything.
  GridDistribution(int columns, int rows, const std::vector<double>& weights)
      : columns_(columns), rows_(rows), cells_(std::size_t(rows) * (columns + 1)) {
    std::vector<double> sums(std::size_t(rows), 0);
    for (int j = 0; j < rows; ++j)
      sums[j] = accumulate(&weights[std::size_t(j) * columns], columns, row(j));
    marginal_.resize(rows + 1);
    total_ = accumulate(sums.data(), rows, marginal_.data());
  }

  /// Whether every weight is 0: nothing can be drawn.
  bool isEmpty() const noexcept { return !(total_ > 0); }
  /// Sum of all weights.
  double total() const noexcept { return total_; }

  /// Requires !isEmpty().
  Sample sample(Vec2 u) const noexcept {
    const Place y = draw(marginal_.data(), rows_, u.y);
    const Place x = draw(row(y.cell), columns_, u.x);
    return {{x.at, y.at}, {x.density, y.density}};
  }
  /// The densities of Sample at a point of [0,1]^2.
  Vec2 density(Vec2 p) const noexcept {
    if (isEmpty()) return {};
    const int j = cellOf(p.y, rows_), i = cellOf(p.x, columns_);
    return {share(row(j), i) * columns_, share(marginal_.data(), j) * rows_};
  }

 private:
  // Cumulative sums as multiples of 2^-32: half the memory of double, with uniform resolution (a
  // float is coarse near 1). sample() and density() use the same integers.
  using Fixed = std::uint32_t;
  static constexpr double kOne = 4294967295.0;

  struct Place {
    int cell;
    Real at, density;
  };

  const Fixed* row(int j) const noexcept { return &cells_[std::size_t(j) * (columns_ + 1)]; }
  Fixed* row(int j) noexcept { return &cells_[std::size_t(j) * (columns_ + 1)]; }

  /// Writes n + 1 cumulative sums; a weight above 0 never vanishes in rounding.
  static double accumulate(const double* weights, int n, Fixed* sums) {
    double total = 0;
    for (int i = 0; i < n; ++i) total += weights[i];
    sums[0] = 0;
    if (!(total > 0)) {
      std::fill(sums + 1, sums + n + 1, 0);
      return 0;
    }
    const auto raised = [&](double w) { return w > 0 ? std::max(w, total * 0x1p-31) : 0; };
    double all = 0, sum = 0;  // added in the same order: the last quotient is exactly 1
    for (int i = 0; i < n; ++i) all += raised(weights[i]);
    for (int i = 0; i < n; ++i) {
      sum += raised(weights[i]);
      sums[i + 1] = Fixed(std::min(std::round(sum / all * kOne), kOne));
    }
    return total;
  }
  static Real share(const Fixed* sums, int i) noexcept {
    return Real((double(sums[i + 1]) - double(sums[i])) / kOne);
  }
  static int cellOf(Real x, int n) noexcept { return std::clamp(int(x * n), 0, n - 1); }

  static Place draw(const Fixed* sums, int n, Real u) noexcept {
    const double target = std::clamp(double(u), 0.0, 1 - 0x1p-53) * kOne;
    // The first sum above the target: its cell has a share.
    const Fixed* above = std::upper_bound(sums + 1, sums + n + 1, target,
                                          [](double t, Fixed sum) { return t < double(sum); });
    const int i = int(std::min(above, sums + n) - sums) - 1;
    const double low = sums[i], high = sums[i + 1];
    const Real at = Real((i + (target - low) / (high - low)) / n);
    return {i, std::min(at, kOneMinusEpsilon), share(sums, i) * n};
  }

  int columns_ = 0, rows_ = 0;
  std::vector<Fixed> cells_;     ///< rows of columns + 1 sums
  std::vector<Fixed> marginal_;  ///< rows + 1 sums
  double total_ = 0;
};

}  // namespace vestige
