// SPDX-License-Identifier: Apache-2.0
// Pictures made of panels side by side, each a grid of numbers: densities in grey, errors in red.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "engine/picture/image.h"
#include "judge/trusted_difference.h"

namespace vestige::judge {

/// A picture of a report, and what its axes and colours mean.
struct Picture {
  std::string file;  ///< "density.png"
  Image image;
  std::string legend;
};

/// Numbers in rows, row 0 at the top.
struct Grid {
  int columns, rows;
  std::vector<double> values = std::vector<double>(std::size_t(columns) * rows, 0);

  double& at(int column, int row) { return values[std::size_t(row) * columns + column]; }
  double at(int column, int row) const { return values[std::size_t(row) * columns + column]; }
};

/// f(x, y) at the middle of each cell, x and y in [0, 1] from left to right and top to bottom.
template <class F>
Grid gridOf(int columns, int rows, const F& f) {
  Grid g{columns, rows};
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) g.at(x, y) = f((x + 0.5) / columns, (y + 0.5) / rows);
  return g;
}

double largest(const Grid& g);

/// Panels of the same size, black for 0; white for `white` and more.
Image greyPanels(const std::vector<Grid>& panels, double white);

/// Errors in units of what is allowed: black for 0, red for 1, white for 4 and more; dark blue for
/// kNothingSaid.
Image errorPanels(const std::vector<Grid>& panels);
inline constexpr double kNothingSaid = -1;
inline const std::string kErrorColours =
    "black: no error, red: as much as is allowed, white: four times that, dark blue: differences "
    "say nothing";

/// "0.318/sr" for a legend.
std::string withUnit(double value, const std::string& unit);

// ---------------------------------------------------------------------------------- the sphere

/// Cells of equal solid angle about +z: the column goes by longitude from -180 to 180 degrees, +x
/// in the middle, the row by z, 1 at the top.
inline constexpr int kSphereColumns = 128, kSphereRows = 64;
inline constexpr double kSphereCells = double(kSphereColumns) * kSphereRows;
Vec3 onSphere(double x, double y);  ///< both in [0, 1]
double& cellTowards(Grid& sphere, Vec3 direction);

/// The mean of f(direction) over each cell, by 4 x 4 points.
template <class F>
Grid sphereOf(const F& f) {
  return gridOf(kSphereColumns, kSphereRows, [&](double x, double y) {
    double sum = 0;
    for (int k = 0; k < 16; ++k)
      sum += double(
          f(onSphere(x + (k % 4 - 1.5) / 4 / kSphereColumns, y + (k / 4 - 1.5) / 4 / kSphereRows)));
    return sum / 16;
  });
}

/// The same map about +y, for things of a world that has y up: +z in the middle, +x right of it.
inline Vec3 yUp(Vec3 z) { return {z.y, z.z, z.x}; }
inline Vec3 zUp(Vec3 y) { return {y.z, y.x, y.y}; }

}  // namespace vestige::judge
