// SPDX-License-Identifier: Apache-2.0
// What a film can hold beside radiance: names, channels and units of the AOVs that every integrator
// has and of those that one declares, and where their values come from.
#pragma once
#include <vestige/integrator.h>

#include <optional>
#include <string>
#include <vector>

namespace vestige {

/// A layer of a film: its channels, and the unit in which they are summed.
struct FilmLayer {
  std::string name;                   ///< "depth"
  std::vector<std::string> channels;  ///< "depth.Z"
  double unit = 1;                    ///< a power of two
  bool isCount = false;               ///< shows the pixel's samples and stores nothing
  bool needsFootprint = false;        ///< paths must carry differentials
  /// Writes the values of its channels and returns their number; null: slot `slot` of Aovs::own.
  int (*read)(const Aovs& from, Real out[3]) noexcept = nullptr;
  int slot = 0;

  int stored() const noexcept { return isCount ? 0 : int(channels.size()); }
  /// Larger values are cut: 2^52 units. The sum holds 2048 samples at the limit.
  double limit() const noexcept { return unit * 0x1p52; }
  /// Whether sums of both may be added.
  bool operator==(const FilmLayer& b) const {
    return name == b.name && channels == b.channels && unit == b.unit && isCount == b.isCount;
  }
};

/// Names of all AOVs: the common ones, then the integrator's own.
std::vector<std::string> aovNames(std::span<const AovSlot> own = {});
/// The layer of an AOV; nullopt: there is none of that name. `sceneSize` is the largest distance
/// from the origin that is expected; lengths are summed in units that follow it.
std::optional<FilmLayer> layerOf(std::string_view name, double sceneSize,
                                 std::span<const AovSlot> own = {});
/// Writes the values of a layer's stored channels and returns their number.
int values(const FilmLayer& layer, const Aovs& from, Real out[3]) noexcept;

}  // namespace vestige
