// SPDX-License-Identifier: Apache-2.0
// What of a picture is shown: its colours, or one of the other quantities, made visible.
#pragma once
#include "app/window/window.h"

namespace vestige::app {

/// What the menu offers beside the AOVs of an integrator that has kElementId.
inline constexpr const char* kElementEdges = "element edges";
/// The AOV with a number for each element of a radiosity solution.
inline constexpr const char* kElementId = "element.id";

/// Colours, or (`isAov`) the last quantity of the film scaled to [0, 1]: normals as colours,
/// footprints by their logarithm.
Picture layerOf(const Film::Means& means, bool isAov);
Picture colours(const Image& image);
/// Colours with the borders of elements, where the film has kElementId.
Picture withElementEdges(const Film::Means& means);
/// Relative noise of a picture, guessed from neighbouring pixels: the median over pixels of
/// |luminance - mean of the two beside it| / mean, scaled to a standard error. 0: too small to
/// tell.
double noiseOf(const Picture& picture);

}  // namespace vestige::app
