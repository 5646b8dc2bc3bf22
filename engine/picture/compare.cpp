// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cassert>
#include <cfloat>
#include <cmath>
#include <numeric>

#include "engine/colour/colour.h"
#include "engine/picture/compare.h"
#include "engine/picture/flip.h"
#include "engine/picture/rgb_view.h"

namespace vestige {

namespace {

constexpr double kDark = 0.01;      // added to what is divided by: black pixels count little
constexpr double kTrimmed = 0.001;  // share of pixels that are left out as the worst
constexpr int kBlock = 16;

/// R, G, B; what is not finite counts as black.
std::vector<float> finiteRgb(const Image& image) {
  std::vector<float> rgb = rgbOf(image);
  for (float& x : rgb)
    if (!std::isfinite(x)) x = 0;
  return rgb;
}

void compareErrors(const std::vector<float>& a, const std::vector<float>& b, Comparison& result) {
  std::vector<double> errors(a.size() / 3);  // relative, by pixel
  double squares = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double d = double(a[i]) - b[i];
    squares += d * d;
    errors[i / 3] += d * d / (double(b[i]) * b[i] + kDark) / 3;
  }
  const double n = double(errors.size());
  const auto mean = [&](std::size_t count) {
    return std::accumulate(errors.begin(), errors.begin() + std::ptrdiff_t(count), 0.0) /
           double(count);
  };
  result.rmse = std::sqrt(squares / (3 * n));
  result.relMse = mean(errors.size());
  const auto kept = std::max<std::size_t>(1, std::size_t(n * (1 - kTrimmed)));
  std::nth_element(errors.begin(), errors.begin() + std::ptrdiff_t(kept - 1), errors.end());
  result.relMseTrimmed = mean(kept);
}

void compareMeans(const std::vector<float>& a, const std::vector<float>& b, Comparison& result) {
  for (int c = 0; c < 3; ++c) {
    double sumA = 0, sumB = 0;
    for (std::size_t i = std::size_t(c); i < a.size(); i += 3) sumA += a[i], sumB += b[i];
    const double n = double(a.size() / 3);
    result.meanRatio[c] = sumA / n / std::max(sumB / n, double(FLT_MIN));
  }
}

/// Relative difference of one block's means.
double blockDifference(const float* a, const float* b, int width) {
  double difference = 0, reference = 0;
  for (int c = 0; c < 3; ++c) {
    double sumA = 0, sumB = 0;
    for (int y = 0; y < kBlock; ++y)
      for (int x = 0; x < kBlock; ++x) {
        const std::size_t i = (std::size_t(y) * width + x) * 3 + c;
        sumA += a[i], sumB += b[i];
      }
    difference += std::abs(sumA - sumB), reference += sumB;
  }
  const double n = 3.0 * kBlock * kBlock;
  return difference / n / (reference / n + kDark);
}

/// Blocks that the picture's right and lower edge would cut are left out.
double compareBlocks(const std::vector<float>& a, const std::vector<float>& b, int width,
                     int height) {
  double sum = 0;
  int blocks = 0;
  for (int y = 0; y + kBlock <= height; y += kBlock)
    for (int x = 0; x + kBlock <= width; x += kBlock, ++blocks) {
      const std::size_t start = (std::size_t(y) * width + x) * 3;
      sum += blockDifference(&a[start], &b[start], width);
    }
  return blocks > 0 ? sum / blocks : 0;
}

/// Linear light in [0, 1]: what a screen would show. 8-bit files come as code values.
std::vector<float> shown(const Image& image, std::vector<float> rgb) {
  const auto space = image.metadata.find("oiio:ColorSpace");
  const bool coded = space != image.metadata.end() && space->second == "sRGB";
  for (float& x : rgb) {
    x = std::clamp(x, 0.f, 1.f);
    if (coded) x = float(decodeSrgb(x));
  }
  return rgb;
}

/// Black over violet and orange to pale yellow, by the difference in [0, 1].
Image heatMap(const std::vector<float>& difference, int width, int height) {
  static constexpr double kStops[][3] = {// code values of sRGB, evenly spaced
                                         {0.00, 0.00, 0.02}, {0.23, 0.06, 0.44},
                                         {0.55, 0.16, 0.51}, {0.87, 0.29, 0.41},
                                         {0.99, 0.62, 0.43}, {0.99, 0.99, 0.75}};
  constexpr int kIntervals = int(std::size(kStops)) - 1;
  Image map;
  map.width = width, map.height = height;
  map.channels = {"R", "G", "B"};
  map.pixels.reserve(difference.size() * 3);
  for (const float d : difference) {
    const double x = std::clamp(double(d), 0.0, 1.0) * kIntervals;
    const int i = std::min(int(x), kIntervals - 1);
    for (int c = 0; c < 3; ++c)
      map.pixels.push_back(
          float(decodeSrgb(kStops[i][c] + (x - i) * (kStops[i + 1][c] - kStops[i][c]))));
  }
  return map;
}

}  // namespace

Comparison compareImages(const Image& a, const Image& reference, Image* difference) {
  assert(a.width == reference.width && a.height == reference.height);
  const std::vector<float> x = finiteRgb(a), ref = finiteRgb(reference);
  Comparison result{};
  if (x.empty()) return result;
  compareErrors(x, ref, result);
  compareMeans(x, ref, result);
  result.blockDifference = compareBlocks(x, ref, a.width, a.height);
  const std::vector<float> seen =
      flipDifference(shown(reference, ref), shown(a, x), a.width, a.height);
  result.flip = std::accumulate(seen.begin(), seen.end(), 0.0) / double(seen.size());
  if (difference) *difference = heatMap(seen, a.width, a.height);
  return result;
}

}  // namespace vestige
