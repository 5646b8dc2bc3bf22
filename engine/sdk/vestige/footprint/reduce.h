// SPDX-License-Identifier: Apache-2.0
// Many differentials into four (five with the gradient) that have the same second moments. Every
// later event is linear, so all later ellipses are unchanged, and the cost of a path stays linear
// in its length. Exact polygons are lost [MATH 2.4].
#pragma once
#include <vestige/footprint/differentials.h>

namespace vestige {
namespace detail {

/// Lower triangle of L with L L^T = S for a positive semidefinite S of unit traces, in place.
/// Columns below rounding become zero.
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
void reduceTo(Differentials<Lanes>& d, const Four* weights) noexcept {
  Four rows[N][Lanes / 4] = {};
  for (int b = 0; b < d.blocks(); ++b) {
    const auto& [v, w, g, longest] = d.block(b);
    rows[0][b] = weights[b] * v.x, rows[1][b] = weights[b] * v.y;
    rows[2][b] = weights[b] * w.x, rows[3][b] = weights[b] * w.y;
    if constexpr (N == 5) rows[4][b] = weights[b] * g;
  }
  Real s[N][N];
  for (int i = 0; i < N; ++i)
    for (int k = 0; k <= i; ++k) {
      Four sum = rows[i][0] * rows[k][0];
      for (int b = 1; b < d.blocks(); ++b) sum += rows[i][b] * rows[k][b];
      s[i][k] = (sum[0] + sum[1]) + (sum[2] + sum[3]);
    }
  // Positions, directions and gradients have different units: each block is scaled to unit trace.
  Real unit[N], inverse[N];
  for (int i = 0; i < N; ++i) {
    const int first = i & ~1, second = std::min(first + 1, N - 1);
    const Real trace = s[first][first] + (second > first ? s[second][second] : Real(0));
    unit[i] = trace > 0 ? std::sqrt(trace) : Real(1);
    inverse[i] = 1 / unit[i];
  }
  for (int i = 0; i < N; ++i)
    for (int k = 0; k <= i; ++k) s[i][k] *= inverse[i] * inverse[k];
  factor(s);
  d.clear();
  for (int k = 0; k < N; ++k) {
    Real c[5] = {};
    bool isZero = true;
    for (int i = k; i < N; ++i) c[i] = s[i][k] * unit[i], isZero = isZero && c[i] == 0;
    if (!isZero) d.append(Vec2{c[0], c[1]}, Vec2{c[2], c[3]}, c[4]);
  }
}

}  // namespace detail

/// Replaces the differentials on arrival at a vertex. weights[b] multiplies block b, lane by lane:
/// 1 where deltas are common to all, a number's own delta where they are frozen. Without
/// `gradient`, g becomes 0.
template <int Lanes>
void reduce(Differentials<Lanes>& d, const Four* weights, bool gradient) noexcept {
  if (gradient)
    detail::reduceTo<5>(d, weights);
  else
    detail::reduceTo<4>(d, weights);
}

}  // namespace vestige
