// SPDX-License-Identifier: Apache-2.0
// The judge's findings as checks of Catch2.
#pragma once
#include "judge/verdict.h"
#include "support/catch.h"

namespace vestige::test {

using judge::Finding;
using judge::WorstEvent;

inline void check(const WorstEvent& worst) {
  INFO(worst.event);
  CHECK(worst.events > 0);
  CHECK(worst.error <= 1);
}

inline void check(const Finding& finding) {
  INFO(finding.test);
  check(finding.worst);
  if (finding.asked > 0) CHECK(finding.judged > finding.asked / 3);
}

}  // namespace vestige::test
