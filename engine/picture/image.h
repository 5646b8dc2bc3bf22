// SPDX-License-Identifier: Apache-2.0
// Pictures in memory, and how they come from and go to files. OpenImageIO stays behind this header.
#pragma once
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "engine/colour/display.h"

namespace vestige {

/// Float channels, interleaved, row 0 at the top. "R", "G", "B" first; AOVs are "normal.X", ...
struct Image {
  int width = 0, height = 0;
  std::vector<std::string> channels;
  std::vector<float> pixels;                    ///< [height][width][channels]
  std::map<std::string, std::string> metadata;  ///< written as string attributes to EXR

  float* at(int x, int y) { return &pixels[offset(x, y)]; }
  const float* at(int x, int y) const { return &pixels[offset(x, y)]; }

 private:
  std::size_t offset(int x, int y) const { return (std::size_t(y) * width + x) * channels.size(); }
};

/// Pictures with more pixels are refused, so that a small file cannot claim all memory.
/// [main thread, before any picture is read]
void limitPictures(long long pixels);
inline constexpr long long kMaxPicturePixels = 1LL << 28;  ///< the default

/// Reads any format that OpenImageIO supports, without colour conversion; on failure the width is 0
/// and `error` is set.
Image readImage(const std::string& file, std::string& error);

struct WriteOptions {
  Display display;         ///< for PNG, JPEG and other integer formats
  bool halfFloat = false;  ///< for EXR
};
/// Writes a picture in the format of the file's ending: EXR, HDR, TIFF linear with all channels;
/// PNG, JPEG RGB through OpenColorIO. Writes beside the target and renames, so that a full disk
/// never leaves half a picture under its name. False with `error` in the user's words.
bool writeImage(const std::string& file, const Image& image, const WriteOptions& options,
                std::string& error);

/// Whether writeImage() could work: known ending, folder exists and may be written. Asked before
/// rendering.
bool canWrite(const std::string& file, std::string& error);

/// Name and version of the image and colour libraries, for --version.
std::string imageLibraryVersions();

}  // namespace vestige
