// SPDX-License-Identifier: Apache-2.0
// Flat disc, with a hole on request.
#include <vestige/plugin.h>

#include "annulus.h"

namespace vestige {
namespace {

class Disc final : public Shape {
 public:
  enum Row { kCentre, kNormal, kRadius, kHole };

  static Schema schema() {
    return {
        .kind = "shape",
        .name = "disc",
        .summary = "flat and round, with a hole on request",
        .params = {vec3("centre", {}).need().place().in("scene units").doc("the middle"),
                   vec3("normal", {0, 1, 0}).need().place().doc("of any length"),
                   real("radius", 1).need().place().positive().in("scene units").doc("of the rim"),
                   real("hole_radius", 0)
                       .place()
                       .range(0, std::numeric_limits<double>::infinity())
                       .in("scene units")
                       .doc("of the hole in the middle; 0: none")}};
  }
  explicit Disc(const Values& v) {
    const exact::V n(v.vec3(kNormal));
    if (!(length(n) > 0))
      throw PluginError(kNormal, "the normal is <0, 0, 0>, expected a direction");
    if (!(v.real(kHole) < v.real(kRadius)))
      throw PluginError(kHole, "the hole is as large as the disc: nothing is left of it");
    ring_ = {exact::Axes::around(normalize(n)), v.vec3(kCentre), v.real(kHole), v.real(kRadius)};
  }

  Bounds bounds() const noexcept override {
    Bounds b;
    ring_.addTo(b);
    return b;
  }

  std::optional<ShapeHit> intersect(const Ray& ray) const noexcept override {
    const exact::V o(ray.origin), d(ray.direction);
    const double t = dot(ring_.axes.n, ring_.centre - o) / dot(ring_.axes.n, d);
    if (!exact::within(t, ray) || !ring_.holds(o + t * d)) return std::nullopt;
    return ShapeHit{Real(t)};
  }

  SurfacePoint surface(Vec3 near, const ShapeHit&) const noexcept override {
    return ring_.near(near);
  }
  bool isClosed() const noexcept override { return false; }
  Real area() const noexcept override { return Real(ring_.area()); }
  AreaSample samplePoint(Vec2 u) const noexcept override { return ring_.sample(u); }
  int faces() const noexcept override { return 1; }
  SurfacePoint at(Vec2 uv, int) const noexcept override { return ring_.at(uv); }

 private:
  Annulus ring_;
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Shape, vestige::Disc)
