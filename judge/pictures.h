// SPDX-License-Identifier: Apache-2.0
// What the judge saw, as pictures.
#pragma once
#include <string>

#include "engine/scene/plugin_library.h"
#include "judge/verdict.h"

namespace vestige::judge {

/// For a BRDF, density.png: samples (left) beside pdf() (right) over the sphere, longitude across,
/// +z above; and derivative.png: over the unit square of numbers, how far du is from differences,
/// white where it is further than allowed, grey where differences say nothing. Of the defaults, 45
/// degrees from the normal. Nothing for other kinds. False with `error` in the user's words.
bool writePictures(const Plugin& plugin, const Effort& effort, const std::string& folder,
                   std::string& error);

}  // namespace vestige::judge
