// SPDX-License-Identifier: Apache-2.0
#include <vestige/tools/sampling.h>

#include "engine/light/shape_light.h"
#include "engine/trace/world.h"
#include "support/catch.h"
#include "support/solids.h"

using namespace vestige;
using namespace vestige::test;

namespace {

constexpr bool kDouble = sizeof(Real) == 8;

struct Holder final : MeshShape {
  explicit Holder(TriangleMesh m) { parts_.push_back({std::move(m), "", nullptr, {}}); }
};

/// A light, and the same surface in a world of its own.
struct Lamp {
  std::string name;
  Placement placement;
  bool twoSided = false;

  std::unique_ptr<Light> light() const {
    const auto radiance = [](const SurfacePoint&) { return Rgb{2, 3, 4}; };
    return makeShapeLight(placement, radiance, twoSided, {2, 3, 4});
  }
  World world() const {
    World w;
    w.add(placement);
    w.commit();
    return w;
  }
};

TriangleMesh tent() {
  TriangleMesh m;
  m.positions = {{-1, 0, -1}, {1, 0, -1}, {0, 1, 0}, {-1, 0, 1}, {1, Real(0.2), 1}};
  m.triangles = {{0, 2, 1}, {0, 3, 2}, {3, 4, 2}, {4, 1, 2}};
  return m;
}

std::vector<Lamp> lamps() {
  std::vector<Lamp> list;
  const Affine skewed = move(0.3, -0.2, 0.5) * turn({1, 2, 3}, 0.7) * scale(1.4, 0.6, 0.9);
  const Affine alike = move(0.1, 0.2, 0) * turn({3, 1, 0}, 0.4) * scale(-0.5, 0.5, 0.5);
  for (const Solid& solid : solids())
    for (const Affine& place : {alike, skewed}) {
      Placement p;
      p.shape = solid.make(), p.toWorld = place;
      list.push_back({solid.name + (solid.closed ? "" : " open"), p, !solid.closed});
    }
  Placement p;
  p.shape = std::make_shared<Holder>(tent());
  p.mesh = &p.shape->parts()->front().mesh;
  p.toWorld = skewed;
  list.push_back({"mesh", p, false}), list.push_back({"mesh", p, true});
  return list;
}

/// Bins of direction: cosine and angle around an axis, over a cone that holds the whole light.
struct Bins {
  static constexpr int n = 8;
  Frame frame;
  double low;  ///< smallest cosine
  int of(Vec3 d) const {
    const Vec3 l = frame.toLocal(d);
    const double z = (double(l.z) - low) / (1 - low);
    const double a = std::atan2(double(l.y), double(l.x)) / 6.283185307179586 + 0.5;
    const auto cell = [](double x) { return std::clamp(int(x * n), 0, n - 1); };
    return cell(z) * n + cell(a);
  }
};

const Vec3 kFrom{1, 5, -3};

LightHit hitOf(Vec3 from, Vec3 toLight, const Surface& s) {
  return {from, toLight, s.distance, s.position, s.geometricNormal, s.uv};
}

/// Density times cosine of all the surfaces along a direction: drawn by area each counts.
double densityAlong(const World& world, const Light& light, bool byAngle, Ray ray) {
  double sum = 0;
  while (const auto s = world.intersect(ray)) {
    sum += double(light.pdf({ray.origin}, hitOf(ray.origin, ray.direction, *s))) *
           std::abs(dot(s->geometricNormal, ray.direction));
    if (byAngle) break;
    ray.tMin = s->distance * (1 + Real(1e-5)) + Real(1e-5);
  }
  return sum;
}

}  // namespace

TEST_CASE("a shining shape is sampled with the density that it tells", "[light]") {
  for (const Lamp& lamp : lamps()) {
    INFO(lamp.name << (lamp.twoSided ? " both sides" : ""));
    const auto light = lamp.light();
    const World world = lamp.world();
    const Vec3 middle = world.bounds().centre();
    const Real reach = length(world.bounds().size()) / 2;
    const Bins bins{Frame::around(normalize(middle - kFrom)),
                    std::sqrt(1 - sqr(std::min(Real(0.99), reach / length(middle - kFrom))))};
    const int n = 60000;
    Random random(131);
    // Weighted by the cosine at the light: the density by angle has a pole where that is zero.
    std::vector<double> drawn(64), expected(64), squares(64);
    for (int k = 0; k < n; ++k) {
      const auto s = light->sample({kFrom}, random.square());
      if (!s) continue;
      const double cosine = std::abs(dot(s->hit.normal, s->hit.toLight));
      drawn[bins.of(s->hit.toLight)] += cosine;
      squares[bins.of(s->hit.toLight)] += cosine * cosine;
      if (k % 50) continue;
      CHECK(light->pdf({s->hit.from}, s->hit) == Approx(s->pdf).epsilon(2e-3));
      CHECK(s->radiance == Rgb{2, 3, 4});
      CHECK(light->eval(s->hit) == Rgb{2, 3, 4});
      CHECK(length(kFrom + s->hit.distance * s->hit.toLight - s->hit.position) < 1e-4);
      CHECK(length(s->hit.toLight) == Approx(1).epsilon(1e-5));
    }
    const bool byAngle = lamp.placement.shape->towardPdf({100, 0, 0}) > 0 &&
                         world.patches().size() == 1 && lamp.name == "sphere" &&
                         lamp.placement.toWorld.determinant() < 0;
    const int rays = 200000;
    const double cone = 6.283185307179586 * (1 - bins.low);
    for (int k = 0; k < rays; ++k) {
      const double z = bins.low + (1 - bins.low) * random.number(), r = std::sqrt(1 - z * z);
      const double a = random.between(0, 6.283185307179586);
      const Vec3 d = bins.frame.toWorld({Real(r * std::cos(a)), Real(r * std::sin(a)), Real(z)});
      const double f = densityAlong(world, *light, byAngle, {kFrom, d, 0, kInfinity}) * cone / rays;
      expected[bins.of(d)] += n * f, squares[bins.of(d)] += double(n) * n * f * f;
    }
    double total = 0, all = 0, noise = 0, chi2 = 0;
    int cells = 0;
    for (int b = 0; b < 64; ++b) {
      total += expected[b], all += drawn[b], noise += squares[b];
      if (expected[b] < 20) continue;
      chi2 += sqr(Real(drawn[b] - expected[b])) / squares[b], ++cells;
    }
    CHECK(std::abs(total - all) < 5 * std::sqrt(noise));
    CHECK(chi2 < cells + 6 * std::sqrt(2.0 * cells));
    CHECK(cells > 5);
  }
}

TEST_CASE("radiance that varies over a light counts in its gradient", "[light]") {
  const Real h = kDouble ? Real(1e-4) : Real(4e-3);
  const auto varies = [](const SurfacePoint& p) {
    return grey(std::exp(Real(0.9) * p.position.x + Real(0.5) * p.position.y - p.position.z));
  };
  for (const Lamp& lamp : lamps()) {
    INFO(lamp.name);
    const auto even = lamp.light();
    const auto varied = makeShapeLight(lamp.placement, varies, lamp.twoSided, grey(1));
    Random random(34);
    std::vector<double> off;
    for (int k = 0; k < 400; ++k) {
      const Vec3 from = k % 2 ? kFrom : Vec3{-4, 1, 2};
      const Vec2 u{Real(random.between(0.05, 0.95)), Real(random.between(0.05, 0.95))};
      const auto s = varied->sample({from}, u);
      if (!s || std::abs(dot(s->hit.normal, s->hit.toLight)) < Real(0.15)) continue;
      const LightLogGradient all = varied->logGradient({from}, u),
                             some = even->logGradient({from}, u);
      const LightJacobian j = varied->sampleDerivatives({from}, u);
      const Vec3 p = j.du.c[0], q = j.du.c[1];
      const auto compare = [&](Real told, Vec3 dFrom, Vec2 du) {
        const auto a = varied->sample({from - h * dFrom}, u - h * du);
        const auto b = varied->sample({from + h * dFrom}, u + h * du);
        if (!a || !b) return;
        // Directions drawn by angle may be turned about the axis, which is a shift of the numbers.
        const Vec3 spin =
            (b->hit.toLight - a->hit.toLight) / (2 * h) - j.dFrom * dFrom - du.x * p - du.y * q;
        const Real pp = dot(p, p), pq = dot(p, q), qq = dot(q, q), det = pp * qq - pq * pq;
        const Vec2 shift = {(qq * dot(p, spin) - pq * dot(q, spin)) / det,
                            (pp * dot(q, spin) - pq * dot(p, spin)) / det};
        told += dot(all.du - some.du, shift);
        const Real slope =
            (std::log(luminance(b->radiance)) - std::log(luminance(a->radiance))) / (2 * h);
        if (told == 0 && slope == 0) return;  // drawn by area, and only the eye moved
        off.push_back(double(std::abs(told - slope) / std::max(Real(1), std::abs(slope))));
      };
      compare(all.du.x - some.du.x, {}, {1, 0}), compare(all.du.y - some.du.y, {}, {0, 1});
      for (int axis = 0; axis < 3; ++axis) {
        Vec3 e;
        e[axis] = 1;
        compare(all.dFrom[axis] - some.dFrom[axis], e, {});
      }
    }
    REQUIRE(off.size() > 100);
    std::sort(off.begin(), off.end());
    INFO("median " << off[off.size() / 2] << ", 95 % " << off[off.size() * 95 / 100]);
    CHECK(off[off.size() / 2] < (kDouble ? 1e-4 : 1e-2));
    CHECK(off[off.size() * 95 / 100] < (kDouble ? 1e-2 : 5e-2));  // the rest: seams of the surface
  }
}

TEST_CASE("derivatives of a sampled light agree with differences", "[light]") {
  const Real h = kDouble ? Real(1e-5) : Real(2e-3);
  const double tolerance = kDouble ? 1e-5 : 3e-2;
  for (const Lamp& lamp : lamps()) {
    INFO(lamp.name);
    const auto light = lamp.light();
    Random random(33);
    int wrong = 0, tried = 0;
    for (int k = 0; k < 600; ++k) {
      const Vec3 from = k % 2 ? kFrom : Vec3{-4, 1, 2};
      const Vec2 u{Real(random.between(0.02, 0.98)), Real(random.between(0.02, 0.98))};
      const auto s = light->sample({from}, u);
      if (!s) continue;
      const LightJacobian j = light->sampleDerivatives({from}, u);
      const LightLogGradient g = light->logGradient({from}, u);
      const bool cone = length(g.dFrom) == 0;
      const auto factor = [&](const LightSample& x) {
        return std::log(double(std::abs(dot(x.hit.normal, x.hit.toLight))) /
                        sqr(double(x.hit.distance)));
      };
      if (!cone && std::abs(dot(s->hit.normal, s->hit.toLight)) < Real(0.15)) continue;
      ++tried;
      CHECK(length(cross(j.du.c[0], j.du.c[1])) * s->pdf ==
            Approx(1).epsilon(kDouble ? 1e-6 : 5e-3));
      for (const int axis : {0, 1}) {  // from either side: seams
        bool agrees = false;
        for (const Real step : {h, -h}) {
          Vec2 a = u, b = u;
          (axis ? a.y : a.x) += step, (axis ? b.y : b.x) += 2 * step;
          const auto sa = light->sample({from}, a), sb = light->sample({from}, b);
          if (!sa || !sb) continue;
          const Vec3 d =
              (Real(4) * sa->hit.toLight - Real(3) * s->hit.toLight - sb->hit.toLight) / (2 * step);
          bool same = length(d - j.du.c[axis]) < tolerance * (1 + length(d));
          const double slope =
              (4 * factor(*sa) - 3 * factor(*s) - factor(*sb)) / (2 * double(step));
          const double told = axis ? g.du.y : g.du.x;
          if (!cone) same &= std::abs(slope - told) < 3 * tolerance * (1 + std::abs(slope));
          agrees |= same;
        }
        wrong += !agrees;
      }
      for (int axis = 0; axis < 3; ++axis) {
        Vec3 e;
        e[axis] = kDouble ? Real(1e-4) : Real(1e-2);
        const auto a = light->sample({from - e}, u), b = light->sample({from + e}, u);
        if (!a || !b) continue;
        const Vec3 d = (b->hit.toLight - a->hit.toLight) / (2 * e[axis]);
        // Directions drawn by angle may be turned about the axis: up to that they must agree.
        const Vec3 w = normalize(lamp.placement.toWorld.point({Real(0.5), Real(-0.25), 0}) - from);
        const Vec3 spin = normalize(cross(w, s->hit.toLight));
        const Vec3 off = d - j.dFrom.c[axis];
        CHECK((cone ? length(off - dot(off, spin) * spin) : length(off)) < tolerance);
        if (cone) continue;
        const double slope = (factor(*b) - factor(*a)) / (2 * double(e[axis]));
        CHECK(std::abs(slope - g.dFrom[axis]) < tolerance * (1 + std::abs(slope)));
      }
    }
    CHECK(tried > 20);
    CHECK(wrong <= (kDouble ? tried / 100 : tried / 20));
  }
}

TEST_CASE("particles carry the light's power and start as they say", "[light]") {
  for (const Lamp& lamp : lamps()) {
    INFO(lamp.name);
    const auto light = lamp.light();
    double patches = 0;
    const World world = lamp.world();
    for (const Patch& p : world.patches()) patches += double(p.area);
    Random random(37);
    double sum = 0;
    const int n = 20000;
    int back = 0;
    const Vec3 own = world.patches()[0].normal;
    for (int k = 0; k < n; ++k) {
      const auto p = light->emit({random.square(), random.square()});
      REQUIRE(p);
      sum += double(p->power.r) / n;
      CHECK(dot(p->normal, p->direction) >= 0);
      back += dot(p->normal, own) < 0;
    }
    const double expected = 3.14159265358979 * patches * 2 * (lamp.twoSided ? 2 : 1);
    CHECK(sum == Approx(expected).epsilon(0.02));
    CHECK(light->power().r == Approx(expected).epsilon(0.01));
    if (lamp.twoSided) CHECK(back == Approx(n / 2).epsilon(0.05));
  }
}

TEST_CASE("derivatives of emission agree with differences", "[light]") {
  const Real h = kDouble ? Real(1e-5) : Real(2e-3);
  const double tolerance = kDouble ? 1e-5 : 3e-2;
  for (const Lamp& lamp : lamps()) {
    INFO(lamp.name);
    const auto light = lamp.light();
    Random random(39);
    int wrong = 0, tried = 0;
    for (int k = 0; k < 200; ++k) {
      double x[4];
      for (double& c : x) c = random.between(0.02, 0.98);
      const auto at = [&](const double* v) {
        return *light->emit({{Real(v[0]), Real(v[1])}, {Real(v[2]), Real(v[3])}});
      };
      const Particle p = at(x);
      if (dot(p.normal, p.direction) < Real(0.3)) continue;
      const RayJacobian j =
          light->emissionDerivatives({{Real(x[0]), Real(x[1])}, {Real(x[2]), Real(x[3])}});
      for (int axis = 0; axis < 4; ++axis) {
        ++tried;
        bool agrees = false;
        for (const Real step : {h, -h}) {
          double y[4] = {x[0], x[1], x[2], x[3]}, z[4] = {x[0], x[1], x[2], x[3]};
          y[axis] += double(step), z[axis] += 2 * double(step);
          const Particle a = at(y), b = at(z);
          const auto slope = [&](Vec3 f0, Vec3 f1, Vec3 f2) {
            return (Real(4) * f1 - Real(3) * f0 - f2) / (2 * step);
          };
          Vec3 dD = slope(p.direction, a.direction, b.direction);
          const Vec3 dO = slope(p.origin, a.origin, b.origin);
          Vec3 told = j.dDirection[axis];
          if (axis < 2) {  // up to a spin about the normal, which only relabels the numbers
            const Vec3 spin = normalize(cross(p.normal, p.direction));
            dD -= dot(dD, spin) * spin, told -= dot(told, spin) * spin;
          }
          agrees |= length(dO - j.dOrigin[axis]) < tolerance * (1 + length(dO)) &&
                    length(dD - told) < tolerance * (1 + length(dD));
        }
        wrong += !agrees;
      }
    }
    CHECK(tried > 100);
    CHECK(wrong <= (kDouble ? tried / 100 : tried / 20));
  }
}
