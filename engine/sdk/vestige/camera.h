// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vestige/inputs.h>
#include <optional>

/// A map from points of the film to rays in the world.
///
/// Conventions of every method:
///   * The film is the unit square: x from left to right, y from top to bottom; `aspect` is its
///     width over its height in square pixels.
///   * Rays are in world space with unit direction; a camera applies Values::toWorld() when it is
///     created.
///   * Methods are const, thread-safe and noexcept; they allocate nothing.
namespace vestige {

struct CameraNumbers {
  Vec2 film;  ///< [0,1]^2
  Vec2 lens;  ///< [0,1)^2
  Real aspect;
};

struct CameraSample {
  Vec3 origin, direction;
  Rgb weight = {1, 1, 1};  ///< factor applied to the radiance along the ray
};

/// Only sample() has no default. DualCamera (dual_camera.h) derives it and its derivatives from one
/// map.
class Camera {
 public:
  virtual ~Camera() = default;

  /// A ray for a film and a lens point; nullopt outside the image circle.
  virtual std::optional<CameraSample> sample(CameraNumbers n) const noexcept = 0;

  /// Density of the direction at a given origin for uniform film points, 1/sr; 0 off the film. For
  /// cameras whose origin moves with the film (orthographic) there is no such density: 0.
  /// By default 0: integrators that connect paths to the camera cannot use such a camera.
  virtual Real pdf(Vec3 /*origin*/, Vec3 /*direction*/, Real /*aspect*/) const noexcept {
    return 0;
  }

  /// Derivatives of the ray per unit of film coordinate (0, 1) and of lens coordinate (2, 3). By
  /// default: finite differences of sample(), and a note to the user.
  virtual RayJacobian sampleDerivatives(CameraNumbers n) const noexcept;

  /// How many of the random numbers have an effect: 2, or 4 with a lens.
  virtual int variables() const noexcept { return 2; }
};

}  // namespace vestige

#include <vestige/camera_differences.h>  // the default of sampleDerivatives()
