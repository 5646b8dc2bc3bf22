// SPDX-License-Identifier: Apache-2.0
// Pictures of a plugin's samples and errors, for one set of parameters and one receiver.
//
//     density.png     samples beside the density that they are said to have
//     flux.png flux of a light's particles beside that of sample() derivative.png over the unit
//     square of numbers, or over a film: how far derivatives are from
//                     differences
//     emission.png    the same for a light's particles
#pragma once
#include "engine/scene/plugin_library.h"
#include "judge/brdf_tests.h"
#include "judge/camera_tests.h"
#include "judge/light_tests.h"
#include "judge/picture.h"

namespace vestige::judge {

/// No pictures for kinds without tests, or if the plugin refuses all parameters.
std::vector<Picture> picturesOf(const Plugin& plugin, const Effort& effort);

/// The pictures of its kind that are missing, with the reason; "": none.
std::string leftOutPictures(const Plugin& plugin, const std::vector<Picture>& pictures);

std::vector<Picture> brdfPictures(const BrdfCase& c, const Effort& effort);
std::vector<Picture> lightPictures(const LightCase& c, const Effort& effort);
std::vector<Picture> cameraPictures(const CameraCase& c, const Effort& effort);

/// False with `error` in the user's words.
bool writePictures(const std::vector<Picture>& pictures, const std::string& folder,
                   std::string& error);

}  // namespace vestige::judge
