// SPDX-License-Identifier: Apache-2.0
// The perceived difference when flipping between two pictures, private to engine/picture.
#pragma once
#include <vector>

namespace vestige {

/// LDR-FLIP [And20: Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom, Fairchild, "FLIP: A
/// Difference Evaluator for Alternating Images", HPG 2020]. Both pictures linear Rec. 709 in
/// [0, 1], [height][width][3], seen from 0.7 m on a screen 0.7 m and 3840 pixels wide. Returns
/// [height][width], 0 the same to 1 as different as can be.
std::vector<float> flipDifference(const std::vector<float>& reference,
                                  const std::vector<float>& test, int width, int height);

}  // namespace vestige
