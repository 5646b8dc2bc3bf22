// SPDX-License-Identifier: Apache-2.0
// What a film can hold beside radiance: names, channels and units, and which part of Aovs goes
// where.
#pragma once
#include <string>
#include <vector>

#include <vestige/integrator.h>

namespace vestige {

enum class Aov {
  normal,
  albedo,
  depth,
  position,
  uv,
  samples,
  footprint,
  footprintTexels,
  gradient,
  elementLevel,
  elementId
};
inline constexpr int kAovs = int(Aov::elementId) + 1;
/// "normal", "footprint.texels", ...
const char* name(Aov aov) noexcept;

/// A layer of a film: its channels, and the unit in which they are summed.
struct FilmLayer {
  std::string name;                   ///< "depth"
  std::vector<std::string> channels;  ///< "depth.Z"
  double unit = 1;                    ///< a power of two
  bool isCount = false;               ///< shows the pixel's samples and stores nothing

  int stored() const noexcept { return isCount ? 0 : int(channels.size()); }
  /// Larger values are cut: 2^52 units. The sum holds 2048 samples at the limit.
  double limit() const noexcept { return unit * 0x1p52; }
  bool operator==(const FilmLayer&) const = default;
};

/// The layer of an AOV. `sceneSize` is the largest distance from the origin that is expected;
/// lengths are summed in units that follow it.
FilmLayer layerOf(Aov aov, double sceneSize);
/// Writes the values of an AOV's stored channels and returns their number.
int values(Aov aov, const Aovs& from, Real out[3]) noexcept;

}  // namespace vestige
