// SPDX-License-Identifier: Apache-2.0
// From a picture to the bytes of a file, private to engine/picture.
#pragma once
#include <string>
#include <vector>

#include "engine/picture/image.h"

namespace vestige {

enum class PictureKind { none, exr, hdr, tiff, png, jpeg };

/// In memory, not in a file: the libraries behind some formats end the program, or say nothing,
/// when the disk is full. False with `error`.
bool encodePicture(const Image& image, PictureKind kind, const WriteOptions& options,
                   std::vector<unsigned char>& bytes, std::string& error);

}  // namespace vestige
