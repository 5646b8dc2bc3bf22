// SPDX-License-Identifier: Apache-2.0
// Textures as they lie in memory, private to engine/texture: as small as the file's own numbers,
// with a table that decodes them.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <vestige/math.h>

#include "engine/texture/pyramid.h"

namespace vestige {

using DecodeTable = std::vector<float>;  ///< by code value: 256 or 65536 entries

/// Code: uint8_t or uint16_t (an integer or the bits of a half) with tables, or float without.
template <class Code>
struct TexelArray {
  std::vector<Code> codes;  ///< [height][width][channels], row 0 at the top
  std::shared_ptr<const DecodeTable> colour, alpha;
};

/// Channels: 1 grey, 2 grey and alpha, 3 RGB, 4 RGB and alpha. Decoded, they are linear, in
/// rendering space, finite and not premultiplied.
struct Texels {
  int width = 0, height = 0, channels = 0;
  std::variant<TexelArray<std::uint8_t>, TexelArray<std::uint16_t>, TexelArray<float>> data;
  Pyramid pyramid;
  Rgba mean;
  std::size_t bytes = 0;      ///< pyramid included
  std::size_t nonFinite = 0;  ///< texels' channels that were NaN or infinite and are 0 now

  bool hasAlpha() const noexcept { return channels == 2 || channels == 4; }
};

/// How texels are held: uint8_t, uint16_t and the bits of halfs with tables, or floats.
enum class Storage { bytes, shorts, halfs, floats };

/// The plan of loadTexels() for a file, derived from its header.
struct TexelPlan {
  int width = 0, height = 0, channels = 0;
  Storage storage = Storage::floats;
  std::size_t bytes = 0;  ///< pyramid included
  /// Decode tables of integers, as in TexelArray; null for others.
  std::shared_ptr<const DecodeTable> colour, alpha;
  std::string colourKey;  ///< two files of the same bytes and this are the same texture

  bool isInteger() const noexcept {
    return storage == Storage::bytes || storage == Storage::shorts;
  }
};
/// Nothing, with the reason in `error`.
std::optional<TexelPlan> planTexels(const std::string& file, const std::string& colourSpace,
                                    std::string& error);

/// Reads a picture: `colourSpace` "" goes by the file's metadata, "raw" or "linear" takes numbers
/// as they are, "srgb" decodes sRGB's curve, any other names a space of the colour config. Null
/// with `error`.
std::shared_ptr<const Texels> loadTexels(const std::string& file, const std::string& colourSpace,
                                         std::string& error);

}  // namespace vestige
