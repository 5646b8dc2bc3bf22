// SPDX-License-Identifier: Apache-2.0
// A parallelogram that shines evenly, to the side of cross(edge1, edge2) or to both.
//
// Points are drawn uniformly by area, P = corner + u.x edge1 + u.y edge2, and the density turned
// into solid angle: distance^2 / (area cos). MATH is docs/mathematics.md, here and in the other
// lights.
#include <vestige/light.h>
#include <vestige/plugin.h>
#include <vestige/tools/sampling.h>
#include <vestige/tools/words.h>

namespace vestige {
namespace {

class Area final : public Light {
 public:
  enum Row { kCorner, kEdge1, kEdge2, kRadiance, kTwoSided };

  static Schema schema() {
    return {.kind = "light",
            .name = "area",
            .summary = "a parallelogram that shines",
            .params = {vec3("corner", {}).need().place().in("scene units").doc("one corner"),
                       vec3("edge1", {}).need().place().in("scene units").doc("from that corner"),
                       vec3("edge2", {})
                           .need()
                           .place()
                           .in("scene units")
                           .doc("from that corner; shines to the side of vcross(edge1, edge2)"),
                       rgb("radiance", 1).range(0, 1e12).in("W/(m^2 sr)").doc("given off"),
                       boolean("two_sided", false).doc("shines to both sides")}};
  }

  explicit Area(const Values& values)
      : corner_(values.toWorld().point(values.vec3(kCorner))),
        edge_{values.toWorld().vector(values.vec3(kEdge1)),
              values.toWorld().vector(values.vec3(kEdge2))},
        radiance_(values.rgb(kRadiance)),
        twoSided_(values.flag(kTwoSided)) {
    for (const Row row : {kEdge1, kEdge2})
      if (lengthSquared(values.vec3(row)) == 0)
        throw PluginError(
            row, "the edge " + words(values.vec3(row)) + " has no length: the light has no area");
    const Vec3 across = cross(edge_.c[0], edge_.c[1]);
    area_ = length(across);
    if (!(area_ > Real(1e-6) * length(edge_.c[0]) * length(edge_.c[1])))
      throw PluginError(kEdge2, "edge2 " + words(values.vec3(kEdge2)) + " is parallel to edge1 " +
                                    words(values.vec3(kEdge1)) + ": the light has no area");
    // A mirroring transform also mirrors the emitting side.
    const bool mirrored = values.toWorld().determinant() < 0;
    normal_ = (mirrored ? Real(-1) : Real(1)) * across / area_;
    offset_ = kRayError * std::max(maxAbsComponent(edge_.c[0]), maxAbsComponent(edge_.c[1]));
    mesh_.positions = {corner_, at({1, 0}), at({1, 1}), at({0, 1})};
    mesh_.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh_.triangles = {{0, 1, 2}, {0, 2, 3}};
    if (mirrored) mesh_.triangles = {{0, 2, 1}, {0, 3, 2}};
  }

  const TriangleMesh* geometry() const noexcept override { return &mesh_; }

  std::optional<LightSample> sample(const Receiver& r, Vec2 u) const noexcept override {
    const Vec3 position = at(u), way = position - r.position;
    const Real distance = length(way);
    const Vec3 toLight = way / distance;
    const Real pdf = density(toLight, distance);
    if (!(pdf > 0) || !std::isfinite(pdf)) return std::nullopt;
    return LightSample{
        {r.position, toLight, distance, position, normal_, u, {}, offset_}, radiance_, pdf};
  }

  Real pdf(const Receiver&, const LightHit& hit) const noexcept override {
    return density(hit.toLight, hit.distance);
  }

  Rgb eval(const LightHit& hit) const noexcept override {
    return cosine(hit.toLight) > 0 ? radiance_ : Rgb{};
  }

  LightJacobian sampleDerivatives(const Receiver& r, Vec2 u) const noexcept override {
    const Vec3 way = at(u) - r.position;  // [MATH 1.11]
    const Mat3 turn = (1 / length(way)) * projection(normalize(way));
    return {.du = turn * edge_, .dFrom = Real(-1) * turn};
  }

  LightLogGradient logGradient(const Receiver& r, Vec2 u) const noexcept override {
    // log (cos / distance^2) = log |normal . way| - 3/2 log way^2
    const Vec3 way = at(u) - r.position;
    const Real c = dot(normal_, way);
    if (c == 0) return {};
    const Vec3 dWay = normal_ / c - 3 / lengthSquared(way) * way;
    return {{dot(dWay, edge_.c[0]), dot(dWay, edge_.c[1])}, -dWay};
  }

  std::optional<Particle> emit(EmissionNumbers u) const noexcept override {
    const Side s = side(u.direction);
    // radiance cos / (cos / pi . 1 / area)
    return Particle{.origin = at(u.point),
                    .direction = Frame::around(s.normal).toWorld(cosineHemisphere(s.u).d),
                    .normal = s.normal,
                    .power = power(),
                    .variables = 4};
  }

  RayJacobian emissionDerivatives(EmissionNumbers u) const noexcept override {
    const Side s = side(u.direction);
    const Frame f = Frame::around(s.normal);
    const Mat3x2 du = cosineHemisphere(s.u).du;
    return {.dOrigin = {edge_.c[0], edge_.c[1]},
            .dDirection = {Vec3{}, Vec3{}, s.stretch * f.toWorld(du.c[0]), f.toWorld(du.c[1])}};
  }

  LightExtent extent() const noexcept override {
    LightExtent e{{}, normal_, twoSided_ ? kPi : 0};
    for (const Vec3& p : mesh_.positions) e.box.add(p);
    return e;
  }

  Rgb power() const noexcept override { return (twoSided_ ? 2 : 1) * kPi * area_ * radiance_; }

 private:
  /// The side from which a particle is emitted. If two-sided, the halves of the first random number
  /// choose it.
  struct Side {
    Vec3 normal;
    Vec2 u;
    Real stretch;  ///< d(u.x) per unit of the number given
  };
  Side side(Vec2 u) const noexcept {
    if (!twoSided_) return {normal_, u, 1};
    const bool front = u.x < Real(0.5);
    return {front ? normal_ : -normal_,
            {std::min(2 * u.x - (front ? 0 : 1), kOneMinusEpsilon), u.y},
            2};
  }

  Vec3 at(Vec2 u) const noexcept { return corner_ + edge_ * u; }

  /// Cosine at the light; 0 where it does not emit.
  Real cosine(Vec3 toLight) const noexcept {
    const Real c = -dot(normal_, toLight);
    return twoSided_ ? std::abs(c) : std::max(c, Real(0));
  }

  /// Of a point drawn by area, 1/sr.
  Real density(Vec3 toLight, Real distance) const noexcept {
    const Real c = cosine(toLight);
    return c > 0 ? sqr(distance) / (area_ * c) : 0;
  }

  Vec3 corner_;
  Mat3x2 edge_;
  Rgb radiance_;
  bool twoSided_;
  Vec3 normal_;  ///< unit, on the emitting side
  Real area_;    ///< world, scene units squared
  Real offset_;  ///< LightHit::offset
  TriangleMesh mesh_;
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Light, vestige::Area)
