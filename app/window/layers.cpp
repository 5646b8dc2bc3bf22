// SPDX-License-Identifier: Apache-2.0
#include "app/window/layers.h"

#include <algorithm>
#include <cmath>

namespace vestige::app {
namespace {

struct Range {
  float low, high;
};

/// Of the finite values above 0, without the outermost hundredths.
Range rangeOf(std::vector<float> values) {
  std::erase_if(values, [](float x) { return !std::isfinite(x) || x <= 0; });
  if (values.empty()) return {0, 1};
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return {values[n / 100], std::max(values[n - 1 - n / 100], values[n / 100] * 1.001f)};
}

/// Blue, green, yellow, red.
void ramp(float t, float* rgb) {
  t = std::clamp(t, 0.f, 1.f);
  rgb[0] = std::clamp(1.5f - std::abs(4 * t - 3), 0.f, 1.f);
  rgb[1] = std::clamp(1.5f - std::abs(4 * t - 2), 0.f, 1.f);
  rgb[2] = std::clamp(1.5f - std::abs(4 * t - 1), 0.f, 1.f);
}

/// A colour of its own for each whole number.
void hash(float x, float* rgb) {
  auto h = std::uint32_t(std::int64_t(x)) * 2654435761u;
  h ^= h >> 15;
  for (int c = 0; c < 3; ++c) rgb[c] = 0.2f + 0.8f * float((h >> (8 * c)) & 255) / 255;
}

}  // namespace

Picture layerOf(const Film::Means& means, bool isAov) {
  const std::size_t stride = means.channels.size();
  const std::size_t count = std::size_t(means.width) * means.height;
  Picture p{means.width, means.height, std::vector<float>(count * 3)};
  const std::size_t first = isAov ? 3 : 0, channels = isAov ? stride - 3 : 3;
  const auto at = [&](std::size_t i, std::size_t c) {
    return means.pixels[i * stride + first + std::min(c, channels - 1)];
  };
  const std::string name = isAov ? means.channels[3] : "";
  const auto starts = [&](const char* word) { return name.rfind(word, 0) == 0; };
  if (channels == 1) {
    std::vector<float> values;
    for (std::size_t i = 0; i < count; ++i) values.push_back(at(i, 0));
    const Range r = rangeOf(values);
    const bool isLog = starts("footprint") || starts("gradient");
    for (std::size_t i = 0; i < count; ++i) {
      const float x = values[i];
      const float t = isLog ? std::log(std::max(x, r.low) / r.low) / std::log(r.high / r.low)
                            : (x - r.low) / (r.high - r.low);
      if (name == kElementId)
        hash(x, &p.rgb[3 * i]);
      else if (isLog || starts("element"))
        ramp(x > 0 ? t : 0, &p.rgb[3 * i]);
      else
        for (int c = 0; c < 3; ++c) p.rgb[3 * i + std::size_t(c)] = std::clamp(t, 0.f, 1.f);
    }
    return p;
  }
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      float x = at(i, c);
      if (starts("normal")) x = 0.5f + 0.5f * x;
      if (starts("position") || starts("uv")) x = c < channels ? x - std::floor(x) : 0;
      p.rgb[3 * i + c] = x;
    }
  return p;
}

Picture withElementEdges(const Film::Means& means) {
  Picture p = layerOf(means, false);
  const auto& names = means.channels;
  const auto id = std::size_t(std::find(names.begin(), names.end(), kElementId) - names.begin());
  if (id == names.size()) return p;
  const auto idAt = [&](int x, int y) {
    return means.pixels[(std::size_t(y) * means.width + x) * names.size() + id];
  };
  for (int y = 0; y + 1 < means.height; ++y)
    for (int x = 0; x + 1 < means.width; ++x)
      if (idAt(x, y) != idAt(x + 1, y) || idAt(x, y) != idAt(x, y + 1)) {
        float* c = &p.rgb[(std::size_t(y) * p.width + x) * 3];
        c[0] = 0.25f * c[0] + 0.3f, c[1] = 0.25f * c[1] + 0.15f, c[2] = 0.25f * c[2];
      }
  return p;
}

double noiseOf(const Picture& p) {
  constexpr std::size_t kMost = 20000;  // of a sparse grid: it is asked for every frame
  std::vector<float> differences;
  const std::size_t count = std::size_t(p.width) * p.height;
  const std::size_t step = std::max<std::size_t>(1, count / kMost) | 1;
  const auto luminance = [&](std::size_t i) {
    return 0.2126f * p.rgb[3 * i] + 0.7152f * p.rgb[3 * i + 1] + 0.0722f * p.rgb[3 * i + 2];
  };
  for (std::size_t i = 1; i + 1 < count; i += step) {
    const float beside = (luminance(i - 1) + luminance(i + 1)) / 2;
    const float mean = (2 * beside + luminance(i)) / 3;
    if (mean > 0) differences.push_back(std::abs(luminance(i) - beside) / mean);
  }
  if (differences.size() < 100) return 0;
  const auto middle = differences.begin() + std::ptrdiff_t(differences.size() / 2);
  std::nth_element(differences.begin(), middle, differences.end());
  // The median of |x| for a normal x is 0.6745 standard deviations; the variance here is 1.5.
  return double(*middle) / 0.6745 / std::sqrt(1.5);
}

Picture colours(const Image& image) {
  Picture p{image.width, image.height, {}};
  const std::size_t stride = image.channels.size();
  p.rgb.resize(std::size_t(image.width) * image.height * 3);
  for (std::size_t i = 0; i < std::size_t(image.width) * image.height; ++i)
    for (std::size_t c = 0; c < 3; ++c)
      p.rgb[3 * i + c] = image.pixels[i * stride + std::min(c, stride - 1)];
  return p;
}

}  // namespace vestige::app
