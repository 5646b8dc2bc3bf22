// SPDX-License-Identifier: Apache-2.0
// Procedural patterns averaged over a footprint, in closed form along one axis.
//
// A footprint is the parallelogram p + u a + v b with u, v uniform in [-1/2, 1/2]. Along a
// coordinate that is linear in p it is the convolution of two boxes of widths |da| and |db|: a
// trapezium. A wave with known first and second integral has an exact average over it. A product of
// waves along several axes is exact if the axes are independent over the footprint; cutting the
// footprint into pieces makes them nearly independent.
#pragma once
#include <vestige/pigment.h>

namespace vestige {

/// Full widths of the two boxes along one coordinate, in periods of the wave; their signs are
/// irrelevant. Double: second differences of integrals divide by the product of both.
struct Widths {
  double a = 0, b = 0;

  bool isPoint() const noexcept { return a == 0 && b == 0; }
  /// Whether the widths exceed a million periods, or are NaN: the average is the wave's mean.
  bool isHuge() const noexcept { return !(std::abs(a) + std::abs(b) < 1e6); }
  /// The widths after a blur of this variance. Each box, of variance w^2 / 12, gets half of it.
  Widths blurred(double variance) const noexcept {
    if (variance == 0) return *this;
    return {std::sqrt(a * a + 6 * variance), std::sqrt(b * b + 6 * variance)};
  }
};

/// The fractional part, in [0, 1]; 0 for infinity and NaN.
inline double fraction(double x) noexcept {
  const double part = x - std::floor(x);
  return part >= 0 ? part : 0;
}

/// Waves of period 1, by value, mean over a period, and the first and second integral of what is
/// left without the mean. Integrals have period 1, which fixes the first; the second's constant
/// does not matter.
///
/// 1 where the fraction is below `duty`, else 0. The duty is within (0, 1).
struct PulseWave {
  double duty = 0.5;

  double mean() const noexcept { return duty; }
  double value(double t) const noexcept { return fraction(t) < duty ? 1 : 0; }
  double first(double t) const noexcept {
    const double x = fraction(t);
    return std::min(x, duty) - duty * x - duty * (1 - duty) / 2;
  }
  double second(double t) const noexcept {
    const double x = fraction(t), y = 1 - x;
    return x < duty ? (1 - duty) * x * (x - duty) / 2 : -duty * y * (y - (1 - duty)) / 2;
  }
};

/// Sawtooth: from 0 up to 1, then down at once.
struct SawWave {
  double mean() const noexcept { return 0.5; }
  double value(double t) const noexcept { return fraction(t); }
  double first(double t) const noexcept {
    const double x = fraction(t);
    return x * (x - 1) / 2 + 1.0 / 12;
  }
  double second(double t) const noexcept {
    const double x = fraction(t);
    return x * (x * (x / 6 - 0.25) + 1.0 / 12);
  }
};

/// Triangle: from 0 to 1 at t = 1/2 and back.
struct TriangleWave {
  double mean() const noexcept { return 0.5; }
  double value(double t) const noexcept { return 1 - std::abs(2 * fraction(t) - 1); }
  double first(double t) const noexcept {
    const double x = fraction(t), y = std::min(x, 1 - x);
    return x < 0.5 ? y * (y - 0.5) : -y * (y - 0.5);
  }
  double second(double t) const noexcept {
    const double x = fraction(t), y = std::min(x, 1 - x);
    return y * y * (y / 3 - 0.25);
  }
};

/// The mean of a wave over both boxes around t, within [0, 1]. The value at t if both widths are 0,
/// the wave's mean if they are huge.
template <class Wave>
double filtered(const Wave& wave, double t, Widths widths) noexcept {
  if (widths.isHuge()) return wave.mean();
  const double w = std::max(std::abs(widths.a), std::abs(widths.b));
  const double s = std::min(std::abs(widths.a), std::abs(widths.b));
  double rest = 0;
  if (w < 1e-9) return wave.value(t);
  if (s < 1e-3 * w || w < 1e-4) {  // one box of the same variance: rounding would drown the other
    const double box = std::sqrt(w * w + s * s);
    rest = (wave.first(t + box / 2) - wave.first(t - box / 2)) / box;
  } else {
    const double outer = (w + s) / 2, inner = (w - s) / 2;
    rest = (wave.second(t + outer) - wave.second(t + inner) - wave.second(t - inner) +
            wave.second(t - outer)) /
           (w * s);
  }
  const double mean = wave.mean() + rest;
  return std::clamp(mean, 0.0, 1.0);
}

/// A footprint in a pattern's own units: the parallelogram centre + u a + v b, u and v in
/// [-1/2, 1/2].
struct PatternFootprint {
  Vec3 centre, a, b;

  explicit PatternFootprint(const Lookup& at) noexcept
      : centre(at.position), a(at.footprint.dP[0]), b(at.footprint.dP[1]) {}
  PatternFootprint(Vec3 c, Vec3 da, Vec3 db) noexcept : centre(c), a(da), b(db) {}

  bool isPoint() const noexcept { return lengthSquared(a) + lengthSquared(b) == 0; }
  bool isHuge() const noexcept { return !(maxAbsComponent(a) < 1e6 && maxAbsComponent(b) < 1e6); }
  /// Along one axis, for a wave of that many units a period and that phase.
  Widths along(int axis, Real period) const noexcept {
    return {double(a[axis]) / double(period), double(b[axis]) / double(period)};
  }
};

/// The mean of f(piece) over na x nb equal pieces of a patch.
template <class Function>
double overPieces(const PatternFootprint& patch, int na, int nb, const Function& f) noexcept {
  const Vec3 a = patch.a / Real(na), b = patch.b / Real(nb);
  double sum = 0;
  for (int i = 0; i < na; ++i)
    for (int j = 0; j < nb; ++j) {
      const Real u = (i + Real(0.5)) - Real(0.5) * Real(na);
      const Real v = (j + Real(0.5)) - Real(0.5) * Real(nb);
      sum += f(PatternFootprint{patch.centre + u * a + v * b, a, b});
    }
  return sum / (na * nb);
}

/// How many pieces a vector is cut into, so that no piece changes along two axes at once by more
/// than about `step`. The second largest component decides, so a vector along an axis stays whole.
inline int slantPieces(Vec3 v, Real step, int most) noexcept {
  const Real x = std::abs(v.x), y = std::abs(v.y), z = std::abs(v.z);
  const Real second = std::max(std::min(x, y), std::min(std::max(x, y), z));
  return int(std::clamp(std::ceil(second / step), Real(1), Real(most)));
}

/// The mean of a product of waves along the axes over a patch, with cells of this size. `f(piece)`
/// must be exact for vectors along one axis. The shorter vector is cut into up to 3 pieces, the
/// longer until there are 16; beyond, the correlation between axes is lost and the pattern fades
/// early.
template <class Function>
double overSlant(const PatternFootprint& patch, Vec3 cell, const Function& f) noexcept {
  const auto inCells = [&](Vec3 v) { return Vec3{v.x / cell.x, v.y / cell.y, v.z / cell.z}; };
  const Vec3 a = inCells(patch.a), b = inCells(patch.b);
  const bool aIsLonger = lengthSquared(a) >= lengthSquared(b);
  constexpr Real kStep = Real(0.5);
  const int across = slantPieces(aIsLonger ? b : a, kStep, 3);
  const int along = slantPieces(aIsLonger ? a : b, kStep, 16 / across);
  return aIsLonger ? overPieces(patch, along, across, f) : overPieces(patch, across, along, f);
}

}  // namespace vestige
