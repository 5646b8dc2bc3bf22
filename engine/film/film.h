// SPDX-License-Identifier: Apache-2.0
// Where samples are summed: integers, so that the picture is the same in whatever order they come.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <vestige/integrator.h>

#include "engine/film/aov.h"

namespace vestige {

/// Pixels [x0, x1) x [y0, y1) of a film.
struct Crop {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  bool operator==(const Crop&) const = default;
};

__extension__ typedef __int128 Int128;

/// The unit of the sums of radiance: a sample of 1e-12 keeps 20 bits. The limit of a sample is
/// 1e15; a sum holds 2^17 samples at the limit, or 10^8 of 1e12.
inline constexpr int kRadianceBits = 60;
inline constexpr double kRadianceUnit = 0x1p-60;
inline constexpr double kRadianceLimit = 0x1p50;

/// Sums of radiance, 16 bytes a channel, and of the wanted AOVs, 8 bytes a channel. One thread adds
/// to a pixel at a time; different pixels may be added to at once.
class Film {
 public:
  /// `sceneSize` as in layerOf().
  Film(int width, int height, Crop crop, std::vector<Aov> aovs, double sceneSize = 1);

  int width() const noexcept { return width_; }
  int height() const noexcept { return height_; }
  Crop crop() const noexcept { return crop_; }
  const std::vector<Aov>& aovs() const noexcept { return aovs_; }
  const std::vector<FilmLayer>& layers() const noexcept { return layers_; }
  /// Whether one of them is about footprints, which paths otherwise carry for textures only.
  bool wantsFootprint() const noexcept;

  /// Adds one sample of weight 1. Radiance that is not finite is left out as black and counted;
  /// radiance beyond the limit is clamped and counted. Of AOVs, cuts() counts both.
  void add(int x, int y, Rgb radiance, const Aovs& aovs, Counters& counters) noexcept;
  /// Adds all samples of another film of the same size, crop window, AOVs and units: to the bit
  /// what one film with all the samples holds. Throws std::runtime_error with a sentence for the
  /// user if the films differ. Sums that do not fit are clamped and counted as in add().
  void merge(const Film& other, Counters& counters);

  /// Samples that the pixel holds.
  std::uint32_t samples(int x, int y) const noexcept;
  /// Fewest samples of any pixel.
  std::uint32_t minSamples() const noexcept;
  /// Most samples of any pixel, and their mean over the pixels.
  std::uint32_t maxSamples() const noexcept;
  double meanSamples() const noexcept;
  /// Luminance of the pixel's mean; 0 where no sample is.
  double luminance(int x, int y) const noexcept;
  /// Samples of each layer whose values were not finite or too large.
  std::span<const std::uint64_t> cuts() const noexcept { return cuts_; }

  /// Means so far: R, G, B, then the AOVs' channels ("normal.X", "depth.Z", "uv.U", ...). Size of
  /// the crop window; black where no sample is.
  struct Means {
    int width, height;
    std::vector<std::string> channels;
    std::vector<float> pixels;
  };
  Means means() const;

  /// All numbers that it holds, as bytes of this machine: sums of radiance and of AOVs row by row,
  /// samples of each pixel, cuts of each layer.
  std::array<std::span<std::byte>, 4> storage() noexcept;
  std::array<std::span<const std::byte>, 4> storage() const noexcept;
  bool operator==(const Film&) const = default;

 private:
  friend Film withoutAovs(const Film& film);
  std::size_t index(int x, int y) const noexcept;
  void addLayer(std::size_t layer, std::span<const Real> values, std::int64_t* sums) noexcept;

  int width_, height_;
  Crop crop_;
  std::vector<Aov> aovs_;
  std::vector<FilmLayer> layers_;  ///< of each AOV
  std::size_t stored_ = 0;         ///< channels of all layers that have sums
  std::vector<Int128> radiance_;
  std::vector<std::int64_t> sums_;
  std::vector<std::uint32_t> counts_;
  std::vector<std::uint64_t> cuts_;  ///< several threads may count at once
};

/// Its radiance alone.
Film withoutAovs(const Film& film);

}  // namespace vestige
