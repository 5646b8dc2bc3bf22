// SPDX-License-Identifier: Apache-2.0
// Bins in latitude and longitude, and what a density puts into each: for chi-square tests.
#pragma once
#include <vestige/math.h>

#include <vector>

#include "judge/statistics.h"

namespace vestige::judge {

/// `columns` of longitude from -pi, 0 towards +z and growing towards +x; `rows` of latitude from
/// the south pole, y up.
struct SphereGrid {
  int columns, rows;

  std::size_t bin(Vec3 d) const {
    const double side = 0.5 + std::atan2(double(d.x), double(d.z)) / (2 * M_PI);
    const double up = 0.5 + std::atan2(double(d.y), std::hypot(double(d.x), double(d.z))) / M_PI;
    return std::size_t(std::clamp(int(up * rows), 0, rows - 1) * columns +
                       std::clamp(int(side * columns), 0, columns - 1));
  }
  static Vec3 direction(double side, double up) {
    const double lon = M_PI * (2 * side - 1), lat = M_PI * (up - 0.5);
    return {Real(std::cos(lat) * std::sin(lon)), Real(std::sin(lat)),
            Real(std::cos(lat) * std::cos(lon))};
  }

  /// Integral of f(direction) over each bin, by `fine` x `fine` points.
  template <class F>
  std::vector<double> integrate(const F& f, int fine) const {
    std::vector<double> sums(std::size_t(columns) * rows, 0);
    const int nx = columns * fine, ny = rows * fine;
    for (int y = 0; y < ny; ++y) {
      const double up = (y + 0.5) / ny, area = 2 * M_PI * M_PI * std::sin(M_PI * up) / nx / ny;
      for (int x = 0; x < nx; ++x)
        sums[std::size_t(y / fine) * columns + x / fine] +=
            area * double(f(direction((x + 0.5) / nx, up)));
    }
    return sums;
  }
};

struct GridVerdict {
  double mass;    ///< integral of the density: 1 if every number gives a direction
  double pValue;  ///< chi-square
};

/// Directions drawn n times against their density, 1/sr.
template <class Draw, class Density>
GridVerdict gridVerdict(SphereGrid grid, int fine, int n, const Draw& draw,
                        const Density& density) {
  std::vector<double> expected = grid.integrate(density, fine), seen(expected.size(), 0);
  double mass = 0;
  for (double& e : expected) mass += e, e *= n;
  for (int i = 0; i < n; ++i) seen[grid.bin(draw())] += 1;
  return {mass, chiSquareTest(expected, seen)};
}

}  // namespace vestige::judge
