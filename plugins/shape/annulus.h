// SPDX-License-Identifier: Apache-2.0
// A flat ring or full disc: a shape of its own and the lids of cylinders and cones.
#pragma once
#include <vestige/tools/sampling.h>

#include "exact.h"

namespace vestige {

struct Annulus {
  exact::Axes axes;  ///< n is the normal; u runs from s towards t
  exact::V centre;
  double hole, radius;  ///< 0 <= hole < radius
  double turn = 1;      ///< -1: the normal is -axes.n, u runs the same way

  double area() const noexcept { return exact::kPi * (radius * radius - hole * hole); }

  /// Whether a point of its plane lies on it.
  bool holds(exact::V p) const noexcept {
    const exact::V q = axes.local(p - centre);
    const double r2 = q.x * q.x + q.y * q.y;
    return r2 <= radius * radius && r2 >= hole * hole;
  }

  SurfacePoint near(Vec3 p) const noexcept {
    const exact::V q = axes.local(exact::V(p) - centre);
    const double r = std::hypot(q.x, q.y), clamped = std::clamp(r, hole, radius);
    return r > 0 ? point(q.x / r, q.y / r, clamped) : point(1, 0, clamped);
  }
  SurfacePoint at(Vec2 uv) const noexcept {
    const double a = 2 * exact::kPi * uv.x;
    return point(std::cos(a), std::sin(a), hole + uv.y * (radius - hole));
  }

  /// Uniform by area: concentric where there is no hole, polar (which then has no pole) else.
  AreaSample sample(Vec2 u) const noexcept {
    const auto flat = [&](double x, double y) -> Vec3 { return axes.world({x, y, 0}); };
    if (hole == 0) {
      const Disk k = concentricDisk(u);
      const auto scaled = [&](Vec2 d) { return flat(radius * d.x, radius * d.y); };
      const double l = std::sqrt(double(dot(k.d, k.d)));
      return {l > 0 ? point(k.d.x / l, k.d.y / l, radius * l) : point(1, 0, 0),
              {scaled(k.du[0]), scaled(k.du[1])},
              {},
              Real(1 / area())};
    }
    const double wide = radius * radius - hole * hole, r = std::sqrt(hole * hole + u.y * wide);
    const double a = 2 * exact::kPi * u.x, c = std::cos(a), s = std::sin(a);
    const double byV = wide / (2 * r), byU = 2 * exact::kPi * r;
    return {
        point(c, s, r), {flat(-byU * s, byU * c), flat(byV * c, byV * s)}, {}, Real(1 / area())};
  }

  void addTo(Bounds& b) const noexcept {
    Vec3 room;  // along each axis: radius times the sine of the angle to the normal
    for (int k = 0; k < 3; ++k) {
      const double n = Vec3(axes.n)[k];
      room[k] = Real(radius * std::sqrt(std::max(0.0, 1 - n * n)));
    }
    b.add(Vec3(centre) - room), b.add(Vec3(centre) + room);
  }

 private:
  SurfacePoint point(double c, double s, double r) const noexcept {
    SurfacePoint p;
    p.position = centre + axes.world({r * c, r * s, 0});
    p.normal = p.geometricNormal = turn * axes.n;
    p.uv = {Real(exact::turns(c, s)), Real((r - hole) / (radius - hole))};
    const double wide = 2 * exact::kPi * std::max(r, exact::kPole * radius);
    p.dPdu = axes.world({-wide * s, wide * c, 0});
    p.dPdv = (radius - hole) * axes.world({c, s, 0});
    p.dPduu = -4 * exact::kPi * exact::kPi * r * axes.world({c, s, 0});
    p.dPduv = 2 * exact::kPi * (radius - hole) * axes.world({-s, c, 0});
    return p;
  }
};

}  // namespace vestige
