// SPDX-License-Identifier: Apache-2.0
// The default derivatives of a camera: finite differences of sample(). The engine notifies the user
// once if a scene uses such a plugin.
#pragma once
#include <vestige/camera.h>
#include <vestige/tools/differences.h>

namespace vestige::differences {

inline RayJacobian ofCamera(const Camera& camera, CameraNumbers n) noexcept {
  RayJacobian j;
  const auto here = camera.sample(n);
  if (!here) return j;
  const Real size = 1 + length(here->origin);
  for (int k = 0; k < std::min(camera.variables(), 4); ++k) {
    const auto moved = [&](Real h) -> std::optional<CameraSample> {
      CameraNumbers m = n;
      Real& x = k == 0 ? m.film.x : k == 1 ? m.film.y : k == 2 ? m.lens.x : m.lens.y;
      x += h;
      const bool isWithin = x >= 0 && (k < 2 ? x <= 1 : x < 1);
      return isWithin ? camera.sample(m) : std::nullopt;
    };
    const auto origin = [&](Real h) {
      const auto s = moved(h);
      return s ? std::optional(s->origin) : std::nullopt;
    };
    const auto direction = [&](Real h) {
      const auto s = moved(h);
      return s ? std::optional(s->direction) : std::nullopt;
    };
    j.dOrigin[k] = derivative(origin, here->origin, kStep, size);
    // The derivative of a unit vector is perpendicular to it.
    j.dDirection[k] = projection(here->direction) * derivative(direction, here->direction, kStep);
  }
  return j;
}

}  // namespace vestige::differences

namespace vestige {

inline RayJacobian Camera::sampleDerivatives(CameraNumbers n) const noexcept {
  return differences::ofCamera(*this, n);
}

}  // namespace vestige
