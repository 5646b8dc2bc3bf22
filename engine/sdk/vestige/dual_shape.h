// SPDX-License-Identifier: Apache-2.0
// Base class of shapes whose author writes the point P(u, v) as a template over the number, and the
// intersection with a ray; tangents, normals and their derivatives follow.
//
//   class Bowl final : public DualShape<Bowl> {
//     template <class T>
//     TVec3<T> point(const T& u, const T& v, int face) const noexcept { ... }
//     std::optional<ShapeHit> intersect(const Ray& ray) const noexcept override;  // with its uv
//     Bounds bounds() const noexcept override;
//   };
#pragma once
#include <vestige/dual.h>
#include <vestige/shape.h>

namespace vestige {

/// A number with its first and second derivatives by u and v: a truncated Taylor series. Templates
/// over it follow the rules of dual.h: branch on value(x).
struct Jet {
  Real v = 0, du = 0, dv = 0, duu = 0, duv = 0, dvv = 0;

  Jet() = default;
  Jet(Real value) : v(value) {}  // NOLINT: a constant is a number that does not move
  Jet(Real value, Real byU, Real byV, Real byUu, Real byUv, Real byVv)
      : v(value), du(byU), dv(byV), duu(byUu), duv(byUv), dvv(byVv) {}
};

inline Real value(const Jet& x) noexcept { return x.v; }

/// g(a) of a function whose value and first two derivatives at a are known.
inline Jet chain(const Jet& a, Real g, Real dg, Real ddg) noexcept {
  return {g,
          dg * a.du,
          dg * a.dv,
          dg * a.duu + ddg * a.du * a.du,
          dg * a.duv + ddg * a.du * a.dv,
          dg * a.dvv + ddg * a.dv * a.dv};
}
inline Jet operator+(const Jet& a, const Jet& b) noexcept {
  return {a.v + b.v, a.du + b.du, a.dv + b.dv, a.duu + b.duu, a.duv + b.duv, a.dvv + b.dvv};
}
inline Jet operator-(const Jet& a) noexcept { return {-a.v, -a.du, -a.dv, -a.duu, -a.duv, -a.dvv}; }
inline Jet operator-(const Jet& a, const Jet& b) noexcept { return a + -b; }
inline Jet operator*(const Jet& a, const Jet& b) noexcept {
  return {a.v * b.v,
          a.v * b.du + a.du * b.v,
          a.v * b.dv + a.dv * b.v,
          a.v * b.duu + 2 * a.du * b.du + a.duu * b.v,
          a.v * b.duv + a.du * b.dv + a.dv * b.du + a.duv * b.v,
          a.v * b.dvv + 2 * a.dv * b.dv + a.dvv * b.v};
}
inline Jet operator/(const Jet& a, const Jet& b) noexcept {
  const Real r = 1 / b.v;
  return a * chain(b, r, -r * r, 2 * r * r * r);
}
/// The derivatives at zero are taken as zero, as for Dual.
inline Jet sqrt(const Jet& a) noexcept {
  const Real r = safeSqrt(a.v);
  const Real d = r > 0 ? Real(0.5) / r : Real(0);
  return chain(a, r, d, r > 0 ? -d / (2 * a.v) : Real(0));
}
inline Jet exp(const Jet& a) noexcept {
  const Real e = std::exp(a.v);
  return chain(a, e, e, e);
}
inline Jet log(const Jet& a) noexcept { return chain(a, std::log(a.v), 1 / a.v, -1 / sqr(a.v)); }
inline Jet sin(const Jet& a) noexcept {
  const Real s = std::sin(a.v);
  return chain(a, s, std::cos(a.v), -s);
}
inline Jet cos(const Jet& a) noexcept {
  const Real c = std::cos(a.v);
  return chain(a, c, -std::sin(a.v), -c);
}
/// a to a constant power, a >= 0.
inline Jet pow(const Jet& a, Real n) noexcept {
  if (!(a.v > 0)) return {std::pow(a.v, n)};
  const Real p = std::pow(a.v, n);
  return chain(a, p, n * p / a.v, n * (n - 1) * p / sqr(a.v));
}
inline Jet abs(const Jet& a) noexcept { return a.v < 0 ? -a : a; }
inline Jet max(const Jet& a, const Jet& b) noexcept { return a.v < b.v ? b : a; }
inline Jet min(const Jet& a, const Jet& b) noexcept { return b.v < a.v ? b : a; }

/// Base of a shape with a template point(u, v, face). Its intersect() must set uv and part (the
/// face) in the ShapeHit. It cannot emit light unless it overrides area() and samplePoint().
template <class Derived>
class DualShape : public Shape {
 public:
  SurfacePoint surface(Vec3, const ShapeHit& hit) const noexcept final {
    return at(hit.uv, hit.part);
  }
  SurfacePoint at(Vec2 uv, int face) const noexcept final;

  int faces() const noexcept override { return 1; }
  bool isClosed() const noexcept override { return false; }
  Real area() const noexcept override { return 0; }
  AreaSample samplePoint(Vec2) const noexcept override { return {}; }

  /// Orientation of the normal: 1 along dP/du x dP/dv, -1 against it.
  virtual Real side(int /*face*/) const noexcept { return 1; }

 private:
  using Jets = TVec3<Jet>;
  Jets jets(Vec2 uv, int face) const noexcept {
    return static_cast<const Derived*>(this)->point(Jet(uv.x, 1, 0, 0, 0, 0),
                                                    Jet(uv.y, 0, 1, 0, 0, 0), face);
  }
};

template <class Derived>
SurfacePoint DualShape<Derived>::at(Vec2 uv, int face) const noexcept {
  Jets p = jets(uv, face);
  SurfacePoint s;
  s.position = {p.x.v, p.y.v, p.z.v};
  s.uv = uv;
  const auto derive = [&] {
    s.dPdu = {p.x.du, p.y.du, p.z.du};
    s.dPdv = {p.x.dv, p.y.dv, p.z.dv};
    return cross(s.dPdu, s.dPdv);
  };
  Vec3 n = derive();
  // At a pole a tangent vanishes: take the derivatives a little beside it, where they still span
  // the tangent plane.
  constexpr Real kAside = Real(1e-4);
  if (!(length(n) > kAside * std::max(lengthSquared(s.dPdu), lengthSquared(s.dPdv)))) {
    p = jets(uv + kAside * (Vec2{Real(0.5), Real(0.5)} - uv), face);
    n = derive();
  }
  s.dPduu = {p.x.duu, p.y.duu, p.z.duu};
  s.dPduv = {p.x.duv, p.y.duv, p.z.duv};
  s.dPdvv = {p.x.dvv, p.y.dvv, p.z.dvv};
  const Real l = length(n);
  s.normal = s.geometricNormal = (side(face) / l) * n;
  const auto turned = [&](Vec3 d) {  // d(n / |n|) = P(n) dn / |n|
    return (side(face) / l) * (d - dot(d, s.normal) * s.normal);
  };
  s.dNdu = turned(cross(s.dPduu, s.dPdv) + cross(s.dPdu, s.dPduv));
  s.dNdv = turned(cross(s.dPduv, s.dPdv) + cross(s.dPdu, s.dPdvv));
  return s;
}

}  // namespace vestige
