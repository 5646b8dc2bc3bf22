// SPDX-License-Identifier: Apache-2.0
// A camera's ray as a map from one variable, for finite differences.
#pragma once
#include "judge/camera_tests.h"

namespace vestige::judge {

/// Direction or origin of the ray whose number k (0, 1: film; 2, 3: lens) is moved by h.
inline std::optional<Vec3> movedRay(const Camera& camera, CameraNumbers n, int k, double h,
                                    bool direction) {
  (k == 0 ? n.film.x : k == 1 ? n.film.y : k == 2 ? n.lens.x : n.lens.y) += Real(h);
  const auto s = camera.sample(n);
  return s ? std::optional(direction ? s->direction : s->origin) : std::nullopt;
}

}  // namespace vestige::judge
