// SPDX-License-Identifier: Apache-2.0
// Positions of samples in and around a pixel, drawn from the filter itself: every sample has weight
// 1.
#pragma once
#include <array>

#include "engine/scene/scene.h"

namespace vestige {

/// An offset from the pixel's centre along one axis, and its derivative by the random number.
struct FilterOffset {
  Real offset;  ///< pixels
  Real slope;   ///< pixels per unit of random number, at most kMaxSlope
};

class PixelFilterSampler {
 public:
  explicit PixelFilterSampler(PixelFilter filter);
  FilterOffset sample(Real u) const noexcept;

  /// In a filter's thin tails a small change of u moves the sample far; the footprint's slope is
  /// capped at this [MATH 1.1].
  static constexpr Real kMaxSlope = 2;

 private:
  static constexpr int kCells = 512;
  bool isBox_;
  std::array<Real, kCells + 1> inverse_;  ///< offset at u = i / kCells
};

}  // namespace vestige
