// SPDX-License-Identifier: Apache-2.0
// Parallelogram; its normal is cross(edge1, edge2).
#include <vestige/plugin.h>

#include "exact.h"

namespace vestige {
namespace {

using exact::V;

class Quad final : public Shape {
 public:
  enum Row { kCorner, kEdge1, kEdge2 };

  static Schema schema() {
    return {
        .kind = "shape",
        .name = "quad",
        .summary = "parallelogram; its normal is vcross(edge1, edge2)",
        .params = {vec3("corner", {}).need().place().in("scene units").doc("where u and v are 0"),
                   vec3("edge1", {}).need().place().in("scene units").doc("along u"),
                   vec3("edge2", {}).need().place().in("scene units").doc("along v")}};
  }
  explicit Quad(const Values& v)
      : corner_(v.vec3(kCorner)), edge1_(v.vec3(kEdge1)), edge2_(v.vec3(kEdge2)) {
    const V n = cross(V(edge1_), V(edge2_));
    if (!(length(V(edge1_)) > 0)) throw PluginError(kEdge1, "the edge has no length");
    if (!(length(n) > 1e-7 * length(V(edge1_)) * length(V(edge2_))))
      throw PluginError(kEdge2, "the two edges are parallel: the quad has no area");
    n_ = normalize(n);
    byU_ = (1 / dot(n, n)) * cross(V(edge2_), n);
    byV_ = (1 / dot(n, n)) * cross(n, V(edge1_));
    area_ = Real(length(n));
  }

  Bounds bounds() const noexcept override {
    Bounds b;
    for (const Vec3 e : {Vec3{}, edge1_, edge2_, edge1_ + edge2_}) b.add(corner_ + e);
    return b;
  }

  std::optional<ShapeHit> intersect(const Ray& ray) const noexcept override {
    const V o = V(ray.origin) - V(corner_), d(ray.direction);
    const double t = -dot(n_, o) / dot(n_, d);
    if (!exact::within(t, ray)) return std::nullopt;
    const V p = o + t * d;
    const double u = dot(byU_, p), v = dot(byV_, p);
    // A hair too wide, so that quads that share an edge leave no crack.
    constexpr double low = -1e-7, high = 1 + 1e-7;
    if (!(u >= low && u <= high && v >= low && v <= high)) return std::nullopt;
    return ShapeHit{Real(t)};
  }

  SurfacePoint surface(Vec3 near, const ShapeHit&) const noexcept override {
    const V p = V(near) - V(corner_);
    return at({Real(std::clamp(dot(byU_, p), 0.0, 1.0)), Real(std::clamp(dot(byV_, p), 0.0, 1.0))},
              0);
  }

  bool isClosed() const noexcept override { return false; }
  Real area() const noexcept override { return area_; }
  AreaSample samplePoint(Vec2 u) const noexcept override {
    return {at(u, 0), {edge1_, edge2_}, {}, 1 / area_};
  }

  int faces() const noexcept override { return 1; }
  SurfacePoint at(Vec2 uv, int) const noexcept override {
    const V p = V(corner_) + double(uv.x) * V(edge1_) + double(uv.y) * V(edge2_);
    return SurfacePoint::flat(p, n_, uv, edge1_, edge2_);
  }

 private:
  Vec3 corner_, edge1_, edge2_;
  V n_, byU_, byV_;  ///< unit normal; gradients of u and v
  Real area_;
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Shape, vestige::Quad)
