// SPDX-License-Identifier: Apache-2.0
// The picture of a solution: paths from the eye that end on diffuse surfaces, whose irradiance the
// solution has, and scatter everywhere else.
#pragma once
#include <vestige/tools/path_walk.h>

#include "irradiance.h"

namespace vestige::particle {

/// Slots of Aovs::own.
enum OwnAov { kElementLevel, kElementId };

enum class Show {
  smooth,    ///< irradiance interpolated between vertices
  elements,  ///< constant on each element
  gather,    ///< rays light the first diffuse surface, and these see elements
};

struct Viewing {
  Show show = Show::smooth;
  bool glossy = true;  ///< follow rays from what is not diffuse; otherwise it stays black
  bool wires = false;  ///< draw the edges of elements
  int depth = 16;      ///< longest path, edges
  Irradiance light = {};

  /// Along the ray of the context, W/(m^2 sr).
  Rgb radiance(PathContext& c) const noexcept;

 private:
  struct Path;
  bool look(Path& path) const noexcept;
  static bool end(Path& path) noexcept;
  bool scatter(Path& path) const noexcept;
  Real wire(PathContext& c, const PatchPoint& at) const noexcept;
};

}  // namespace vestige::particle
