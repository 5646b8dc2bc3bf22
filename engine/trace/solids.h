// SPDX-License-Identifier: Apache-2.0
// Which placements are dielectric solids, and which of them may overlap.
#pragma once
#include <vector>

#include "engine/trace/tree.h"

namespace vestige {

/// Sets Item::solid of items whose bounds are known. Returns the solids by number, the first of
/// which stands for none.
/// `mostAtOnce` receives an estimate of the most solids around one point.
std::vector<World::Solid> numberSolids(std::vector<Item>& items, int& mostAtOnce);

}  // namespace vestige
