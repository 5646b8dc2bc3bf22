// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vestige/math.h>

namespace vestige {

/// A point that receives light. Lights are sampled and chosen for a receiver.
///
/// Multiple importance sampling needs the same receiver in sample() and in pdf(): an integrator
/// stores the receiver of the last scattering event.
struct Receiver {
  Vec3 position;
  Vec3 normal{};    ///< shading normal, unit; light may arrive at either side. Zero: in a volume
  Real time = 0;    ///< time of the ray that arrived here
  int medium = -1;  ///< index of the surrounding medium; -1: vacuum
};

}  // namespace vestige
