// SPDX-License-Identifier: Apache-2.0
// A program that measures spheres, by closed forms.
#pragma once
#include <cmath>
#include <limits>

#include "lang/measure.h"
#include "tests/lang/schemas.h"

namespace vestige::lang::test {

/// Of spheres, moved and scaled alike in all directions, and unions of them. Planes have no bounds.
class Spheres : public Measure {
 public:
  int questions = 0;

  bool extent(const Object& object, Extent& extent, std::string& why) override {
    constexpr double kAll = std::numeric_limits<double>::infinity();
    extent = {{kAll, kAll, kAll}, {-kAll, -kAll, -kAll}};
    return each(*object, why, [&](const Point& c, double r) {
      for (std::size_t i = 0; i < 3; ++i) {
        extent.low[i] = std::min(extent.low[i], c[i] - r);
        extent.high[i] = std::max(extent.high[i], c[i] + r);
      }
    });
  }
  bool inside(const Object& object, const Point& p, bool& isInside, std::string& why) override {
    isInside = false;
    return each(*object, why, [&](const Point& c, double r) {
      isInside |= std::hypot(p[0] - c[0], p[1] - c[1], p[2] - c[2]) < r;
    });
  }
  bool trace(const Object& object, const Point& o, const Point& d, Hit& hit,
             std::string& why) override {
    double nearest = std::numeric_limits<double>::infinity();
    return each(*object, why, [&](const Point& c, double r) {
      const Point m = {o[0] - c[0], o[1] - c[1], o[2] - c[2]};
      const double a = dot(d, d), b = dot(m, d), root = b * b - a * (dot(m, m) - r * r);
      if (root < 0) return;
      for (const double t : {(-b - std::sqrt(root)) / a, (-b + std::sqrt(root)) / a})
        if (t > 1e-9 && t < nearest) {
          nearest = t;
          hit.isHit = true;
          for (std::size_t i = 0; i < 3; ++i) {
            hit.point[i] = o[i] + t * d[i];
            hit.normal[i] = (hit.point[i] - c[i]) / r;
          }
        }
    });
  }

 private:
  static double dot(const Point& a, const Point& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }
  template <class F>
  bool each(const Block& b, std::string& why, F f) {
    ++questions;
    for (const Block& child : b.children)
      if (!each(child, why, f)) return false;
    if (b.kind == "union") return true;
    if (b.plugin == "plane") return f({0, 0, 0}, std::numeric_limits<double>::infinity()), true;
    why = "it is no sphere";
    if (b.plugin != "sphere") return false;
    const auto& m = b.world.m;
    const auto& c = b.find("centre")->v;
    Point at{};
    for (std::size_t i = 0; i < 3; ++i)
      at[i] = m[i][0] * c[0] + m[i][1] * c[1] + m[i][2] * c[2] + m[i][3];
    f(at, b.find("radius")->v[0] * std::hypot(m[0][0], m[1][0], m[2][0]));
    return true;
  }
};

inline Options with(Spheres& spheres) {
  Options options;
  options.measure = &spheres;
  return options;
}

}  // namespace vestige::lang::test
