// SPDX-License-Identifier: Apache-2.0
// Paths that branch: the random numbers of each branch, the stratification of a split, and the
// second lobe of a fork.
#pragma once
#include <vestige/footprint.h>

#include <optional>

namespace vestige {

/// A sampled continuation of a path, with its random numbers.
struct Continuation {
  ScatterNumbers numbers;
  std::optional<Scatter> scatter;  ///< empty: the path is absorbed
};

/// The random numbers of a path: each vertex has its own dimensions, and in each dimension the path
/// uses the number of its index. Branches of a path get different streams.
struct RandomStream {
  std::uint32_t index = 0;
  std::uint32_t firstVertex = 0;  ///< number of the first vertex, which chooses the dimensions

  /// Number of the vertex at the end of an edge; edge 1 leaves the camera.
  std::uint32_t vertex(int edge) const noexcept { return firstVertex + std::uint32_t(edge) - 1; }

  /// The stream of child i of `count`. Siblings have consecutive indices from a multiple of
  /// `count`, hence stratified numbers. While 32 bits suffice, the children of all parents share
  /// one sequence; beyond, each parent has a block of indices and dimensions by hash.
  RandomStream child(int count, int i) const noexcept {
    const auto n = std::uint32_t(count);
    if (std::uint64_t(index) * n + n <= kIndices)
      return {index * n + std::uint32_t(i), firstVertex};
    const std::uint64_t block = detail::mix(index, firstVertex) % (kIndices / n);
    return {std::uint32_t(block) * n + std::uint32_t(i),
            detail::mix(firstVertex ^ 0x5bd1e995u, index)};
  }

  /// A second stream of the same index. Its dimensions lie behind those of 4096 vertices.
  RandomStream forked() const noexcept { return {index, firstVertex + 4096}; }

 private:
  static constexpr std::uint64_t kIndices = std::uint64_t(1) << 32;
};

/// Stratification of a split's pairs of random numbers: a (0,2)-net if their count is a power of
/// two, else a grid as square as the count allows (6 as 2 x 3).
struct SplitStrata {
  int count = 1;
  int columns = 0;  ///< 0: a net
  int rows = 0;

  explicit SplitStrata(int n) : count(n) {
    if ((n & (n - 1)) == 0) return;
    rows = int(std::sqrt(double(n)));
    while (n % rows != 0) --rows;
    columns = n / rows;
  }
  Strata strata() const noexcept {
    if (columns == 0) return squareStrata(count);
    return {Real(columns), Real(rows)};
  }
  /// The pair of child i, whose stream has the given index.
  Vec2 pair(const Sampler& s, std::uint32_t dim, std::uint32_t index, int i) const noexcept {
    const Vec2 u = s.pair(dim, index);
    if (columns == 0) return u;
    const auto within = [](Real x, int cell, int n) {
      return std::min((Real(cell) + x) / Real(n), kOneMinusEpsilon);
    };
    return {within(u.x, i % columns, columns), within(u.y, i / columns, rows)};
  }
};

/// The lobe that was not drawn, for a path that hits a rough dielectric from inside: there one ray
/// of 25 is reflected, and may carry all the light of a lamp. Empty if the BRDF has other lobes
/// than these two. Must depend on the direction numbers of `drawn` only, never on the lobe drawn;
/// otherwise the estimate is biased.
inline std::optional<Continuation> otherLobe(const Interaction& x,
                                             const Continuation& drawn) noexcept {
  if (!x.point.behind || !drawn.scatter || drawn.scatter->local.specular) return std::nullopt;
  const ScatterSample& one = drawn.scatter->local;
  if (!(one.lobeChance < 1)) return std::nullopt;
  constexpr Real kFirst = 0, kLast = Real(0x1.fffffep-1);
  for (const Real lobe : {kFirst, kLast}) {
    const ScatterNumbers numbers{lobe, drawn.numbers.u};
    const Continuation other{numbers, drawScatter(x, numbers)};
    if (!other.scatter) return std::nullopt;
    const ScatterSample& two = other.scatter->local;
    if (two.lobe == one.lobe) continue;
    if (two.specular || (two.toNext.z > 0) == (one.toNext.z > 0)) return std::nullopt;
    const bool areAll = std::abs(one.lobeChance + two.lobeChance - 1) < Real(1e-4);
    return areAll ? std::optional(other) : std::nullopt;
  }
  return std::nullopt;
}

/// The continuation followed for certain, weighted by the probability of drawing its lobe.
inline Continuation madeCertain(Continuation c) noexcept {
  Scatter& s = *c.scatter;
  const Real chance = s.local.lobeChance;
  s.local.lobeChance = 1;
  s.weight = chance * s.weight;
  s.local.weight = chance * s.local.weight;
  return c;
}

}  // namespace vestige
