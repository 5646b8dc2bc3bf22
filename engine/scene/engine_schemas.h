// SPDX-License-Identifier: Apache-2.0
// What the engine adds to the language beside the plugins: rows that every brdf and every shape
// understands, and blocks that are no plugins.
#pragma once
#include <vestige/schema.h>

#include <vector>

namespace vestige {

/// Blocks without a plugin: film, union.
std::vector<Schema> engineSchemas();

/// A plugin's schema as the language sees it: blocks of the engine's own kinds stand where they
/// may; inputs are texturable; a brdf has `normal_map` and `opacity` after its own inputs and
/// `opacity_cutoff` (and `priority` and `absorption`, if it may refract) after its parameters, a
/// shape `emission` and a brdf inside; shapes and lights say to which rays they are visible.
Schema withEngineRows(Schema schema);

/// How many inputs withEngineRows() appends to a brdf: normal_map, then opacity.
inline constexpr int kBrdfRows = 2;
inline constexpr const char* kNormalMap = "normal_map";
inline constexpr const char* kOpacity = "opacity";
/// Names of the rows that it appends to a shape.
inline constexpr const char* kEmission = "emission";
inline constexpr const char* kEmissionSides = "emission_sides";
/// ... to a shape, a union and a light.
inline constexpr const char* kVisibleTo = "visible_to";
inline constexpr const char* kNoShadow = "no_shadow";
inline constexpr const char* kNoImage = "no_image";
inline constexpr const char* kNoReflection = "no_reflection";
/// ... to the parameters of a brdf.
inline constexpr const char* kOpacityCutoff = "opacity_cutoff";
/// ... of a brdf that has a refractive index, or holds others that may.
inline constexpr const char* kPriority = "priority";
inline constexpr const char* kAbsorption = "absorption";

}  // namespace vestige
