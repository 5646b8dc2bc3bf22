// SPDX-License-Identifier: Apache-2.0
#include "engine/trace/world.h"
#include "engine/light/shape_light.h"

#include <vestige/tools/sampling.h>

#include "engine/trace/embree.h"
#include "support/catch.h"
#include "support/solids.h"

using namespace vestige;
using namespace vestige::test;

namespace {

constexpr bool kDouble = sizeof(Real) == 8;

std::shared_ptr<Shape> sphereShape(Vec3 c, double r) {
  return makeShape("sphere", {{"centre", vec(c.x, c.y, c.z)}, {"radius", number(r)}});
}

/// A mesh that a Placement can hold: the parts of a shape.
struct Holder final : MeshShape {
  explicit Holder(TriangleMesh m) { parts_.push_back({std::move(m), "", nullptr, {}}); }
};
Placement placed(const std::shared_ptr<const Shape>& shape, const Affine& toWorld = {},
                 int object = 0) {
  Placement p;
  p.shape = shape, p.toWorld = toWorld, p.object = object;
  p.mesh = shape->parts() ? &shape->parts()->front().mesh : nullptr;
  p.closed = shape->isClosed();
  return p;
}
World worldOf(const std::vector<Placement>& placements) {
  World w;
  for (const Placement& p : placements) w.add(p);
  w.commit();
  return w;
}

/// A sphere of triangles, n around, with smooth normals and uv.
TriangleMesh ball(int n, Vec3 centre = {}, Real radius = 1) {
  TriangleMesh m;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= 2 * n; ++i) {
      const double a = 3.14159265358979 * i / n, b = 3.14159265358979 * j / n;
      const Vec3 d{Real(std::sin(b) * std::cos(a)), Real(-std::cos(b)),
                   Real(std::sin(b) * std::sin(a))};
      m.positions.push_back(centre + radius * d), m.normals.push_back(d);
      m.uvs.push_back({Real(i) / (2 * n), Real(j) / n});
    }
  const auto at = [&](int i, int j) { return std::uint32_t(j * (2 * n + 1) + i); };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < 2 * n; ++i) {
      m.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j)});
      m.triangles.push_back({at(i + 1, j + 1), at(i + 1, j), at(i, j + 1)});
    }
  return m;
}

Ray towards(Vec3 from, Vec3 to) { return {from, normalize(to - from), 0, kInfinity}; }

Rgb half(const void*, const Surface&) { return grey(Real(0.5)); }

/// Rays that leave a convex surface at all angles, most of them grazing: outwards they must not
/// meet it again, inwards (if it is closed) they must.
void leaveConvex(const char* what, const World& world, Vec3 centre, double reach, bool closed) {
  INFO(what);
  Random random(21);
  int tried = 0, again = 0, lost = 0;
  while (tried < 4000) {
    const Vec3 from = centre + Real(2.5 * reach) * random.direction();
    const auto s = world.intersect(towards(from, centre + random.inBox(reach * 0.5)));
    if (!s) continue;
    ++tried;
    const Frame f = Frame::around(s->geometricNormal);
    const double up = std::pow(10.0, random.between(-6, 0)), a = random.between(0, 2 * kPi);
    const Vec3 out = normalize(Real(std::cos(a)) * f.s + Real(std::sin(a)) * f.t + Real(up) * f.n);
    again += world.intersect(spawnRay(*s, out)).has_value();
    again += world.transmittance(spawnRay(*s, out), half, nullptr).g < 1;
    const Vec3 in = out - 2 * dot(out, f.n) * f.n;
    // Within an offset of an edge the start lies beyond the other face.
    if (closed && up > 1e-3 && s->offset < 1e-3 * reach)
      lost += !world.intersect(spawnRay(*s, in)).has_value();
  }
  CHECK(again == 0);
  CHECK(lost == 0);
}

}  // namespace

TEST_CASE("an empty world answers", "[world]") {
  World world;
  CHECK(!world.intersect({{0, 0, 0}, {0, 0, 1}, 0, kInfinity}));
  world.commit();
  CHECK(!world.intersect({{0, 0, 0}, {0, 0, 1}, 0, kInfinity}));
  CHECK(world.transmittance({{0, 0, 0}, {0, 0, 1}, 0, kInfinity}, half, nullptr) == grey(1));
  CHECK(world.bounds().isEmpty());
  CHECK(world.patches().empty());
  CHECK(world.triangles() == 0);
  CHECK(!World::embreeVersion().empty());
}

TEST_CASE("a ray that leaves a convex surface does not meet it again", "[world]") {
  struct Case {
    Vec3 centre;
    double radius;
  };
  for (const Case& c : {Case{{0, 0, 0}, 1}, Case{{100, 50, -70}, 1}, Case{{100, 50, -70}, 1e-3},
                        Case{{100, 50, -70}, 1e4}, Case{{10, 10, 10}, 0.01}}) {
    INFO(c.centre.x << " radius " << c.radius);
    const double r = c.radius;
    leaveConvex("sphere", worldOf({placed(sphereShape(c.centre, r))}), c.centre, r, true);
    const Affine move3 = move(c.centre.x, c.centre.y, c.centre.z);
    const Affine oval = move3 * turn({1, 2, 3}, 1) * scale(r, 0.3 * r, 0.7 * r);
    leaveConvex("ellipsoid", worldOf({placed(sphereShape({}, 1), oval)}), c.centre, 0.5 * r, true);
    const auto cube = makeShape("box", {{"corner1", vec(-1, -1, -1)}, {"corner2", vec(1, 1, 1)}});
    leaveConvex("box", worldOf({placed(cube, oval)}), c.centre, 0.5 * r, true);
    const auto can = makeShape(
        "cylinder", {{"base", vec(0, -1, 0)}, {"cap", vec(0, 1, 0)}, {"radius", number(1)}});
    leaveConvex("cylinder", worldOf({placed(can, oval)}), c.centre, 0.5 * r, true);
    if (r < 0.1 && c.centre.x > 50) continue;  // facets of a few rounding steps are not convex
    const auto mesh = std::make_shared<Holder>(ball(8));
    leaveConvex("mesh", worldOf({placed(mesh, oval)}), c.centre, 0.3 * r, true);
    leaveConvex("instance", worldOf({placed(mesh, oval), placed(mesh, move(1e6, 0, 0))}), c.centre,
                0.3 * r, true);
  }
}

TEST_CASE("a ray that leaves a large floor does not meet it again", "[world]") {
  for (const double size : {10.0, 1e3, 1e5}) {
    INFO(size);
    TriangleMesh floor;
    const Real s = Real(size);
    floor.positions = {{-s, Real(0.3), -s}, {s, Real(0.3) + s / 10, -s}, {-s, Real(0.3), s}};
    floor.triangles = {{0, 2, 1}};
    const auto shape = std::make_shared<Holder>(floor);
    leaveConvex("triangle", worldOf({placed(shape, turn({1, 0, 1}, 0.3))}), {-s / 2, 0, -s / 2},
                size / 2, false);
    const auto quad = makeShape(
        "quad",
        {{"corner", vec(-s, 0.3, -s)}, {"edge1", vec(2 * s, 0, 1)}, {"edge2", vec(0, 0.1, 2 * s)}});
    leaveConvex("quad", worldOf({placed(quad, turn({1, 0, 1}, 0.3))}), {}, size, false);
  }
}

TEST_CASE("a lamp does not shadow itself, however flat its light falls", "[world]") {
  const auto disc = makeShape(
      "disc", {{"centre", vec(0, 0, 0)}, {"normal", vec(0, -1, 0)}, {"radius", number(0.5)}});
  const auto can = makeShape(
      "cylinder", {{"base", vec(0, 0, 0)}, {"cap", vec(1, 0, 0)}, {"radius", number(0.3)}});
  TriangleMesh sheet;
  sheet.positions = {{-1, 0, -1}, {1, 0, -1}, {-1, 0, 1}, {1, 0, 1}};
  sheet.triangles = {{0, 1, 2}, {1, 3, 2}};
  const auto quad = std::make_shared<Holder>(sheet), solid = std::make_shared<Holder>(ball(5));
  const auto floor = makeShape("plane", {{"normal", vec(0, 1, 0)}, {"distance", number(0)}});
  for (const double far : {0.0, 1e2, 1e4}) {
    const Affine there = move(far, 2 * far, -far), above = there * move(0, 1.2, 0);
    for (const auto& lamp : std::vector<std::vector<Placement>>{
             {placed(sphereShape({}, 1), above)},
             {placed(sphereShape({Real(far), 0, 0}, 1), move(0, 1.2 + 2 * far, -far))},
             {placed(disc, above)},
             {placed(can, above * turn({0, 1, 0}, 0.7))},
             {placed(quad, above)},
             {placed(solid, above)},
             {placed(solid, above), placed(solid, above * move(0, 4, 0) * turn({1, 2, 3}, 1))}}) {
      std::vector<Placement> all = lamp;
      all.push_back(placed(floor, there));
      const World world = worldOf(all);
      const auto light = makeShapeLight(
          lamp[0], [](const SurfacePoint&) { return grey(1); }, false, grey(1));
      Random random(3);
      int drawn = 0, dark = 0;
      for (int k = 0; k < 20000; ++k) {
        const double r = std::pow(10, random.between(0.3, 2.3)), a = random.between(0, 6.28);
        const Vec3 at = there.point({Real(r * std::cos(a)), Real(0.5), Real(r * std::sin(a))});
        const auto s = world.intersect({at, {0, -1, 0}, 0, kInfinity});
        if (!s) continue;
        const Real u = Real(random.between(0, 1)), v = Real(random.between(0, 1));
        const auto sample = light->sample({s->position}, {u, v});
        if (!sample || sample->hit.toLight.y <= 0) continue;
        ++drawn;
        dark += world.transmittance(shadowRay(*s, sample->hit), half, nullptr).r < 1;
      }
      INFO("lamp " << lamp[0].shape.get() << ", " << lamp.size() << " of them, " << far << " away");
      CHECK(drawn > 1000);
      CHECK(dark == 0);
    }
  }
}

TEST_CASE("what floats a thousandth above a surface stays apart from it", "[world]") {
  TriangleMesh sheet;
  sheet.positions = {{5, 9, 5}, {15, 9, 5}, {5, 9, 15}};
  sheet.triangles = {{0, 2, 1}};
  const auto shape = std::make_shared<Holder>(sheet);
  const auto quad = makeShape(
      "quad", {{"corner", vec(0, 9.001, 0)}, {"edge1", vec(0, 0, 20)}, {"edge2", vec(20, 0, 0)}});
  const World world = worldOf({placed(shape, {}, 1), placed(quad, {}, 2)});
  const auto first = world.intersect({{7, 20, 7}, {0, -1, 0}, 0, kInfinity});
  REQUIRE(first);
  CHECK(first->object == 2);
  const auto second = world.intersect(spawnRay(*first, {0, -1, 0}));
  REQUIRE(second);
  CHECK(second->object == 1);
  const auto back = world.intersect(spawnRay(*second, {0, 1, 0}));
  REQUIRE(back);
  CHECK(back->object == 2);
  CHECK(back->distance == Approx(0.001).epsilon(0.05));
}

TEST_CASE("an instance is met where the same mesh in place is", "[world]") {
  const auto shared = std::make_shared<Holder>(ball(12));
  const std::vector<Affine> places = {move(3, 0, 0) * turn({0, 1, 1}, 0.5),
                                      move(-3, 1, 0) * scale(-1, 0.5, 2),
                                      move(0, 0, 4) * turn({1, 1, 0}, 2) * scale(0.3, 1, 1)};
  World instanced, baked;
  for (std::size_t k = 0; k < places.size(); ++k) {
    instanced.add(placed(shared, places[k], int(k)));
    baked.add(placed(std::make_shared<Holder>(ball(12)), places[k], int(k)));
  }
  instanced.commit(), baked.commit();
  CHECK(instanced.triangles() * 3 == baked.triangles());
  CHECK(instanced.patches().size() == baked.patches().size());
  Random random(4);
  int hits = 0;
  for (int k = 0; k < 3000; ++k) {
    const Ray ray = towards(Real(12) * random.direction(), random.inBox(4));
    const auto a = instanced.intersect(ray), b = baked.intersect(ray);
    if (!a || !b || a->primitive != b->primitive || a->object != b->object) {
      CHECK((!a == !b || k % 50 == 0));  // a silhouette may differ by rounding
      continue;
    }
    ++hits;
    CHECK(a->distance == Approx(b->distance).epsilon(1e-4));
    CHECK(length(a->position - b->position) < 1e-4);
    CHECK(length(a->geometricNormal - b->geometricNormal) < 1e-4);
    CHECK(length(a->normal - b->normal) < 1e-3);
    CHECK(length(a->dPdu - b->dPdu) < 1e-3 * length(a->dPdu));
    CHECK(length(a->dNdv - b->dNdv) < 2e-3 * (1 + length(a->dNdv)));
    CHECK(a->patch == b->patch);
    const Vec3 out = places[std::size_t(a->object)].inverse().point(
        a->position + Real(0.05) * a->geometricNormal);
    CHECK(length(out) > length(places[std::size_t(a->object)].inverse().point(a->position)));
  }
  CHECK(hits > 300);
  for (std::size_t k = 0; k < instanced.patches().size(); k += 37) {
    const Patch& a = instanced.patches()[k];
    const Patch& b = baked.patches()[k];
    CHECK(a.area == Approx(b.area).epsilon(1e-4));
    CHECK(length(a.normal - b.normal) < 1e-3);
  }
}

TEST_CASE("a smooth mesh has the derivatives of its neighbouring points", "[world]") {
  const Affine place = move(1, 2, 3) * turn({1, 2, 3}, 1) * scale(1, -0.5, 1.7);
  const World world = worldOf({placed(std::make_shared<Holder>(ball(6)), place)});
  const Real h = kDouble ? Real(1e-4) : Real(3e-3);
  Random random(8);
  int tried = 0;
  for (int k = 0; k < 3000; ++k) {
    const Ray ray = towards(Vec3{1, 2, 3} + Real(5) * random.direction(), {1, 2, 3});
    const auto s = world.intersect(ray);
    if (!s || std::abs(dot(s->geometricNormal, ray.direction)) < Real(0.3)) continue;
    for (const Vec3 aside : {Frame::around(ray.direction).s, Frame::around(ray.direction).t}) {
      Ray left = ray, right = ray;
      left.origin -= h * aside, right.origin += h * aside;
      const auto a = world.intersect(left), b = world.intersect(right);
      if (!a || !b || a->primitive != s->primitive || b->primitive != s->primitive) continue;
      const Vec2 d = b->uv - a->uv, dB = b->patchUv - a->patchUv;
      const Vec3 dP = b->position - a->position, dN = b->normal - a->normal;
      CHECK(length(dP - (d.x * s->dPdu + d.y * s->dPdv)) < 2e-3 * length(dP));
      CHECK(length(dN - (d.x * s->dNdu + d.y * s->dNdv)) < 1e-2 * (length(dN) + length(dP)));
      CHECK(std::abs(dB.x) + std::abs(dB.y) > 0);
      ++tried;
    }
    CHECK(dot(s->normal, s->geometricNormal) > Real(0.7));
  }
  CHECK(tried > 200);
}

TEST_CASE("a mesh without usable uv has a frame all the same", "[world]") {
  TriangleMesh m;
  m.positions = {{0, 0, 0}, {2, 0, 0}, {0, 1, 0}};
  m.uvs = {{Real(0.5), Real(0.5)}, {Real(0.5), Real(0.5)}, {Real(0.5), Real(0.5)}};
  m.triangles = {{0, 1, 2}};
  const World world = worldOf({placed(std::make_shared<Holder>(m))});
  const auto s = world.intersect(towards({Real(0.3), Real(0.3), -2}, {Real(0.3), Real(0.3), 0}));
  REQUIRE(s);
  CHECK(length(cross(s->dPdu, s->dPdv)) > 0.1);
  CHECK(s->geometricNormal.z == Approx(1));  // cross(b - a, c - a)
}

TEST_CASE("broken triangles are left out and counted", "[world]") {
  TriangleMesh m;
  const Real nan = std::numeric_limits<Real>::quiet_NaN();
  m.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {nan, 0, 0}, {2, 0, 0}, {kInfinity, 0, 1}};
  m.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {0, 2, 5}, {0, 0, 2}, {0, 1, 77}};
  const World world = worldOf({placed(std::make_shared<Holder>(m))});
  CHECK(world.triangles() == 1);
  CHECK(world.dropped() == 5);
  CHECK(world.bounds().high.x == 1);
  CHECK(world.intersect(towards({Real(0.2), Real(0.2), 3}, {Real(0.2), Real(0.2), 0})));
  TriangleMesh none;
  none.triangles = {{0, 1, 2}};
  const World empty = worldOf({placed(std::make_shared<Holder>(none))});
  CHECK(empty.dropped() == 1);
  CHECK(!empty.intersect(towards({0, 0, 3}, {0, 0, 0})));
}

TEST_CASE("light passes what lets it through, layer by layer", "[world]") {
  const auto layers = [](int n, bool wall, bool behind) {
    World w;
    for (int k = 0; k < n; ++k) {
      Placement p =
          placed(k % 2 ? makeShape("plane", {{"normal", vec(0, 0, 1)}, {"distance", number(1 + k)}})
                       : makeShape("disc", {{"centre", vec(0, 0, 1 + k)},
                                            {"normal", vec(0, 0, 1)},
                                            {"radius", number(1)}}));
      p.translucent = true;
      w.add(p);
    }
    if (wall) w.add(placed(sphereShape({0, 0, behind ? Real(500) : Real(2.5)}, 0.1)));
    w.commit();
    return w;
  };
  const Ray ray{{Real(0.01), Real(0.02), 0}, {0, 0, 1}, 0, 100};
  CHECK(layers(0, false, false).transmittance(ray, half, nullptr) == grey(1));
  CHECK(layers(5, false, false).transmittance(ray, half, nullptr) == grey(Real(1.0 / 32)));
  CHECK(layers(5, true, false).transmittance(ray, half, nullptr) == Rgb{});
  CHECK(layers(5, true, true).transmittance(ray, half, nullptr) == grey(Real(1.0 / 32)));
  Ray near = ray;
  near.tMax = Real(2.5);
  CHECK(layers(5, false, false).transmittance(near, half, nullptr) == grey(Real(0.25)));
  near.tMin = Real(1.5);
  CHECK(layers(5, false, false).transmittance(near, half, nullptr) == grey(Real(0.5)));
}

TEST_CASE("parts of patches have their share of the area", "[world]") {
  TriangleMesh m;
  m.positions = {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}};
  m.triangles = {{0, 1, 2}};
  const World world = worldOf({placed(std::make_shared<Holder>(m), scale(1, 1, 1), 4),
                               placed(sphereShape({}, 1), scale(1, 2, 3), 5)});
  REQUIRE(world.patches().size() == 2);
  CHECK(world.patches()[0].area == Approx(3));
  CHECK(world.patches()[0].isTriangle);
  CHECK(world.patches()[0].object == 4);
  CHECK(world.patchArea(0, {0, 0}, {1, 1}) == Approx(3));
  CHECK(world.patchArea(0, {0, 0}, {Real(0.5), Real(0.5)}) == Approx(1.5));
  CHECK(world.patchArea(0, {Real(0.5), Real(0.5)}, {1, 1}) == Approx(0).margin(1e-6));
  CHECK(world.patchArea(0, {Real(0.5), 0}, {1, 1}) == Approx(0.75));
  // Ellipsoid with half-axes 1, 2, 3: its area by the elliptic integrals is 48.8821.
  CHECK(world.patches()[1].area == Approx(48.8821).epsilon(1e-4));
  double sum = 0;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      sum += double(
          world.patchArea(1, {Real(i) / 4, Real(j) / 4}, {Real(i + 1) / 4, Real(j + 1) / 4}));
  CHECK(sum == Approx(48.8821).epsilon(1e-4));
  CHECK(length(world.patches()[1].normal) == 0);
}

TEST_CASE("a failure of Embree is an exception with a reason", "[world]") {
  const embree::Device device = embree::newDevice();
  embree::check(device.get(), "doing nothing");
  rtcCommitScene(nullptr);  // noted for the thread, not for the device
  const embree::Scene scene(rtcNewScene(device.get()));
  rtcDetachGeometry(scene.get(), 17);
  CHECK_THROWS_WITH(embree::check(device.get(), "testing"),
                    containsText("Embree failed while testing"));
}
