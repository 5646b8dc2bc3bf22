// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vestige/scene_desc.h>

namespace vestige::lang {

/// Hash of the meaning: equal for two texts that describe the same scene with the same words in any
/// layout. Stable between runs and machines.
std::uint64_t hashOf(const SceneDesc& scene);

}  // namespace vestige::lang
