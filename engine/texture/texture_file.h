// SPDX-License-Identifier: Apache-2.0
// Textures as files to be paged in, private to engine/texture.
//
// A .tx (TIFF, tiles of 64 x 64) of the very numbers that Texels would hold, so that a lookup gives
// the same bits wherever they come from: first the full resolution, then each level of the pyramid
// with its border, rows from the top. Integers stay codes of 16 bits, all else is decoded floats.
#pragma once
#include <optional>
#include <string>

#include "engine/texture/texels.h"

namespace vestige {

/// A power of 2, and what the library's own converter takes: 24 KB for three channels of 16 bits.
inline constexpr int kTileShift = 6, kTileSide = 1 << kTileShift;

/// Must be raised whenever the same picture would give another file.
inline constexpr int kTextureFileVersion = 1;

/// The properties of a texture without its texels.
struct TextureFacts {
  Rgba mean;
  std::size_t nonFinite = 0;
};

/// Writes `texels`, made by `plan`, under a temporary name and renames it, so that readers see a
/// whole file or none. False with the reason in `why`.
bool writeTextureFile(const std::string& file, const Texels& texels, const TexelPlan& plan,
                      const std::string& key, std::string& why);

/// Nothing unless the file is whole, of this plan and this key.
std::optional<TextureFacts> readTextureFile(const std::string& file, const TexelPlan& plan,
                                            const std::string& key);

}  // namespace vestige
