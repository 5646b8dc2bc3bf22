// SPDX-License-Identifier: Apache-2.0
// The judge's instruments, by their own names in tests.
#pragma once
#include "judge/differences.h"
#include "judge/sphere_grid.h"
#include "judge/statistics.h"
#include "judge/trusted_difference.h"

namespace vestige::test {
using namespace judge;
}
