// SPDX-License-Identifier: Apache-2.0
// Decodes code values to linear light, private to engine/texture.
#pragma once
#include <OpenImageIO/imageio.h>

#include <memory>
#include <string>

#include "engine/colour/colour.h"
#include "engine/texture/texels.h"

namespace vestige {

/// How the colour channels of a file are to be decoded.
struct Encoding {
  enum class Kind { linear, srgb, power, config };
  Kind kind = Kind::linear;
  double exponent = 1;                               ///< of Kind::power
  std::shared_ptr<const ColourTransform> transform;  ///< of Kind::config: mixes channels
};

/// The decoding for `colourSpace`, or by the file's metadata if it is "": integers are sRGB unless
/// the file's metadata are linear or another exponent, floating point is linear. (The name that a
/// converted .tx file carries is still that of its source, so it is ignored for floating point.)
/// False with `error`.
bool chooseEncoding(const OIIO::ImageSpec& spec, const std::string& colourSpace, Encoding& encoding,
                    std::string& error);

/// Tables of integers, divided by the largest, then decoded; of halfs, by their bits, with 0 for
/// what is not finite. Shared by all textures. Kind::config counts as linear.
std::shared_ptr<const DecodeTable> integerTable(int bits, const Encoding& encoding);
std::shared_ptr<const DecodeTable> halfTable(const Encoding& encoding);

/// The same for pixels in place, RGB as floats.
void decodeColours(const Encoding& encoding, float* rgb, std::size_t pixels);

}  // namespace vestige
