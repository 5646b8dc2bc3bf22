// SPDX-License-Identifier: Apache-2.0
// What cylinder and cone share: a circle of one radius carried along an axis to one of another.
// Faces: 0 the side, u around and v along the axis; then the lids that there are, uv as a disc's.
#pragma once
#include "annulus.h"

namespace vestige {

class Frustum : public Shape {
 public:
  Bounds bounds() const noexcept final {
    Bounds b;
    for (const Annulus& l : ends_) l.addTo(b);
    return b;
  }

  std::optional<ShapeHit> intersect(const Ray& ray) const noexcept final {
    const Meetings all = meetings(ray);
    const Meetings::One* best = nullptr;
    for (int k = 0; k < all.count; ++k)
      if (exact::within(all.list[k].t, ray) && (!best || all.list[k].t < best->t))
        best = &all.list[k];
    if (!best) return std::nullopt;
    return ShapeHit{Real(best->t), best->face};
  }

  int crossings(const Ray& ray, std::span<Crossing> found) const noexcept final {
    if (open_) return Shape::crossings(ray, found);
    // Convex: the nearest and the farthest meeting, whatever an edge adds between.
    const Meetings all = meetings(ray);
    if (all.count < 2) return 0;
    const auto byT = [](const Meetings::One& a, const Meetings::One& b) { return a.t < b.t; };
    const auto [in, out] = std::minmax_element(all.list, all.list + all.count, byT);
    return exact::interval({Real(in->t), in->face}, in->t, {Real(out->t), out->face}, out->t, ray,
                           found);
  }

  SurfacePoint surface(Vec3 near, const ShapeHit& hit) const noexcept final {
    const int face = hit.part;
    if (face > 0) return ends_[lidEnd_[face - 1]].near(near);
    const exact::V q = axes_.local(exact::V(near) - base_);
    const double r = std::hypot(q.x, q.y);
    const double z = std::clamp(q.z, 0.0, height_);
    return r > 0 ? side(q.x / r, q.y / r, z) : side(1, 0, z);
  }

  bool isClosed() const noexcept final { return !open_; }
  Real area() const noexcept final { return Real(sums_[lids_]); }

  AreaSample samplePoint(Vec2 u) const noexcept final {
    const double total = sums_[lids_], x = u.x * total;
    int f = 0;
    while (f < lids_ && x >= sums_[f]) ++f;
    const double low = f > 0 ? sums_[f - 1] : 0, width = sums_[f] - low;
    const Vec2 rest{Real(std::clamp((x - low) / width, 0.0, 1.0)), u.y};
    AreaSample s = f == 0 ? sampleSide(rest) : ends_[lidEnd_[f - 1]].sample(rest);
    s.du.c[0] *= Real(total / width), s.dNdu.c[0] *= Real(total / width);
    s.pdf = Real(1 / total);
    return s;
  }

  int faces() const noexcept final { return 1 + lids_; }
  SurfacePoint at(Vec2 uv, int face) const noexcept final {
    if (face > 0) return ends_[lidEnd_[face - 1]].at(uv);
    const double a = 2 * exact::kPi * uv.x;
    return side(std::cos(a), std::sin(a), uv.y * height_);
  }

 protected:
  /// a != b; radii not negative and not both 0.
  Frustum(Vec3 a, Real ra, Vec3 b, Real rb, bool open) : base_(a), ra_(ra), rb_(rb), open_(open) {
    const exact::V axis = exact::V(b) - exact::V(a);
    height_ = length(axis);
    axes_ = exact::Axes::around((1 / height_) * axis);
    slope_ = (rb_ - ra_) / height_;
    slant_ = std::sqrt(1 + slope_ * slope_);
    ends_[0] = {axes_, base_, 0, ra_, -1}, ends_[1] = {axes_, exact::V(b), 0, rb_, 1};
    sums_[0] = exact::kPi * (ra_ + rb_) * slant_ * height_;
    for (int end = 0; end < 2 && !open; ++end)
      if (ends_[end].radius > 0) {
        lidEnd_[lids_++] = end;
        sums_[lids_] = sums_[lids_ - 1] + ends_[end].area();
      }
  }

 private:
  /// Where a ray's line meets the side and the lids, in no order.
  struct Meetings {
    struct One {
      double t;
      int face;
    };
    One list[4];
    int count = 0;
  };
  Meetings meetings(const Ray& ray) const noexcept {
    const exact::V o = axes_.local(exact::V(ray.origin) - base_), d = axes_.local(ray.direction);
    Meetings all;
    // x^2 + y^2 = (radius at z)^2
    const double r = ra_ + slope_ * o.z, dr = slope_ * d.z;
    double roots[2];
    const int n = exact::quadratic(d.x * d.x + d.y * d.y - dr * dr, d.x * o.x + d.y * o.y - r * dr,
                                   o.x * o.x + o.y * o.y - r * r, roots);
    for (int k = 0; k < n; ++k) {
      const double z = o.z + roots[k] * d.z;
      if (z >= 0 && z <= height_) all.list[all.count++] = {roots[k], 0};
    }
    for (int k = 0; k < lids_ && d.z != 0; ++k) {
      const bool far = lidEnd_[k] == 1;
      const double t = ((far ? height_ : 0) - o.z) / d.z, x = o.x + t * d.x, y = o.y + t * d.y;
      const double limit = far ? rb_ : ra_;
      if (x * x + y * y <= limit * limit) all.list[all.count++] = {t, k + 1};
    }
    return all;
  }

  SurfacePoint side(double c, double s, double z) const noexcept {
    const double r = std::max(0.0, ra_ + slope_ * z);
    SurfacePoint p;
    p.position = base_ + axes_.world({r * c, r * s, z});
    p.normal = p.geometricNormal = (1 / slant_) * axes_.world({c, s, -slope_});
    p.uv = {Real(exact::turns(c, s)), Real(z / height_)};
    const double wide = 2 * exact::kPi * std::max(r, exact::kPole * std::max(ra_, rb_));
    const exact::V around = axes_.world({-s, c, 0});
    p.dPdu = wide * around;
    p.dPdv = axes_.world({slope_ * height_ * c, slope_ * height_ * s, height_});
    p.dNdu = (2 * exact::kPi / slant_) * around;
    p.dPduu = -4 * exact::kPi * exact::kPi * r * axes_.world({c, s, 0});
    p.dPduv = 2 * exact::kPi * slope_ * height_ * around;
    return p;
  }

  AreaSample sampleSide(Vec2 u) const noexcept {
    // The circumference grows linearly: radius^2 is uniform. z/h = y (ra + rb) / (ra + r).
    const double r = std::sqrt(ra_ * ra_ + u.y * (rb_ * rb_ - ra_ * ra_));
    const double sum = ra_ + rb_, z = height_ * std::min(1.0, u.y * sum / (ra_ + r));
    const double a = 2 * exact::kPi * u.x;
    SurfacePoint p = side(std::cos(a), std::sin(a), ra_ + r > 0 ? z : 0);
    const double byV = sum / (2 * std::max(r, exact::kPole * sum));  // d(z/h) by u.y
    return {p, {p.dPdu, Real(byV) * p.dPdv}, {p.dNdu, {}}, Real(1 / sums_[0])};
  }

  exact::V base_;
  exact::Axes axes_;  ///< n along the axis
  double ra_, rb_, height_, slope_, slant_;
  bool open_;
  Annulus ends_[2];
  int lids_ = 0, lidEnd_[2] = {};  ///< which ends have one, by face - 1
  double sums_[3];                 ///< areas of the faces up to and including each
};

}  // namespace vestige
