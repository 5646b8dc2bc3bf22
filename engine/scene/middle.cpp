// SPDX-License-Identifier: Apache-2.0
#include "engine/scene/middle.h"

namespace vestige {
namespace {

/// Scenes that stand closer to the origin, in sizes of the scene, lose less than five bits there.
constexpr double kNear = 32;

}  // namespace

Vec3 middleOf(const Bounds& extent) noexcept {
  if (extent.isEmpty() || extent.isInfinite()) return {};
  const Vec3 centre = extent.centre();
  const double size = double(maxAbsComponent(extent.size()));
  if (!(size > 0) || !(double(maxAbsComponent(centre)) > kNear * size)) return {};
  const double step = std::exp2(std::ceil(std::log2(size)));
  const auto snapped = [&](Real x) { return Real(step * std::round(double(x) / step)); };
  return {snapped(centre.x), snapped(centre.y), snapped(centre.z)};
}

Bounds boundsIn(const Shape& shape, const Affine& toWorld) noexcept {
  Bounds world;
  if (shape.parts()) {
    for (const MeshPart& part : *shape.parts())
      for (const Vec3 p : part.mesh.positions)
        if (isFinite(p)) world.add(toWorld.point(p));
    return world;
  }
  const Bounds own = shape.bounds();
  if (own.isEmpty() || own.isInfinite()) return own;
  for (int k = 0; k < 8; ++k)
    world.add(toWorld.point({k & 1 ? own.high.x : own.low.x, k & 2 ? own.high.y : own.low.y,
                             k & 4 ? own.high.z : own.low.z}));
  return world;
}

Affine around(Vec3 middle, const Affine& toWorld) noexcept {
  Affine moved = toWorld;
  for (int i = 0; i < 3; ++i) moved.m[i][3] -= double(middle[i]);
  return moved;
}

}  // namespace vestige
