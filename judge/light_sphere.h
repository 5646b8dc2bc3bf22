// SPDX-License-Identifier: Apache-2.0
// A sphere around a light (or around the scene, for lights at infinity): all its flux passes
// through it.
#pragma once
#include "judge/light_tests.h"

namespace vestige::judge {

struct LightSphere {
  Vec3 centre;
  Real radius;
};
inline LightSphere sphereFor(const Light& light, Random& r) {
  if (light.traits().isInfinite) return {kLightScene.centre(), length(kLightScene.size()) / 2};
  Bounds origins;
  for (int i = 0; i < 256; ++i)
    if (const auto p = light.emit({r.pair(), r.pair()})) origins.add(p->origin);
  if (origins.isEmpty()) origins = light.extent().box;  // the light emits no particles
  if (origins.isEmpty()) return {{}, 0};
  return {origins.centre(), length(origins.size()) + 1};
}

/// The point where a particle crosses the sphere, away from the light.
inline std::optional<Vec3> crossing(const Particle& p, const LightSphere& s, bool isInfinite) {
  const Vec3 o = p.origin - s.centre;
  const Real b = dot(o, p.direction), q = sqr(b) - lengthSquared(o) + sqr(s.radius);
  if (q < 0) return std::nullopt;
  return o + (-b + (isInfinite ? -1 : 1) * std::sqrt(q)) * p.direction;
}

/// Luminance of the irradiance by one sample, W/m^2.
inline double irradiance(const Light& light, Vec3 from, Vec3 normal, Vec2 u) {
  const auto s = light.sample({from, normal}, u);
  if (!s) return 0;
  return double(luminance(s->radiance) * std::max(Real(0), dot(s->hit.toLight, normal)) / s->pdf);
}

}  // namespace vestige::judge
