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

/// One library, with several sets of parameters of its schema. Kinds without tests are only created
/// with their defaults: Judgement::unchecked lists what was not tested.
Judgement judgePlugin(const Plugin& plugin, const Effort& effort);

/// Judges one BRDF with several sets of parameters. `schema`: inputs that a texture may drive out
/// of their range; null: none.
Judgement judgeBrdf(const BrdfCases& cases, const Schema* schema, const Effort& effort);
/// Judges one light, or camera, with several sets of parameters.
Judgement judgeLight(const LightCases& cases, const Effort& effort);
Judgement judgeCamera(const CameraCases& cases, const Effort& effort);

}  // namespace vestige::judge
