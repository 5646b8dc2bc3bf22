// SPDX-License-Identifier: Apache-2.0
#include "engine/picture/rgb_view.h"

#include <algorithm>
#include <array>

namespace vestige {

namespace {

std::array<std::size_t, 3> rgbChannels(const std::vector<std::string>& names) {
  const auto find = [&](const char* name) {
    return std::size_t(std::find(names.begin(), names.end(), name) - names.begin());
  };
  const std::array<std::size_t, 3> rgb = {find("R"), find("G"), find("B")};
  if (*std::max_element(rgb.begin(), rgb.end()) < names.size()) return rgb;
  if (names.size() >= 3) return {0, 1, 2};
  return {0, 0, 0};
}

}  // namespace

std::vector<float> rgbOf(const Image& image) {
  const auto rgb = rgbChannels(image.channels);
  const std::size_t pixels = std::size_t(image.width) * image.height, n = image.channels.size();
  std::vector<float> result(pixels * 3);
  for (std::size_t i = 0; i < pixels; ++i)
    for (std::size_t c = 0; c < 3; ++c) result[3 * i + c] = image.pixels[i * n + rgb[c]];
  return result;
}

}  // namespace vestige
