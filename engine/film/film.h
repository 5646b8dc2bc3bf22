// SPDX-License-Identifier: Apache-2.0
// Where samples are summed: integers, so that the picture is the same in whatever order they come.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <vestige/integrator.h>

namespace vestige {

/// Pixels [x0, x1) x [y0, y1) of a film.
struct Crop {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

enum class Aov {
  normal,
  albedo,
  depth,
  position,
  uv,
  samples,
  footprint,
  footprintTexels,
  gradient,
  elementLevel,
  elementId
};
inline constexpr int kAovs = int(Aov::elementId) + 1;
/// "normal", "footprint.texels", ...
const char* name(Aov aov) noexcept;

/// One unit of the sums: 2^-28; each sample is clamped to +-2^24 first.
inline constexpr double kFilmUnit = 0x1p-28;
inline constexpr double kFilmLimit = 0x1p24;

/// Sums of radiance and of the wanted AOVs, int64 a channel. One thread a pixel at a time;
/// different pixels may be added to at once.
class Film {
 public:
  Film(int width, int height, Crop crop, std::vector<Aov> aovs);

  int width() const noexcept { return width_; }
  int height() const noexcept { return height_; }
  Crop crop() const noexcept { return crop_; }
  const std::vector<Aov>& aovs() const noexcept { return aovs_; }
  /// Whether one of them is about footprints, which paths otherwise carry for textures only.
  bool wantsFootprint() const noexcept;

  /// Adds one sample of weight 1. What is not finite is left out as black and counted, what is too
  /// large is clamped and counted.
  void add(int x, int y, Rgb radiance, const Aovs& aovs, Counters& counters) noexcept;

  /// Samples that the pixel holds.
  std::uint32_t samples(int x, int y) const noexcept;
  /// Fewest samples of any pixel.
  std::uint32_t minSamples() const noexcept;
  /// Most samples of any pixel, and their mean over the pixels.
  std::uint32_t maxSamples() const noexcept;
  double meanSamples() const noexcept;
  /// Luminance of the pixel's mean; 0 where no sample is.
  double luminance(int x, int y) const noexcept;

  /// Means so far: R, G, B, then the AOVs' channels ("normal.X", "depth.Z", "uv.U", ...). Size of
  /// the crop window; black where no sample is.
  struct Means {
    int width, height;
    std::vector<std::string> channels;
    std::vector<float> pixels;
  };
  Means means() const;

  /// All that it holds, row by row: a sum for each channel of each pixel, samples of each pixel.
  std::span<const std::int64_t> sums() const noexcept { return sums_; }
  std::span<const std::uint32_t> counts() const noexcept { return counts_; }
  std::span<std::int64_t> sums() noexcept { return sums_; }
  std::span<std::uint32_t> counts() noexcept { return counts_; }

 private:
  std::size_t index(int x, int y) const noexcept;

  int width_, height_;
  Crop crop_;
  std::vector<Aov> aovs_;
  int channels_;
  std::vector<std::int64_t> sums_;
  std::vector<std::uint32_t> counts_;
};

/// Its radiance alone.
Film withoutAovs(const Film& film);

}  // namespace vestige
