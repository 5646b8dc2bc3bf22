// SPDX-License-Identifier: Apache-2.0
#include "engine/render/adaptive.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

namespace vestige {
namespace {

/// Steps of the bisection that meets the budget to a few samples.
constexpr int kHalvings = 40;

}  // namespace

Adaptive::Adaptive(const Film& film, Goal goal)
    : crop_(film.crop()),
      target_(goal.noise * goal.noise),
      blocksX_((crop_.x1 - crop_.x0 + kBlock - 1) / kBlock),
      blocksY_((crop_.y1 - crop_.y0 + kBlock - 1) / kBlock),
      blocks_(blocksX_ * blocksY_),
      pixels_(std::int64_t(crop_.x1 - crop_.x0) * (crop_.y1 - crop_.y0)) {
  budget_ = goal.samples * double(pixels_);
  // A quarter of the samples finds out where the others belong.
  least_ = budget_ > 0 ? std::clamp(int(goal.samples / 4), 2, kLeastSamples) : kLeastSamples;
  luminance_.assign(std::size_t(pixels_), 0);
  for (int y = crop_.y0; y < crop_.y1; ++y)
    for (int x = crop_.x0; x < crop_.x1; ++x) ++blocks_[block(x, y)].pixels;
}

int Adaptive::block(int x, int y) const noexcept {
  return (y - crop_.y0) / kBlock * blocksX_ + (x - crop_.x0) / kBlock;
}

void Adaptive::judge(const Film& film, int samples) {
  const double scale = double(samples_) / (samples - samples_);
  const bool canDecide = samples_ > 0 && samples >= least_;
  taken_ += double(pixels_ - pixelsDone_) * (samples - samples_);
  samples_ = samples;
  measure(film, scale);
  if (!canDecide) return;
  if (budget_ > 0)
    closePaid();
  else
    closeQuiet();
}

void Adaptive::close(Block& b) noexcept {
  b.done = true;
  pixelsDone_ += b.pixels;
}

/// Errors of the open blocks, from the means at the last decision and now.
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
      if (b.done) continue;
      b.error += change * change * scale;
      b.samples = samples_;
    }
  luminance_ = std::move(now);
}

template <class Visit>
void Adaptive::forNeighbours(int block, const Visit& visit) const {
  const int bx = block % blocksX_, by = block / blocksX_;
  for (int y = std::max(by - 1, 0); y <= std::min(by + 1, blocksY_ - 1); ++y)
    for (int x = std::max(bx - 1, 0); x <= std::min(bx + 1, blocksX_ - 1); ++x)
      visit(blocks_[y * blocksX_ + x]);
}

void Adaptive::closeQuiet() {
  for (int i = 0; i < blocks_.size(); ++i) blocks_[i].excess = excess(i);
  for (Block& b : blocks_) {
    if (b.done || b.excess > 1) continue;
    close(b);
    // Its error will not change any more, so neighbours must not wait for it.
    b.error = std::min(b.error, b.pixels * target_);
  }
}

/// A block is done when the mean over it and its neighbours is below the target and none of them is
/// far above it. Returns the squared error over the allowed one, hence samples needed over taken.
double Adaptive::excess(int block) const noexcept {
  double sum = 0, worst = 0;
  int pixels = 0;
  forNeighbours(block, [&](const Block& b) {
    sum += b.error;
    pixels += b.pixels;
    worst = std::max(worst, b.error / b.pixels);
  });
  return std::max(sum / pixels, worst / (kFar * kFar)) / target_;
}

/// The sum of s^2 / n is least for n proportional to s. Finds the largest factor that the budget
/// pays for, and closes the blocks whose samples would not double.
void Adaptive::closePaid() {
  Table<double> deviations(blocks_.size());
  double largest = 0;
  for (int i = 0; i < blocks_.size(); ++i)
    if (!blocks_[i].done) largest = std::max(largest, deviations[i] = deviation(i));
  const auto doublings = [&](int i, double rate) {
    return std::max(0.0, std::round(std::log2(rate * deviations[i] / samples_)));
  };
  const auto isTooDear = [&](double rate) {
    double cost = taken_;
    for (int i = 0; i < blocks_.size(); ++i)
      if (!blocks_[i].done && deviations[i] > 0)
        cost += blocks_[i].pixels * samples_ * (std::exp2(doublings(i, rate)) - 1);
    return cost > budget_;
  };
  double paid = 0;
  if (largest > 0 && std::isfinite(largest)) {
    double dear = samples_ / largest;
    while (!isTooDear(dear)) {
      paid = dear;
      dear *= 2;
    }
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = (paid + dear) / 2;
      (isTooDear(middle) ? dear : paid) = middle;
    }
  }
  for (int i = 0; i < blocks_.size(); ++i)
    if (!blocks_[i].done && !(doublings(i, paid) > 0)) close(blocks_[i]);
}

/// Standard deviation of one sample of a pixel over luminance, from the block and its neighbours.
double Adaptive::deviation(int block) const noexcept {
  double sum = 0;
  int pixels = 0;
  forNeighbours(block, [&](const Block& b) {
    sum += b.error * b.samples;
    pixels += b.pixels;
  });
  return std::sqrt(sum / pixels);
}

double Adaptive::share(double samples, int most) const noexcept {
  if (budget_ > 0)
    return std::min(1.0, (taken_ + double(pixels_ - pixelsDone_) * (samples - samples_)) / budget_);
  if (samples_ < least_) return 0;
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
