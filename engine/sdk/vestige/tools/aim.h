// SPDX-License-Identifier: Apache-2.0
// Location and axis of lights that are aimed at a point.
#pragma once
#include <vestige/plugin.h>
#include <vestige/tools/words.h>

namespace vestige {

struct Aim {
  Vec3 location;
  Frame frame;  ///< n: the axis, from the location to the point aimed at
};

/// Reads both from two rows of the schema, in the block's own space. Throws PluginError if the two
/// points coincide.
inline Aim ownAim(const Values& values, int locationRow, int pointAtRow) {
  const Vec3 location = values.vec3(locationRow), at = values.vec3(pointAtRow);
  const Vec3 axis = normalize(at - location);
  if (lengthSquared(axis) == 0)
    throw PluginError(pointAtRow, "point_at is " + words(at) +
                                      ", the light's own location: expected another point");
  return {location, Frame::around(axis)};
}

/// The same in world space: the block's transform is applied to both points.
inline Aim aim(const Values& values, int locationRow, int pointAtRow) {
  ownAim(values, locationRow, pointAtRow);
  const Vec3 location = values.toWorld().point(values.vec3(locationRow));
  const Vec3 axis = normalize(values.toWorld().point(values.vec3(pointAtRow)) - location);
  if (lengthSquared(axis) == 0)
    throw PluginError(pointAtRow,
                      "point_at is so near the light's own location that no direction "
                      "is left: expected another point");
  return {location, Frame::around(axis)};
}

}  // namespace vestige
