// SPDX-License-Identifier: Apache-2.0
// Where the flux goes: nothing is lost that is not booked, and no oracle moves any from patch to
// patch.
#include <fstream>

#include "particle/solve.h"
#include "plugins/integrator/particle/solution_file.h"
#include "support/temp_folder.h"

using namespace vestige;
using namespace vestige::particle;

namespace {

/// A diffuse ball and one of ground glass in a room with a lamp, a spot and a window.
std::string furnished() {
  return box("brdf lambert { diffuse rgb <0.7, 0.5, 0.3> }") +
         "light area { <0.8, 1.9, 0.8>, <0.4, 0, 0>, <0, 0, 0.4> radiance rgb <20, 18, 12> }\n"
         "light point { <1.8, 1.5, 0.3> intensity rgb <0.5, 0.6, 0.7> }\n"
         "sphere { <0.6, 0.5, 1>, 0.4 brdf lambert { diffuse rgb 0.6 } }\n"
         "sphere { <1.4, 0.6, 1.1>, 0.4 brdf glass { ior 1.5 } }\n"
         "sphere { <1.0, 0.3, 0.5>, 0.2 brdf principled { base_color rgb 0.5 roughness 0.3 } }\n";
}

std::string furnace(double reflectance) {
  return box("brdf lambert { diffuse rgb " + std::to_string(reflectance) +
             " } emission rgb <1, 0.5, 0.25>");
}

void checkSame(const Solution& a, const Solution& b) {
  REQUIRE(a.scene->view().patches().size() == b.scene->view().patches().size());
  CHECK(a.booking.emitted == b.booking.emitted);
  CHECK(a.booking.hits == b.booking.hits);
  const int n = int(a.scene->view().patches().size());
  const Irradiance left(a.scene->view(), *a.hierarchy, a.scale());
  const Irradiance right(b.scene->view(), *b.hierarchy, b.scale());
  CHECK(left.leaves() == right.leaves());
  for (int i = 0; i < 20000; ++i) {
    PatchPoint p{i % n, false, {Real(i % 131) / 131, Real(i % 137) / 137}};
    REQUIRE(left.at(p, false).r == right.at(p, false).r);
    REQUIRE(left.at(p, true).b == right.at(p, true).b);
    REQUIRE(left.element(p).id == right.element(p).id);
  }
}

}  // namespace

TEST_CASE("emitted = absorbed + escaped, when roulette is booked", "[particle]") {
  const Solution s = solve(furnished(), 40000, settings(Oracle::footprint, true));
  const Booking& b = s.booking;
  for (std::size_t c = 0; c < 3; ++c) {
    CHECK(b.emitted[c] > 0);
    CHECK(b.absorbed[c] > 0);
    CHECK(double(b.emitted[c] + b.gained[c]) ==
          Approx(double(b.absorbed[c] + b.escaped[c] + b.lost[c])).epsilon(1e-12));
    // Roulette is fair in the mean.
    CHECK(double(b.gained[c]) == Approx(double(b.lost[c])).epsilon(0.05));
    CHECK(double(b.emitted[c]) * s.scale() <= 1.02 * s.power);
  }
  CHECK(double(b.emitted[0]) * s.scale() == Approx(s.power).epsilon(0.02));
  CHECK(b.escaped[0] == 0);  // the room is closed

  const Solution open = solve(
      "camera pinhole { location <0, 2, -5> look_at <0, 0, 0> }\n"
      "light point { <0, 1, 0> intensity rgb 1 }\nquad { <-1, 0, -1>, <0, 0, 2>, <2, 0, 0> }\n",
      20000, settings(Oracle::footprint));
  CHECK(open.booking.escaped[0] > open.booking.absorbed[0]);
}

TEST_CASE("no oracle moves flux from patch to patch: bit for bit", "[particle]") {
  HierarchySettings whole = settings(Oracle::footprint);
  whole.maxLevel = 0;  // no hierarchy at all
  const Solution plain = solve(furnished(), 20000, whole);
  for (const Oracle oracle : {Oracle::footprint, Oracle::variance, Oracle::uniform}) {
    const Solution s = solve(furnished(), 20000, settings(oracle));
    CHECK(s.hierarchy->elements().size() > plain.hierarchy->elements().size() + 100);
    for (int i = 0; i < int(s.scene->view().patches().size()); ++i)
      for (const bool back : {false, true}) CHECK(s.total(i, back) == plain.total(i, back));
  }
  // Clusters take some of it, and hand it down again: by no more than the footprints are wide.
  const Solution c = solve(furnished(), 20000, settings(Oracle::footprint, true));
  CHECK(c.booking.hits == plain.booking.hits);
}

TEST_CASE("the same solution by one thread and by two", "[particle]") {
  for (const Oracle oracle : {Oracle::footprint, Oracle::variance, Oracle::uniform}) {
    INFO(int(oracle));
    checkSame(solve(furnished(), 20000, settings(oracle, true), 1),
              solve(furnished(), 20000, settings(oracle, true), 2));
  }
}

TEST_CASE("three parts of one declared total add up to the whole", "[particle]") {
  const test::TempFolder folder;
  const std::uint64_t n = 20000;
  HierarchySettings how = settings(Oracle::footprint, true);
  how.edges = false;  // parts know nothing of each other's hits
  const Solution whole = solve(furnished(), n, how);
  Solution sum = solve(furnished(), n, how, 1, 0, 1);
  sum.booking = {};
  sum.hierarchy = std::make_unique<Hierarchy>(sum.scene->view(), how);
  SolutionKey key{fingerprint(sum.scene->view(), *sum.hierarchy), 0, 0};
  for (std::uint64_t part = 0; part < 3; ++part) {
    const Solution s = solve(furnished(), n, how, 2, n * part / 3, n * (part + 1) / 3);
    const std::string file = folder.path() + "/" + std::to_string(part) + ".solution";
    saveSolution(file, {fingerprint(s.scene->view(), *s.hierarchy), n, s.power}, s.booking,
                 *s.hierarchy);
    addSolution(file, key, sum.booking, *sum.hierarchy);
  }
  CHECK(key.particles == n);
  CHECK(sum.booking.particles == n);
  sum.power = key.power;
  checkSame(whole, sum);
}

TEST_CASE("what is no solution of this scene is refused, with a reason", "[particle]") {
  const test::TempFolder folder;
  const Solution s = solve(furnished(), 2000, settings(Oracle::footprint));
  const SolutionKey key{fingerprint(s.scene->view(), *s.hierarchy), 2000, s.power};
  const std::string file = folder.path() + "/a.solution";
  saveSolution(file, key, s.booking, *s.hierarchy);
  std::string bytes;
  {
    std::ifstream in(file, std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(in), {});
  }
  const auto why = [&](const std::string& content, SolutionKey wanted = {}) {
    std::ofstream(file, std::ios::binary) << content;
    Hierarchy into(s.scene->view(), settings(Oracle::footprint));
    Booking b;
    if (wanted.surfaces == 0) wanted = {key.surfaces, 0, 0};
    try {
      addSolution(file, wanted, b, into);
    } catch (const std::runtime_error& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  CHECK(why(bytes) == "");
  CHECK_THAT(why(bytes, {key.surfaces + 1, 0, 0}), containsText("other surfaces"));
  CHECK_THAT(why(bytes, {key.surfaces, 3000, s.power}),
             containsText("another number of particles"));
  CHECK_THAT(why(bytes.substr(0, bytes.size() - 7)), containsText("is damaged"));
  CHECK_THAT(why(bytes.substr(0, 60)), containsText("is damaged"));
  CHECK_THAT(why("P3 2 2"), containsText("is no radiosity solution"));
  std::remove(file.c_str());
  Hierarchy into(s.scene->view(), settings(Oracle::footprint));
  Booking b;
  SolutionKey any = key;
  CHECK_THROWS_WITH(addSolution(file, any, b, into), containsText("cannot be read"));
  CHECK_THROWS_WITH(checkSolutionFile("/nowhere/a"), containsText("cannot be written"));
}

TEST_CASE("memory that is used up stops refinement between passes", "[particle]") {
  HierarchySettings how = settings(Oracle::footprint);
  how.memory = 200 * sizeof(Element);
  const Solution s = solve(furnished(), 40000, how), t = solve(furnished(), 40000, how, 1);
  CHECK(s.filled);
  CHECK(s.hierarchy->isFull());
  checkSame(s, t);
  // The flux is all there, on coarser elements.
  const Solution plain = solve(furnished(), 40000, settings(Oracle::footprint));
  CHECK(s.hierarchy->elements().size() < plain.hierarchy->elements().size());
  for (int i = 0; i < 6; ++i) CHECK(s.total(i) == plain.total(i));
}

TEST_CASE("in a furnace all is as bright as it has to be", "[particle]") {
  // Radiance e / (1 - r) everywhere: irradiance pi times that.
  const Solution s = solve(furnace(0.5), 100000, settings(Oracle::footprint));
  for (int i = 0; i < 6; ++i) CHECK(s.irradiance(i) == Approx(2 * double(kPi)).epsilon(0.02));
}

TEST_CASE("in a furnace, to half a percent", "[particle][slow]") {
  for (const double r : {0.2, 0.5, 0.8}) {
    const Solution s = solve(furnace(r), 10'000'000, settings(Oracle::footprint));
    for (int i = 0; i < 6; ++i) {
      std::printf("furnace;%.1f;patch %d;%.5f of what it should be\n", r, i,
                  s.irradiance(i) / (double(kPi) / (1 - r)));
      CHECK(s.irradiance(i) == Approx(double(kPi) / (1 - r)).epsilon(0.005));
    }
  }
}

TEST_CASE("a dark scene, an empty one, and lights that shine on nothing", "[particle]") {
  const Solution dark =
      solve(box("brdf lambert { diffuse rgb 0.5 }"), 100, settings(Oracle::footprint));
  CHECK(dark.power == 0);
  CHECK(dark.booking.hits == 0);
  const std::string camera = "camera pinhole { location <0, 2, -5> look_at <0, 0, 0> }\n";
  CHECK(solve(camera, 100, settings(Oracle::footprint, true)).booking.hits == 0);
  const Solution point = solve(camera + "light point { <0, 1, 0> intensity rgb 1 }\n", 100,
                               settings(Oracle::footprint, true));
  CHECK(point.booking.hits == 0);
  CHECK(point.booking.escaped[0] == point.booking.emitted[0]);
}
