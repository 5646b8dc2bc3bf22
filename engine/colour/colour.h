// SPDX-License-Identifier: Apache-2.0
// Colour spaces, private to engine/colour. OpenColorIO stays behind this header.
#pragma once
#include <cstddef>
#include <memory>
#include <string>

#include "engine/colour/display.h"

namespace vestige {

/// The text of config.ocio.
extern const char* const kBuiltinColourConfig;

/// sRGB's curve [IEC 61966-2-1], for [0, 1].
double decodeSrgb(double code) noexcept;
double encodeSrgb(double linear) noexcept;

/// A change of colours, made once and applied to many pixels.
class ColourTransform {
 public:
  virtual ~ColourTransform() = default;
  /// True where apply() would change nothing.
  virtual bool isIdentity() const noexcept = 0;
  /// `count` pixels in place, [count][stride]; the first three of each are R, G, B [any thread].
  virtual void apply(float* pixels, std::size_t count, int stride) const = 0;
};

/// Transform from a colour space of the config in use (the file that the environment variable OCIO
/// names, else the built-in one) to rendering space; null with `error` if there is none of that
/// name.
std::shared_ptr<const ColourTransform> fromColourSpace(const std::string& space,
                                                       std::string& error);

/// Transform from rendering space to code values of a display, with exposure; results are not
/// clamped.
std::shared_ptr<const ColourTransform> forDisplay(const Display& display, std::string& error);

/// Version of OpenColorIO.
std::string colourLibraryVersion();

}  // namespace vestige
