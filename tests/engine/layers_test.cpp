// SPDX-License-Identifier: Apache-2.0
// Many transparent layers between a point and a light: exact, coloured, and the same to the bit in
// any order.
#include <numeric>

#include "engine/trace/tree.h"
#include "engine/trace/world.h"
#include "support/catch.h"
#include "support/solids.h"

using namespace vestige;
using namespace vestige::test;

namespace {

enum class Made { quads, planes, meshes, instances, mixed };

/// One square of two triangles across z = 0.
struct Tile final : MeshShape {
  explicit Tile(Real z) {
    TriangleMesh m;
    m.positions = {{-1, -1, z}, {1, -1, z}, {1, 1, z}, {-1, 1, z}};
    m.triangles = {{0, 1, 2}, {0, 2, 3}};
    parts_.push_back({std::move(m), "", nullptr, {}});
  }
};

Placement layer(Made made, int k, const std::shared_ptr<Shape>& shared) {
  const Real z = Real(1) + Real(0.01) * Real(k);
  Placement p;
  p.object = k;
  p.translucent = true;
  if (made == Made::mixed) made = Made(k % 4);
  switch (made) {
    case Made::quads:
      p.shape = makeShape(
          "quad",
          {{"corner", vec(-1, -1, double(z))}, {"edge1", vec(2, 0, 0)}, {"edge2", vec(0, 2, 0)}});
      return p;
    case Made::planes:
      p.shape = makeShape("plane", {{"normal", vec(0, 0, 1)}, {"distance", number(double(z))}});
      return p;
    case Made::meshes:
      p.shape = std::make_shared<Tile>(z);
      break;
    default:
      p.shape = shared;
      p.toWorld = move(0, 0, double(z));
  }
  p.mesh = &p.shape->parts()->front().mesh;
  return p;
}

/// n layers, added in the order of a permutation; object k is the k-th along z.
World layers(Made made, int n, int stride = 1) {
  static const auto shared = std::make_shared<Tile>(Real(0));
  World world;
  for (int i = 0; i < n; ++i) world.add(layer(made, int(std::int64_t(i) * stride % n), shared));
  if (made == Made::mixed || made == Made::instances) {
    Placement beside = layer(Made::instances, n, shared);  // so that the mesh is instanced
    beside.toWorld = move(50, 0, 0);
    world.add(beside);
  }
  world.commit();
  return world;
}

const Ray kRay{{Real(0.013), Real(0.021), 0}, {0, 0, 1}, 0, 100};

Rgb thin(const void*, const Surface&) { return {Real(0.001), Real(0.002), Real(0.003)}; }
/// Each layer has a colour of its own.
Rgb own(const void*, const Surface& s) {
  const Real a = Real(0.0001) * Real(s.object % 37);
  return {a, 2 * a, Real(0.5) * a};
}

}  // namespace

TEST_CASE("a thousand transparent layers let through what school says", "[world][layers]") {
  for (const Made made : {Made::quads, Made::planes, Made::meshes, Made::instances, Made::mixed})
    for (const int n : {1, 63, 64, 65, 128, 1000}) {
      INFO("made " << int(made) << ", layers " << n);
      const Rgb t = layers(made, n).transmittance(kRay, thin, nullptr);
      const auto share = [&](double a) { return Approx(std::pow(1 - a, n)).epsilon(1e-6); };
      // Of 1 - 0.001 as Real has it.
      CHECK(t.r == Approx(std::pow(double(1 - Real(0.001)), n)).epsilon(1e-6));
      CHECK(t.g == Approx(std::pow(double(1 - Real(0.002)), n)).epsilon(1e-6));
      CHECK(t.b == Approx(std::pow(double(1 - Real(0.003)), n)).epsilon(1e-6));
      if (n == 1) CHECK(t.r == share(0.001));
    }
}

TEST_CASE("an edge between two triangles is one layer", "[world][layers]") {
  for (const Made made : {Made::meshes, Made::instances})
    for (const int n : {1, 100})
      for (const Real x : {Real(0), Real(0.25), Real(-0.5)}) {
        INFO("made " << int(made) << ", layers " << n << ", x " << x);
        const Ray diagonal{{x, x, 0}, {0, 0, 1}, 0, 100};
        CHECK(layers(made, n).transmittance(diagonal, thin, nullptr).r ==
              Approx(std::pow(double(1 - Real(0.001)), n)).epsilon(1e-6));
      }
}

TEST_CASE("the order of the objects changes no bit of what layers let through", "[world][layers]") {
  for (const Made made : {Made::quads, Made::meshes, Made::mixed})
    for (const int n : {50, 1001}) {
      INFO("made " << int(made) << ", layers " << n);
      const Rgb first = layers(made, n).transmittance(kRay, own, nullptr);
      double expected = 1;
      for (int k = 0; k < n; ++k) expected *= 1 - double(Real(0.0001) * Real(k % 37));
      CHECK(first.r == Approx(expected).epsilon(1e-5));
      for (const int stride : {7, 13, n - 1}) {
        if (std::gcd(stride, n) != 1) continue;
        const Rgb again = layers(made, n, stride).transmittance(kRay, own, nullptr);
        CHECK(again == first);
      }
    }
}

TEST_CASE("layers at one place are multiplied in no order", "[world][layers]") {
  // Coincident quads of different colours, more than one round of them.
  const auto coincident = [](int n, bool isReversed) {
    World world;
    for (int i = 0; i < n; ++i) {
      Placement p = layer(Made::quads, 0, nullptr);
      p.object = isReversed ? n - 1 - i : i;
      world.add(p);
    }
    world.commit();
    return world;
  };
  for (const int n : {30, 64})
    CHECK(coincident(n, false).transmittance(kRay, own, nullptr) ==
          coincident(n, true).transmittance(kRay, own, nullptr));
  double expected = 1;
  for (int k = 0; k < 200; ++k) expected *= 1 - double(Real(0.0001) * Real(k % 37));
  CHECK(coincident(200, false).transmittance(kRay, own, nullptr).r ==
        Approx(expected).epsilon(1e-5));
}

TEST_CASE("what is opaque blocks wherever it stands among the layers", "[world][layers]") {
  for (const double z : {0.5, 1.005, 6.0, 10.995, 20.0}) {
    INFO("wall at " << z);
    World world;
    for (int k = 0; k < 1000; ++k) world.add(layer(Made::quads, k, nullptr));
    Placement wall;
    wall.shape = makeShape("sphere", {{"centre", vec(0, 0, z)}, {"radius", number(0.1)}});
    world.add(wall);
    world.commit();
    CHECK(world.transmittance(kRay, thin, nullptr) == Rgb{});
    Ray before = kRay;
    before.tMax = Real(0.3);
    CHECK(world.transmittance(before, thin, nullptr) == grey(1));
  }
}

TEST_CASE("a ray has as many layers of a closed shape as it crosses", "[world][layers]") {
  const auto half = [](const void*, const Surface&) { return grey(Real(0.5)); };
  const auto crossed = [&](const std::shared_ptr<Shape>& shape, const Ray& ray) {
    World world;
    Placement p;
    p.shape = shape;
    p.translucent = true;
    world.add(p);
    world.commit();
    return world.transmittance(ray, half, nullptr).g;
  };
  const auto torus =
      makeShape("torus", {{"major_radius", number(1.25)}, {"minor_radius", number(0.5)}});
  CHECK(crossed(torus, {{-3, Real(0.1), 0}, {1, 0, 0}, 0, kInfinity}) == Real(1.0 / 16));
  CHECK(crossed(torus, {{0, Real(0.1), 0}, {1, 0, 0}, 0, kInfinity}) == Real(1.0 / 4));
  CHECK(crossed(torus, {{-1, Real(0.1), 0}, {1, 0, 0}, 0, kInfinity}) == Real(1.0 / 8));
  CHECK(crossed(torus, {{-1, Real(0.1), 0}, {1, 0, 0}, 0, Real(0.1)}) == 1);
}

TEST_CASE("the buffer of layers keeps the nearest and goes on behind them", "[layers]") {
  Layers layers;
  for (int k = 0; k < 200; ++k) {
    const int i = k * 77 % 200;
    layers.add({i, 0, Real(i), {}});
    layers.add({i, 0, Real(i), {}});  // Embree may report one twice
  }
  int seen = 0;
  for (;;) {
    layers.settle();
    for (const TreeHit& hit : layers.hits()) CHECK(hit.item == seen++);
    if (!layers.isCut()) break;
    CHECK(layers.goOn() == Real(seen - 1));
    for (int k = 199; k >= 0; --k) layers.add({k, 0, Real(k), {}});
  }
  CHECK(seen == 200);
}

TEST_CASE("kinds of rays meet what is visible to them", "[world][visibility]") {
  const RayKind kinds[] = {RayKind::camera, RayKind::shadow, RayKind::reflection,
                           RayKind::refraction, RayKind::indirect};
  const auto shared = std::make_shared<Tile>(Real(0));
  for (const Made made : {Made::quads, Made::planes, Made::meshes, Made::instances})
    for (const bool isTranslucent : {false, true})
      for (const RayKind visible : kinds) {
        World world;
        Placement p = layer(made, 0, shared);
        p.translucent = isTranslucent;
        p.visibleTo = visible;
        world.add(p);
        Placement beside = layer(Made::instances, 1, shared);
        beside.toWorld = move(50, 0, 0);
        world.add(beside);
        world.commit();
        for (const RayKind asked : kinds) {
          Ray ray = kRay;
          ray.kind = asked;
          INFO("made " << int(made) << " kinds " << bits(visible) << " and " << bits(asked));
          CHECK(world.intersect(ray).has_value() == (visible == asked));
        }
        CHECK(world.intersect(kRay).has_value());  // any
        const Rgb all = world.transmittance(
            kRay, [](const void*, const Surface&) { return grey(1); }, nullptr);
        CHECK(all == grey(visible == RayKind::shadow ? 0 : 1));
      }
}

TEST_CASE("the time of a ray reaches what it meets and what leaves from there", "[world]") {
  const World world = layers(Made::quads, 1);
  Ray ray = kRay;
  ray.time = Real(0.75);
  const auto s = world.intersect(ray);
  REQUIRE(s);
  CHECK(s->time == Real(0.75));
  CHECK(spawnRay(*s, {0, 0, 1}).time == Real(0.75));
  CHECK(shadowRay(*s, {0, 0, 1}, 5).time == Real(0.75));
}
