// SPDX-License-Identifier: Apache-2.0
// The derivatives that every BRDF owes: of its sampled direction by the random numbers and by
// toPrev, and of log f. Area identity and five-point differences, on every BRDF library found.
#include "judge/brdf_tests.h"
#include "support/brdf_events.h"

using namespace vestige;
using namespace vestige::test;

namespace {

/// Every set of parameters at 2000 events, and 1000 random sets of each plugin at ten.
template <class Test>
void checkConfigurations(const Test& test) {
  check(test(brdfCases(), {.samples = 32000}));
  check(test(randomBrdfCases(1000), {.samples = 160}));
}

}  // namespace

TEST_CASE("the derivative's area is the density's inverse", "[brdf][derivatives]") {
  checkConfigurations(judge::areaIsInverseDensity);
}

TEST_CASE("du is the derivative of the sampling map by its numbers", "[brdf][derivatives]") {
  checkConfigurations(judge::duIsTheDerivative);
}

TEST_CASE("dPrev is the derivative of the sampling map by toPrev", "[brdf][derivatives]") {
  // A lobe built in a frame around its axis may turn that frame as it likes; the derivative is the
  // one without spin, so the frame's own spin is taken out of the differences. A lobe that is not
  // built so has no spin to take out. Which of the two a lobe is, it has to be at every event.
  checkConfigurations(judge::dPrevIsTheDerivative);
}

TEST_CASE("logGradient is the derivative of log f", "[brdf][derivatives]") {
  checkConfigurations(judge::logGradientIsTheDerivative);
}
