// SPDX-License-Identifier: Apache-2.0
// What solids absorb of particles, by Beer's law.
#include "particle/solve.h"

using namespace vestige;
using namespace vestige::particle;

TEST_CASE("particles are absorbed on their way through a solid", "[particle][dielectrics]") {
  // A narrow beam straight down through 2 units of water onto an almost black floor in it, and
  // through a sheet that the water's priority takes away.
  const Solution s = solve(
      "camera pinhole { location <0, 3, -5> look_at <0, 0, 0> }\n"
      "light spot { <0, 2, 0> intensity rgb 1 point_at <0, 0, 0> radius 1 falloff 1.1 }\n"
      "quad { <-1, 0, -1>, 2*z, 2*x brdf lambert { diffuse rgb 1e-4 } }\n"
      "box { <-5, -1, -5>, <5, 5, 5> brdf glass { ior 1.33 absorption rgb <0.2, 0.7, 0> } }\n"
      "box { <-3, 0.5, -3>, <3, 1, 3> brdf glass { ior 1.6 priority -1 absorption rgb 9 } }\n",
      20000, settings(Oracle::footprint));
  const Booking& b = s.booking;
  int floor = -1;
  for (int k = 0; k < int(s.scene->view().patches().size()); ++k)
    if (s.scene->view().patches()[std::size_t(k)].area == Approx(4)) floor = k;
  REQUIRE(floor >= 0);
  const double absorption[] = {0.2, 0.7, 0};
  for (std::size_t c = 0; c < 3; ++c) {
    const double arrived = double(s.total(floor)[c]) / double(b.emitted[c]);
    CHECK(arrived == Approx(std::exp(-2 * absorption[c])).epsilon(1e-3));
    CHECK(double(b.emitted[c] + b.gained[c]) ==
          Approx(double(b.absorbed[c] + b.escaped[c] + b.lost[c])).epsilon(1e-12));
    CHECK(double(b.escaped[c]) < 1e-3 * double(b.emitted[c]));
  }
}
