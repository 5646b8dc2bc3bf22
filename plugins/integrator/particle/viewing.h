// SPDX-License-Identifier: Apache-2.0
// The picture of a solution: paths from the eye that end on what is matt, where light is kept, and
// go on through everything else.
#pragma once
#include <vestige/path_report.h>

#include "irradiance.h"

namespace vestige::particle {

enum class Show {
  smooth,    ///< irradiance blended between vertices
  elements,  ///< constant on each element
  gather,    ///< what the eye sees first is lit by rays, and these see elements
};

struct Viewing {
  Show show = Show::smooth;
  bool glossy = true;  ///< follow rays from what is not matt; if not it stays black
  bool wires = false;  ///< draw the edges of elements
  int depth = 16;      ///< longest path, edges
  Irradiance light = {};

  /// Along the ray of the context, W/(m^2 sr).
  Rgb radiance(PathContext& c) const noexcept;

 private:
  struct Path;
  bool meet(Path& path) const noexcept;
  bool look(Path& path) const noexcept;
  bool scatter(Path& path) const noexcept;
  Real wire(PathContext& c, const Place& place) const noexcept;
};

}  // namespace vestige::particle
