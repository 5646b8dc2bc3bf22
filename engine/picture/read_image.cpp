// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <new>

#include "engine/colour/colour.h"
#include "engine/picture/image.h"
#include "engine/picture/picture_file.h"

namespace vestige {

Image readImage(const std::string& file, std::string& error) {
  error.clear();
  const auto input = openPicture(file, error);
  if (!input) return {};
  const OIIO::ImageSpec spec = input->spec();
  const long long values = (long long)spec.width * spec.height * spec.nchannels;
  Image image;
  try {
    if (values * (long long)sizeof(float) > kMaxPictureBytes) throw std::bad_alloc();
    image.pixels.resize(std::size_t(values));
  } catch (const std::bad_alloc&) {
    error = fmt::format("the picture '{}' ({} x {} pixels, {} channels) does not fit into memory",
                        file, spec.width, spec.height, spec.nchannels);
    return {};
  }
  if (!readPicture(*input, file, 0, spec.nchannels, OIIO::TypeFloat, image.pixels.data(), error))
    return {};
  image.width = spec.width, image.height = spec.height;
  image.channels = spec.channelnames;
  for (const auto& attribute : spec.extra_attribs)
    image.metadata[attribute.name().string()] = attribute.get_string();
  return image;
}

std::string imageLibraryVersions() {
  const int v = OIIO::openimageio_version();
  return fmt::format("OpenImageIO {}.{}.{}, OpenColorIO {}", v / 10000, v / 100 % 100, v % 100,
                     colourLibraryVersion());
}

}  // namespace vestige
