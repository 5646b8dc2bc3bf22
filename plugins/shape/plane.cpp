// SPDX-License-Identifier: Apache-2.0
// Plane n.x = d with n made a unit vector, as in POV-Ray; it bounds the half-space below.
#include <vestige/plugin.h>

#include "exact.h"

namespace vestige {
namespace {

using exact::V;

class Plane final : public Shape {
 public:
  enum Row { kNormal, kDistance };

  static Schema schema() {
    return {.kind = "shape",
            .name = "plane",
            .summary = "infinite plane",
            .params = {vec3("normal", {0, 1, 0}).need().place().doc("of any length"),
                       real("distance", 0)
                           .place()
                           .in("scene units")
                           .doc("from the origin, along the normal")}};
  }
  explicit Plane(const Values& v) : d_(v.real(kDistance)) {
    const V n(v.vec3(kNormal));
    if (!(length(n) > 0))
      throw PluginError(kNormal, "the normal is <0, 0, 0>, expected a direction");
    axes_ = exact::Axes::around(normalize(n));
  }

  Bounds bounds() const noexcept override {
    return {{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};
  }

  std::optional<ShapeHit> intersect(const Ray& ray) const noexcept override {
    const double slope = dot(axes_.n, V(ray.direction));
    const double t = (d_ - dot(axes_.n, V(ray.origin))) / slope;
    if (slope == 0 || !exact::within(t, ray)) return std::nullopt;
    return ShapeHit{Real(t)};
  }

  SurfacePoint surface(Vec3 near, const ShapeHit&) const noexcept override {
    const V p = axes_.local(near);
    return SurfacePoint::flat(axes_.world({p.x, p.y, d_}), axes_.n, {Real(p.x), Real(p.y)}, axes_.s,
                              axes_.t);
  }

  bool isClosed() const noexcept override { return true; }
  Real area() const noexcept override { return 0; }
  AreaSample samplePoint(Vec2) const noexcept override { return {}; }

 private:
  exact::Axes axes_;
  double d_;
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Shape, vestige::Plane)
