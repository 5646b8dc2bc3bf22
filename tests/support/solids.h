// SPDX-License-Identifier: Apache-2.0
// Every analytic shape with what school geometry says of it: the yardstick of the shape tests.
#pragma once
#include "support/shapes.h"

namespace vestige::test {

struct Solid {
  std::string name;
  std::map<std::string, Value> rows;
  /// Negative inside; of an open surface the signed distance from the plane that it lies in.
  std::function<double(Vec3)> side;
  /// Which points of side() == 0 belong to it.
  std::function<bool(Vec3)> holds = [](Vec3) { return true; };
  double area;
  bool closed = true;
  double reach = 3;  ///< it lies within this distance from the origin

  std::shared_ptr<Shape> make() const { return makeShape(name, rows); }
};

inline double distanceToAxis(Vec3 p, Vec3 a, Vec3 n) { return length(cross(p - a, n)); }

inline std::vector<Solid> solids() {
  const double pi = 3.14159265358979;
  const auto box = [](Vec3 p) {
    return std::max({std::abs(p.x - 0.5) - 1.0, std::abs(p.y) - 0.5, std::abs(p.z + 0.25) - 0.75});
  };
  // Axis from (0,-1,0.5) to (1,1,0.5), length sqrt 5.
  const Vec3 a{0, -1, Real(0.5)}, n = normalize(Vec3{1, 2, 0});
  const double h = std::sqrt(5.0);
  const auto round = [=](double ra, double rb) {
    return [=](Vec3 p) {
      const double z = dot(p - a, n);
      return std::max({-z, z - h, distanceToAxis(p, a, n) - (ra + (rb - ra) * z / h)});
    };
  };
  const auto torus = [](Vec3 p) {
    return std::hypot(std::hypot(double(p.x), double(p.z)) - 1.25, double(p.y)) - 0.5;
  };
  const Vec3 slope = normalize(Vec3{1, 2, 3});
  const auto slant = [=](double big, double small) {
    return pi * (big + small) * std::hypot(h, big - small);
  };
  std::vector<Solid> list;
  list.push_back({"sphere",
                  {{"centre", vec(0.5, -0.25, 0)}, {"radius", number(1.5)}},
                  [](Vec3 p) {
                    return length(p - Vec3{Real(0.5), Real(-0.25), 0}) - 1.5;
                  },
                  {},
                  4 * pi * 2.25});
  list.push_back({"box",
                  {{"corner1", vec(1.5, -0.5, 0.5)}, {"corner2", vec(-0.5, 0.5, -1)}},
                  box,
                  {},
                  2 * (2 * 1 + 2 * 1.5 + 1 * 1.5)});
  list.push_back({"cylinder",
                  {{"base", vec(0, -1, 0.5)}, {"cap", vec(1, 1, 0.5)}, {"radius", number(0.5)}},
                  round(0.5, 0.5),
                  {},
                  slant(0.5, 0.5) + 2 * pi * 0.25});
  list.push_back({"cone",
                  {{"base", vec(0, -1, 0.5)},
                   {"base_radius", number(1)},
                   {"cap", vec(1, 1, 0.5)},
                   {"cap_radius", number(0.25)}},
                  round(1, 0.25),
                  {},
                  slant(1, 0.25) + pi * (1 + 0.0625)});
  list.push_back({"cone",
                  {{"base", vec(0, -1, 0.5)},
                   {"base_radius", number(0)},
                   {"cap", vec(1, 1, 0.5)},
                   {"cap_radius", number(0.75)}},
                  round(0, 0.75),
                  {},
                  slant(0.75, 0) + pi * 0.5625});
  list.push_back({"torus",
                  {{"major_radius", number(1.25)}, {"minor_radius", number(0.5)}},
                  torus,
                  {},
                  4 * pi * pi * 1.25 * 0.5});
  list.push_back({"disc",
                  {{"centre", vec(0.2, 0.1, -0.3)},
                   {"normal", vec(1, 2, 3)},
                   {"radius", number(1.5)},
                   {"hole_radius", number(0.5)}},
                  [=](Vec3 p) {
                    return dot(p - Vec3{Real(0.2), Real(0.1), Real(-0.3)}, slope);
                  },
                  [](Vec3 p) {
                    const double r = length(p - Vec3{Real(0.2), Real(0.1), Real(-0.3)});
                    return r > 0.5 && r < 1.5;
                  },
                  pi * 2,
                  false});
  list.push_back({"disc",
                  {{"centre", vec(0, 0, 0)}, {"normal", vec(0, -2, 0)}, {"radius", number(1)}},
                  [](Vec3 p) { return -double(p.y); },
                  [](Vec3 p) { return length(p) < 1; },
                  pi,
                  false});
  list.push_back({"quad",
                  {{"corner", vec(-1, -1, 0)}, {"edge1", vec(2, 0, 1)}, {"edge2", vec(0, 1.5, 0)}},
                  [](Vec3 p) { return (p.x * -1.0 + p.z * 2.0 - 1.0) / std::sqrt(5.0); },
                  [](Vec3 p) { return std::abs(p.x) < 1 && p.y > -1 && p.y < 0.5; },
                  std::sqrt(5.0) * 1.5,
                  false});
  for (Solid& s : list)
    if (!s.holds) s.holds = [](Vec3) { return true; };
  return list;
}

/// First crossing of the surface along a ray, by small steps and then bisection; infinite: none.
inline double march(const Solid& s, const Ray& ray, double tMax) {
  const int steps = 4000;
  double before = s.side(ray.at(ray.tMin)), low = ray.tMin;
  for (int k = 1; k <= steps; ++k) {
    const double t = ray.tMin + (tMax - ray.tMin) * k / steps, now = s.side(ray.at(Real(t)));
    if ((before < 0) != (now < 0)) {
      double a = low, b = t;
      for (int i = 0; i < 60; ++i) {
        const double m = 0.5 * (a + b);
        ((s.side(ray.at(Real(m))) < 0) == (before < 0) ? a : b) = m;
      }
      if (s.holds(ray.at(Real(a)))) return a;
    }
    before = now, low = t;
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace vestige::test
