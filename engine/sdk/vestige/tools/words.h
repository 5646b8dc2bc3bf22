// SPDX-License-Identifier: Apache-2.0
// Numbers in the notation of scenes, for messages of plugins.
#pragma once
#include <vestige/math.h>

#include <cstdio>
#include <string>

namespace vestige {

/// 38, 0.5, 1e-07: six digits, no padding.
inline std::string words(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", x == 0 ? 0.0 : x);  // no -0
  return text;
}
/// <0, 1, -5>
inline std::string words(Vec3 v) {
  char text[96];
  const auto plain = [](Real x) { return x == 0 ? 0.0 : double(x); };
  std::snprintf(text, sizeof text, "<%g, %g, %g>", plain(v.x), plain(v.y), plain(v.z));
  return text;
}

}  // namespace vestige
