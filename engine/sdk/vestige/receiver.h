// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vestige/math.h>

#include <cstdint>

namespace vestige {

/// A point that receives light. Lights are sampled and chosen for a receiver.
///
/// Multiple importance sampling needs the same receiver in sample() and in pdf(): an integrator
/// stores the receiver of the last scattering event.
struct Receiver {
  Vec3 position;
  Vec3 normal{};  ///< shading normal, unit; light may arrive at either side. Zero: in a volume
  Real time = 0;  ///< time of the ray that arrived here
  std::uint32_t medium = 0;  ///< solid that fills the place, as MediumStack::top(); 0: none
};

}  // namespace vestige
