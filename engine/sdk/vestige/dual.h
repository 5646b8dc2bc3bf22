// SPDX-License-Identifier: Apache-2.0
// Numbers with four derivatives: forward-mode automatic differentiation. Write a sampling routine
// and log f once, as templates over the number, and inherit sampleDerivatives() and logGradient()
// from DualBrdf (dual_brdf.h).
//
// Four are enough in the local frame: two tangents of toPrev and two of u (or of toNext).
// Rules for templated code: branch on value(x); no acos or atan2 (poles: see tools/sampling.h);
// build frames with inFrameAround(), which transports them without spin.
#pragma once
#include <vestige/tools/sampling.h>

namespace vestige {

/// A number and its derivatives by four variables.
struct Dual {
  typedef Real Lanes __attribute__((vector_size(4 * sizeof(Real))));
  Real v = 0;
  Lanes d = {0, 0, 0, 0};

  Dual() = default;
  Dual(Real value) : v(value) {}  // NOLINT: a constant is a number that does not move
  Dual(Real value, const Lanes& derivative) : v(value), d(derivative) {}
  /// The variable that derivative `lane` is taken by.
  static Dual variable(Real value, int lane) noexcept {
    Dual x(value);
    x.d[lane] = 1;
    return x;
  }
};

inline Real value(Real x) noexcept { return x; }
inline Real value(const Dual& x) noexcept { return x.v; }

inline Dual operator+(Dual a, Dual b) noexcept { return {a.v + b.v, a.d + b.d}; }
inline Dual operator-(Dual a, Dual b) noexcept { return {a.v - b.v, a.d - b.d}; }
inline Dual operator-(Dual a) noexcept { return {-a.v, -a.d}; }
inline Dual operator*(Dual a, Dual b) noexcept { return {a.v * b.v, a.d * b.v + b.d * a.v}; }
inline Dual operator/(Dual a, Dual b) noexcept {
  const Real r = 1 / b.v, q = a.v * r;
  return {q, (a.d - b.d * q) * r};
}
/// The derivative at zero is taken as zero: the true one is infinite.
inline Dual sqrt(Dual a) noexcept {
  const Real r = std::sqrt(std::max(Real(0), a.v));
  return {r, a.d * (r > 0 ? Real(0.5) / r : Real(0))};
}
inline Dual exp(Dual a) noexcept {
  const Real e = std::exp(a.v);
  return {e, a.d * e};
}
inline Dual log(Dual a) noexcept { return {std::log(a.v), a.d * (1 / a.v)}; }
/// exp(a) - 1 and log(1 + a), exact near a = 0.
inline Dual expm1(Dual a) noexcept { return {std::expm1(a.v), a.d * std::exp(a.v)}; }
inline Dual log1p(Dual a) noexcept { return {std::log1p(a.v), a.d * (1 / (1 + a.v))}; }
inline Dual sin(Dual a) noexcept { return {std::sin(a.v), a.d * std::cos(a.v)}; }
inline Dual cos(Dual a) noexcept { return {std::cos(a.v), a.d * -std::sin(a.v)}; }
/// a to a constant power, a >= 0.
inline Dual pow(Dual a, Real n) noexcept {
  const Real p = std::pow(a.v, n);
  return {p, a.d * (a.v > 0 ? n * p / a.v : Real(0))};
}
inline Dual abs(Dual a) noexcept { return a.v < 0 ? -a : a; }
inline Dual max(Dual a, Dual b) noexcept { return a.v < b.v ? b : a; }
inline Dual min(Dual a, Dual b) noexcept { return b.v < a.v ? b : a; }

/// A 2- or 3-vector of numbers or duals.
template <class T>
struct TVec2 {
  T x{}, y{};
};
template <class T>
struct TVec3 {
  T x{}, y{}, z{};
};
/// An origin and a direction.
template <class T>
struct TRay {
  TVec3<T> origin, direction;
};
template <class T>
TVec3<T> operator+(const TVec3<T>& a, const TVec3<T>& b) noexcept {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
TVec3<T> operator-(const TVec3<T>& a, const TVec3<T>& b) noexcept {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
TVec3<T> operator*(const T& s, const TVec3<T>& a) noexcept {
  return {s * a.x, s * a.y, s * a.z};
}
template <class T>
T dot(const TVec3<T>& a, const TVec3<T>& b) noexcept {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
TVec3<T> cross(const TVec3<T>& a, const TVec3<T>& b) noexcept {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
TVec3<T> normalize(const TVec3<T>& a) noexcept {
  using std::sqrt;
  return (T(1) / sqrt(dot(a, a))) * a;
}

inline TVec3<Real> lifted(Vec3 a) noexcept { return {a.x, a.y, a.z}; }
/// A constant vector.
template <class T>
TVec3<T> constant(Vec3 a) noexcept {
  return {T(a.x), T(a.y), T(a.z)};
}
inline Vec3 value(const TVec3<Real>& a) noexcept { return {a.x, a.y, a.z}; }
inline Vec3 value(const TVec3<Dual>& a) noexcept { return {a.x.v, a.y.v, a.z.v}; }
/// Derivative of a vector by variable `lane`.
inline Vec3 derivative(const TVec3<Dual>& a, int lane) noexcept {
  return {a.x.d[lane], a.y.d[lane], a.z.d[lane]};
}
/// p + tangent0 * variable `first` + tangent1 * variable `first + 1`.
inline TVec3<Dual> moving(Vec3 p, Vec3 tangent0, Vec3 tangent1, int first) noexcept {
  const auto component = [&](Real v, Real a, Real b) {
    Dual x(v);
    x.d[first] = a, x.d[first + 1] = b;
    return x;
  };
  return {component(p.x, tangent0.x, tangent1.x), component(p.y, tangent0.y, tangent1.y),
          component(p.z, tangent0.z, tangent1.z)};
}

/// The concentric disk with the derivative of its own map, not of its branches.
inline TVec2<Real> concentricDisk(const TVec2<Real>& u) noexcept {
  const Disk k = concentricDisk(Vec2{u.x, u.y});
  return {k.d.x, k.d.y};
}
inline TVec2<Dual> concentricDisk(const TVec2<Dual>& u) noexcept {
  const Disk k = concentricDisk(Vec2{u.x.v, u.y.v});
  return {{k.d.x, u.x.d * k.du[0].x + u.y.d * k.du[1].x},
          {k.d.y, u.x.d * k.du[0].y + u.y.d * k.du[1].y}};
}

/// The other maps of tools/sampling.h, with their own derivatives.
inline TVec3<Dual> mapped(const Direction& k, const TVec2<Dual>& u) noexcept {
  const auto component = [&](Real v, Real byX, Real byY) {
    return Dual(v, u.x.d * byX + u.y.d * byY);
  };
  return {component(k.d.x, k.du.c[0].x, k.du.c[1].x), component(k.d.y, k.du.c[0].y, k.du.c[1].y),
          component(k.d.z, k.du.c[0].z, k.du.c[1].z)};
}
inline TVec3<Real> cosineHemisphere(const TVec2<Real>& u) noexcept {
  return lifted(cosineHemisphere(Vec2{u.x, u.y}).d);
}
inline TVec3<Dual> cosineHemisphere(const TVec2<Dual>& u) noexcept {
  return mapped(cosineHemisphere(Vec2{u.x.v, u.y.v}), u);
}
inline TVec3<Real> uniformCap(const TVec2<Real>& u, Real cosMax) noexcept {
  return lifted(uniformCap(Vec2{u.x, u.y}, cosMax).d);
}
inline TVec3<Dual> uniformCap(const TVec2<Dual>& u, Real cosMax) noexcept {
  return mapped(uniformCap(Vec2{u.x.v, u.y.v}, cosMax), u);
}

/// x s + y t + z n in a frame around n. The frame is Frame::around(n); as n moves it is carried
/// along without spin: de = (n x dn) x e. (Differentiating the routine itself would add its own
/// spin, a shift of the random number, and its own singularity.)
inline TVec3<Real> inFrameAround(const TVec3<Real>& n, const TVec3<Real>& local) noexcept {
  return lifted(Frame::around(value(n)).toWorld(value(local)));
}
inline TVec3<Dual> inFrameAround(const TVec3<Dual>& n, const TVec3<Dual>& local) noexcept {
  const Frame f = Frame::around(value(n));
  const Vec3 at = f.toWorld(value(local));
  TVec3<Dual> r{at.x, at.y, at.z};
  for (int k = 0; k < 4; ++k) {
    const Vec3 dn = derivative(n, k),
               d = f.toWorld(derivative(local, k)) + cross(cross(f.n, dn), at);
    r.x.d[k] = d.x, r.y.d[k] = d.y, r.z.d[k] = d.z;
  }
  return r;
}

}  // namespace vestige
