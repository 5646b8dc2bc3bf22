// SPDX-License-Identifier: Apache-2.0
// The difference of two pictures, by error measures and by perception.
#pragma once
#include "engine/picture/image.h"

namespace vestige {

/// How two pictures differ.
struct Comparison {
  double rmse;             ///< over pixels and channels R, G, B
  double relMse;           ///< mean of (a-b)^2 / (b^2 + 0.01), b the reference
  double relMseTrimmed;    ///< the same without the worst 0.1 % of pixels
  double meanRatio[3];     ///< mean of a / mean of b
  double blockDifference;  ///< mean of |a - b| / (b + 0.01) over 16 x 16 block means
  double flip;             ///< mean of the perceptual difference picture, [0, 1]
};
/// Pictures of the same size only; `difference`, if not null, receives the difference picture.
Comparison compareImages(const Image& a, const Image& reference, Image* difference);

}  // namespace vestige
