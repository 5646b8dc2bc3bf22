// SPDX-License-Identifier: Apache-2.0
// From a pixel and a sample's index to the path that an integrator follows.
#pragma once
#include "engine/render/pixel_filter.h"

namespace vestige {

/// What all paths of one render have in common.
struct PathSource {
  const SceneView& scene;
  const Camera& camera;
  PixelFilterSampler filter;
  int width, height;  ///< of the whole film, pixels
  std::uint32_t seed = 0;
  std::uint64_t declaredSamples = 0;  ///< as in PathContext
  bool wantsFootprint = false;
  bool wantsJacobian = false;
};

/// Where the results of a path go.
struct PathOutputs {
  Counters& counters;
  Aovs* aovs = nullptr;
  PathRecord* record = nullptr;
};

struct StartedPath {
  PathContext context;
  Rgb weight;  ///< of the radiance that estimate() returns; black: no ray leaves the camera there
};

/// Sample `index` of pixel (x, y). [any thread]
StartedPath startPath(const PathSource& source, int x, int y, std::uint32_t index,
                      const PathOutputs& outputs) noexcept;

}  // namespace vestige
