// SPDX-License-Identifier: Apache-2.0
// The picture of a solution: paths from the eye that end on diffuse surfaces, where light is kept,
// and go on from everything else.
#pragma once
#include <vestige/path_report.h>

#include "irradiance.h"

namespace vestige::particle {

enum class Show {
  smooth,    ///< irradiance blended between vertices
  elements,  ///< constant on each element
  gather,    ///< the first diffuse surface is lit by rays, and these see elements
};

struct Viewing {
  Show show = Show::smooth;
  bool glossy = true;  ///< follow rays for what is not diffuse; if not, that part is black
  bool wires = false;  ///< draw the edges of elements
  int depth = 16;      ///< longest path, edges
  Irradiance light = {};

  /// Along the ray of the context, W/(m^2 sr).
  Rgb radiance(PathContext& c) const noexcept;

 private:
  struct Path;
  bool meet(Path& path) const noexcept;
  bool look(Path& path) const noexcept;
  static bool end(Path& path) noexcept;
  bool scatter(Path& path) const noexcept;
  Real wire(PathContext& c, const PatchPoint& at) const noexcept;
};

}  // namespace vestige::particle
