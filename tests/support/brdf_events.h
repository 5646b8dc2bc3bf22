// SPDX-License-Identifier: Apache-2.0
// Events of the BRDF suite, and the judge's findings of them as checks.
#pragma once
#include "judge/brdf_event.h"
#include "support/brdf_cases.h"
#include "support/findings.h"
