// SPDX-License-Identifier: Apache-2.0
// Many differentials into four (five with the gradient) that have the same second moments. Every
// later event is linear, so all ellipses stay what they were; a long path costs no more than a
// short one. Exact polygons do not survive this [MATH 2.4].
#pragma once
#include <vestige/footprint/differentials.h>

namespace vestige {
namespace detail {

/// Rows: position (2), direction (2), gradient (1).
inline constexpr int kState = 5;
using Moments = std::array<std::array<Real, kState>, kState>;

/// Columns of a factor L of the positive semidefinite S = L L^T, largest pivots first; what is
/// below rounding is left out. Returns how many columns there are.
inline int factor(Moments s, int size, Moments& l) noexcept {
  constexpr Real kLeastPivot = 64 * std::numeric_limits<Real>::epsilon();
  int rank = 0;
  for (; rank < size; ++rank) {
    int pivot = 0;
    for (int i = 1; i < size; ++i)
      if (s[i][i] > s[pivot][pivot]) pivot = i;
    if (!(s[pivot][pivot] > kLeastPivot)) break;
    const Real root = 1 / std::sqrt(s[pivot][pivot]);
    for (int i = 0; i < size; ++i) l[rank][i] = s[i][pivot] * root;
    for (int i = 0; i < size; ++i)
      for (int j = 0; j < size; ++j) s[i][j] -= l[rank][i] * l[rank][j];
    s[pivot][pivot] = 0;
  }
  return rank;
}

}  // namespace detail

/// Replaces the differentials at a vertex with geometric normal n on a path that arrives along
/// `direction` (or leaves along it: whatever dDirection is tangent to). weights[j] multiplies
/// number j: 1 where deltas are common to all, its own delta where they are frozen. Without
/// `gradient`, g becomes 0.
template <int Lanes>
void reduce(Differentials<Lanes>& d, Vec3 n, Vec3 direction, const Real* weights,
            bool gradient) noexcept {
  using namespace detail;
  const Frame fv = Frame::around(n), fd = Frame::around(direction);
  Real rows[Lanes][kState], trace[3] = {};
  for (int j = 0; j < d.size(); ++j) {
    const Vec3 v = weights[j] * d.dVertex(j), w = weights[j] * d.dDirection(j);
    const Real r[kState] = {dot(v, fv.s), dot(v, fv.t), dot(w, fd.s), dot(w, fd.t),
                            gradient ? weights[j] * d.gradient(j) : 0};
    for (int i = 0; i < kState; ++i) rows[j][i] = r[i], trace[i / 2] += r[i] * r[i];
  }
  // Positions, directions and gradients have units of their own: each block to unit trace.
  Real unit[kState];
  for (int i = 0; i < kState; ++i) unit[i] = trace[i / 2] > 0 ? std::sqrt(trace[i / 2]) : Real(1);
  Moments s{}, l{};
  for (int j = 0; j < d.size(); ++j)
    for (int i = 0; i < kState; ++i)
      for (int k = 0; k < kState; ++k) s[i][k] += rows[j][i] / unit[i] * (rows[j][k] / unit[k]);
  const int rank = factor(s, gradient ? kState : kState - 1, l);
  d.clear();
  for (int j = 0; j < rank; ++j) {
    Real c[kState];
    for (int i = 0; i < kState; ++i) c[i] = l[j][i] * unit[i];
    d.append(c[0] * fv.s + c[1] * fv.t, c[2] * fd.s + c[3] * fd.t, c[4]);
  }
}

}  // namespace vestige
