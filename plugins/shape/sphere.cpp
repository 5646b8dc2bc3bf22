// SPDX-License-Identifier: Apache-2.0
// Sphere, sampled by the angle that it fills.
//
// [MATH] docs/mathematics.md 1.11: derivatives of the cone sampler
#include <vestige/plugin.h>
#include <vestige/tools/sampling.h>

#include "exact.h"

namespace vestige {
namespace {

using exact::V;

class Sphere final : public Shape {
 public:
  enum Row { kCentre, kRadius };

  static Schema schema() {
    return {.kind = "shape",
            .name = "sphere",
            .summary = "all points at one distance from a centre",
            .params = {vec3("centre", {}).need().place().in("scene units").doc("the middle"),
                       real("radius", 1)
                           .need()
                           .place()
                           .positive()
                           .in("scene units")
                           .doc("from the middle to the surface")}};
  }
  explicit Sphere(const Values& v)
      : c_(v.vec3(kCentre)),
        r_(v.real(kRadius)),
        onIt_(1e-6 + 4 * double(std::numeric_limits<Real>::epsilon()) *
                         double(maxAbsComponent(c_) / r_)) {}

  Bounds bounds() const noexcept override {
    const Vec3 r{r_, r_, r_};
    return {c_ - r, c_ + r};
  }

  std::optional<ShapeHit> intersect(const Ray& ray) const noexcept override {
    const std::optional<Chord> c = chord(ray);
    if (!c) return std::nullopt;
    for (const double t : {c->in, c->out})
      if (exact::within(t, ray)) return ShapeHit{Real(t)};
    return std::nullopt;
  }
  int crossings(const Ray& ray, std::span<Crossing> found) const noexcept override {
    const std::optional<Chord> c = chord(ray);
    if (!c) return 0;
    return exact::interval({Real(c->in)}, c->in, {Real(c->out)}, c->out, ray, found);
  }

  SurfacePoint surface(Vec3 near, const ShapeHit&) const noexcept override {
    const V away = V(near) - V(c_);
    const double l = length(away);
    return point(l > 0 ? (1 / l) * away : V{0, 1, 0});
  }

  bool isClosed() const noexcept override { return true; }
  Real area() const noexcept override { return 4 * kPi * r_ * r_; }

  AreaSample samplePoint(Vec2 u) const noexcept override {
    const Direction d = uniformCap(u, -1);
    return {point(V(d.d)), r_ * d.du, d.du, 1 / area()};
  }

  std::optional<ConeSample> sampleToward(Vec3 from, Vec2 u) const noexcept override {
    const Cone k = cone(from);
    if (!(k.height > 0)) return std::nullopt;
    const Cap s = cap(u, k.height);
    // The chord begins where the ray comes within r of the centre.
    const double sine2 = dot(V(s.d.x, s.d.y, 0), V(s.d.x, s.d.y, 0));
    const double chord =
        std::sqrt(std::max(0.0, double(r_) * r_ - k.distance * k.distance * sine2));
    return ConeSample{Frame::around(k.axis).toWorld(s.d), Real(k.distance * s.d.z - chord),
                      towardPdf(from)};
  }

  Real towardPdf(Vec3 from) const noexcept override {
    const Cone k = cone(from);
    return k.height > 0 ? Real(1 / (2 * exact::kPi * k.height)) : 0;
  }

  ConeJacobian towardDerivatives(Vec3 from, Vec2 u) const noexcept override {
    const Cone k = cone(from);
    if (!(k.height > 0)) return {};
    const Frame frame = Frame::around(k.axis);
    const Cap s = cap(u, k.height);
    const Vec3 d = frame.toWorld(s.d), w = k.axis;
    // The axis turns and takes the sample along; the cap widens as the eye comes nearer:
    // d(height)/d(distance) = -r^2 / (distance^3 cos) [MATH 1.11].
    const Mat3 turn = dot(w, d) * identity() - outer(w, d);
    const Real widen = Real(double(r_) * r_ /
                            (k.distance * k.distance * k.distance * std::max(1 - k.height, 1e-6)));
    return {{frame.toWorld(s.du.c[0]), frame.toWorld(s.du.c[1])},
            Real(-1 / k.distance) * (turn * projection(w)) +
                outer(frame.toWorld(s.byHeight), widen * w)};
  }

  int faces() const noexcept override { return 1; }
  SurfacePoint at(Vec2 uv, int) const noexcept override {
    const double a = 2 * exact::kPi * uv.x, b = exact::kPi * uv.y, s = std::sin(b);
    return point({s * std::cos(a), -std::cos(b), s * std::sin(a)});
  }

 private:
  /// The part of a ray's line that is inside, by t.
  struct Chord {
    double in, out;
  };
  std::optional<Chord> chord(const Ray& ray) const noexcept {
    const V d(ray.direction), o = V(ray.origin) - V(c_);
    const double a = dot(d, d), nearest = -dot(o, d) / a;
    // From the point of the ray nearest to the centre: no large squares are subtracted
    // [Haines et al. 2019, Ray Tracing Gems 7].
    const V p = o + nearest * d;
    const double half2 = (double(r_) * r_ - dot(p, p)) / a;
    if (!(half2 >= 0)) return std::nullopt;
    const double half = std::sqrt(half2);
    return Chord{nearest - half, nearest + half};
  }

  struct Cone {
    Vec3 axis;        ///< unit, from the eye to the centre
    double distance;  ///< to the centre
    double height;    ///< 1 - cosine of the half angle; 0: the eye is inside
  };
  Cone cone(Vec3 from) const noexcept {
    const V way = V(c_) - V(from);
    const double d2 = dot(way, way), d = std::sqrt(d2), s2 = double(r_) * r_ / d2;
    if (!(s2 < 1 - onIt_)) return {{}, d, 0};  // on it or inside
    return {(1 / d) * way, d, s2 / (1 + std::sqrt(1 - s2))};
  }

  /// Directions around +z, uniform over the cap of this height, and their derivatives. As
  /// uniformCap(), but by the height, which keeps its digits when the cap is small.
  struct Cap {
    Vec3 d;
    Mat3x2 du;
    Vec3 byHeight;
  };
  static Cap cap(Vec2 u, double height) noexcept {
    // z = 1 - h q, radius = m |disk point| with m^2 = h (2 - h q), q = |disk point|^2
    const Disk k = concentricDisk(u);
    const double h = height, q = vestige::dot(k.d, k.d), m = std::sqrt(h * (2 - h * q));
    const auto column = [&](Vec2 d) {
      const double dq = 2 * vestige::dot(k.d, d), dm = -h * h * dq / (2 * m);
      return Vec3{Real(d.x * m + k.d.x * dm), Real(d.y * m + k.d.y * dm), Real(-h * dq)};
    };
    const double mh = (1 - h * q) / m;
    return {{Real(k.d.x * m), Real(k.d.y * m), Real(1 - h * q)},
            {column(k.du[0]), column(k.du[1])},
            {Real(k.d.x * mh), Real(k.d.y * mh), Real(-q)}};
  }

  /// The point in direction n from the centre.
  SurfacePoint point(V n) const noexcept {
    const double ring = std::hypot(n.x, n.z), r = double(r_);
    const V out = ring > 0 ? V{n.x / ring, 0, n.z / ring} : V{1, 0, 0};
    const double wide = std::max(ring, exact::kPole);
    SurfacePoint s;
    s.position = V(c_) + r * n;
    s.normal = s.geometricNormal = n;
    s.uv = {Real(exact::turns(n.x, n.z)), Real(std::atan2(ring, -n.y) / exact::kPi)};
    s.dNdu = 2 * exact::kPi * wide * V{-out.z, 0, out.x};
    s.dNdv = exact::kPi * V{-n.y * out.x, ring, -n.y * out.z};
    s.dPdu = r_ * s.dNdu, s.dPdv = r_ * s.dNdv;
    const double turn = exact::kPi * exact::kPi * r;  // by u an angle of 2 pi, by v of pi
    s.dPduu = -4 * turn * V{n.x, 0, n.z};
    s.dPduv = -2 * turn * n.y * V{-out.z, 0, out.x};
    s.dPdvv = -turn * n;
    return s;
  }

  Vec3 c_;
  Real r_;
  /// 1 - (radius / distance)^2 of an eye that may lie on the sphere, as coordinates are rounded.
  double onIt_;
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Shape, vestige::Sphere)
