// SPDX-License-Identifier: Apache-2.0
// Smooth random blobs between two colours [Per02: Perlin, "Improving Noise", SIGGRAPH 2002].
#include <vestige/pigment.h>
#include <vestige/plugin.h>

#include <cstdint>

namespace vestige {

namespace {

/// A well mixed number for a lattice point: the finaliser of MurmurHash3 after three odd multiples.
std::uint32_t hash(std::int32_t x, std::int32_t y, std::int32_t z, std::uint32_t seed) noexcept {
  std::uint32_t h = seed ^ (std::uint32_t(x) * 0x9e3779b1u) ^ (std::uint32_t(y) * 0x85ebca77u) ^
                    (std::uint32_t(z) * 0xc2b2ae3du);
  h = (h ^ (h >> 16)) * 0x85ebca6bu;
  h = (h ^ (h >> 13)) * 0xc2b2ae35u;
  return h ^ (h >> 16);
}

/// d . g for one of the twelve directions to the edges of a cube [Per02].
Real slope(std::uint32_t h, Vec3 d) noexcept {
  const std::uint32_t edge = std::uint32_t((std::uint64_t(h) * 12) >> 32);
  const Real a = edge < 8 ? d.x : d.y;
  const Real b = edge < 4 ? d.y : d.z;
  return (edge & 1 ? -a : a) + (edge & 2 ? -b : b);
}

/// 6 t^5 - 15 t^4 + 10 t^3: no kink in value, slope or curvature at lattice points.
Real fade(Real t) noexcept { return t * t * t * (t * (t * 6 - 15) + 10); }
Real mix(Real a, Real b, Real t) noexcept { return a + t * (b - a); }

/// Gradient noise: 0 at lattice points, mean 0, within [-1.04, 1.04].
Real noise(Vec3 p, std::uint32_t seed) noexcept {
  // Beyond this a float has no fraction, and an int soon no room.
  if (!(maxAbsComponent(p) < Real(1e9))) return 0;
  const Vec3 low{std::floor(p.x), std::floor(p.y), std::floor(p.z)};
  const Vec3 d = p - low;
  const auto x = std::int32_t(low.x), y = std::int32_t(low.y), z = std::int32_t(low.z);
  const auto corner = [&](int i, int j, int k) {
    return slope(hash(x + i, y + j, z + k, seed), d - Vec3{Real(i), Real(j), Real(k)});
  };
  const Real u = fade(d.x), v = fade(d.y), w = fade(d.z);
  const auto face = [&](int k) {
    return mix(mix(corner(0, 0, k), corner(1, 0, k), u), mix(corner(0, 1, k), corner(1, 1, k), u),
               v);
  };
  return mix(face(0), face(1), w);
}

}  // namespace

/// t = 1/2 + 1/2 sum omega^i noise(lambda^i p) / sum omega^i, i < octaves, within [0, 1]: 0 is the
/// first colour, 1 the second. One blob is about one unit.
class Noise final : public Pigment {
 public:
  static Schema schema() {
    return {"pigment",
            "noise",
            "smooth random blobs between two colours",
            {rgb("first", 0).place().doc("where the noise is lowest"),
             rgb("second", 1).place().doc("where it is highest"),
             integer("octaves", 6).range(1, 16).doc("layers, each finer than the last"),
             real("lambda", 2).range(1, 16).doc("how much finer"),
             real("omega", 0.5).range(0, 1).doc("how much fainter"),
             integer("seed", 0).range(0, 4294967295.0).doc("another seed, other blobs")}};
  }

  explicit Noise(const Values& v)
      : first_(v.rgb(0)),
        second_(v.rgb(1)),
        octaves_(int(v.integer(2))),
        lambda_(v.real(3)),
        omega_(v.real(4)),
        seed_(std::uint32_t(v.integer(5))) {
    Real total = 0;
    for (int i = 0; i < octaves_; ++i) total += std::pow(omega_, Real(i));
    scale_ = 1 / total;
  }

  Rgba eval(const Lookup& at) const noexcept override {
    Real sum = 0, share = scale_;
    Vec3 p = at.position;
    for (int i = 0; i < octaves_; ++i, p *= lambda_, share *= omega_)
      sum += share * noise(p, seed_ + std::uint32_t(i) * 0x68e31da4u);
    const Real t = std::clamp(Real(0.5) + Real(0.5) * sum, Real(0), Real(1));
    return {first_ + t * (second_ - first_), 1};
  }

  Rgba mean() const noexcept override { return {Real(0.5) * (first_ + second_), 1}; }

 private:
  Rgb first_, second_;
  int octaves_;
  Real lambda_, omega_, scale_;
  std::uint32_t seed_;
};

}  // namespace vestige

VESTIGE_PLUGIN(vestige::Pigment, vestige::Noise)
