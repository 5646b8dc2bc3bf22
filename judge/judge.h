// SPDX-License-Identifier: Apache-2.0
// Judges a plugin: whether its methods keep the contracts of brdf.h, light.h and camera.h, and if
// not, which of them is at fault.
//
//     const Judgement j = judgePlugin(plugin, effort);
//     if (const Verdict* v = j.failure()) std::cout << v->sentence << '\n' << v->worst << '\n';
#pragma once
#include "judge/brdf_tests.h"
#include "judge/camera_tests.h"
#include "judge/light_tests.h"

namespace vestige::judge {

/// One library, with several sets of parameters of its schema. Kinds that have no tests of their
/// own are created with their defaults: Judgement::unchecked says what that leaves open.
Judgement judgePlugin(const Plugin& plugin, const Effort& effort);

/// `schema` tells which inputs a texture may take out of their range; null: none. The same brdf
/// under several sets of parameters.
Judgement judgeBrdf(const BrdfCases& cases, const Schema* schema, const Effort& effort);
/// The same light, or camera, under several sets of parameters.
Judgement judgeLight(const LightCases& cases, const Effort& effort);
Judgement judgeCamera(const CameraCases& cases, const Effort& effort);

}  // namespace vestige::judge
