// SPDX-License-Identifier: Apache-2.0
// The files that a picture goes to: asked before rendering, written after, none of them lost
// because another one failed.
#pragma once
#include <string>
#include <vector>

#include "app/command.h"
#include "engine/film/film.h"
#include "engine/picture/image.h"

namespace vestige::app {

struct OutputOptions {
  std::vector<std::string> files;
  WriteOptions write;
  bool viewGiven = false;
};

/// What goes into the file besides the pixels.
struct PictureFacts {
  std::uint64_t sceneHash;
  std::uint32_t seed;
  int samples;
  double seconds;
};

/// Failure if the file could not be made or replaced, tried by making one beside it.
void checkWritable(const std::string& file);
/// Failure if a picture cannot be written, or the view is unknown: found before hours of work.
void checkOutputs(const OutputOptions& options, bool hasAovs);

/// The film's means as a picture with metadata.
Image pictureOf(const Film& film, const PictureFacts& facts);

/// Writes all it can and complains about the others; if none could be written, tries to save the
/// picture elsewhere. The files that hold the picture now; `failed` tells whether one of those
/// asked for is missing.
std::vector<std::string> writeOutputs(const OutputOptions& options, const Image& picture,
                                      bool& failed);

}  // namespace vestige::app
