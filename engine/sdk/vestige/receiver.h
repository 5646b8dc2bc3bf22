// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vestige/math.h>

namespace vestige {

/// A point that light arrives at: what lights are sampled for, and chosen by.
///
/// Multiple importance sampling needs the same receiver in sample() and in pdf(): an integrator
/// keeps that of the last scattering event.
struct Receiver {
  Vec3 position;
  Vec3 normal{};    ///< shading normal, unit; light may arrive at either side. Zero: in a volume
  Real time = 0;    ///< of the ray that got there
  int medium = -1;  ///< that surrounds the point; -1: vacuum
};

}  // namespace vestige
