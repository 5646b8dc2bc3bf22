// SPDX-License-Identifier: Apache-2.0
// The region that a vertex of a recorded path stands for, and what it would be under other bounds:
// for the inspector's sliders. Nothing is traced again.
#pragma once
#include <optional>
#include <vector>

#include "engine/picture/image.h"
#include "engine/scene/scene.h"

namespace vestige::app {

/// In place of what the path was traced with.
struct Reckoning {
  std::optional<Bound> bound;  ///< nullopt: as it was traced
  int samples = 16;            ///< a pixel, of which this path is the last
  Real limit = kInfinity;      ///< on the gradient
};

struct Region3 {
  std::vector<Real> deltas;   ///< of each number
  std::vector<Vec3> vectors;  ///< delta dV, in the tangent plane; scene units
  Vec3 a, b;                  ///< full axes of their ellipse, the longer first
  std::vector<Vec3> polygon;  ///< corners of all their sums, about the vertex
  Real area = 0;              ///< of the polygon, scene units squared
  Footprint footprint;        ///< of the ellipse, uv included
};
Region3 regionOf(const PathVertex& vertex, const Reckoning& how);

/// The texture of a vertex' surface over a window of uv, as a picture; width 0 where it has none.
struct TextureWindow {
  Vec2 centre;
  Real side;  ///< of the window, in uv
};
Image textureAround(Scene& scene, const Surface& surface, const TextureWindow& window, int pixels);

}  // namespace vestige::app
