// SPDX-License-Identifier: Apache-2.0
// Where in and around a pixel a sample falls, drawn by the filter itself so that every sample has
// weight 1.
#pragma once
#include <array>

#include "engine/scene/scene.h"

namespace vestige {

/// An offset from the pixel's centre along one axis, and how it moves with the random number.
struct FilterOffset {
  Real offset;  ///< pixels
  Real slope;   ///< pixels per unit of random number, at most kMaxSlope
};

class PixelFilterSampler {
 public:
  explicit PixelFilterSampler(PixelFilter filter);
  FilterOffset sample(Real u) const noexcept;

  /// The tails of a filter are thin, so a number moves far there; a footprint shall not [MATH 1.1].
  static constexpr Real kMaxSlope = 2;

 private:
  static constexpr int kCells = 512;
  bool isBox_;
  std::array<Real, kCells + 1> inverse_;  ///< offset at u = i / kCells
};

}  // namespace vestige
