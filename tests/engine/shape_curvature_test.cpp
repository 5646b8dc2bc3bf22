// SPDX-License-Identifier: Apache-2.0
// How surfaces bend: the second derivatives of position and the first of the normal, of every
// analytic shape that the registry finds, against five-point differences of what they derive from.
#include "engine/trace/place.h"
#include "engine/trace/world.h"
#include "support/catch.h"
#include "support/solids.h"

#include "engine/scene/registry.h"

using namespace vestige;
using namespace vestige::test;

namespace {

constexpr bool kDouble = sizeof(Real) == 8;
constexpr Real kStep = kDouble ? Real(5e-4) : Real(1e-2);
/// Relative to the size of the surface and its derivatives, below 100 scene units in all cases.
constexpr double kTolerance = kDouble ? 1e-7 : 1e-3;

struct Named {
  std::string name;
  std::shared_ptr<Shape> shape;
};

/// Known solids, and what other libraries there are by their defaults. Meshes offer no faces, and a
/// shape that needs a file cannot be made here.
std::vector<Named> shapesWithFaces() {
  std::vector<Named> list;
  std::map<std::string, int> known;
  for (const Solid& s : solids()) list.push_back({s.name, s.make()}), ++known[s.name];
  std::vector<std::string> refused;
  const Registry registry = Registry::load({VESTIGE_PLUGINS}, refused);
  for (const Plugin& p : registry.plugins())
    if (p.kind == "shape" && !known[p.name] && whyRefused(p.name, {}).empty())
      if (const auto shape = makeShape(p.name, {}); !shape->parts() && shape->faces() > 0)
        list.push_back({p.name, shape});
  return list;
}

/// Identity; a rotation after a scale that differs by axis; one that mirrors and shears.
std::vector<Affine> places() {
  Affine shear;
  shear.m[0][1] = 0.4, shear.m[2][0] = -0.3;
  return {Affine{}, move(0.3, -0.2, 0.5) * turn({1, 2, 3}, 0.7) * scale(1.4, 0.6, 0.9),
          turn({1, 0, 1}, 0.4) * scale(-1, 1, 1.3) * shear};
}

/// Derivative of a quantity of the surface along one axis of uv, from five points.
template <class Quantity>
Vec3 slope(const Shape& shape, const Place& place, int face, Vec2 uv, int axis, const Quantity& q) {
  const auto at = [&](Real h) {
    const Vec2 moved = axis == 0 ? Vec2{uv.x + h, uv.y} : Vec2{uv.x, uv.y + h};
    return q(place.world(shape.at(moved, face)));
  };
  return (Real(8) * (at(kStep) - at(-kStep)) - (at(2 * kStep) - at(-2 * kStep))) / (12 * kStep);
}

/// The largest error, relative to the size of what is compared or 1.
struct Worst {
  double value = 0;
  void add(Vec3 found, Vec3 expected) {
    const double e = double(length(found - expected)) / std::max(1.0, double(length(expected)));
    value = std::isfinite(e) ? std::max(value, e) : HUGE_VAL;
  }
};

/// Away from the ends of v, where u may have a pole.
Vec2 inside(Random& random) {
  return {Real(random.between(0.05, 0.95)), Real(random.between(0.06, 0.94))};
}

}  // namespace

TEST_CASE("derivatives of position and normal by uv, first and second", "[shape][derivatives]") {
  for (const Named& named : shapesWithFaces())
    for (const Affine& toWorld : places()) {
      const Place place(toWorld);
      Random random(21);
      Worst tangent, normal, alongU, alongV, mixed;
      for (int k = 0; k < 300; ++k) {
        const int face = int(random.number() * named.shape->faces());
        const Vec2 uv = inside(random);
        const SurfacePoint s = place.world(named.shape->at(uv, face));
        const auto by = [&](int axis, Vec3 SurfacePoint::*member) {
          return slope(*named.shape, place, face, uv, axis,
                       [&](const SurfacePoint& p) { return p.*member; });
        };
        tangent.add(s.dPdu, by(0, &SurfacePoint::position));
        tangent.add(s.dPdv, by(1, &SurfacePoint::position));
        normal.add(s.dNdu, by(0, &SurfacePoint::normal));
        normal.add(s.dNdv, by(1, &SurfacePoint::normal));
        alongU.add(s.dPduu, by(0, &SurfacePoint::dPdu));
        alongV.add(s.dPdvv, by(1, &SurfacePoint::dPdv));
        mixed.add(s.dPduv, by(1, &SurfacePoint::dPdu));
        mixed.add(s.dPduv, by(0, &SurfacePoint::dPdv));
      }
      INFO(named.name << (toWorld.isIdentity() ? "" : ", placed"));
      CHECK(tangent.value < kTolerance);
      CHECK(normal.value < kTolerance);
      CHECK(alongU.value < kTolerance);
      CHECK(alongV.value < kTolerance);
      CHECK(mixed.value < kTolerance);
    }
}

TEST_CASE("second derivatives and derivatives of the normal tell the same curvature",
          "[shape][derivatives]") {
  // N . P_i = 0 along the surface, so N . P_ij = -N_i . P_j [Weingarten].
  for (const auto& [name, shape] : shapesWithFaces())
    for (const Affine& toWorld : places()) {
      const Place place(toWorld);
      Random random(22);
      double worst = 0;
      for (int k = 0; k < 300; ++k) {
        const int face = int(random.number() * shape->faces());
        const SurfacePoint s = place.world(shape->at(inside(random), face));
        worst = std::max<double>(worst, std::abs(dot(s.normal, s.dPduu) + dot(s.dNdu, s.dPdu)));
        worst = std::max<double>(worst, std::abs(dot(s.normal, s.dPduv) + dot(s.dNdu, s.dPdv)));
        worst = std::max<double>(worst, std::abs(dot(s.normal, s.dPduv) + dot(s.dNdv, s.dPdu)));
        worst = std::max<double>(worst, std::abs(dot(s.normal, s.dPdvv) + dot(s.dNdv, s.dPdv)));
      }
      INFO(name << (toWorld.isIdentity() ? "" : ", placed"));
      CHECK(worst < (kDouble ? 1e-11 : 2e-4));
    }
}

TEST_CASE("a ray's hit carries the second derivatives of its place", "[shape][derivatives]") {
  for (const auto& [name, shape] : shapesWithFaces()) {
    const Affine toWorld = places()[1];
    World world;
    Placement p;
    p.shape = shape, p.toWorld = toWorld;
    world.add(p);
    world.commit();
    const Place place(toWorld);
    Random random(23);
    Worst worst;
    int seen = 0;
    for (int k = 0; k < 400; ++k) {
      const Vec3 from = Real(6) * random.direction();
      const auto s = world.intersect({from, normalize(random.inBox(1.5) - from), 0, kInfinity});
      if (!s || s->uv.y < Real(0.02) || s->uv.y > Real(0.98)) continue;
      const SurfacePoint expected = place.world(shape->at(s->uv, s->primitive));
      worst.add(s->dPduu, expected.dPduu);
      worst.add(s->dPduv, expected.dPduv);
      worst.add(s->dPdvv, expected.dPdvv);
      ++seen;
    }
    INFO(name);
    CHECK(seen > 20);
    CHECK(worst.value < (kDouble ? 1e-9 : 1e-3));
  }
}

TEST_CASE("triangles are flat in second order", "[shape][derivatives]") {
  const auto triangle = makeShape("triangle", {{"a", vec(0, 0, 0)},
                                               {"b", vec(1, 0, 0)},
                                               {"c", vec(0, 1, 0)},
                                               {"normal_a", vec(-1, -1, 3)},
                                               {"normal_b", vec(1, -1, 3)},
                                               {"normal_c", vec(-1, 1, 3)}});
  World world;
  Placement p;
  p.shape = triangle, p.mesh = &triangle->parts()->front().mesh, p.toWorld = places()[1];
  world.add(p);
  world.commit();
  const Vec3 middle = p.toWorld.point({Real(0.3), Real(0.3), 0});
  const Vec3 up = normalize(p.toWorld.vector({0, 0, 1}));
  const auto s = world.intersect({middle + Real(3) * up, -up, 0, kInfinity});
  REQUIRE(s);
  CHECK(length(s->dNdu) > 0.1);
  for (const Vec3 d : {s->dPduu, s->dPduv, s->dPdvv}) CHECK(d == Vec3{});
}
