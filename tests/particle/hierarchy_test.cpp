// SPDX-License-Identifier: Apache-2.0
// Elements: division, clusters, and which one a footprint lands in.
#include <random>
#include <thread>

#include "particle/solve.h"
#include "plugins/integrator/particle/clusters.h"

using namespace vestige;
using namespace vestige::particle;
using test::sceneOf;

namespace {

const char* kTriangle =
    "camera pinhole { location <0, 0, -5> look_at <0, 0, 0> }\n"
    "triangle { <0, 0, 0>, <1, 0, 0>, <0, 1, 0> }\n";
const char* kBall =
    "camera pinhole { location <0, 0, -5> look_at <0, 0, 0> }\n"
    "sphere { <0, 0, 0>, 1 scale <1, 0.5, 2> }\n";

/// The element whose own flux is not zero.
ElementId hit(const Hierarchy& h) {
  for (ElementId e = 1; e < h.elements().size(); ++e)
    if (h.elements()[e].hits() > 0) return e;
  return 0;
}

}  // namespace

TEST_CASE("a place keeps its place in every child it falls into", "[particle]") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number;
  for (const bool isTriangle : {false, true})
    for (int i = 0; i < 2000; ++i) {
      Vec2 p = {Real(number(random)), Real(number(random))};
      if (isTriangle && p.x + p.y > 1) p = {1 - p.x, 1 - p.y};
      Cell cell{{}, {1, 0}, {0, 1}, isTriangle};
      Vec2 local = p;
      for (int level = 0; level < 6; ++level) {
        cell = cell.child(descend(local, isTriangle));
        INFO(level << ": " << local.x << " " << local.y);
        CHECK(local.x >= 0);
        CHECK(local.y >= 0);
        CHECK((isTriangle ? local.x + local.y : std::max(local.x, local.y)) <= Real(1.0001));
        const Vec2 back = cell.at(local);
        CHECK(std::abs(back.x - p.x) + std::abs(back.y - p.y) < Real(1e-5));
      }
    }
}

TEST_CASE("an element's children have its area, whatever the surface", "[particle]") {
  for (const char* text : {kTriangle, kBall}) {
    const auto scene = sceneOf(text);
    Hierarchy h(scene->view(), settings(Oracle::footprint));
    for (int i = 0; i < 200; ++i) {
      const Vec2 uv = {Real(i % 20) / 45, Real(i / 20) / 23};
      h.deposit({0, false, uv}, Real(1e-3), {1, 0, 0});
    }
    for (ElementId e = 1; e < h.elements().size(); ++e) {
      const ElementId first = h.elements()[e].children;
      if (first == 0) continue;
      double sum = 0;
      for (ElementId k = 0; k < 4; ++k) sum += double(h.elements()[first + k].area);
      CHECK(sum == Approx(double(h.elements()[e].area)).epsilon(1e-5));
    }
  }
}

TEST_CASE("a particle lands in the largest element that is just smaller than its footprint",
          "[particle]") {
  const auto scene = sceneOf(box("brdf lambert { diffuse rgb 0.5 }"));
  HierarchySettings how = settings(Oracle::footprint);
  how.maxLevel = 8, how.minArea = Real(0.001);
  for (const Real area : {Real(100), Real(4), Real(3.9), Real(1), Real(0.3), Real(0.02), Real(0)}) {
    Hierarchy h(scene->view(), how);
    h.deposit({2, false, {Real(0.3), Real(0.6)}}, area, {1, 2, 3});
    const Element& e = h.elements()[hit(h)];
    INFO("footprint " << area << ", element " << e.area);
    CHECK(e.sum() == Flux{1, 2, 3});
    if (area >= Real(0.02)) CHECK(e.area <= area);
    if (e.parent) CHECK(h.elements()[e.parent].area > area);
    CHECK(e.area >= how.minArea);
    if (area == 0) CHECK(e.level == 5);  // 4 / 4^5; the next would be smaller than allowed
  }
}

TEST_CASE("clusters gather patches of one plane, not what they do not face", "[particle]") {
  // A floor of 4 x 4 tiles, a wall on it, and a far tile.
  std::string text = "camera pinhole { location <0, 5, 0> look_at <0, 0, 0.1> }\n";
  for (int i = 0; i < 16; ++i)
    text += "quad { <" + std::to_string(i % 4) + ", 0, " + std::to_string(i / 4) +
            ">, <0, 0, 1>, <1, 0, 0> }\n";
  text += "quad { <0, 0, 4>, <0, 4, 0>, <4, 0, 0> }\nquad { <40, 0, 0>, <0, 0, 1>, <1, 0, 0> }\n";
  const auto scene = sceneOf(text);
  Hierarchy h(scene->view(), settings(Oracle::footprint, true));
  REQUIRE(h.clusterEnd() > h.firstCluster());
  double widest = 0;
  for (ElementId e = h.firstCluster(); e < h.clusterEnd(); ++e)
    widest = std::max(widest, double(h.elements()[e].area));
  CHECK(widest <= 16.001);  // the floor, never with the wall or the far tile
  CHECK(widest >= 15.999);

  const PatchPoint place{5, false, {Real(0.5), Real(0.5)}};
  h.deposit(place, 1000, {8, 8, 8});
  const ElementId e = hit(h);
  CHECK(e >= h.firstCluster());
  // What lies in a cluster is handed down evenly to its members, and to their fronts only.
  const Irradiance light(scene->view(), h, 1);
  const Real share = 8 / h.elements()[e].area;
  CHECK(light.at(place, false).r == Approx(double(share)));
  CHECK(light.at({5, true, place.uv}, false).r == 0);
  CHECK(light.at({16, false, place.uv}, false).r == 0);
  CHECK(light.at({17, false, place.uv}, false).r == 0);
}

TEST_CASE("a plane has elements around the scene and none far away", "[particle]") {
  const auto scene = sceneOf(
      "camera pinhole { location <0, 2, -5> look_at <0, 0, 0> }\n"
      "plane { y, 0 }\nsphere { <10, 1, 7>, 1 }\n");
  const SceneView& view = scene->view();
  int plane = -1;
  for (std::size_t i = 0; i < view.patches().size(); ++i)
    if (!std::isfinite(view.patches()[i].area)) plane = int(i);
  REQUIRE(plane >= 0);
  Hierarchy h(view, settings(Oracle::footprint));
  const auto below = [&](Vec3 from) {
    Surface s;
    REQUIRE(view.intersect(Ray{from, {0, -1, 0}, 0, kInfinity}, s));
    return patchPointOf(s, {0, 1, 0});
  };
  CHECK(h.root(below({12, 5, 7})) == Hierarchy::rootOf(plane, false));
  CHECK(h.root(below({1000, 5, 7})) == 0);
  h.deposit(below({12, 5, 7}), Real(0.1), {1, 1, 1});
  CHECK(h.elements()[hit(h)].area <= Real(0.1));
  CHECK(h.elements()[hit(h)].area > Real(0.02));
}

TEST_CASE("many threads divide the same elements once", "[particle]") {
  const auto scene = sceneOf(box("brdf lambert { diffuse rgb 0.5 }"));
  const auto fill = [&](int threads) {
    auto h = std::make_unique<Hierarchy>(scene->view(), settings(Oracle::footprint));
    const auto work = [&](int first) {
      for (int i = first; i < 8000; i += threads)
        h->deposit({i % 6, false, {Real(i % 89) / 89, Real(i % 97) / 97}}, Real(i % 13) / 500,
                   {i, 2 * i, 1});
    };
    std::vector<std::thread> all;
    for (int t = 0; t < threads; ++t) all.emplace_back(work, t);
    for (std::thread& t : all) t.join();
    return h;
  };
  const auto one = fill(1), four = fill(4);
  CHECK(one->elements().size() == four->elements().size());
  const Irradiance a(scene->view(), *one, 1), b(scene->view(), *four, 1);
  CHECK(a.leaves() == b.leaves());
  for (int i = 0; i < 3000; ++i) {
    const PatchPoint p{i % 6, false, {Real(i % 71) / 71, Real(i % 73) / 73}};
    REQUIRE(a.at(p, false).g == b.at(p, false).g);
    REQUIRE(a.at(p, true).g == b.at(p, true).g);
    REQUIRE(a.element(p).id == b.element(p).id);
  }
}

TEST_CASE("a particle's footprint is its share of what its light sends", "[particle]") {
  const std::string floor =
      "camera pinhole { location <0, 2, -5> look_at <0, 0, 0> }\n"
      "quad { <-4, 0, -4>, <0, 0, 8>, <8, 0, 0> }\n";
  const std::uint64_t n = 4096;
  for (const char* light : {"light point { <0, 1, 0> intensity rgb 1 }",
                            "light distant { direction -y irradiance rgb 1 }",
                            "light spot { location <0, 1, 0> point_at <0, 0, 0> intensity rgb 1 "
                            "radius 30 falloff 40 }"}) {
    INFO(light);
    HierarchySettings how = settings(Oracle::footprint);
    how.maxLevel = 12, how.minArea = Real(1e-7), how.edges = false;
    const Solution s = solve(floor + light + "\n", n, how);
    double hits = 0, elements = 0;
    for (ElementId e = 1; e < s.hierarchy->elements().size(); ++e)
      if (s.hierarchy->elements()[e].hits() > 0)
        hits += double(s.hierarchy->elements()[e].hits()), ++elements;
    // N^(1/3) = 16 particles share a footprint; an element is a quarter to the whole of one.
    CHECK(hits > 0.2 * double(n));
    CHECK(hits / elements > 3);
    CHECK(hits / elements < 20);
  }
}
