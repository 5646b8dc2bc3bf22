// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vestige/integrator.h>

#include <string>

namespace vestige {

/// What is wrong with the AOVs that an integrator declares, as the rest of a sentence; "" if
/// nothing is.
std::string whatIsWrong(std::span<const AovSlot> slots);

}  // namespace vestige
