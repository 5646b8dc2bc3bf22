// SPDX-License-Identifier: Apache-2.0
#include "engine/light/shape_light.h"
#include "engine/trace/world.h"
#include "support/catch.h"
#include "support/solids.h"

using namespace vestige;
using namespace vestige::test;

namespace {

constexpr bool kDouble = sizeof(Real) == 8;

World worldOf(const std::shared_ptr<Shape>& shape, const Affine& toWorld) {
  World world;
  Placement p;
  p.shape = shape, p.toWorld = toWorld, p.object = 7, p.closed = shape->isClosed();
  p.isDielectric = true;
  world.add(p);
  world.commit();
  return world;
}

Affine skewed() {
  return move(0.3, -0.2, 0.5) * turn({1, 2, 3}, 0.7) * scale(1.4, 0.6, 0.9) * turn({0, 1, 1}, 1.1);
}
Affine mirrored() { return turn({1, 0, 1}, 0.4) * scale(-1, 1, 1.3); }

/// A ray from outside through the middle of things.
Ray rayThrough(Random& random, double reach) {
  const Vec3 from = Real(2 * reach) * random.direction();
  return {from, normalize(random.inBox(reach * 0.6) - from), 0, kInfinity};
}

/// Meetings of a ray with all surfaces, one after the other.
int crossings(const World& world, Ray ray) {
  int n = 0;
  while (const auto s = world.intersect(ray)) {
    ++n;
    ray.tMin = s->distance * (1 + Real(1e-5)) + Real(1e-5);
  }
  return n;
}

}  // namespace

TEST_CASE("shapes meet rays where small steps along them do", "[shape]") {
  for (const Solid& solid : solids()) {
    INFO(solid.name);
    const auto shape = solid.make();
    Random random(3);
    int hits = 0, wrong = 0;
    for (int k = 0; k < 400; ++k) {
      Ray ray = rayThrough(random, solid.reach);
      if (k % 2) ray.origin = random.inBox(1.5);  // from within, too
      if (k % 3 == 0) ray.direction = Real(0.37) * ray.direction;
      const double limit = 4 * solid.reach / length(ray.direction);
      const double expected = march(solid, ray, limit);
      const auto hit = shape->intersect(ray);
      hits += hit.has_value();
      const double found = hit ? double(hit->t) : std::numeric_limits<double>::infinity();
      // Edges may fall either way: there the next crossing of one is the other's.
      const bool same = std::isinf(expected) ? std::isinf(found) || found > limit
                                             : std::abs(found - expected) < 2e-4 * limit;
      wrong += !same;
      if (!hit) continue;
      const Vec3 p = ray.at(hit->t);
      CHECK(std::abs(solid.side(p)) < (kDouble ? 1e-10 : 2e-5));
      const SurfacePoint s = shape->surface(p, *hit);
      CHECK(length(s.position - p) < (kDouble ? 1e-10 : 2e-5));
      Ray rest = ray;  // limits hold
      rest.tMax = hit->t * Real(0.999);
      CHECK(!shape->intersect(rest));
      rest.tMin = hit->t * Real(1.001), rest.tMax = kInfinity;
      if (const auto next = shape->intersect(rest)) CHECK(next->t > rest.tMin);
    }
    CHECK(hits > 40);
    CHECK(wrong <= 2);
  }
}

TEST_CASE("normals of closed shapes point outwards however they are placed", "[shape]") {
  for (const Solid& solid : solids()) {
    if (!solid.closed) continue;
    INFO(solid.name);
    for (const Affine& place : {Affine{}, skewed(), mirrored(), scale(-2, -1, -1)}) {
      const World world = worldOf(solid.make(), place);
      Random random(5);
      int seen = 0;
      for (int k = 0; k < 300; ++k) {
        const auto s = world.intersect(rayThrough(random, solid.reach));
        if (!s) continue;
        ++seen;
        const Vec3 out = s->position + Real(0.01) * s->geometricNormal;
        CHECK(solid.side(place.inverse().point(out)) > 0);
        CHECK(length(s->geometricNormal) == Approx(1).epsilon(1e-5));
        CHECK(s->solid == 1);
        CHECK(s->object == 7);
      }
      CHECK(seen > 30);
    }
  }
}

TEST_CASE("derivatives by uv agree with neighbouring rays under any placement", "[shape]") {
  const Real h = kDouble ? Real(1e-4) : Real(4e-3);
  const double tolerance = kDouble ? 1e-5 : 2e-2;
  for (const Solid& solid : solids()) {
    INFO(solid.name);
    for (const Affine& place : {skewed(), mirrored()}) {
      const World world = worldOf(solid.make(), place);
      Random random(9);
      int tried = 0;
      for (int k = 0; k < 300; ++k) {
        const Ray ray = rayThrough(random, solid.reach);
        const auto s = world.intersect(ray);
        if (!s || std::abs(dot(s->geometricNormal, ray.direction)) < Real(0.3)) continue;
        const Frame frame = Frame::around(ray.direction);
        for (const Vec3 aside : {frame.s, frame.t}) {
          Ray left = ray, right = ray;
          left.origin -= h * aside, right.origin += h * aside;
          const auto a = world.intersect(left), b = world.intersect(right);
          if (!a || !b || a->primitive != s->primitive || b->primitive != s->primitive) continue;
          const Vec2 d = b->uv - a->uv;
          if (std::abs(d.x) > Real(0.05) || std::abs(d.y) > Real(0.05)) continue;  // pole or seam
          const Vec3 dP = b->position - a->position, dN = b->normal - a->normal;
          CHECK(length(dP - (d.x * s->dPdu + d.y * s->dPdv)) < tolerance * length(dP));
          CHECK(length(dN - (d.x * s->dNdu + d.y * s->dNdv)) <
                tolerance * (length(dN) + (kDouble ? 1e-3 : 1) * length(dP)));
          ++tried;
        }
        CHECK(std::abs(dot(s->geometricNormal, s->dPdu)) < 1e-4 * length(s->dPdu));
        CHECK(std::abs(dot(s->geometricNormal, s->dPdv)) < 1e-4 * length(s->dPdv));
        CHECK(std::abs(dot(s->normal, s->dNdu)) < 1e-4 * (1 + length(s->dNdu)));
      }
      CHECK(tried > 50);
    }
  }
}

TEST_CASE("areas agree with school and with lines thrown at the shape", "[shape]") {
  for (const Solid& solid : solids()) {
    INFO(solid.name);
    const auto shape = solid.make();
    CHECK(shape->area() == Approx(solid.area).epsilon(1e-5));
    for (const Affine& place : {Affine{}, skewed()}) {
      const World world = worldOf(shape, place);
      double patches = 0;
      for (const Patch& p : world.patches()) patches += double(p.area);
      if (place.isIdentity()) CHECK(patches == Approx(solid.area).epsilon(1e-5));
      Placement p;
      p.shape = shape, p.toWorld = place;
      const auto light = makeShapeLight(
          p, [](const SurfacePoint&) { return grey(1); }, false, grey(1));
      CHECK(light->power().r / kPi == Approx(patches).epsilon(1e-2));
      // Cauchy and Crofton: random lines through a sphere of radius R cross a surface of area A
      // A / (2 pi R^2) times on average.
      const Real R = 5;
      Random random(11);
      double count = 0;
      const int lines = 40000;
      for (int k = 0; k < lines; ++k) {
        const Vec3 d = random.direction();
        const Frame f = Frame::around(d);
        const double r = R * std::sqrt(random.number()), a = random.between(0, 2 * kPi);
        const Vec3 across = Real(r * std::cos(a)) * f.s + Real(r * std::sin(a)) * f.t;
        count += crossings(world, {across - Real(10) * d, d, 0, kInfinity});
      }
      const double found = count / lines * 2 * kPi * R * R;
      CHECK(std::abs(found - patches) < 0.04 * patches + 0.3);
    }
  }
}

TEST_CASE("points drawn from a shape are on it, uniform, and carry their derivatives", "[shape]") {
  const Real h = kDouble ? Real(1e-5) : Real(2e-3);
  const double tolerance = kDouble ? 1e-5 : 2e-2;
  for (const Solid& solid : solids()) {
    INFO(solid.name);
    const auto shape = solid.make();
    Random random(13);
    int wrong = 0;  // next to where seams meet
    for (int k = 0; k < 400; ++k) {
      const Vec2 u = random.square();
      if (u.x < 2 * h || u.y < Real(0.02) || u.x > 1 - 2 * h || u.y > Real(0.98)) continue;
      const AreaSample s = shape->samplePoint(u);
      CHECK(std::abs(solid.side(s.point.position)) < (kDouble ? 1e-10 : 3e-5));
      CHECK(s.pdf == Approx(1 / solid.area).epsilon(1e-5));
      CHECK(length(cross(s.du.c[0], s.du.c[1])) * s.pdf == Approx(1).epsilon(2e-3));
      for (const int axis : {0, 1}) {
        // From the left or from the right: the map has seams, and faces have borders.
        bool agrees = false;
        for (const Real step : {h, -h}) {
          Vec2 a = u, b = u;
          (axis ? a.y : a.x) += step, (axis ? b.y : b.x) += 2 * step;
          const AreaSample sa = shape->samplePoint(a), sb = shape->samplePoint(b);
          const auto slope = [&](Vec3 f0, Vec3 f1, Vec3 f2) {
            return (Real(4) * f1 - Real(3) * f0 - f2) / (2 * step);
          };
          const Vec3 dP = slope(s.point.position, sa.point.position, sb.point.position);
          const Vec3 dN = slope(s.point.normal, sa.point.normal, sb.point.normal);
          agrees |= length(dP - s.du.c[axis]) < tolerance * (1 + length(dP)) &&
                    length(dN - s.dNdu.c[axis]) < tolerance * (1 + length(dN));
        }
        wrong += !agrees;
      }
    }
    CHECK(wrong <= (kDouble ? 2 : 8));
  }
}

TEST_CASE("a face's point at uv is the point that has this uv", "[shape]") {
  for (const Solid& solid : solids()) {
    INFO(solid.name);
    const auto shape = solid.make();
    Random random(17);
    for (int k = 0; k < 200; ++k) {
      const Vec2 uv{Real(random.between(0.01, 0.99)), Real(random.between(0.05, 0.95))};
      const int face = int(random.number() * shape->faces());
      const SurfacePoint p = shape->at(uv, face), s = shape->surface(p.position, {0, face});
      CHECK(length(s.position - p.position) < 1e-5);
      CHECK(s.uv.x == Approx(uv.x).margin(1e-4));
      CHECK(s.uv.y == Approx(uv.y).margin(1e-4));
      CHECK(length(s.dPdu - p.dPdu) < 1e-3 * length(p.dPdu));
      CHECK(length(s.normal - p.normal) < 1e-4);
    }
  }
}

TEST_CASE("poles keep a frame", "[shape]") {
  const auto sphere = makeShape("sphere", {{"centre", vec(0, 0, 0)}, {"radius", number(2)}});
  const auto disc = makeShape(
      "disc", {{"centre", vec(0, 0, 0)}, {"normal", vec(0, 1, 0)}, {"radius", number(1)}});
  const auto cone = makeShape("cone", {{"base", vec(0, 0, 0)},
                                       {"base_radius", number(1)},
                                       {"cap", vec(0, 1, 0)},
                                       {"cap_radius", number(0)}});
  for (const SurfacePoint& s : {sphere->surface({0, 2, 0}, {}), sphere->surface({0, -2, 0}, {}),
                                disc->surface({0, 0, 0}, {}), cone->surface({0, 1, 0}, {})}) {
    CHECK(isFinite(s.dPdu));
    CHECK(isFinite(s.normal));
    CHECK(length(cross(normalize(s.dPdu), normalize(s.dPdv))) > 0.5);
  }
}

TEST_CASE("uv is where the language says", "[shape]") {
  const auto uv = [](const std::shared_ptr<Shape>& s, Vec3 p, int part) {
    return s->surface(p, {0, part}).uv;
  };
  const auto sphere = makeShape("sphere", {{"centre", vec(0, 0, 0)}, {"radius", number(1)}});
  CHECK(uv(sphere, {0, 0, 1}, 0).x == Approx(0.25));
  CHECK(uv(sphere, {-1, 0, 0}, 0).x == Approx(0.5));
  CHECK(uv(sphere, {1, 0, 0}, 0).y == Approx(0.5));
  CHECK(uv(sphere, {0, -1, 0}, 0).y == Approx(0).margin(1e-6));
  const auto cylinder =
      makeShape("cylinder", {{"base", vec(0, 1, 0)}, {"cap", vec(0, 3, 0)}, {"radius", number(1)}});
  CHECK(uv(cylinder, {0, Real(2.5), 1}, 0).x == Approx(0.25));
  CHECK(uv(cylinder, {0, Real(2.5), 1}, 0).y == Approx(0.75));
  const auto plane = makeShape("plane", {{"normal", vec(0, 3, 0)}, {"distance", number(2)}});
  CHECK(plane->surface({5, 2, 7}, {}).position.y == Approx(2));
  CHECK(uv(plane, {5, 2, 7}, 0).x == Approx(5));
  CHECK(uv(plane, {5, 2, 7}, 0).y == Approx(7));
  const auto quad = makeShape(
      "quad", {{"corner", vec(-1, 5, -1)}, {"edge1", vec(2, 0, 0)}, {"edge2", vec(0, 0, 2)}});
  CHECK(quad->surface({0, 5, 0}, {}).geometricNormal.y == Approx(-1));  // LANGUAGE: shines down
  // A box's face read from outside: the right-hand end of the front face is at +x, of the back
  // face at -x.
  const auto box = makeShape("box", {{"corner1", vec(0, 0, 0)}, {"corner2", vec(1, 1, 1)}});
  Ray front{{Real(0.9), Real(0.2), -5}, {0, 0, 1}, 0, kInfinity};
  auto hit = box->intersect(front);
  REQUIRE(hit);
  CHECK(uv(box, front.at(hit->t), hit->part).x == Approx(0.9));
  Ray back{{Real(0.9), Real(0.2), 5}, {0, 0, -1}, 0, kInfinity};
  hit = box->intersect(back);
  REQUIRE(hit);
  CHECK(uv(box, back.at(hit->t), hit->part).x == Approx(0.1));
  CHECK(uv(box, back.at(hit->t), hit->part).y == Approx(0.2));
}

TEST_CASE("shapes without a surface are refused in words", "[shape]") {
  CHECK_THAT(whyRefused("box", {{"corner1", vec(0, 0, 0)}, {"corner2", vec(1, 0, 1)}}),
             containsText("flat"));
  CHECK_THAT(whyRefused("plane", {{"normal", vec(0, 0, 0)}}), containsText("direction"));
  CHECK_THAT(
      whyRefused("disc",
                 {{"centre", vec(0, 0, 0)}, {"normal", vec(0, 0, 0)}, {"radius", number(1)}}),
      containsText("direction"));
  CHECK_THAT(whyRefused("disc", {{"centre", vec(0, 0, 0)},
                                 {"normal", vec(0, 1, 0)},
                                 {"radius", number(1)},
                                 {"hole_radius", number(1)}}),
             containsText("hole"));
  CHECK_THAT(whyRefused("cylinder",
                        {{"base", vec(1, 1, 1)}, {"cap", vec(1, 1, 1)}, {"radius", number(1)}}),
             containsText("same point"));
  CHECK_THAT(whyRefused("cone", {{"base", vec(0, 0, 0)},
                                 {"base_radius", number(0)},
                                 {"cap", vec(0, 1, 0)},
                                 {"cap_radius", number(0)}}),
             containsText("radii"));
  CHECK_THAT(whyRefused("torus", {{"major_radius", number(1)}, {"minor_radius", number(2)}}),
             containsText("tube"));
  CHECK_THAT(
      whyRefused("quad",
                 {{"corner", vec(0, 0, 0)}, {"edge1", vec(1, 2, 3)}, {"edge2", vec(2, 4, 6)}}),
      containsText("parallel"));
  CHECK_THAT(
      whyRefused("triangle", {{"a", vec(0, 0, 0)}, {"b", vec(1, 1, 1)}, {"c", vec(2, 2, 2)}}),
      containsText("line"));
  CHECK_THAT(whyRefused("triangle", {{"a", vec(0, 0, 0)},
                                     {"b", vec(1, 0, 0)},
                                     {"c", vec(0, 1, 0)},
                                     {"normal_b", vec(0, 0, 1)}}),
             containsText("one corner"));
}

TEST_CASE("open cylinders and cones have no lids", "[shape]") {
  const auto tube = makeShape(
      "cylinder",
      {{"base", vec(0, 0, 0)}, {"cap", vec(0, 2, 0)}, {"radius", number(1)}, {"open", number(1)}});
  CHECK(!tube->isClosed());
  CHECK(tube->faces() == 1);
  CHECK(!tube->intersect({{Real(0.2), -5, 0}, {0, 1, 0}, 0, kInfinity}));
  CHECK(tube->area() == Approx(4 * 3.14159265));
}
