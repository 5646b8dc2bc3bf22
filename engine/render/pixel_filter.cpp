// SPDX-License-Identifier: Apache-2.0
#include "engine/render/pixel_filter.h"

namespace vestige {
namespace {

constexpr double kRadius = 1.5;  ///< pixels
constexpr double kSigma = 0.5;   ///< of the Gaussian, pixels
constexpr double kTwoPi = 6.283185307179586;

/// Density of the filter, not normalised; x in [-kRadius, kRadius].
double weight(PixelFilter filter, double x) {
  if (filter == PixelFilter::gaussian) return std::exp(-x * x / (2 * kSigma * kSigma));
  // Four-term Blackman-Harris window [Harris 1978, 92 dB].
  const double t = kTwoPi * (x / (2 * kRadius) + 0.5);
  return 0.35875 - 0.48829 * std::cos(t) + 0.14128 * std::cos(2 * t) - 0.01168 * std::cos(3 * t);
}

}  // namespace

PixelFilterSampler::PixelFilterSampler(PixelFilter filter) : isBox_(filter == PixelFilter::box) {
  if (isBox_) return;
  // Integrates in fine steps and inverts: the offset at which the integral reaches i / kCells.
  constexpr int kSteps = 1 << 16;
  const double h = 2 * kRadius / kSteps;
  double total = 0;
  for (int i = 0; i < kSteps; ++i) total += weight(filter, -kRadius + (i + 0.5) * h);
  double sum = 0;
  int cell = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double w = weight(filter, -kRadius + (i + 0.5) * h);
    while (cell <= kCells && sum + w >= total * cell / kCells - 1e-12 * total) {
      const double part = w > 0 ? (total * cell / kCells - sum) / w : 0;
      inverse_[std::size_t(cell++)] = Real(-kRadius + (i + std::clamp(part, 0.0, 1.0)) * h);
    }
    sum += w;
  }
  while (cell <= kCells) inverse_[std::size_t(cell++)] = Real(kRadius);
}

FilterOffset PixelFilterSampler::sample(Real u) const noexcept {
  if (isBox_) return {u - Real(0.5), 1};
  const Real x = u * kCells;
  const int i = std::min(int(x), kCells - 1);
  const Real a = inverse_[std::size_t(i)], b = inverse_[std::size_t(i) + 1];
  return {a + (x - Real(i)) * (b - a), std::min((b - a) * kCells, kMaxSlope)};
}

}  // namespace vestige
