// SPDX-License-Identifier: Apache-2.0
// A recorded path as a drawing: from the side, and its footprint at each vertex.
#pragma once
#include <string>

#include "app/path_text.h"

namespace vestige::app {

/// An SVG. Each vertex that carries differentials gets a panel: the segments delta dV, the polygon
/// that they span together and the ellipse that textures are looked up over.
std::string pathSvg(const RecordedPath& path, const LoadedScene& loaded);

}  // namespace vestige::app
