// SPDX-License-Identifier: Apache-2.0
// Converts radiance to code values of a display. OpenColorIO stays behind this header.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace vestige {

/// How a picture for looking at is made from linear radiance.
struct Display {
  double exposure = 0;       ///< stops
  std::string view = "";     ///< "" the config's default ("Standard"), "ACES 1.0 SDR", "Raw"
  std::string display = "";  ///< "" the config's default
};
/// Displays of the colour config in use and their views, the defaults first; empty with `error` if
/// it cannot be read.
struct DisplayViews {
  std::string display;
  std::vector<std::string> views;
};
std::vector<DisplayViews> displayViews(std::string& error);
/// Converts radiance to code values of the display, in place: `count` pixels of which the first
/// three of `stride` numbers are R, G, B. Not clamped. False with `error` for an unknown view.
bool applyDisplay(const Display& display, float* pixels, std::size_t count, int stride,
                  std::string& error);
/// The same but the exposure as GLSL 1.30: a function `vec4 displayed(vec4 radiance)`. "" with
/// `error` where the view is unknown or needs tables, which only applyDisplay() has.
std::string displayShader(const Display& display, std::string& error);

}  // namespace vestige
