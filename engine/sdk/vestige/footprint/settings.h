// SPDX-License-Identifier: Apache-2.0
// Settings of a PathFootprint. footprint/language.h reads them from a scene.
#pragma once
#include <vestige/footprint/deltas.h>

namespace vestige {

enum class RegionShape {
  covariance,      ///< the ellipse with the vectors' second moments
  representative,  ///< PD01's two vectors
};

/// The quantity whose relative change is limited.
enum class Limited {
  contribution,  ///< F, whatever was importance sampled
  score,         ///< F/p [PD01 Sec. 3.4]
};

/// The contribution of a connection to a light to that change.
enum class LightTerm {
  constant,  ///< nothing: the footprint is that of the path up to the surface [PD01 3.2]
  exact,     ///< f cos towards the light, and the light's own factor: Light::logGradient()
};

struct FootprintSettings {
  DeltaPolicy deltas;
  Limited limited = Limited::contribution;
  LightTerm light = LightTerm::constant;
  RegionShape shape = RegionShape::covariance;
  bool alongMajor = false;  ///< images are filtered as in PD01
  bool isOn() const noexcept { return deltas.bound != Bound::none; }
};

/// Largest relative change over a footprint, where limits are wanted and none is given [PD01 4.1].
inline constexpr Real kDefaultLimit = Real(0.7);

}  // namespace vestige
