// SPDX-License-Identifier: Apache-2.0
// Opening picture files, private to engine/picture.
#pragma once
#include <OpenImageIO/imageio.h>

#include <memory>
#include <string>

namespace vestige {

/// Larger pictures are refused: a broken header must not be able to claim all memory.
inline constexpr long long kMaxPictureBytes = 1LL << 34;

/// Opens a flat, two-dimensional picture of a size that fits, alpha left as the file holds it. Null
/// with `error`.
std::unique_ptr<OIIO::ImageInput> openPicture(const std::string& file, std::string& error);

/// Channels [begin, end) of the first picture in the file, rows from the top, into `pixels`, which
/// has room for them as `format`.
bool readPicture(OIIO::ImageInput& input, const std::string& file, int begin, int end,
                 OIIO::TypeDesc format, void* pixels, std::string& error);

/// The library's message as part of a sentence: one line, no full stop, without the file's name.
std::string reason(std::string message, const std::string& file);

}  // namespace vestige
