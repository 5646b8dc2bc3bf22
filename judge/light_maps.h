// SPDX-License-Identifier: Apache-2.0
// The samples of a light as maps from one variable, for finite differences.
#pragma once
#include "judge/light_tests.h"

namespace vestige::judge {

inline Vec2 axis2(int k) { return k == 0 ? Vec2{1, 0} : Vec2{0, 1}; }
inline Vec3 axis3(int k) {
  Vec3 a;
  a[k] = 1;
  return a;
}

inline Receiver moved(Receiver r, int axis, double h) {
  r.position[axis] += Real(h);
  return r;
}

inline std::optional<Vec3> toLight(const Light& light, const Receiver& from, Vec2 u) {
  const auto s = light.sample(from, u);
  return s ? std::optional(s->hit.toLight) : std::nullopt;
}

/// A particle whose number k (0, 1: point; 2, 3: direction) is moved by h.
inline std::optional<Particle> movedParticle(const Light& light, EmissionNumbers u, int k,
                                             double h) {
  (k < 2 ? u.point : u.direction) = (k < 2 ? u.point : u.direction) + Real(h) * axis2(k % 2);
  return light.emit(u);
}
inline std::optional<Vec3> movedDirection(const Light& light, EmissionNumbers u, int k, double h) {
  const auto p = movedParticle(light, u, k, h);
  return p ? std::optional(p->direction) : std::nullopt;
}
/// The derivative is defined without the spin of a disk that turns with the direction, so the spin
/// of the sampling frame is removed. `along`: the direction at 0.
inline std::optional<Vec3> movedOrigin(const Light& light, EmissionNumbers u, Vec3 along, int k,
                                       double h) {
  const auto p = movedParticle(light, u, k, h);
  if (!p) return std::nullopt;
  if (k < 2 || !light.traits().isInfinite) return p->origin;
  const Vec3 centre = kLightScene.centre();
  const Frame there = Frame::around(p->direction), here = Frame::around(along);
  const Vec3 local = here.toWorld(there.toLocal(p->origin - centre));
  return centre + transport(along, p->direction, local);
}

}  // namespace vestige::judge
