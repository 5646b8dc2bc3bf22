// SPDX-License-Identifier: Apache-2.0
// The footprint module alone: shapes of regions, deltas, reduction. Whole paths through the engine
// are in tests/engine.
#include <vestige/footprint/deltas.h>
#include <vestige/footprint/footprints.h>
#include <vestige/footprint/reduce.h>
#include <vestige/sampler.h>
#include <vestige/tools/sampling.h>

#include <vector>

#include "support/catch.h"

using namespace vestige;

namespace {

constexpr double kTight = sizeof(Real) == 8 ? 1e-12 : 2e-5;

std::vector<Vec2> vectors(int k, std::uint32_t seed) {
  std::vector<Vec2> list;
  for (std::uint32_t i = 0; list.size() < std::size_t(k); ++i) {
    const Vec2 u = Sampler(0, seed, i, 5).pair(0);
    list.push_back({2 * u.x - 1, 2 * u.y - 1});
  }
  return list;
}

double shoelace(const std::vector<Vec2>& p) {
  double sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i) sum += cross(p[i], p[(i + 1) % p.size()]);
  return sum / 2;
}

Vec3 tangent(Vec3 n, Vec2 u) {
  const Frame f = Frame::around(n);
  return (2 * u.x - 1) * f.s + (2 * u.y - 1) * f.t;
}

}  // namespace

TEST_CASE("the polygon's area is the sum of pairwise crosses", "[footprint]") {
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    const int k = 2 + int(seed % 11);
    const std::vector<Vec2> v = vectors(k, seed);
    std::vector<Vec2> corners(std::size_t(2 * k));
    polygon(v, corners);
    CHECK(shoelace(corners) == Approx(double(polygonArea(v))).epsilon(10 * kTight));
    // Convex, so every signed combination of half vectors lies inside.
    for (std::uint32_t signs = 0; signs < 8; ++signs) {
      Vec2 p;
      for (int i = 0; i < k; ++i) p = p + ((signs >> (i % 3)) & 1 ? Real(0.5) : Real(-0.5)) * v[i];
      for (std::size_t i = 0; i < corners.size(); ++i)
        CHECK(cross(corners[(i + 1) % corners.size()] - corners[i], p - corners[i]) > -1e-4);
    }
  }
}

TEST_CASE("representative vectors keep at least half the polygon", "[footprint]") {
  for (std::uint32_t seed = 0; seed < 500; ++seed) {
    std::vector<Vec2> v = vectors(2 + int(seed % 7), seed);
    const Real exact = polygonArea(v);
    const Region raw = representative(v, false), r = representative(v);
    const Real ratio = std::abs(cross(raw.a, raw.b)) / exact;
    CHECK(ratio >= 0.5 - kTight);
    CHECK(ratio <= 1 + kTight);
    CHECK(std::abs(cross(r.a, r.b)) == Approx(double(exact)).epsilon(1e-4));
    // x -> 1 - x turns a vector round and means nothing.
    v[seed % v.size()] = Real(-1) * v[seed % v.size()];
    const Region flipped = representative(v);
    const auto same = [&](Region p, Region q) {
      const auto near = [](Vec2 x, Vec2 y) { return dot(x - y, x - y) < 1e-8; };
      return (near(p.a, q.a) && near(p.b, q.b)) || (near(p.a, q.b) && near(p.b, q.a)) ||
             (near(p.a, Real(-1) * q.a) && near(p.b, Real(-1) * q.b)) ||
             (near(p.a, Real(-1) * q.b) && near(p.b, Real(-1) * q.a));
    };
    CHECK(same(r, flipped));
  }
}

TEST_CASE("the ellipse has the vectors' covariance", "[footprint]") {
  for (std::uint32_t seed = 0; seed < 300; ++seed) {
    std::vector<Vec2> v = vectors(1 + int(seed % 9), seed);
    if (seed % 3 == 0)  // nearly parallel: a needle
      for (Vec2& x : v) x.y = Real(2) * x.x + Real(1e-3) * x.y;
    Covariance m, back;
    for (const Vec2 x : v) m.add(x);
    const Region e = ellipse(m);
    back.add(e.a), back.add(e.b);
    CHECK(back.xx == Approx(double(m.xx)).epsilon(1e-4).margin(1e-5));
    CHECK(back.xy == Approx(double(m.xy)).epsilon(1e-4).margin(1e-5));
    CHECK(back.yy == Approx(double(m.yy)).epsilon(1e-4).margin(1e-5));
    CHECK(dot(e.a, e.b) == Approx(0).margin(1e-5));
    CHECK(dot(e.a, e.a) >= dot(e.b, e.b));
  }
  CHECK(dot(ellipse(Covariance{}).a, ellipse(Covariance{}).a) == 0);
}

TEST_CASE("reduction keeps the covariance through later events", "[footprint]") {
  using D = Differentials<16>;
  for (std::uint32_t seed = 0; seed < 100; ++seed) {
    const Sampler s(1, seed, 0, 9);
    const auto unit = [&](std::uint32_t dim) { return uniformCap(s.pair(dim), -1).d; };
    const Vec3 n = unit(0), dir = unit(2);
    D small, weighted;
    for (D* d : {&small, &weighted}) d->begin({}, dir, 0);
    Four weights[4] = {};
    for (std::uint32_t j = 0; j < 10; ++j) {
      const Vec3 dV = tangent(n, s.pair(10 + 6 * j)), dD = tangent(dir, s.pair(12 + 6 * j));
      const Real g = s.number(14 + 6 * j), weight = Real(0.2) + s.number(15 + 6 * j);
      small.append(dV, dD, g), weighted.append(weight * dV, weight * dD, weight * g);
      weights[j / 4][j % 4] = weight;
    }
    reduce(small, weights, true);
    REQUIRE(small.size() == 5);
    // Travel on to some other surface, then compare all second moments there.
    Vec3 n2 = unit(100);
    if (std::abs(dot(n2, dir)) < Real(0.2)) n2 = dir;
    for (D* d : {&weighted, &small}) d->transfer(Real(1.7), n2, 1e6);
    const auto moment = [](const D& d, auto f, auto g) {
      double sum = 0;
      for (int j = 0; j < d.size(); ++j) sum += double(f(d, j)) * double(g(d, j));
      return sum;
    };
    const auto vx = [](const D& d, int j) { return d.dVertex(j).x; };
    const auto vy = [](const D& d, int j) { return d.dVertex(j).y; };
    const auto dz = [](const D& d, int j) { return d.dDirection(j).z; };
    const auto g = [](const D& d, int j) { return d.gradient(j); };
    const double tight = sizeof(Real) == 8 ? 1e-6 : 1e-4;
    CHECK(moment(small, vx, vy) == Approx(moment(weighted, vx, vy)).margin(tight * 30));
    CHECK(moment(small, vx, vx) == Approx(moment(weighted, vx, vx)).epsilon(tight).margin(1e-6));
    CHECK(moment(small, vx, dz) == Approx(moment(weighted, vx, dz)).margin(tight * 30));
    CHECK(moment(small, vx, g) == Approx(moment(weighted, vx, g)).margin(tight * 30));
    CHECK(moment(small, g, g) == Approx(moment(weighted, g, g)).epsilon(tight));
  }
}

TEST_CASE("reduction of a pinhole's two differentials has rank two", "[footprint]") {
  Differentials<8> d;
  RayJacobian j;
  j.dDirection[0] = {Real(0.01), 0, 0}, j.dDirection[1] = {0, Real(0.02), 0};
  d.begin(j, {0, 0, 1}, 2);
  d.transfer(5, {0, 0, -1}, 1e6);
  const Four one{1, 1, 1, 1}, ones[2] = {one, one};
  reduce(d, ones, false);
  CHECK(d.size() == 2);
  CHECK(length(d.dVertex(0)) + length(d.dVertex(1)) == Approx(0.15));
}

TEST_CASE("deltas of each bound", "[footprint]") {
  PathCount c;
  c.begin(15, 400000, 4);
  DeltaPolicy p;
  p.bound = Bound::global;
  c.drew(2), c.drew(2);
  for (int i = 0; i < 3; ++i) c.chance(Real(0.9));
  CHECK(commonDelta(p, c) == Approx(0.207).epsilon(0.01));  // MATH 3.2: survival, not absorption
  p.bound = Bound::safe;
  CHECK(commonDelta(p, c) == Approx(std::pow(16 * 0.729, -2. / 3)));
  {
    PathCount film;
    film.begin(15, 400000, 2);
    CHECK(commonDelta(p, film) == Approx(1.6 * std::pow(16., -2. / 3)));
    film.begin(1, 400000, 2);
    CHECK(commonDelta(p, film) == 1);  // two samples cover the pixel twice
  }
  p.bound = Bound::local;
  CHECK(commonDelta(p, c) == Approx(1 / std::sqrt(400000.0)));
  p.bound = Bound::none;
  CHECK(commonDelta(p, c) == 0);
  p.bound = Bound::safe;
  for (int i = 0; i < 100; ++i) c.chance(Real(0.1));
  CHECK(commonDelta(p, c) == 1);  // never more than the whole interval

  // The gradient's limit, and the width of a sphere.
  Differentials<4> d;
  d.begin({}, {0, 0, 1}, 0);
  d.append({}, {Real(0.1), 0, 0}, 10);
  d.append({}, {Real(0.1), 0, 0}, -10);
  d.append({}, {Real(0.1), 0, 0}, 0);
  d.append({}, {0, 8, 0}, 0);
  const Four half{Real(0.5), Real(0.5), Real(0.5), Real(0.5)};
  const Four limited = d.deltas(0, half, Real(0.7));
  CHECK(limited[0] == Approx(0.07));
  CHECK(limited[1] == Approx(0.07));
  CHECK(limited[2] == Real(0.5));
  CHECK(limited[3] == Approx(0.125));
  const Four small{Real(0.05), Real(0.05), Real(0.05), Real(0.05)};
  CHECK(d.deltas(0, small, Real(0.7))[0] == Real(0.05));
  CHECK(d.deltas(0, half, kInfinity)[0] == Real(0.5));
}
