// SPDX-License-Identifier: Apache-2.0
// From the world back to the film, for any camera: also for one that only a plugin knows.
#pragma once
#include <optional>

#include <vestige/camera.h>

namespace vestige::app {

/// The film point whose ray (through the middle of the lens) meets `point`; nullopt where none was
/// found: behind the camera, or outside of what it sees. Newton's method on the camera's own
/// derivatives, begun at `start`.
std::optional<Vec2> onFilm(const Camera& camera, Vec3 point, Real aspect, Vec2 start);

}  // namespace vestige::app
