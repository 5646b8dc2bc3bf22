// SPDX-License-Identifier: Apache-2.0
// Whatever numbers come, no BRDF answers with NaN, infinity or a negative density: grazing angles,
// the ends of the random numbers' interval, all parameters, and textures that leave their range.
#include "judge/brdf_tests.h"
#include "support/brdf_events.h"

using namespace vestige;
using namespace vestige::test;

namespace {

void fuzz(int events) {
  for (const LoadedPlugin& plugin : pluginsOfKind("brdf"))
    check(judge::nothingIsNan(judge::brdfCases(plugin, 40), plugin.schema, events, 1));
}

}  // namespace

TEST_CASE("nothing is ever infinite, negative or not a number", "[brdf][fuzz]") { fuzz(150000); }

TEST_CASE("nothing is ever infinite, for long", "[brdf][fuzz][slow]") { fuzz(15000000); }
