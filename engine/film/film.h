// SPDX-License-Identifier: Apache-2.0
// Sums of samples, as integers: the picture does not depend on their order.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <vestige/integrator.h>
#include <vestige/table.h>

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
inline constexpr double kRadianceUnit = 0x1p-60;
inline constexpr double kRadianceLimit = 0x1p50;

/// Sums of radiance, 16 bytes a channel, and of the wanted AOVs, 8 bytes a channel. One thread adds
/// to a pixel at a time; different pixels may be added to at once.
class Film {
 public:
  /// The AOVs by name, `own` are those of the integrator; `sceneSize` as in layerOf(). Throws
  /// std::runtime_error with a sentence for the user where a name is unknown.
  Film(int width, int height, Crop crop, const std::vector<std::string>& aovs, double sceneSize = 1,
       std::span<const AovSlot> own = {});

  int width() const noexcept { return width_; }
  int height() const noexcept { return height_; }
  Crop crop() const noexcept { return crop_; }
  /// One for each AOV.
  const Table<FilmLayer>& layers() const noexcept { return layers_; }
  /// Whether an AOV needs footprints; otherwise paths carry them for textures only.
  bool wantsFootprint() const noexcept;

  /// Adds one sample of weight 1. Radiance that is not finite becomes black, radiance beyond the
  /// limit is clamped; `counters` counts both. cuts() counts both for AOVs.
  void add(int x, int y, Rgb radiance, const Aovs& aovs, Counters& counters) noexcept;
  /// Adds all samples of another film of the same size, crop window, AOVs and units. The result is
  /// the same to the bit as one film with all the samples. Throws std::runtime_error with a
  /// sentence for the user if the films differ. Sums that do not fit are clamped and counted as in
  /// add().
  void merge(const Film& other, Counters& counters);

  std::uint32_t samples(int x, int y) const noexcept;
  /// Of the pixel with the fewest.
  std::uint32_t minSamples() const noexcept;
  /// Of the pixel with the most, and the mean over all pixels.
  std::uint32_t maxSamples() const noexcept;
  double meanSamples() const noexcept;
  /// Luminance of the pixel's mean; 0 without samples.
  double luminance(int x, int y) const noexcept;
  /// Samples of each layer whose values were not finite or too large.
  const Table<std::uint64_t>& cuts() const noexcept { return cuts_; }

  /// Means so far: R, G, B, then the AOVs' channels ("normal.X", "depth.Z", "uv.U", ...). Size of
  /// the crop window; black without samples.
  struct Means {
    int width, height;
    std::vector<std::string> channels;
    std::vector<float> pixels;
  };
  Means means() const;

  /// All its numbers, as bytes of this machine: sums of radiance and of AOVs row by row,
  /// samples of each pixel, cuts of each layer.
  std::array<std::span<std::byte>, 4> storage() noexcept;
  std::array<std::span<const std::byte>, 4> storage() const noexcept;
  bool operator==(const Film&) const = default;

 private:
  friend Film withoutAovs(const Film& film);
  std::size_t index(int x, int y) const noexcept;
  void addLayer(int layer, std::span<const Real> values, std::int64_t* sums) noexcept;

  int width_, height_;
  Crop crop_;
  Table<FilmLayer> layers_;
  std::size_t stored_ = 0;  ///< channels of all layers that have sums
  std::vector<Int128> radiance_;
  std::vector<std::int64_t> sums_;
  std::vector<std::uint32_t> counts_;
  Table<std::uint64_t> cuts_;  ///< of each layer; several threads may count at once
};

/// A copy of the radiance alone.
Film withoutAovs(const Film& film);

}  // namespace vestige
