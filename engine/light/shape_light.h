// SPDX-License-Identifier: Apache-2.0
// Shapes that shine, as lights.
#pragma once
#include <functional>
#include <memory>

#include <vestige/light.h>

#include "engine/trace/world.h"

namespace vestige {

/// A shape that shines, as a light: drawn by area (by cone where the shape offers it), in world
/// space. `radiance` is asked with the surface point (uv, position) and must be thread-safe.
std::unique_ptr<Light> makeShapeLight(const Placement& placement,
                                      std::function<Rgb(const SurfacePoint&)> radiance,
                                      bool twoSided, Rgb meanRadiance);

}  // namespace vestige
