// SPDX-License-Identifier: Apache-2.0
// Gradient noise [Per02: Perlin, "Improving Noise", SIGGRAPH 2002], its octaves averaged over a
// footprint, and turbulence of a footprint.
#pragma once
#include <cstdint>

#include <vestige/tools/pattern_filter.h>

namespace vestige {

namespace detail {

/// A well mixed number for a lattice point: the finaliser of MurmurHash3 after three odd multiples.
inline std::uint32_t latticeHash(std::int32_t x, std::int32_t y, std::int32_t z,
                                 std::uint32_t seed) noexcept {
  std::uint32_t h = seed ^ (std::uint32_t(x) * 0x9e3779b1u) ^ (std::uint32_t(y) * 0x85ebca77u) ^
                    (std::uint32_t(z) * 0xc2b2ae3du);
  h = (h ^ (h >> 16)) * 0x85ebca6bu;
  h = (h ^ (h >> 13)) * 0xc2b2ae35u;
  return h ^ (h >> 16);
}

/// d . g for one of the twelve directions to the edges of a cube [Per02].
inline Real latticeSlope(std::uint32_t h, Vec3 d) noexcept {
  const std::uint32_t edge = std::uint32_t((std::uint64_t(h) * 12) >> 32);
  const Real a = edge < 8 ? d.x : d.y;
  const Real b = edge < 4 ? d.y : d.z;
  return (edge & 1 ? -a : a) + (edge & 2 ? -b : b);
}

/// 6 t^5 - 15 t^4 + 10 t^3: no kink in value, slope or curvature at lattice points.
inline Real latticeFade(Real t) noexcept { return t * t * t * (t * (t * 6 - 15) + 10); }

}  // namespace detail

/// Gradient noise: mean 0, within [-1.04, 1.04]. Its lattice is rotated against the axes, because
/// noise is flatter on planes of lattice points, which floors and walls would otherwise be, and the
/// mean of |noise| would be wrong there.
inline Real gradientNoise(Vec3 at, std::uint32_t seed) noexcept {
  // Beyond this a float has no fraction, and an int would soon overflow.
  if (!(maxAbsComponent(at) < Real(1e9))) return 0;
  const Vec3 p{dot(Vec3{Real(0.670649316), Real(-0.561275730), Real(0.484973246)}, at),
               dot(Vec3{Real(0.692047325), Real(0.708791032), Real(-0.136695915)}, at),
               dot(Vec3{Real(-0.267020587), Real(0.427299460), Real(0.863779589)}, at)};
  const Vec3 low{std::floor(p.x), std::floor(p.y), std::floor(p.z)};
  const Vec3 d = p - low;
  const auto x = std::int32_t(low.x), y = std::int32_t(low.y), z = std::int32_t(low.z);
  const auto corner = [&](int i, int j, int k) {
    return detail::latticeSlope(detail::latticeHash(x + i, y + j, z + k, seed),
                                d - Vec3{Real(i), Real(j), Real(k)});
  };
  const auto mix = [](Real a, Real b, Real t) { return a + t * (b - a); };
  const Real u = detail::latticeFade(d.x), v = detail::latticeFade(d.y),
             w = detail::latticeFade(d.z);
  const auto face = [&](int k) {
    return mix(mix(corner(0, 0, k), corner(1, 0, k), u), mix(corner(0, 1, k), corner(1, 1, k), u),
               v);
  };
  return mix(face(0), face(1), w);
}

/// Moments of gradient noise n over all space, measured at 2 10^7 points.
inline constexpr Real kNoiseVariance = Real(0.0729), kNoiseMeanAbs = Real(0.2202);

/// Seeds of the octaves: an odd constant apart, so that no two lattices are alike.
inline std::uint32_t octaveSeed(std::uint32_t seed, int octave) noexcept {
  return seed + std::uint32_t(octave) * 0x68e31da4u;
}

/// The share of the noise at a patch's centre that remains in the mean over the patch: the
/// correlation of gradient noise over a distance r is about exp(-2.3 r^2) (`finer` times that in
/// the exponent for shapes like |n|), of which the mean over a box of width l is about exp(-2.3 l^2
/// / 12). The patch is in lattice units. 0 where the result is negligible.
inline Real noiseKept(const PatternFootprint& patch, Real finer = 1) noexcept {
  const Real squares = lengthSquared(patch.a) + lengthSquared(patch.b);
  return squares * finer < 25 ? std::exp(Real(-2.3 / 12) * finer * squares) : Real(0);
}

/// Numbers of pieces of a and b, for pieces about as long as `step`, at most `most` in all.
struct Pieces {
  int a = 1, b = 1;
};
inline Pieces grainPieces(const PatternFootprint& patch, Real step, int most) noexcept {
  const auto wanted = [&](Vec3 v) {
    return int(std::clamp(std::ceil(length(v) / step), Real(1), Real(most)));
  };
  Pieces n{wanted(patch.a), wanted(patch.b)};
  while (n.a * n.b > most) --(n.a > n.b ? n.a : n.b);
  return n;
}

/// One octave `shape(noise)` minus its mean, averaged over a patch in lattice units by up to six
/// pieces' centres. Pieces are not faded by their own size: fading is closer at a single point, but
/// has the same bias at all points of a pixel, which more samples do not reduce. Only patches too
/// large for six points fade to the mean.
template <class Shape>
Real octaveOver(const PatternFootprint& patch, std::uint32_t seed, Real mean,
                const Shape& shape) noexcept {
  if (patch.isPoint()) return shape(gradientNoise(patch.centre, seed)) - mean;
  if (patch.isHuge()) return 0;
  constexpr Real kFrom = 10, kTo = 30;  // grains under the patch, about
  const Real grains = (1 + length(patch.a)) * (1 + length(patch.b));
  if (!(grains < kTo)) return 0;
  const Real kept = std::min((kTo - grains) / (kTo - kFrom), Real(1));
  const auto [na, nb] = grainPieces(patch, Real(0.75), 6);
  const double rest = overPieces(patch, na, nb, [&](const PatternFootprint& piece) {
    return double(shape(gradientNoise(piece.centre, seed)) - mean);
  });
  return kept * Real(rest);
}

/// A patch scaled by `scale`.
inline PatternFootprint scaled(const PatternFootprint& p, Real scale) noexcept {
  return {scale * p.centre, scale * p.a, scale * p.b};
}

/// Parameters of turbulence, with POV-Ray's names and defaults.
struct TurbulenceSettings {
  int octaves = 6;
  Real lambda = 2, omega = Real(0.5);
  std::uint32_t seed = 0;
};

/// sum omega^i noise(lambda^i p) over a patch: its smooth part, and the variance of the rest.
struct Turbulence {
  Real value = 0;               ///< at the centre
  Real alongA = 0, alongB = 0;  ///< change along the whole of a and of b
  Real lost = 0;                ///< variance of the octaves that are finer than the patch
};

inline Turbulence turbulence(const PatternFootprint& patch, const TurbulenceSettings& s) noexcept {
  Turbulence t;
  Real scale = 1, share = 1;
  const bool isPoint = patch.isPoint();
  for (int i = 0; i < s.octaves; ++i, scale *= s.lambda, share *= s.omega) {
    const PatternFootprint p = scaled(patch, scale);
    const std::uint32_t seed = octaveSeed(s.seed, i);
    const Real kept = isPoint ? Real(1) : noiseKept(p);
    t.lost += sqr(share) * kNoiseVariance * (1 - sqr(kept));
    if (kept == 0) continue;
    const auto change = [&](Vec3 v) {
      if (lengthSquared(v) == 0) return Real(0);
      return gradientNoise(p.centre + Real(0.5) * v, seed) -
             gradientNoise(p.centre - Real(0.5) * v, seed);
    };
    t.value += share * kept * gradientNoise(p.centre, seed);
    t.alongA += share * kept * change(p.a);
    t.alongB += share * kept * change(p.b);
  }
  return t;
}

/// The mean of f(piece, turbulence) over up to four pieces of a patch, within which turbulence is
/// nearly linear.
template <class Function>
double overTurbulence(const PatternFootprint& patch, const TurbulenceSettings& s,
                      const Function& f) noexcept {
  if (patch.isPoint()) return f(patch, turbulence(patch, s));
  const Pieces n = grainPieces(patch, Real(0.3), 4);
  return overPieces(patch, n.a, n.b,
                    [&](const PatternFootprint& p) { return f(p, turbulence(p, s)); });
}

}  // namespace vestige
