// SPDX-License-Identifier: Apache-2.0
// How a path moves with the random numbers that made it: first derivatives of its vertex, direction
// and contribution, carried from event to event by the chain rule.
//
// A *differential* is a change per unit of a random number; no delta is multiplied in, because some
// deltas change at every vertex [MATH 0]. One of these rows a number, kept side by side, so that
// four go through each step at once.
//
// [PD01]  Suykens, Willems. Path differentials and applications. EGWR 2001.
// [Ige99] Igehy. Tracing ray differentials. SIGGRAPH 1999.
#pragma once
#include <vestige/brdf.h>
#include <vestige/light.h>

namespace vestige {

/// Cosine below which a divisor is clamped: a footprint grows to 1 / kGrazing of its head-on size
/// and no further.
inline constexpr Real kGrazing = Real(0.03);
/// The least cosine in d(log cos): the gradient saturates at the horizon.
inline constexpr Real kLeastCosine = Real(1e-3);

/// How the normal and uv move along with a point of a surface. Linear maps of dV.
struct SurfaceMotion {
  Vec3 normal;         ///< unit shading normal that faces the path, before any normal map
  Mat3 dNormal{};      ///< [3 x 3], of that normal; per scene unit
  Vec3 du, dv;         ///< gradients of u and v: d(uv) = (du . dV, dv . dV)
  bool isFlat = true;  ///< neither normal nor tangents turn as one walks on it
};

/// [MATH 1.4]. For a path that arrives along `direction`: a normal that is turned to face it
/// changes with the opposite sign. Degenerate uv: no change.
inline SurfaceMotion surfaceMotion(const SurfacePoint& s, Vec3 direction) noexcept {
  const bool behind = dot(direction, s.geometricNormal) > 0;
  const bool turned = dot(s.normal, s.geometricNormal) < 0;
  const Real facing = behind != turned ? Real(-1) : Real(1);
  SurfaceMotion m;
  m.normal = facing * s.normal;
  const Real uu = dot(s.dPdu, s.dPdu), uv = dot(s.dPdu, s.dPdv), vv = dot(s.dPdv, s.dPdv);
  const Real det = uu * vv - uv * uv;
  if (!(det > Real(1e-10) * uu * vv)) return m;
  m.du = (vv * s.dPdu - uv * s.dPdv) / det;
  m.dv = (uu * s.dPdv - uv * s.dPdu) / det;
  constexpr auto isZero = [](Vec3 a, Vec3 b) { return lengthSquared(a) + lengthSquared(b) == 0; };
  m.isFlat = isZero(s.dNdu, s.dNdv) && isZero(s.dPduu, s.dPduv);
  if (!m.isFlat) m.dNormal = facing * (outer(s.dNdu, m.du) + outer(s.dNdv, m.dv));
  return m;
}

/// How a shading frame moves along with a point of its surface. Linear maps of dV.
struct FrameMotion {
  Mat3 dNormal{};       ///< [3 x 3], of the frame's n
  Vec3 twist;           ///< spin of s and t about n beyond the least turn, rad = twist . dV
  bool isStill = true;  ///< both are zero
};

namespace detail {

/// t . ds for s along the part of dP/du across n.
inline Vec3 twistOf(const SurfacePoint& s, const SurfaceMotion& m, const Frame& f,
                    const Mat3& dNormal) noexcept {
  const Real along = dot(f.n, s.dPdu), across = dot(f.s, s.dPdu);
  if (!(across > Real(1e-4) * std::abs(along)) || !(across > 0)) return {};
  return (dot(f.t, s.dPduu) * m.du + dot(f.t, s.dPduv) * m.dv -
          along * (transpose(dNormal) * f.t)) /
         across;
}

}  // namespace detail

/// Of a frame whose s lies along dP/du. Where a map or the engine has tilted n away from the smooth
/// normal, n is carried along with the smooth frame: a map's own curvature is ignored [MATH 1.4].
inline FrameMotion frameMotion(const SurfacePoint& s, const SurfaceMotion& m,
                               const Frame& f) noexcept {
  if (m.isFlat) return {};
  FrameMotion r{m.dNormal, {}, false};
  if (lengthSquared(f.n - m.normal) > Real(1e-8)) {
    const Frame base = Frame::along(m.normal, s.dPdu);
    const Mat3 turn =
        crossMatrix(m.normal) * m.dNormal + outer(m.normal, detail::twistOf(s, m, base, m.dNormal));
    r.dNormal = Real(-1) * (crossMatrix(f.n) * turn);  // dn = omega x n
  }
  r.twist = detail::twistOf(s, m, f, r.dNormal);
  return r;
}

/// Everything about one event that is the same for all differentials. World space.
struct ScatterEvent {
  Frame frame;    ///< shading frame, n faces the path
  Vec3 arriving;  ///< D, unit, into the surface
  Vec3 leaving;   ///< D', unit
  FrameMotion motion;
};

namespace detail {

/// Vectors of four differentials at once, and the little algebra that the chain rule needs.
struct Four3 {
  Four x, y, z;
};
inline Four four(Real v) noexcept { return Four{v, v, v, v}; }
inline Four3 operator+(const Four3& a, const Four3& b) noexcept {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Four3 operator-(const Four3& a, const Four3& b) noexcept {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Four3 scaled(const Four& s, Vec3 v) noexcept { return {s * v.x, s * v.y, s * v.z}; }
inline Four3 scaled(Real s, const Four3& v) noexcept { return {s * v.x, s * v.y, s * v.z}; }
inline Four dot(Vec3 a, const Four3& b) noexcept { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Four3 cross(Vec3 a, const Four3& b) noexcept {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Four3 cross(const Four3& a, Vec3 b) noexcept {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Four3 operator*(const Mat3& m, const Four3& v) noexcept {
  return {m.c[0].x * v.x + m.c[1].x * v.y + m.c[2].x * v.z,
          m.c[0].y * v.x + m.c[1].y * v.y + m.c[2].y * v.z,
          m.c[0].z * v.x + m.c[1].z * v.y + m.c[2].z * v.z};
}
inline Four3 toLocal(const Frame& f, const Four3& v) noexcept {
  return {dot(f.s, v), dot(f.t, v), dot(f.n, v)};
}
inline Four3 toWorld(const Frame& f, const Four3& v) noexcept { return Mat3{f.s, f.t, f.n} * v; }
inline Four lengthSquared(const Four3& v) noexcept { return v.x * v.x + v.y * v.y + v.z * v.z; }

}  // namespace detail

/// K differentials of a path. Lanes is the most that fit; a multiple of 4.
template <int Lanes>
class Differentials {
 public:
  int size() const noexcept { return size_; }
  Vec3 dVertex(int j) const noexcept { return at(v_, j); }          ///< dV/dx_j
  Vec3 dDirection(int j) const noexcept { return at(d_, j); }       ///< dD/dx_j
  Real gradient(int j) const noexcept { return g_[j / 4][j % 4]; }  ///< g_j [PD01 Eq. 12]
  /// dV of four numbers from 4 b on, as components along two directions.
  struct FourVec2 {
    Four x, y;
  };
  FourVec2 verticesAlong(int b, Vec3 s, Vec3 t) const noexcept {
    return {detail::dot(s, v_[b]), detail::dot(t, v_[b])};
  }
  /// g of four numbers from 4 b on.
  Four gradients(int b) const noexcept { return g_[b]; }
  /// dD likewise.
  FourVec2 directionsAlong(int b, Vec3 s, Vec3 t) const noexcept {
    return {detail::dot(s, d_[b]), detail::dot(t, d_[b])};
  }
  int blocks() const noexcept { return (size_ + 3) / 4; }
  /// Of four numbers: the bound after the gradient's limit [PD01 Eq. 14] and the width of a sphere:
  /// a differential vector longer than that means nothing [MATH 2.5]. A gradient of zero limits
  /// nothing.
  Four deltas(int b, Four bound, Real limit) const noexcept {
    Four d = bound;
    if (limit < kInfinity) {
      const Four steep = g_[b] < 0 ? -g_[b] : g_[b];
      d = d * steep > limit ? limit / steep : d;
    }
    return d < widest_[b] ? d : widest_[b];
  }

  /// Starts with the numbers of a camera, or of a light's emission.
  void begin(const RayJacobian& ray, int variables) noexcept {
    size_ = 0;
    for (int j = 0; j < variables; ++j)
      append(ray.dOrigin[std::size_t(j)], ray.dDirection[std::size_t(j)], 0);
  }

  /// To the point where the ray meets a surface at distance t [Ige99 Eq. 10, 12; MATH 1.3].
  /// n is the geometric normal, either side. `limit`: no dV grows beyond it (the scene's size).
  void transfer(Vec3 direction, Real t, Vec3 n, Real limit) noexcept {
    using namespace detail;
    const Real c = dot(direction, n), divisor = std::copysign(std::max(std::abs(c), kGrazing), c);
    const Vec3 k = n / divisor;
    for (int b = 0; b < blocks(); ++b) {
      const Four3 w = v_[b] + scaled(t, d_[b]);
      v_[b] = w - scaled(dot(k, w), direction);
      // A clamped divisor leaves a rest along n: take it out, dV lies in the surface.
      if (c != divisor) v_[b] = v_[b] - scaled(dot(n, v_[b]), n);
      shorten(v_[b], limit);
    }
  }

  /// Through an event at fixed random numbers: chain rule on every differential, then, unless
  /// specular, the two numbers of this event are appended [PD01 Eq. 4, 5; MATH 1.5 to 1.10].
  /// `jacobian` and `log` are the BRDF's, local; the cosine at the surface is accounted for here.
  /// Without `log` g stays as it is: where nobody asks for it, and at specular events, whose weight
  /// has no cosine and whose chance follows Fresnel's term.
  ///
  /// The frame turns by omega = N x dN + tau N; seen from it the path arrives from
  /// dp = F^T(-dD + omega x D), and leaves at dD' = omega x D' + F dPrev dp (DESIGN 3.2, MATH 1.7).
  void scatter(const ScatterEvent& e, const ScatterJacobian& jacobian, const LogGradient* log,
               bool specular) noexcept {
    using namespace detail;
    const Real cosine = 1 / clampedCosine(e);
    for (int b = 0; b < blocks(); ++b) {
      Four3 dN{}, omega{}, turned = scaled(Real(-1), d_[b]);
      if (!e.motion.isStill) {
        dN = e.motion.dNormal * v_[b];
        omega = cross(e.frame.n, dN) + scaled(dot(e.motion.twist, v_[b]), e.frame.n);
        turned = turned + cross(omega, e.arriving);
      }
      const Four3 dPrev = toLocal(e.frame, turned);
      const Four3 dNext = jacobian.dPrev * dPrev;
      Four3 d = toWorld(e.frame, dNext);
      if (!e.motion.isStill) d = d + cross(omega, e.leaving);
      d = d - scaled(dot(e.leaving, d), e.leaving);  // D' stays a unit vector
      d_[b] = d;
      narrow(widest_[b], lengthSquared(d));
      if (!log) continue;
      // d(log f) = gPrev . dp + gNext . F^T(dD' - omega x D'); the cosine: (dN . D' + N . dD') /
      // cos.
      g_[b] += dot(log->dPrev, dPrev) + dot(log->dNext, dNext) +
               cosine * (dot(e.leaving, dN) + dot(e.frame.n, d));
    }
    if (specular) return;
    const Vec3 gNext = log ? e.frame.toWorld(log->dNext) + cosine * e.frame.n : Vec3{};
    for (const Vec3 column : jacobian.du.c) {
      Vec3 d = e.frame.toWorld(column);
      d -= dot(d, e.leaving) * e.leaving;
      append({}, d, dot(gNext, d));
    }
  }

  /// The connection to a light in the direction e.leaving: how that direction and f cos L move, the
  /// light's own two numbers last [MATH 1.11, 1.14]. The path's own differentials stay as they are.
  Differentials<Lanes + 4> connect(const ScatterEvent& e, const LogGradient& log,
                                   const LightJacobian& light,
                                   const LightLogGradient& lightLog) const noexcept {
    Differentials<Lanes + 4> all;
    for (int j = 0; j < size_; ++j) {
      const Vec3 v = dVertex(j), d = light.dFrom * v;
      all.append(v, d, gradient(j) + connectionGradient(e, log, j, d) + dot(lightLog.dFrom, v));
    }
    const Vec3 gNext = e.frame.toWorld(log.dNext) + e.frame.n / clampedCosine(e);
    all.append({}, light.du.c[0], dot(gNext, light.du.c[0]) + lightLog.du.x);
    all.append({}, light.du.c[1], dot(gNext, light.du.c[1]) + lightLog.du.y);
    return all;
  }

  /// One more number; ignored when all lanes are taken (reduce() before).
  void append(Vec3 dV, Vec3 dD, Real g) noexcept {
    if (size_ == Lanes) return;
    if (size_ % 4 == 0) {  // a new block: its other lanes rest at zero
      constexpr Four zero{};
      v_[size_ / 4] = d_[size_ / 4] = {zero, zero, zero};
      g_[size_ / 4] = zero, widest_[size_ / 4] = zero + 1;
    }
    set(size_++, dV, dD, g);
  }
  void set(int j, Vec3 dV, Vec3 dD, Real g) noexcept {
    const int b = j / 4, i = j % 4;
    v_[b].x[i] = dV.x, v_[b].y[i] = dV.y, v_[b].z[i] = dV.z;
    d_[b].x[i] = dD.x, d_[b].y[i] = dD.y, d_[b].z[i] = dD.z;
    g_[b][i] = g, widest_[b][i] = 1 / std::sqrt(std::max(lengthSquared(dD), Real(1)));
  }
  void clear() noexcept { size_ = 0; }

 private:
  static Vec3 at(const detail::Four3* list, int j) noexcept {
    const detail::Four3& f = list[j / 4];
    return {f.x[j % 4], f.y[j % 4], f.z[j % 4]};
  }

  static bool anyAbove(const Four& a, Real limit) noexcept {
    return a[0] > limit || a[1] > limit || a[2] > limit || a[3] > limit;
  }
  static void shorten(detail::Four3& v, Real limit) noexcept {
    const Four l = detail::lengthSquared(v);
    if (!anyAbove(l, limit * limit)) return;
    for (int i = 0; i < 4; ++i) {
      if (!(l[i] > limit * limit)) continue;
      const Real k = limit / std::sqrt(l[i]);
      v.x[i] *= k, v.y[i] *= k, v.z[i] *= k;
    }
  }
  static void narrow(Four& widest, const Four& turn) noexcept {
    if (!anyAbove(turn, 1)) return;
    for (int i = 0; i < 4; ++i)
      if (turn[i] > 1) widest[i] = std::min(widest[i], 1 / std::sqrt(turn[i]));
  }

  static Real clampedCosine(const ScatterEvent& e) noexcept {
    const Real c = dot(e.frame.n, e.leaving);
    return std::copysign(std::max(std::abs(c), kLeastCosine), c);
  }

  /// d log(f cos) by number j for a direction that moves by dNext whatever the frame does.
  Real connectionGradient(const ScatterEvent& e, const LogGradient& log, int j,
                          Vec3 dNext) const noexcept {
    const Vec3 v = dVertex(j), dN = e.motion.dNormal * v;
    const Real tau = dot(e.motion.twist, v);
    const Vec3 omega = cross(e.frame.n, dN) + tau * e.frame.n;
    const Vec3 dPrev = e.frame.toLocal(-dDirection(j) + cross(omega, e.arriving));
    const Vec3 dOut = e.frame.toLocal(dNext - cross(omega, e.leaving));
    return dot(log.dPrev, dPrev) + dot(log.dNext, dOut) +
           (dot(dN, e.leaving) + dot(e.frame.n, dNext)) / clampedCosine(e);
  }

  detail::Four3 v_[Lanes / 4], d_[Lanes / 4];
  Four g_[Lanes / 4];
  Four widest_[Lanes / 4];  ///< the most that delta may be: 1 over the longest |dD| so far, or 1
  int size_ = 0;
};

}  // namespace vestige
