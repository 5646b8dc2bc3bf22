// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vestige/inputs.h>
#include <optional>

/// From a point of the film to a ray into the world.
///
/// Said once, true of every method:
///   * The film is the unit square: x from left to right, y from top to bottom; `aspect` is its
///     width over its height in square pixels.
///   * Rays are in world space with unit direction; a camera applies Values::toWorld() when
///   created.
///   * Methods are const, thread-safe and noexcept; they allocate nothing.
namespace vestige {

struct CameraNumbers {
  Vec2 film;  ///< [0,1]^2
  Vec2 lens;  ///< [0,1)^2
  Real aspect;
};

struct CameraSample {
  Vec3 origin, direction;
  Rgb weight = {1, 1, 1};  ///< radiance along the ray counts this much
};

class Camera {
 public:
  virtual ~Camera() = default;

  /// nullopt where the film sees nothing (outside an image circle).
  virtual std::optional<CameraSample> sample(CameraNumbers n) const noexcept = 0;

  /// Density of the direction at a given origin for uniform film points, 1/sr; 0 off the film. For
  /// cameras whose origin moves with the film (orthographic) there is no such density: 0.
  virtual Real pdf(Vec3 origin, Vec3 direction, Real aspect) const noexcept = 0;

  /// Per unit of film coordinate (numbers 0, 1) and of lens number (2, 3).
  virtual RayJacobian sampleDerivatives(CameraNumbers n) const noexcept = 0;

  /// Random numbers that matter: 2, or 4 with a lens.
  virtual int variables() const noexcept { return 2; }
};

}  // namespace vestige
