// SPDX-License-Identifier: Apache-2.0
// The maps of one placement between its object's space and the world.
#pragma once
#include <vestige/shape.h>

namespace vestige {

struct Place {
  explicit Place(const Affine& objectToWorld);

  Affine toWorld, toObject;
  Mat3 linear;      ///< of toWorld
  Mat3 normals;     ///< takes normals along, outward ones to outward ones even if the place mirrors
  Real areaScale;   ///< |det|^(2/3); normals is scaled so that its own determinant is near 1
  Real norm;        ///< largest row sum of |linear|
  Real condition;   ///< norm times that of the inverse
  Real shift;       ///< largest component of the offset
  bool similarity;  ///< turns, mirrors and scales all axes alike: angles keep
  bool identity;    ///< both spaces are one: nothing to carry

  /// A surface point with its normals and derivatives, object to world [MATH 1.4].
  SurfacePoint world(const SurfacePoint& object) const noexcept;
  /// The same t means the same point.
  Ray object(const Ray& world) const noexcept {
    if (identity) return world;
    Ray ray = world;
    ray.origin = toObject.point(world.origin);
    ray.direction = toObject.vector(world.direction);
    return ray;
  }
  /// object(world).at(t), without a copy of the ray.
  Vec3 objectPoint(const Ray& world, Real t) const noexcept {
    if (identity) return world.at(t);
    return toObject.point(world.origin) + t * toObject.vector(world.direction);
  }
  /// World area of a unit of area whose unit normal in object space is this.
  Real stretch(Vec3 objectNormal) const noexcept {
    return areaScale * length(normals * objectNormal);
  }
  Bounds bounds(const Bounds& object) const noexcept;
};

}  // namespace vestige
