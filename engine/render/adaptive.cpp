// SPDX-License-Identifier: Apache-2.0
#include "engine/render/adaptive.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>

namespace vestige {

Adaptive::Adaptive(const Film& film, double noise)
    : crop_(film.crop()),
      target_(noise * noise),
      blocksX_((crop_.x1 - crop_.x0 + kBlock - 1) / kBlock),
      blocksY_((crop_.y1 - crop_.y0 + kBlock - 1) / kBlock),
      blocks_(std::size_t(blocksX_) * std::size_t(blocksY_)),
      pixels_(std::int64_t(crop_.x1 - crop_.x0) * (crop_.y1 - crop_.y0)) {
  luminance_.assign(std::size_t(pixels_), 0);
  for (int y = crop_.y0; y < crop_.y1; ++y)
    for (int x = crop_.x0; x < crop_.x1; ++x) ++blocks_[block(x, y)].pixels;
}

std::size_t Adaptive::block(int x, int y) const noexcept {
  return std::size_t((y - crop_.y0) / kBlock * blocksX_ + (x - crop_.x0) / kBlock);
}

void Adaptive::judge(const Film& film, int samples) {
  const double scale = double(samples_) / (samples - samples_);
  const bool canDecide = samples_ > 0 && samples >= kLeastSamples;
  measure(film, scale);
  taken_ += double(pixels_ - pixelsDone_) * (samples - samples_);
  samples_ = samples;
  if (!canDecide) return;
  for (int by = 0; by < blocksY_; ++by)
    for (int bx = 0; bx < blocksX_; ++bx)
      blocks_[std::size_t(by * blocksX_ + bx)].excess = excess(bx, by);
  for (Block& b : blocks_) {
    if (b.done || b.excess > 1) continue;
    b.done = true;
    pixelsDone_ += b.pixels;
    // It will not change any more: neighbours shall not wait for it.
    b.error = std::min(b.error, b.pixels * target_);
  }
}

/// Errors of the blocks under way, from means then and now.
void Adaptive::measure(const Film& film, double scale) {
  std::vector<double> now(luminance_.size());
  std::size_t pixel = 0;
  for (int y = crop_.y0; y < crop_.y1; ++y)
    for (int x = crop_.x0; x < crop_.x1; ++x) now[pixel++] = film.luminance(x, y);
  const double mean = std::accumulate(now.begin(), now.end(), 0.0) / double(pixels_);
  const double least = std::max(kFloor * mean, std::numeric_limits<double>::min());
  for (Block& b : blocks_)
    if (!b.done) b.error = 0;
  pixel = 0;
  for (int y = crop_.y0; y < crop_.y1; ++y)
    for (int x = crop_.x0; x < crop_.x1; ++x, ++pixel) {
      Block& b = blocks_[block(x, y)];
      const double change = (now[pixel] - luminance_[pixel]) / std::max(now[pixel], least);
      if (!b.done) b.error += change * change * scale;
    }
  luminance_ = std::move(now);
}

/// The rule: the mean over the block and its neighbours is below the target, and none of them is
/// far above it. As a multiple of the squared error allowed, hence of the samples taken.
double Adaptive::excess(int bx, int by) const noexcept {
  double sum = 0, worst = 0;
  int pixels = 0;
  for (int y = std::max(by - 1, 0); y <= std::min(by + 1, blocksY_ - 1); ++y)
    for (int x = std::max(bx - 1, 0); x <= std::min(bx + 1, blocksX_ - 1); ++x) {
      const Block& b = blocks_[std::size_t(y * blocksX_ + x)];
      sum += b.error, pixels += b.pixels;
      worst = std::max(worst, b.error / b.pixels);
    }
  return std::max(sum / pixels, worst / (kFar * kFar)) / target_;
}

double Adaptive::share(double samples, int most) const noexcept {
  if (samples_ < kLeastSamples) return 0;
  double whole = taken_;
  for (const Block& b : blocks_) {
    if (b.done) continue;
    const auto wanted = std::uint64_t(std::min(b.excess * samples_, double(most)));
    const double last = std::min(double(std::bit_ceil(wanted + 1)), double(most));
    whole += b.pixels * std::max(0.0, last - samples_);
  }
  const double taken = taken_ + double(pixels_ - pixelsDone_) * (samples - samples_);
  return std::min(1.0, taken / whole);
}

}  // namespace vestige
