// SPDX-License-Identifier: Apache-2.0
// R, G and B out of a picture with any channels, private to engine/picture.
#pragma once
#include <vector>

#include "engine/picture/image.h"

namespace vestige {

/// [height][width][3]: the channels of those names, else the first three, else the first as grey.
std::vector<float> rgbOf(const Image& image);

}  // namespace vestige
