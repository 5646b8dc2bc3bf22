// SPDX-License-Identifier: Apache-2.0
// Bands across z, stirred by turbulence of their own.
#include <vestige/plugin.h>
#include <vestige/tools/pattern_noise.h>

namespace vestige {

/// POV-Ray's `agate`: t = (1/2 + 1/2 sin(2 pi phi))^0.77, phi = 1.1 z + 1.3 agate_turb T(p), with T
/// six octaves of turbulence. Over a footprint the wave's first harmonics are faded each by itself.
class Agate final : public Pigment {
 public:
  static Schema schema() {
    return {"pigment",
            "agate",
            "bands across z, stirred by turbulence of their own",
            {rgb("first", 0).place().doc("in the valleys of the bands"),
             rgb("second", 1).place().doc("on their tops"),
             real("agate_turb", 1).doc("how strongly they are stirred"),
             integer("seed", 0).range(0, 4294967295.0).doc("another seed, another stone")}};
  }

  explicit Agate(const Values& v)
      : first_(v.rgb(0)), second_(v.rgb(1)), strength_(Real(1.3) * v.real(2)) {
    noise_.seed = std::uint32_t(v.integer(3));
    // Even around phi = 1/4, so cosines from there say all; the sum is exact but for rounding.
    constexpr int kPlaces = 4096;
    for (int i = 0; i < kPlaces; ++i)
      for (int k = 0; k <= kHarmonics; ++k) {
        const double x = (i + 0.5) / kPlaces;
        harmonic_[k] += (k ? 2 : 1) * wave(x + 0.25) * std::cos(kTurn * k * x) / kPlaces;
      }
  }

  Rgba eval(const Lookup& at) const noexcept override {
    const PatternFootprint patch(at);
    if (patch.isHuge()) return mean();
    return mixed(
        overTurbulence(patch, noise_, [&](const PatternFootprint& p, const Turbulence& stir) {
          const double phi = 1.1 * double(p.centre.z) + double(strength_ * stir.value);
          const Widths widths{1.1 * double(p.a.z) + double(strength_ * stir.alongA),
                              1.1 * double(p.b.z) + double(strength_ * stir.alongB)};
          const double lost = double(sqr(strength_) * stir.lost);
          return widths.isPoint() && lost == 0 ? wave(phi) : faded(phi, widths, lost);
        }));
  }

  Rgba mean() const noexcept override { return mixed(harmonic_[0]); }

 private:
  static constexpr int kHarmonics = 4;
  static constexpr double kTurn = 2 * double(kPi);

  static double wave(double phi) noexcept {
    return std::pow(0.5 + 0.5 * std::sin(kTurn * fraction(phi)), 0.77);
  }

  /// What both boxes and a normal blur leave of harmonic k.
  static double kept(int k, Widths w, double variance) noexcept {
    const auto sinc = [](double x) { return std::abs(x) < 1e-6 ? 1.0 : std::sin(x) / x; };
    const double half = kTurn * k / 2;
    return sinc(half * w.a) * sinc(half * w.b) * std::exp(-kTurn * k * kTurn * k * variance / 2);
  }

  /// What lies above the last harmonic fades together with the next.
  double faded(double phi, Widths widths, double variance) const noexcept {
    const double rest = kept(kHarmonics + 1, widths, variance);
    double sum = harmonic_[0] + rest * (wave(phi) - harmonic_[0]);
    for (int k = 1; k <= kHarmonics; ++k)
      sum += (kept(k, widths, variance) - rest) * harmonic_[k] *
             std::cos(kTurn * k * (fraction(phi) - 0.25));
    return std::clamp(sum, 0.0, 1.0);
  }

  Rgba mixed(double t) const noexcept { return {first_ + Real(t) * (second_ - first_), 1}; }

  Rgb first_, second_;
  Real strength_;
  TurbulenceSettings noise_;
  double harmonic_[kHarmonics + 1] = {};  ///< cosines of phi - 1/4
};

}  // namespace vestige

VESTIGE_PLUGIN(vestige::Pigment, vestige::Agate)
