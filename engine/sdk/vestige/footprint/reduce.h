// SPDX-License-Identifier: Apache-2.0
// Many differentials into four (five with the gradient) that have the same second moments. Every
// later event is linear, so all ellipses stay what they were; a long path costs no more than a
// short one. Exact polygons do not survive this [MATH 2.4].
#pragma once
#include <vestige/footprint/differentials.h>

namespace vestige {
namespace detail {

/// Lower triangle of L with L L^T = S for a positive semidefinite S of unit traces, in place. What
/// is below rounding becomes a column of zeros.
template <int N>
void factor(Real (&s)[N][N]) noexcept {
  constexpr Real kLeastPivot = 64 * std::numeric_limits<Real>::epsilon();
  for (int k = 0; k < N; ++k) {
    const Real pivot = s[k][k];
    const Real inverse = pivot > kLeastPivot ? 1 / std::sqrt(pivot) : Real(0);
    for (int i = k; i < N; ++i) s[i][k] *= inverse;
    for (int j = k + 1; j < N; ++j)
      for (int i = j; i < N; ++i) s[i][j] -= s[i][k] * s[j][k];
  }
}

/// Rows: position (2), direction (2), gradient (1 or none).
template <int N, int Lanes>
void reduceTo(Differentials<Lanes>& d, const Frame& fv, const Frame& fd,
              const Four* weights) noexcept {
  Four rows[N][Lanes / 4] = {};
  for (int b = 0; b < d.blocks(); ++b) {
    const auto v = d.verticesAlong(b, fv.s, fv.t), w = d.directionsAlong(b, fd.s, fd.t);
    rows[0][b] = weights[b] * v.x, rows[1][b] = weights[b] * v.y;
    rows[2][b] = weights[b] * w.x, rows[3][b] = weights[b] * w.y;
    if constexpr (N == 5) rows[4][b] = weights[b] * d.gradients(b);
  }
  Real s[N][N];
  for (int i = 0; i < N; ++i)
    for (int k = 0; k <= i; ++k) {
      Four sum = rows[i][0] * rows[k][0];
      for (int b = 1; b < d.blocks(); ++b) sum += rows[i][b] * rows[k][b];
      s[i][k] = (sum[0] + sum[1]) + (sum[2] + sum[3]);
    }
  // Positions, directions and gradients have units of their own: each block to unit trace.
  Real unit[N];
  for (int i = 0; i < N; ++i) {
    const int first = i & ~1, second = std::min(first + 1, N - 1);
    const Real trace = s[first][first] + (second > first ? s[second][second] : Real(0));
    unit[i] = trace > 0 ? std::sqrt(trace) : Real(1);
  }
  for (int i = 0; i < N; ++i)
    for (int k = 0; k <= i; ++k) s[i][k] /= unit[i] * unit[k];
  factor(s);
  d.clear();
  for (int k = 0; k < N; ++k) {
    Real c[5] = {};
    bool isZero = true;
    for (int i = k; i < N; ++i) c[i] = s[i][k] * unit[i], isZero = isZero && c[i] == 0;
    if (!isZero) d.append(c[0] * fv.s + c[1] * fv.t, c[2] * fd.s + c[3] * fd.t, c[4]);
  }
}

}  // namespace detail

/// Replaces the differentials at a vertex with geometric normal n on a path that arrives along
/// `direction` (or leaves along it: whatever dDirection is tangent to). weights[j] multiplies
/// number j, one for every lane: 1 where deltas are common to all, its own delta where they are
/// frozen. Without `gradient`, g becomes 0.
template <int Lanes>
void reduce(Differentials<Lanes>& d, Vec3 n, Vec3 direction, const Four* weights,
            bool gradient) noexcept {
  const Frame fv = Frame::around(n), fd = Frame::around(direction);
  if (gradient)
    detail::reduceTo<5>(d, fv, fd, weights);
  else
    detail::reduceTo<4>(d, fv, fd, weights);
}

}  // namespace vestige
