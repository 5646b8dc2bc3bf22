// SPDX-License-Identifier: Apache-2.0
// What the judge saw, as pictures: of one set of parameters, seen from one place.
//
//     density.png     samples beside the density that they are said to have
//     flux.png        what a light's particles bring beside what sample() says
//     derivative.png  over the unit square of numbers, or over a film: how far derivatives are from
//                     differences
//     emission.png    the same for a light's particles
#pragma once
#include "engine/scene/plugin_library.h"
#include "judge/brdf_tests.h"
#include "judge/camera_tests.h"
#include "judge/light_tests.h"
#include "judge/picture.h"

namespace vestige::judge {

/// None for kinds that have no tests, and where the plugin refuses what it is given.
std::vector<Picture> picturesOf(const Plugin& plugin, const Effort& effort);

/// Which of the pictures of its kind are not there, and why; "": all are.
std::string leftOutPictures(const Plugin& plugin, const std::vector<Picture>& pictures);

std::vector<Picture> brdfPictures(const BrdfCase& c, const Effort& effort);
std::vector<Picture> lightPictures(const LightCase& c, const Effort& effort);
std::vector<Picture> cameraPictures(const CameraCase& c, const Effort& effort);

/// False with `error` in the user's words.
bool writePictures(const std::vector<Picture>& pictures, const std::string& folder,
                   std::string& error);

}  // namespace vestige::judge
