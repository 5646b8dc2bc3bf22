// SPDX-License-Identifier: Apache-2.0
// Which pixels need more samples. A pixel's error is estimated from the change of its mean while
// its samples double.
#pragma once
#include <vestige/table.h>

#include <cstdint>
#include <vector>

#include "engine/film/film.h"

namespace vestige {

/// Decides for blocks of pixels, after passes that double the samples, whether they need more.
///
/// Let M(m) be a pixel's mean luminance after m samples. For independent samples
///     E[(M(n) - M(m))^2] = (1/m - 1/n) s^2, so (M(n) - M(m))^2 m / (n - m) estimates s^2 / n,
/// the squared standard error: for n = 2m the half-difference of two halves. One pixel's estimate
/// is unreliable. Averaged over 576 pixels (nine blocks) it is reliable, and almost independent of
/// any single pixel.
/// docs/adaptive.md has measurements and limits.
class Adaptive {
 public:
  /// Either may be 0.
  struct Goal {
    double noise = 0;    ///< standard error over luminance, in every block
    double samples = 0;  ///< a pixel, on average, shared out to minimise the mean of (standard
                         ///< error / luminance)^2 over the picture
  };
  /// Keeps one number for each pixel of the film.
  Adaptive(const Film& film, Goal goal);

  /// Whether the pixel needs more samples. [any thread; not during judge()]
  bool wants(int x, int y) const noexcept { return !blocks_[block(x, y)].done; }

  /// Decides from the film once all pixels that want samples hold `samples` of them. A block that
  /// is done stays done. [main thread]
  void judge(const Film& film, int samples);

  bool isDone() const noexcept { return pixelsDone_ == pixels_; }
  /// Share of the pixels that are done, [0,1]: they reached the wanted noise, or their samples.
  double quiet() const noexcept { return double(pixelsDone_) / double(pixels_); }
  /// Share of all work that is done when open pixels hold `samples`, [0,1]; 0 before the first
  /// decision. Assumes that errors fall with the square root of the samples, and that no pixel
  /// takes more than `most`.
  double share(double samples, int most) const noexcept;

  static constexpr int kBlock = 8;          ///< pixels, width and height
  static constexpr int kLeastSamples = 16;  ///< a pixel, before the first decision about noise
  /// Least luminance that an error is divided by, as a share of the picture's mean.
  static constexpr double kFloor = 0.05;
  /// A block stays open while a neighbour's own error is above this many times the wanted noise.
  static constexpr double kFar = 1.5;

 private:
  struct Block {
    double error = 0;   ///< sum over its pixels of (standard error / luminance)^2
    int samples = 0;    ///< that a pixel held when `error` was measured
    double excess = 0;  ///< samples needed over samples taken; <= 1: done
    int pixels = 0;
    bool done = false;
  };
  int block(int x, int y) const noexcept;
  /// Calls `visit(neighbour)` for a block and the up to eight around it.
  template <class Visit>
  void forNeighbours(int block, const Visit& visit) const;
  void measure(const Film& film, double scale);
  void closeQuiet();
  double excess(int block) const noexcept;
  void closePaid();
  double deviation(int block) const noexcept;
  void close(Block& b) noexcept;

  Crop crop_;
  double target_;  ///< noise^2
  double budget_;  ///< samples of the whole picture; 0: by noise
  int least_;      ///< samples a pixel, before the first decision
  int blocksX_, blocksY_;
  Table<Block> blocks_;
  std::vector<double> luminance_;  ///< means when last judged
  int samples_ = 0;                ///< a pixel, when last judged
  double taken_ = 0;               ///< samples of the whole picture, when last judged
  std::int64_t pixels_, pixelsDone_ = 0;
};

}  // namespace vestige
