// SPDX-License-Identifier: Apache-2.0
// makeShapeLight(): which points of a placement are drawn, and how.
#include "engine/light/shape_light.h"

#include "engine/light/surface_light.h"
#include "engine/trace/place.h"
#include "engine/trace/triangles.h"

#include <vestige/tools/sampling.h>

namespace vestige {
namespace {

/// Largest coordinate.
Real reachOf(const Bounds& b) noexcept {
  return b.isEmpty() ? 0 : std::max(maxAbsComponent(b.low), maxAbsComponent(b.high));
}

/// An analytic shape: by the angle that it fills where the shape can and the placement keeps
/// angles, else by area in the shape's own space.
class AnalyticLight final : public SurfaceLight {
 public:
  AnalyticLight(const Placement& p, Radiance radiance, bool twoSided, Rgb mean)
      : SurfaceLight(std::move(radiance), twoSided, mean), shape_(p.shape), place_(p.toWorld) {
    constexpr int n = 32;  // world area: the mean stretch over the shape's own area
    double sum = 0;
    if (shape_->area() > 0)
      for (int i = 0; i < n * n; ++i) {
        const AreaSample a =
            shape_->samplePoint({(i % n + Real(0.5)) / n, (i / n + Real(0.5)) / n});
        sum += place_.stretch(a.point.geometricNormal) / a.pdf;
        const Vec3 normal = place_.world(a.point).geometricNormal;
        if (i == 0) axis_ = normal;
        isFlat_ = isFlat_ && dot(normal, axis_) > Real(0.9999);
      }
    area_ = Real(sum / (n * n));
    // A ray is rounded when it enters the shape's own space.
    offset_ = kRayError * place_.norm * reachOf(shape_->bounds());
  }

  std::optional<LightSample> sample(const Receiver& r, Vec2 u) const noexcept override {
    const Vec3 from = r.position;
    const std::optional<ConeSample> c = cone(from, u);
    if (!c) return SurfaceLight::sample(r, u);
    return seen(from, met(from, *c), normalize(place_.linear * c->toShape),
                c->distance * length(place_.linear * c->toShape), c->pdf);
  }

  Real pdf(const Receiver& r, const LightHit& hit) const noexcept override {
    const Real byAngle = conePdf(r.position);
    return byAngle > 0 ? byAngle : SurfaceLight::pdf(r, hit);
  }

  LightJacobian sampleDerivatives(const Receiver& r, Vec2 u) const noexcept override {
    const Vec3 from = r.position;
    if (!(conePdf(from) > 0)) return SurfaceLight::sampleDerivatives(r, u);
    const ConeJacobian c = shape_->towardDerivatives(place_.toObject.point(from), u);
    // Directions are rotated by the linear part over its scale; the receiver is transformed by the
    // inverse.
    const Mat3 turn = (1 / std::sqrt(place_.areaScale)) * place_.linear;
    return {turn * c.du, turn * c.dFrom * place_.toObject.linear()};
  }

  LightLogGradient logGradient(const Receiver& r, Vec2 u) const noexcept override {
    const Vec3 from = r.position;
    const std::optional<ConeSample> c = cone(from, u);
    if (!c) return SurfaceLight::logGradient(r, u);
    // A direction was drawn: only the radiance changes, with the point that it meets [MATH 1.3].
    const SurfacePoint p = met(from, *c);
    const Vec3 w = normalize(place_.linear * c->toShape), n = p.geometricNormal;
    const Real distance = length(p.position - from), cosine = dot(w, n);
    if (std::abs(cosine) < Real(1e-3)) return {};
    const LightJacobian turn = sampleDerivatives(r, u);
    const auto along = [&](Vec3 dFrom, Vec3 dToLight) {
      const Vec3 moved = dFrom + distance * dToLight;
      return radianceSlope(p, moved - dot(n, moved) / cosine * w);
    };
    LightLogGradient g{{along({}, turn.du.c[0]), along({}, turn.du.c[1])}, {}};
    for (int k = 0; k < 3; ++k) {
      Vec3 axis;
      axis[k] = 1;
      g.dFrom[k] = along(axis, turn.dFrom * axis);
    }
    return g;
  }

 private:
  Real conePdf(Vec3 from) const noexcept {
    return place_.similarity ? shape_->towardPdf(place_.toObject.point(from)) : 0;
  }
  std::optional<ConeSample> cone(Vec3 from, Vec2 u) const noexcept {
    if (!(conePdf(from) > 0)) return std::nullopt;
    return shape_->sampleToward(place_.toObject.point(from), u);
  }

  /// The point that a ray meets which was drawn by angle; world.
  SurfacePoint met(Vec3 from, const ConeSample& c) const noexcept {
    const Vec3 eye = place_.toObject.point(from);
    const std::optional<ShapeHit> hit = shape_->intersect({eye, c.toShape, 0, kInfinity});
    const Vec3 near = eye + (hit ? hit->t : c.distance) * c.toShape;
    return place_.world(shape_->surface(near, hit ? *hit : ShapeHit{}));
  }

  std::optional<AreaSample> draw(Vec2 u) const noexcept override {
    if (!(shape_->area() > 0)) return std::nullopt;
    AreaSample a = shape_->samplePoint(u);
    a.pdf /= place_.stretch(a.point.geometricNormal);
    const Vec3 n = place_.normals * a.point.geometricNormal;
    const Real l = length(n);
    for (int k = 0; k < 2; ++k) {  // as Place::world() does with the derivatives by uv
      const Vec3 d = place_.normals * a.dNdu.c[k];
      a.dNdu.c[k] = (d - dot(n, d) / (l * l) * n) / l;
      a.du.c[k] = place_.linear * a.du.c[k];
    }
    a.point = place_.world(a.point);
    return a;
  }
  Real areaPdf(Vec3 normal) const noexcept override {
    const Vec3 own = normalize(transpose(place_.linear) * normal);
    return 1 / (shape_->area() * place_.stretch(own));
  }
  Real area() const noexcept override { return area_; }
  LightExtent oneSided() const noexcept override {
    return {place_.bounds(shape_->bounds()), axis_, isFlat_ ? Real(0.03) : kPi};
  }

  std::shared_ptr<const Shape> shape_;
  Place place_;
  Real area_;
  Vec3 axis_{0, 0, 1};  ///< the normal, where it is the same everywhere
  bool isFlat_ = true;
};

/// Triangles: one is chosen by area with u.x, which is then stretched over its own interval again,
/// so that a low-discrepancy pair keeps its order inside each; so du grows by 1 / chance.
class MeshLight final : public SurfaceLight {
 public:
  MeshLight(const Placement& p, Radiance radiance, bool twoSided, Rgb mean)
      : SurfaceLight(std::move(radiance), twoSided, mean),
        shape_(p.shape),
        triangles_(*p.mesh, p.toWorld) {
    sums_.reserve(triangles_.size());
    double sum = 0;
    Real edge = 0;
    for (std::uint32_t k = 0; k < triangles_.size(); ++k) {
      sums_.push_back(sum += double(triangles_.area(k)));
      const Triangles::Edges e = triangles_.edges(k);
      edge = std::max({edge, maxAbsComponent(e.ab), maxAbsComponent(e.ac)});
    }
    // As in World for an instance, since the mesh may be one.
    const Place place(p.toWorld);
    offset_ = kRayError * (edge + place.condition * (reachOf(triangles_.bounds()) + place.shift));
  }

 private:
  std::optional<AreaSample> draw(Vec2 u) const noexcept override {
    if (sums_.empty()) return std::nullopt;
    const double total = sums_.back(), x = double(u.x) * total;
    const auto chosen = std::upper_bound(sums_.begin(), sums_.end() - 1, x);
    const auto k = std::uint32_t(chosen - sums_.begin());
    const double low = k > 0 ? sums_[k - 1] : 0, width = *chosen - low;
    const Real rest = std::clamp(Real((x - low) / width), Real(0), kOneMinusEpsilon);
    const TrianglePoint t = uniformTriangle({rest, u.y});
    const Triangles::Edges e = triangles_.edges(k);
    const Real stretch = Real(total / width);
    const auto column = [&](Vec2 d) { return d.x * e.ab + d.y * e.ac; };
    AreaSample s{{}, {stretch * column(t.du[0]), column(t.du[1])}, {}, Real(1 / total)};
    triangles_.at(k, t.b, s.point);
    return s;
  }
  Real areaPdf(Vec3) const noexcept override { return sums_.empty() ? 0 : Real(1 / sums_.back()); }
  Real area() const noexcept override { return sums_.empty() ? 0 : Real(sums_.back()); }
  LightExtent oneSided() const noexcept override {
    Vec3 sum;
    for (std::uint32_t k = 0; k < triangles_.size(); ++k)
      sum += triangles_.area(k) * triangles_.edges(k).normal;
    if (!(lengthSquared(sum) > 0)) return {triangles_.bounds()};
    LightExtent result{triangles_.bounds(), normalize(sum), 0};
    Real least = 1;
    for (std::uint32_t k = 0; k < triangles_.size(); ++k)
      least = std::min(least, dot(triangles_.edges(k).normal, result.axis));
    result.spread = std::acos(std::max(least, Real(-1)));
    return result;
  }

  std::shared_ptr<const Shape> shape_;  ///< keeps the mesh alive
  Triangles triangles_;
  std::vector<double> sums_;  ///< areas up to and including each triangle
};

}  // namespace

std::unique_ptr<Light> makeShapeLight(const Placement& placement,
                                      std::function<Rgb(const SurfacePoint&)> radiance,
                                      bool twoSided, Rgb meanRadiance) {
  std::unique_ptr<SurfaceLight> light;
  if (placement.mesh)
    light = std::make_unique<MeshLight>(placement, std::move(radiance), twoSided, meanRadiance);
  else
    light = std::make_unique<AnalyticLight>(placement, std::move(radiance), twoSided, meanRadiance);
  if (!shareKind(placement.visibleTo, RayKind::indirect)) light->hide();
  return light;
}

}  // namespace vestige
