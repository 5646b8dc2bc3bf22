// SPDX-License-Identifier: Apache-2.0
// Lights made of emitting shapes.
#pragma once
#include <functional>
#include <memory>

#include <vestige/light.h>

#include "engine/trace/world.h"

namespace vestige {

/// An emitting shape as a light, in world space: sampled by area, or by solid angle if the shape
/// supports it. `radiance` is called with the surface point (uv, position) and must be thread-safe.
std::unique_ptr<Light> makeShapeLight(const Placement& placement,
                                      std::function<Rgb(const SurfacePoint&)> radiance,
                                      bool twoSided, Rgb meanRadiance);

}  // namespace vestige
