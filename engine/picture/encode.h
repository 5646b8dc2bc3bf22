// SPDX-License-Identifier: Apache-2.0
// Encodes a picture as the bytes of a file, private to engine/picture.
#pragma once
#include <string>
#include <vector>

#include "engine/picture/image.h"

namespace vestige {

enum class PictureKind { none, exr, hdr, tiff, png, jpeg };

/// In memory, not in a file: the libraries behind some formats end the program, or report no error,
/// when the disk is full. False with `error`.
bool encodePicture(const Image& image, PictureKind kind, const WriteOptions& options,
                   std::vector<unsigned char>& bytes, std::string& error);

}  // namespace vestige
