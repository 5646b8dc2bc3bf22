// SPDX-License-Identifier: Apache-2.0
#include "engine/picture/encode.h"

#include <fmt/format.h>
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>

#include "engine/colour/colour.h"
#include "engine/picture/picture_file.h"
#include "engine/picture/rgb_view.h"

namespace vestige {

namespace {

/// The library's input: numbers of one type, interleaved, top row first.
struct Pixels {
  OIIO::ImageSpec spec;
  OIIO::TypeDesc format;
  std::vector<float> floats;
  std::vector<std::uint8_t> bytes;
  const void* data() const {
    return bytes.empty() ? static_cast<const void*>(floats.data()) : bytes.data();
  }
};

OIIO::ImageSpec specOf(const Image& image, const std::vector<std::string>& channels,
                       OIIO::TypeDesc format) {
  OIIO::ImageSpec spec(image.width, image.height, int(channels.size()), format);
  spec.channelnames = channels;
  spec.alpha_channel = spec.channelindex("A");
  for (const auto& [name, value] : image.metadata)
    if (name.rfind("oiio:", 0) != 0) spec.attribute(name, value);  // the library's own remarks
  return spec;
}

const std::vector<std::string> kRgb = {"R", "G", "B"};

/// R, G, B as halfs, within their range; what else there is (positions, depths) needs a float.
void makeHalf(Pixels& p) {
  constexpr float kLargestHalf = 65504;
  const std::size_t n = p.spec.channelnames.size();
  p.spec.channelformats.assign(n, OIIO::TypeFloat);
  for (std::size_t c = 0; c < n; ++c) {
    const std::string& name = p.spec.channelnames[c];
    if (name != "R" && name != "G" && name != "B" && name != "A") continue;
    p.spec.channelformats[c] = OIIO::TypeHalf;
    for (std::size_t i = c; i < p.floats.size(); i += n)
      if (std::isfinite(p.floats[i]))
        p.floats[i] = std::clamp(p.floats[i], -kLargestHalf, kLargestHalf);
  }
}

Pixels linearPixels(const Image& image, PictureKind kind, const WriteOptions& options) {
  Pixels p;
  p.format = OIIO::TypeFloat;
  if (kind == PictureKind::hdr) {  // RGBE has neither sign nor NaN
    p.spec = specOf(image, kRgb, p.format);
    p.floats = rgbOf(image);
    for (float& x : p.floats) x = x > 0 ? std::min(x, 1e30f) : 0;
  } else {
    p.spec = specOf(image, image.channels, p.format);
    p.floats = image.pixels;
    p.spec.attribute("compression", "zip");
    if (kind == PictureKind::exr && options.halfFloat) makeHalf(p);
  }
  p.spec.attribute("oiio:ColorSpace", "Linear");
  return p;
}

/// For display: converted by the colour config, 8 bits, rounded, no dither.
bool displayPixels(const Image& image, const WriteOptions& options, Pixels& p, std::string& error) {
  const auto transform = forDisplay(options.display, error);
  if (!transform) return false;
  std::vector<float> rgb = rgbOf(image);
  // After exposure 1e6 at most: the config's own formulas make NaN of infinity.
  const auto bright = float(1e6 * std::exp2(-options.display.exposure));
  for (float& x : rgb) x = std::isnan(x) ? 0 : std::clamp(x, -bright, bright);
  transform->apply(rgb.data(), rgb.size() / 3, 3);
  p.bytes.resize(rgb.size());
  for (std::size_t i = 0; i < rgb.size(); ++i)
    p.bytes[i] = std::uint8_t(std::clamp(rgb[i] > 0 ? rgb[i] : 0.f, 0.f, 1.f) * 255 + 0.5f);
  p.format = OIIO::TypeUInt8;
  p.spec = specOf(image, kRgb, p.format);
  p.spec.attribute("oiio:ColorSpace", "sRGB");
  p.spec.attribute("compression", "jpeg:95");
  p.spec.attribute("jpeg:subsampling", "4:4:4");
  return true;
}

const char* libraryName(PictureKind kind) {
  switch (kind) {
    case PictureKind::exr:
      return "openexr";
    case PictureKind::hdr:
      return "hdr";
    case PictureKind::tiff:
      return "tiff";
    case PictureKind::png:
      return "png";
    case PictureKind::jpeg:
      return "jpeg";
    case PictureKind::none:
      break;
  }
  return "";
}

}  // namespace

bool encodePicture(const Image& image, PictureKind kind, const WriteOptions& options,
                   std::vector<unsigned char>& bytes, std::string& error) {
  Pixels p;
  if (kind == PictureKind::png || kind == PictureKind::jpeg) {
    if (!displayPixels(image, options, p, error)) return false;
  } else {
    p = linearPixels(image, kind, options);
  }
  const std::string name = libraryName(kind);
  OIIO::Filesystem::IOVecOutput memory(bytes);  // outlives the writer
  const auto output = OIIO::ImageOutput::create(name);
  if (!output || !output->supports("ioproxy")) {
    error = fmt::format("the image library cannot write {} files", name);
    return false;
  }
  output->set_ioproxy(&memory);
  if (output->open("picture." + name, p.spec) && output->write_image(p.format, p.data()) &&
      output->close())
    return true;
  error = reason(output->geterror(), "picture." + name);
  return false;
}

}  // namespace vestige
