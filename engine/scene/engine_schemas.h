// SPDX-License-Identifier: Apache-2.0
// What the engine adds to the language beside the plugins: rows that every brdf and every shape
// understands, and blocks that are no plugins.
#pragma once
#include <vestige/schema.h>

#include <vector>

namespace vestige {

/// Blocks without a plugin: film, union.
std::vector<Schema> engineSchemas();

/// A plugin's schema as the language sees it: blocks of the engine's own kinds stand where they may;
/// inputs are texturable; a brdf has `normal_map` and
/// `opacity` after its own inputs, a shape `emission` and a brdf inside.
Schema withEngineRows(Schema schema);

/// How many inputs withEngineRows() appends to a brdf: normal_map, then opacity.
inline constexpr int kBrdfRows = 2;
/// Names of the rows that it appends to a shape.
inline constexpr const char* kEmission = "emission";
inline constexpr const char* kEmissionSides = "emission_sides";

}  // namespace vestige
