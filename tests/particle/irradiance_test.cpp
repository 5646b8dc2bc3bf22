// SPDX-License-Identifier: Apache-2.0
// What the picture sees of the elements: one value on each, or a surface without jumps.
#include <map>
#include <random>

#include "particle/solve.h"

using namespace vestige;
using namespace vestige::particle;
using test::sceneOf;

namespace {

/// Deposits of one density everywhere, but so that elements have all sizes.
void fillEvenly(Hierarchy& h, const SceneView& scene) {
  // A checker of depths: the flux of an element is its area, and nobody above has any.
  for (int patch = 0; patch < int(scene.patches().size()); ++patch) {
    const auto fill = [&](auto&& self, ElementId e, const Cell& cell, unsigned seed,
                          int depth) -> void {
      seed = seed * 1664525u + 1013904223u;
      if (depth < 2 || (depth < 5 && seed >> 30 != 0)) {
        const ElementId first = h.divide(e, patch, cell);
        for (int k = 0; k < 4; ++k)
          self(self, first + ElementId(k), cell.child(k), seed + unsigned(k) * 77u, depth + 1);
        return;
      }
      const auto f = std::int64_t(double(h.elements()[e].area) * 0x1p40);
      h.elements()[e].deposit({f, f, f}, 0);
    };
    fill(fill, Hierarchy::rootOf(patch, false), h.cellOf(patch), unsigned(patch), 0);
  }
}

}  // namespace

TEST_CASE("even light is even, on elements and between them", "[particle]") {
  for (const char* shape : {"sphere { <0, 0, 0>, 1 }", "box { <0, 0, 0>, <1, 2, 3> }",
                            "triangle { <0, 0, 0>, <1, 0, 0>, <0, 1, 0> }\ntriangle { <1, 1, 0>, "
                            "<0, 1, 0>, <1, 0, 0> }",
                            "torus { 2, 0.5 }", "quad { <0, 0, 0>, <1, 0, 0>, <0, 2, 0> }"}) {
    INFO(shape);
    const auto scene =
        sceneOf(std::string("camera pinhole { location <0, 0, -9> look_at <0, 0, 0> }\n") + shape);
    Hierarchy h(scene->view(), settings(Oracle::footprint));
    fillEvenly(h, scene->view());
    const Irradiance light(scene->view(), h, 0x1p-40);
    CHECK(light.leaves() > 10);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> number;
    for (int i = 0; i < 2000; ++i) {
      PatchPoint p{i % int(scene->view().patches().size()),
                   false,
                   {Real(number(random)), Real(number(random))}};
      if (p.uv.x + p.uv.y > 1) p.uv = {1 - p.uv.x, 1 - p.uv.y};
      REQUIRE(light.at(p, false).r == Approx(1).epsilon(1e-4));
      REQUIRE(light.at(p, true).r == Approx(1).epsilon(1e-4));
    }
  }
}

TEST_CASE("between vertices nothing jumps: not in a patch, not from one to the next",
          "[particle]") {
  // Two triangles and a quad of very different subdivision, side by side in one plane.
  const auto scene = sceneOf(
      "camera pinhole { location <0, 0, -9> look_at <0, 0, 0> }\n"
      "triangle { <0, 0, 0>, <1, 0, 0>, <0, 1, 0> }\n"
      "triangle { <1, 1, 0>, <0, 1, 0>, <1, 0, 0> }\n"
      "quad { <1, 0, 0>, <1, 0, 0>, <0, 1, 0> }\n");
  Hierarchy h(scene->view(), settings(Oracle::footprint));
  std::mt19937 random(9);
  std::uniform_real_distribution<double> number;
  std::vector<bool> sides;  // which side of each patch looks to the camera
  for (int i = 0; i < 3; ++i) sides.push_back(scene->view().patches()[std::size_t(i)].normal.z > 0);
  for (int i = 0; i < 400; ++i) {
    const int patch = i % 3;
    Vec2 uv = {Real(number(random)), Real(number(random))};
    if (patch < 2 && uv.x + uv.y > 1) uv = {1 - uv.x, 1 - uv.y};
    const auto f = std::int64_t(1000 * number(random));
    // One of them much finer than the others.
    h.deposit({patch, sides[std::size_t(patch)], uv}, Real(patch == 1 ? 1e-4 : 2e-2), {f, f, f});
  }
  const Irradiance light(scene->view(), h, 1);

  const auto at = [&](Real x, Real y) {
    Surface s;
    REQUIRE(scene->view().intersect(Ray{{x, y, -5}, {0, 0, 1}, 0, kInfinity}, s));
    return double(light.at(patchPointOf(s, {0, 0, -1}), true).r);
  };
  double highest = 0, jump = 0, slope = 0;
  for (int i = 0; i < 40000; ++i) {
    const Real angle = Real(number(random) * 2 * kPi), step = Real(1e-5);
    const Real x = Real(0.01 + 1.98 * number(random)), y = Real(0.01 + 0.98 * number(random));
    const double a = at(x, y), b = at(x + step * std::cos(angle), y + step * std::sin(angle));
    const double c = at(x + 64 * step * std::cos(angle), y + 64 * step * std::sin(angle));
    highest = std::max(highest, a);
    jump = std::max(jump, std::abs(b - a)), slope = std::max(slope, std::abs(c - a) / 64);
  }
  CHECK(highest > 0);
  // A crack would show as a step of some share of the highest value; a slope over 1e-5 is less.
  CHECK(jump <= 4 * slope + 1e-3 * highest);
  CHECK(jump < 0.01 * highest);

  // Across the patches' edges: where cracks would be.
  double crack = 0;
  for (int i = 0; i < 4000; ++i) {
    const Real t = Real(0.001 + 0.998 * number(random)), step = Real(1e-5);
    crack = std::max(crack, std::abs(at(1 - step, t) - at(1 + step, t)));
    crack = std::max(crack, std::abs(at(t - step, 1 - t - step) - at(t + step, 1 - t + step)));
  }
  CHECK(crack < 0.01 * highest);
}

TEST_CASE("the finest elements of neighbours differ by one level at most", "[particle]") {
  const auto scene = sceneOf(
      "camera pinhole { location <0, 0, -9> look_at <0, 0, 0> }\n"
      "quad { <0, 0, 0>, <1, 0, 0>, <0, 1, 0> }\n");
  Hierarchy h(scene->view(), settings(Oracle::footprint));
  h.deposit({0, false, {Real(0.51), Real(0.51)}}, Real(1e-5), {1, 1, 1});
  const Irradiance light(scene->view(), h, 1);
  // From one element of level 8 to level 1 beside it takes many more than the 4 + 3 * 8 there were.
  CHECK(light.leaves() > 3 * 8 + 1);
}

TEST_CASE("all elements of a closed room together get what its lamp sends, and sends again",
          "[particle]") {
  // Of flux P a wall that reflects r of it sees P + r P + r^2 P + ... = P / (1 - r).
  const double r = 0.4, power = 4 * double(kPi) * 1.5;
  const Solution s = solve(box("brdf lambert { diffuse rgb 0.4 }") +
                               "light point { <0.7, 1.1, 1.2> intensity rgb 1.5 }\n",
                           200000, settings(Oracle::footprint));
  const SceneView& scene = s.scene->view();
  const Irradiance light(scene, *s.hierarchy, s.scale());
  std::map<std::pair<int, std::uint32_t>, SeenElement> seen;
  constexpr int kSide = 512;  // finer than min_area allows elements to be
  for (int patch = 0; patch < 6; ++patch)
    for (const bool back : {false, true})
      for (int i = 0; i < kSide * kSide; ++i) {
        const PatchPoint p{
            patch, back, {Real(i % kSide + 0.5) / kSide, Real(i / kSide + 0.5) / kSide}};
        const SeenElement e = light.seen(p);
        CHECK_FALSE(e.area <= 0);
        if (light.at(p, false).r > 0)
          REQUIRE(double(e.flux.r / e.area) == Approx(double(light.at(p, false).r)));
        seen[{2 * patch + back, e.id}] = e;
      }
  double flux = 0, area = 0;
  std::uint64_t hits = 0;
  for (const auto& [where, e] : seen)
    flux += double(e.flux.r), area += double(e.area), hits += e.hits;
  CHECK(seen.size() > 500);
  CHECK(flux == Approx(power / (1 - r)).epsilon(0.01));
  CHECK(area == Approx(2 * 24).epsilon(0.001));
  CHECK(hits <= s.booking.hits);
  CHECK(hits > 0);
}

TEST_CASE("a side that nothing reached is dark and costs nothing", "[particle]") {
  const auto scene = sceneOf(
      "camera pinhole { location <0, 0, -9> look_at <0, 0, 0> }\n"
      "quad { <0, 0, 0>, <1, 0, 0>, <0, 1, 0> }\nquad { <5, 0, 0>, <1, 0, 0>, <0, 1, 0> }\n");
  Hierarchy h(scene->view(), settings(Oracle::footprint));
  h.deposit({0, false, {Real(0.5), Real(0.5)}}, 2, {1, 1, 1});
  const Irradiance light(scene->view(), h, 1);
  CHECK(light.leaves() == 1);
  CHECK(light.covers({1, true, {Real(0.5), Real(0.5)}}));
  CHECK(light.at({1, true, {Real(0.5), Real(0.5)}}, true).r == 0);
  CHECK_FALSE(Irradiance().covers({0, false, {}}));
}
