// SPDX-License-Identifier: Apache-2.0
#include "lang/transforms.h"

#include <cmath>

namespace vestige::lang {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;

/// Quarter turns are exact, so that boxes stay boxes.
void sinCos(double degrees, double& s, double& c) {
  const double quarters = degrees / 90;
  if (std::abs(quarters) < 1e9 && quarters == std::floor(quarters)) {
    constexpr double sines[] = {0, 1, 0, -1};
    const int q = int(((std::int64_t(quarters) % 4) + 4) % 4);
    s = sines[q], c = sines[(q + 1) % 4];
    return;
  }
  s = std::sin(degrees * kDegree), c = std::cos(degrees * kDegree);
}

/// Turns the plane of axes i and j by the angle, from i towards j.
Affine turn(int i, int j, double degrees) {
  Affine a;
  double s = 0, c = 1;
  sinCos(degrees, s, c);
  a.m[i][i] = c, a.m[j][j] = c;
  a.m[j][i] = s, a.m[i][j] = -s;
  return a;
}

}  // namespace

Affine translation(const Numbers& by) {
  Affine a;
  for (int i = 0; i < 3; ++i) a.m[i][3] = by.at(i);
  return a;
}

Affine scaling(const Numbers& by) {
  Affine a;
  for (int i = 0; i < 3; ++i) a.m[i][i] = by.at(i) == 0 ? 1 : by.at(i);
  return a;
}

Affine rotation(const Numbers& degrees) {
  return turn(0, 1, degrees.at(2)) * turn(2, 0, degrees.at(1)) * turn(1, 2, degrees.at(0));
}

Affine rotationAround(const Numbers& axis, double degrees) {
  const double l = std::hypot(axis.at(0), axis.at(1), axis.at(2));
  const double n[3] = {axis.at(0) / l, axis.at(1) / l, axis.at(2) / l};
  double s = 0, c = 1;
  sinCos(degrees, s, c);
  Affine a;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) a.m[i][j] = n[i] * n[j] * (1 - c) + (i == j ? c : 0);
  for (int i = 0; i < 3; ++i) {
    a.m[(i + 2) % 3][(i + 1) % 3] += s * n[i];
    a.m[(i + 1) % 3][(i + 2) % 3] -= s * n[i];
  }
  return a;
}

Affine fromRows(const double (&rows)[12]) {
  Affine a;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 3; ++i) a.m[i][j] = rows[3 * j + i];
  return a;
}

}  // namespace vestige::lang
