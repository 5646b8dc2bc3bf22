// SPDX-License-Identifier: Apache-2.0
// A shape that implements only what every shape must: faces() and at() keep their defaults, so its
// surface belongs to no patch.
//
//     p = corner + size (u, 0, v),   u and v in [0, 1]
#include <vestige/plugin.h>
#include <vestige/shape.h>

namespace vestige {
namespace {

class Faceless final : public Shape {
 public:
  enum Row { kCorner, kSize };

  static Schema schema() {
    return {.kind = "shape",
            .name = "faceless",
            .summary = "a square that lies flat and has no patches",
            .params = {vec3("corner", {}).need().place().in("scene units").doc("least x and z"),
                       real("size", 1).place().positive().in("scene units").doc("of a side")}};
  }
  explicit Faceless(const Values& values)
      : corner_(values.vec3(kCorner)), size_(values.real(kSize)) {}

  Bounds bounds() const noexcept override { return {corner_, corner_ + Vec3{size_, 0, size_}}; }
  std::optional<ShapeHit> intersect(const Ray& ray) const noexcept override {
    const double t = (double(corner_.y) - ray.origin.y) / ray.direction.y;
    if (!(t > ray.tMin && t < ray.tMax)) return std::nullopt;
    const Vec3 p = ray.at(Real(t)) - corner_;
    const bool isInside = p.x >= 0 && p.x <= size_ && p.z >= 0 && p.z <= size_;
    return isInside ? std::optional(ShapeHit{Real(t)}) : std::nullopt;
  }
  SurfacePoint surface(Vec3 near, const ShapeHit&) const noexcept override {
    SurfacePoint s{};
    s.position = {near.x, corner_.y, near.z};
    s.geometricNormal = {0, 1, 0};
    s.normal = s.geometricNormal;
    s.uv = {(near.x - corner_.x) / size_, (near.z - corner_.z) / size_};
    s.dPdu = {size_, 0, 0};
    s.dPdv = {0, 0, size_};
    return s;
  }
  bool isClosed() const noexcept override { return false; }
  Real area() const noexcept override { return size_ * size_; }
  AreaSample samplePoint(Vec2 u) const noexcept override {
    const SurfacePoint s = surface(corner_ + Vec3{size_ * u.x, 0, size_ * u.y}, {});
    return {.point = s, .du = {s.dPdu, s.dPdv}, .dNdu = {}, .pdf = 1 / area()};
  }

 private:
  Vec3 corner_;
  Real size_;
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Shape, vestige::Faceless)
