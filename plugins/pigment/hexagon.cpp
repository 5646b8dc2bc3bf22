// SPDX-License-Identifier: Apache-2.0
// Three colours in hexagons of side 1.
#include <vestige/plugin.h>
#include <vestige/tools/pattern_filter.h>

namespace vestige {

namespace {

constexpr double kRoot3 = 1.7320508075688772;

/// Cell of a hexagonal board: its middle is <1.5 q, sqrt(3) (r + q / 2)> in x and z.
struct Cell {
  double q, r;
  Vec2 middle() const noexcept { return {Real(1.5 * q), Real(kRoot3 * (r + q / 2))}; }
  /// 0, 1, 2: neighbours differ.
  int colour() const noexcept {
    const double d = r - q, c = d - 3 * std::floor(d / 3);
    return c > 1.5 ? 2 : c > 0.5 ? 1 : 0;  // of whatever is too far away to tell: 0
  }
};

/// The cell around a point: q, r and -q-r rounded, of which the worst gives way to the others.
Cell cellAt(double x, double z) noexcept {
  const double q = x / 1.5, r = z / kRoot3 - q / 2, s = -q - r;
  const double Q = std::round(q), R = std::round(r), S = std::round(s);
  const double dq = std::abs(Q - q), dr = std::abs(R - r), ds = std::abs(S - s);
  if (dq > dr && dq > ds) return {-R - S, R};
  return dr > ds ? Cell{Q, -Q - S} : Cell{Q, R};
}

/// A convex polygon in the parameters u, v of a patch: the unit square, cut by lines.
class Cut {
 public:
  /// Keeps where c0 + c.x u + c.y v <= 0 [Sutherland, Hodgman 1974].
  void keep(Real c0, Vec2 c) noexcept {
    Vec2 kept[kMost];
    int n = 0;
    for (int i = 0; i < count_; ++i) {
      const Vec2 p = corner_[i], q = corner_[(i + 1) % count_];
      const Real hp = c0 + dot(c, p), hq = c0 + dot(c, q);
      if (hp <= 0) kept[n++] = p;
      if ((hp <= 0) != (hq <= 0)) kept[n++] = p + hp / (hp - hq) * (q - p);
    }
    count_ = n;
    std::copy(kept, kept + n, corner_);
  }
  double area() const noexcept {
    Real twice = 0;
    for (int i = 2; i < count_; ++i)
      twice += cross(corner_[i - 1] - corner_[0], corner_[i] - corner_[0]);
    return double(twice) / 2;
  }

 private:
  static constexpr int kMost = 12;  // four corners, one more for each of six sides; rounding
  static constexpr Real kHalf = Real(0.5);
  Vec2 corner_[kMost] = {{-kHalf, -kHalf}, {kHalf, -kHalf}, {kHalf, kHalf}, {-kHalf, kHalf}};
  int count_ = 4;
};

}  // namespace

/// POV-Ray's `hexagon`: columns along y, a hexagon of side 1 around the origin with two corners on
/// the x axis. Small footprints are cut by the hexagons they meet, which is exact; large ones see
/// the first harmonics of the pattern, each faded exactly.
class Hexagon final : public Pigment {
 public:
  static Schema schema() {
    return {"pigment",
            "hexagon",
            "three colours in hexagons of side 1",
            {rgb("first", 0).place().doc("around the origin"),
             rgb("second", 0.5).place().doc("of the neighbour towards +z"),
             rgb("third", 1).place().doc("of the neighbour towards -z")}};
  }

  explicit Hexagon(const Values& v) : colours_{v.rgb(0), v.rgb(1), v.rgb(2)} {
    int n = 0;
    for (int i = -kReach; i <= kReach; ++i)
      for (int j = -kReach; j <= kReach; ++j) {
        // One of each pair k, -k; the board of one colour has periods <3, 0> and <1.5, 1.5 sqrt 3>.
        const bool isFirst = i > 0 || (i == 0 && j > 0);
        const Vec2 k{2 * kPi * Real(i) / 3, 2 * kPi * Real((2 * j - i) / (3 * kRoot3))};
        if (isFirst && i * i - i * j + j * j <= kReach * kReach) waves_[n++] = {k, strength(k)};
      }
    count_ = n;
  }

  Rgba eval(const Lookup& at) const noexcept override {
    const auto flat = [](Vec3 v) { return Vec2{v.x, v.z}; };
    const Region r{flat(at.position), flat(at.footprint.dP[0]), flat(at.footprint.dP[1])};
    const Real a = dot(r.a, r.a), b = dot(r.b, r.b);
    if (a + b == 0) return {colours_[cellAt(r.centre.x, r.centre.y).colour()], 1};
    if (!(a + b < Real(1e8)) || !std::isfinite(r.centre.x + r.centre.y)) return mean();
    return mixed(a + b < sqr(kSmall) ? cutShares(r) : waveShares(r));
  }

  Rgba mean() const noexcept override { return mixed({1.0 / 3, 1.0 / 3}); }

 private:
  struct Region {
    Vec2 centre, a, b;
  };
  struct Wave {
    Vec2 k;
    double strength;
  };
  /// How much of the first and of the second colour there is; the third is the rest.
  using Shares = std::array<double, 2>;
  static constexpr int kReach = 4, kMostWaves = 30;
  static constexpr Real kSmall = 3;  ///< units: up to here a footprint is cut

  /// Share of the wave k in the hexagons of one colour: the Fourier integral of a hexagon as a sum
  /// over its sides (Stokes), by 3 hexagons' area.
  static double strength(Vec2 k) noexcept {
    double sum = 0;
    for (int side = 0; side < 6; ++side) {
      const auto corner = [&](int n) { return Vec2{std::cos(n * kPi / 3), std::sin(n * kPi / 3)}; };
      const Vec2 from = corner(side), to = corner(side + 1), along = to - from;
      const double phase = double(dot(k, Real(0.5) * (from + to)));
      sum += double(cross(k, along)) * std::sin(phase) * sinc(double(dot(k, along)) / 2);
    }
    return sum / double(dot(k, k)) / (4.5 * kRoot3);
  }

  static double sinc(double x) noexcept { return std::abs(x) < 1e-6 ? 1.0 : std::sin(x) / x; }

  /// Exact: the footprint's square of parameters, cut by each hexagon near it.
  static Shares cutShares(const Region& r) noexcept {
    const Real reachX = Real(0.5) * (std::abs(r.a.x) + std::abs(r.b.x));
    const Real reachZ = Real(0.5) * (std::abs(r.a.y) + std::abs(r.b.y));
    const Cell at = cellAt(r.centre.x, r.centre.y);
    const Vec2 offset = r.centre - at.middle();
    const int columns = int(std::ceil((reachX + 2) / Real(1.5)));
    Shares shares = {};
    for (int q = -columns; q <= columns; ++q) {
      const int rows = int(std::ceil((reachZ + Real(kRoot3)) / Real(kRoot3)));
      const int middle = int(std::floor(-q / 2.0));
      for (int row = middle - rows; row <= middle + rows + 1; ++row) {
        const Vec2 d = offset - Cell{double(q), double(row)}.middle();
        if (std::abs(d.x) > reachX + 1 || std::abs(d.y) > reachZ + Real(kRoot3 / 2)) continue;
        const int colour = Cell{at.q + q, at.r + row}.colour();
        if (colour < 2) shares[std::size_t(colour)] += cutArea(d, r);
      }
    }
    return shares;
  }

  /// Of the footprint, the part in a hexagon whose middle lies at -d from its centre.
  static double cutArea(Vec2 d, const Region& r) noexcept {
    constexpr Real kHalfWidth = Real(kRoot3 / 2);
    const Vec2 normals[3] = {{0, 1}, {kHalfWidth, Real(0.5)}, {kHalfWidth, Real(-0.5)}};
    Cut cut;
    for (const Vec2 n : normals) {
      const Vec2 slope{dot(n, r.a), dot(n, r.b)};
      cut.keep(dot(n, d) - kHalfWidth, slope);
      cut.keep(-dot(n, d) - kHalfWidth, Real(-1) * slope);
    }
    return cut.area();
  }

  Shares waveShares(const Region& r) const noexcept {
    Shares shares = {1.0 / 3, 1.0 / 3};
    for (int i = 0; i < count_; ++i) {
      const Wave& w = waves_[i];
      const double left =
          2 * w.strength * sinc(double(dot(w.k, r.a)) / 2) * sinc(double(dot(w.k, r.b)) / 2);
      const double phase = double(dot(w.k, r.centre));
      shares[0] += left * std::cos(phase);
      shares[1] += left * std::cos(phase - double(w.k.y) * kRoot3);
    }
    return shares;
  }

  Rgba mixed(Shares s) const noexcept {
    const Real first = Real(std::clamp(s[0], 0.0, 1.0));
    const Real second = std::clamp(Real(s[1]), Real(0), 1 - first);
    return {first * colours_[0] + second * colours_[1] + (1 - first - second) * colours_[2], 1};
  }

  Rgb colours_[3];
  Wave waves_[kMostWaves];
  int count_ = 0;
};

}  // namespace vestige

VESTIGE_PLUGIN(vestige::Pigment, vestige::Hexagon)
