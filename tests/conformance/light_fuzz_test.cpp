// SPDX-License-Identifier: Apache-2.0
// Whatever the schema allows and wherever one stands, no light and no camera answers with NaN,
// infinity or a negative density: the ends of the random numbers, points in the plane of a light,
// on it, a hair above it and far away, film corners, films like ribbons.
#include "judge/camera_tests.h"
#include "judge/light_tests.h"
#include "support/findings.h"
#include "support/harsh.h"

namespace vestige::test {

TEST_CASE("light: nothing is ever infinite, negative or not a number", "[light][fuzz]") {
  Random r(51);
  judge::LightCases cases;
  for (const HarshCase<Light>& c : harshCases<Light>("light", 60, r)) {
    c.made->setScene({{-3, -2, -3}, {3, 2, 4}});
    cases.push_back({c.title, c.made});
  }
  CHECK(cases.size() >= 5 * 60);
  check(judge::lightIsNeverNan(cases, {.samples = 16 * 1000, .seed = 51}));
}

TEST_CASE("camera: nothing is ever infinite or not a number", "[camera][fuzz]") {
  Random r(52);
  judge::CameraCases cases;
  for (const HarshCase<Camera>& c : harshCases<Camera>("camera", 100, r))
    cases.push_back({c.title, c.made});
  CHECK(cases.size() >= 4 * 100);
  check(judge::cameraIsNeverNan(cases, {.samples = 16 * 500, .seed = 52}));
}

}  // namespace vestige::test
