// SPDX-License-Identifier: Apache-2.0
// The disk on which particles of lights at infinity start: it covers the scene as seen along their
// direction.
#pragma once
#include <vestige/tools/sampling.h>

namespace vestige {

/// The sphere around the finite part of a scene; each of its great disks, moved outwards, covers
/// the scene from one direction.
struct SceneDisk {
  Vec3 centre;
  Real radius = 1;

  /// A unit sphere if no object is finite, so that lights keep a finite flux.
  static SceneDisk around(const Bounds& scene) noexcept {
    if (scene.isEmpty() || scene.isInfinite()) return {};
    const Real r = length(scene.size()) / 2;
    return {scene.centre(), r > 0 ? r : 1};
  }
  Real area() const noexcept { return kPi * radius * radius; }

  /// A point drawn uniformly over the disk perpendicular to unit `direction`, one radius before the
  /// centre [MATH 1.12].
  Vec3 start(Vec3 direction, Vec2 u) const noexcept {
    const Vec2 d = concentricDisk(u).d;
    const Frame f = Frame::around(direction);
    return centre + radius * (d.x * f.s + d.y * f.t - direction);
  }
  /// Its derivative at a fixed direction, per unit of random number.
  Mat3x2 du(Vec3 direction, Vec2 u) const noexcept {
    const Disk k = concentricDisk(u);
    const Frame f = Frame::around(direction);
    const auto column = [&](Vec2 d) { return radius * (d.x * f.s + d.y * f.t); };
    return {column(k.du[0]), column(k.du[1])};
  }
  /// Derivative of a start when the direction changes by dDirection and carries the disk along
  /// without spin; the spin of Frame::around about the direction only relabels u.
  Vec3 turned(Vec3 start, Vec3 direction, Vec3 dDirection) const noexcept {
    return cross(cross(direction, dDirection), start - centre);
  }
};

}  // namespace vestige
