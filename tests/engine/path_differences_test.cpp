// SPDX-License-Identifier: Apache-2.0
// Whole paths through the real engine: every differential at every vertex against differences of
// the path itself.
#include "support/room_of_everything.h"

using namespace vestige;
using namespace vestige::test;

TEST_CASE("differentials of whole paths are the paths' derivatives", "[engine][footprint]") {
  const TempFolder folder;
  const auto scene = built(everything(folder.path()));
  const PathTracer tracer(*scene, 1);
  Random random(11);
  Judged result;
  for (int i = 0; i < 400; ++i) judgePath(tracer, randomNumbers(random, 6), 6, result);
  INFO("asked " << result.asked << ", judged " << result.judged);
  INFO("dV median " << result.position.at(0.5) << ", 99 % " << result.position.at(0.99));
  INFO("dD median " << result.direction.at(0.5) << ", 99 % " << result.direction.at(0.99));
  INFO("g median " << result.gradient.at(0.5) << ", 99 % " << result.gradient.at(0.99));
  CHECK(result.judged > result.asked / 2);
  for (Errors* e : {&result.position, &result.direction, &result.gradient}) checkErrors(*e);
}
