// SPDX-License-Identifier: Apache-2.0
// Coarser versions of a texture, private to engine/texture.
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <variant>
#include <vector>

#include <vestige/table.h>

namespace vestige {

/// One version. Each of its texels is the average of the same area of the full resolution, so every
/// level has the picture's mean, whatever its size. Around it lies a border of one texel, made of
/// the picture's edge texels alone: what a clamped lookup sees beyond the edge.
struct Level {
  std::int32_t width = 0, height = 0;
  std::size_t start = 0;  ///< of the lower left corner of the border, in numbers
  /// Texels of the full resolution that one texel of this level spans.
  float scaleX = 1, scaleY = 1;
  /// Variance of a texel's own average along either axis, in squared texels of the full resolution.
  float spreadX = 0, spreadY = 0;
};

/// All levels but the full resolution. Each has half the size of the one before, rounded up, so
/// no level is coarser than 2^level; the last is one texel. Linear light, channels averaged each by
/// itself: colour is not premultiplied.
struct Pyramid {
  static constexpr float kUnitCodes = 65535;

  Table<Level> levels;
  /// [height + 2][width + 2][channels] a level, row 0 at the bottom. Integers where all values lie
  /// in [0, 1], linear: no table is needed, and memory grows by two thirds for pictures of 8 bits.
  std::variant<std::vector<std::uint16_t>, std::vector<float>> texels;

  std::size_t bytes() const noexcept;
};

/// The levels of a picture of this size, and how many numbers a pyramid of them has.
Table<Level> pyramidLevels(std::int32_t width, std::int32_t height, int channels);
std::size_t pyramidNumbers(const Table<Level>& levels, int channels) noexcept;

/// Writes one row of the full resolution, decoded, into [width][channels]; row 0 at the bottom.
using ReadRow = std::function<void(std::int32_t y, float* row)>;

/// `unit`: all values lie in [0, 1].
Pyramid makePyramid(std::int32_t width, std::int32_t height, int channels, bool unit,
                    const ReadRow& readRow);

}  // namespace vestige
