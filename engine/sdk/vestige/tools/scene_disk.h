// SPDX-License-Identifier: Apache-2.0
// Where particles of lights at infinity start: on a disk that covers the scene as the light sees
// it.
#pragma once
#include <vestige/tools/sampling.h>

namespace vestige {

/// The sphere around the finite part of a scene; each of its great disks, moved outwards, covers
/// the scene from one direction.
struct SceneDisk {
  Vec3 centre;
  Real radius = 1;

  /// Where nothing is finite, a unit sphere: lights keep a flux to be chosen by.
  static SceneDisk around(const Bounds& scene) noexcept {
    if (scene.isEmpty() || scene.isInfinite()) return {};
    const Real r = length(scene.size()) / 2;
    return {scene.centre(), r > 0 ? r : 1};
  }
  Real area() const noexcept { return kPi * radius * radius; }

  /// Uniform over the disk across unit `direction`, one radius before the centre [MATH 1.12].
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
  /// How a start moves when the direction turns by dDirection and takes the disk along without
  /// spin; the turn of Frame::around about the direction only relabels u.
  Vec3 turned(Vec3 start, Vec3 direction, Vec3 dDirection) const noexcept {
    return cross(cross(direction, dDirection), start - centre);
  }
};

}  // namespace vestige
