// SPDX-License-Identifier: Apache-2.0
// Random numbers as a pure function of (pixel, sample index, dimension, seed), so that an image is
// the same for any order of work, and can be continued without a known number of samples.
//
// [Bur20] Burley. Practical hash-based Owen scrambling. JCGT 9(4), 2020.
// [AKLZ24] Ahmed, et al.: the second Sobol' dimension is Pascal's triangle modulo 2, which factors
// into
//          five shifts (tested against the direction numbers).
#pragma once
#include <vestige/math.h>
#include <cstdint>

namespace vestige {

/// Dimensions of a path. Pairs start where a pair is drawn.
namespace dimension {
inline constexpr std::uint32_t kFilm = 0, kLens = 2, kTime = 4;
inline constexpr std::uint32_t kFirstVertex = 5, kPerVertex = 8;
/// Offsets inside a vertex.
inline constexpr std::uint32_t kDirection = 0, kLobe = 2, kLight = 3, kLightChoice = 5,
                               kRoulette = 6, kOpacity = 7;
inline constexpr std::uint32_t vertex(std::uint32_t k) noexcept {
  return kFirstVertex + kPerVertex * k;
}
}  // namespace dimension

namespace detail {

inline std::uint32_t mix(std::uint32_t h) noexcept {  // "lowbias32", C. Wellons
  h ^= h >> 16, h *= 0x7feb352du, h ^= h >> 15, h *= 0x846ca68bu;
  return h ^ (h >> 16);
}
inline std::uint32_t mix(std::uint32_t a, std::uint32_t b) noexcept {
  return mix(a ^ (mix(b) + 0x9e3779b9u + (a << 6) + (a >> 2)));
}
inline std::uint32_t reverseBits(std::uint32_t x) noexcept {
  x = __builtin_bswap32(x);
  x = ((x & 0x0f0f0f0fu) << 4) | ((x >> 4) & 0x0f0f0f0fu);
  x = ((x & 0x33333333u) << 2) | ((x >> 2) & 0x33333333u);
  return ((x & 0x55555555u) << 1) | ((x >> 1) & 0x55555555u);
}
/// The same for two numbers in one word, at the cost of one. The first is in the upper half of the
/// result.
inline std::uint64_t reverseBits(std::uint32_t first, std::uint32_t second) noexcept {
  std::uint64_t x = __builtin_bswap64((std::uint64_t(second) << 32) | first);
  x = ((x & 0x0f0f0f0f0f0f0f0fu) << 4) | ((x >> 4) & 0x0f0f0f0f0f0f0f0fu);
  x = ((x & 0x3333333333333333u) << 2) | ((x >> 2) & 0x3333333333333333u);
  return ((x & 0x5555555555555555u) << 1) | ((x >> 1) & 0x5555555555555555u);
}
/// Owen scrambling of a number whose bits are reversed: bit k is flipped by a hash of the bits
/// below it [Bur20, constants by N. Vegdahl].
inline std::uint32_t owenReversed(std::uint32_t x, std::uint32_t seed) noexcept {
  x ^= x * 0x3d20adeau, x += seed, x *= (seed >> 16) | 1u;
  x ^= x * 0x05526c56u;
  return x ^ (x * 0x53a22864u);
}
/// Second Sobol' dimension of index i, bits reversed [AKLZ24].
inline std::uint32_t sobol1Reversed(std::uint32_t i) noexcept {
  i ^= (i >> 1) & 0x55555555u, i ^= (i >> 2) & 0x33333333u, i ^= (i >> 4) & 0x0f0f0f0fu;
  i ^= (i >> 8) & 0x00ff00ffu;
  return i ^ (i >> 16);
}
inline Real unitInterval(std::uint32_t x) noexcept {
  // 24 bits are what a float holds; more would round up to 1.
  return sizeof(Real) == 4 ? Real(x >> 8) * Real(0x1p-24) : Real(x) * Real(0x1p-32);
}

}  // namespace detail

/// Owen-scrambled Sobol' numbers of one sample of one pixel.
class Sampler {
 public:
  Sampler(std::uint32_t x, std::uint32_t y, std::uint32_t index, std::uint32_t seed) noexcept
      : key_(detail::mix(detail::mix(x, y), seed)), index_(index) {}

  std::uint32_t index() const noexcept { return index_; }

  /// A number of [0,1); over the index a scrambled van der Corput sequence.
  Real number(std::uint32_t dim) const noexcept { return number(dim, index_); }
  /// A pair of [0,1)^2; over the index a scrambled (0,2)-sequence.
  Vec2 pair(std::uint32_t dim) const noexcept { return pair(dim, index_); }

  /// The same with an index of the caller's: child c of a split of n draws index() * n + c.
  /// (Inline always: numbers of one index then share its reversal.)
  [[gnu::always_inline]] Real number(std::uint32_t dim, std::uint32_t index) const noexcept {
    const std::uint32_t key = keyOf(dim);
    return detail::unitInterval(
        detail::reverseBits(detail::owenReversed(shuffled(index, key), key * kSeeds[0])));
  }
  [[gnu::always_inline]] Vec2 pair(std::uint32_t dim, std::uint32_t index) const noexcept {
    using namespace detail;
    const std::uint32_t key = keyOf(dim), i = shuffled(index, key);
    const std::uint64_t both = reverseBits(owenReversed(i, key * kSeeds[0]),
                                           owenReversed(sobol1Reversed(i), key * kSeeds[1]));
    return {unitInterval(std::uint32_t(both >> 32)), unitInterval(std::uint32_t(both))};
  }

 private:
  /// Odd: from a key that is well mixed, seeds that share no pattern.
  static constexpr std::uint32_t kSeeds[2] = {0x9e3779b9u, 0x846ca68bu};

  [[gnu::always_inline]] std::uint32_t keyOf(std::uint32_t dim) const noexcept {
    return detail::mix(key_ ^ (dim * 0x9e3779b9u));
  }
  /// Decorrelates dimensions: an Owen scramble of the index, which keeps every aligned power of two
  /// of indices together.
  [[gnu::always_inline]] static std::uint32_t shuffled(std::uint32_t index,
                                                       std::uint32_t key) noexcept {
    return detail::reverseBits(detail::owenReversed(detail::reverseBits(index), key));
  }

  std::uint32_t key_, index_;
};

}  // namespace vestige
