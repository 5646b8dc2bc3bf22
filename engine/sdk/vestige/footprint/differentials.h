// SPDX-License-Identifier: Apache-2.0
// How a path moves with the random numbers that made it: first derivatives of its vertex, direction
// and contribution, carried from event to event by the chain rule.
//
// A *differential* is a change per unit of a random number; no delta is multiplied in, because some
// deltas change at every vertex [MATH 0]. One of these rows a number, kept side by side, so that
// one loop serves all of them.
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
  Vec3 normal;     ///< unit shading normal that faces the path, before any normal map
  Mat3 dNormal{};  ///< [3 x 3], of that normal; per scene unit
  Vec3 du, dv;     ///< gradients of u and v: d(uv) = (du . dV, dv . dV)
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
  m.dNormal = facing * (outer(s.dNdu, m.du) + outer(s.dNdv, m.dv));
  return m;
}

/// How a shading frame moves along with a point of its surface. Linear maps of dV.
struct FrameMotion {
  Mat3 dNormal{};  ///< [3 x 3], of the frame's n
  Vec3 twist;      ///< spin of s and t about n beyond the least turn, rad = twist . dV
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
  FrameMotion r{m.dNormal, {}};
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

/// K differentials of a path. Lanes is the most that fit; a multiple of 4.
template <int Lanes>
class Differentials {
 public:
  int size() const noexcept { return size_; }
  Vec3 dVertex(int j) const noexcept { return {vx_[j], vy_[j], vz_[j]}; }     ///< dV/dx_j
  Vec3 dDirection(int j) const noexcept { return {dx_[j], dy_[j], dz_[j]}; }  ///< dD/dx_j
  Real gradient(int j) const noexcept { return g_[j]; }  ///< g_j = (dF/dx_j) / F [PD01 Eq. 12]
  /// The most that delta_j may be: a differential vector longer than the sphere of directions is
  /// wide means nothing [MATH 2.5].
  Real largestDelta(int j) const noexcept { return 1 / std::sqrt(std::max(turn_[j], Real(1))); }

  /// Starts with the numbers of a camera, or of a light's emission.
  void begin(const RayJacobian& ray, int variables) noexcept {
    *this = {};
    for (int j = 0; j < variables; ++j)
      append(ray.dOrigin[std::size_t(j)], ray.dDirection[std::size_t(j)], 0);
  }

  /// To the point where the ray meets a surface at distance t [Ige99 Eq. 10, 12; MATH 1.3].
  /// n is the geometric normal, either side. `limit`: no dV grows beyond it (the scene's size).
  void transfer(Vec3 direction, Real t, Vec3 n, Real limit) noexcept {
    const Real c = dot(direction, n), clamped = std::copysign(std::max(std::abs(c), kGrazing), c);
    const Vec3 k = n / clamped;
    const Real most = limit * limit;
    for (int j = 0; j < Lanes; ++j) {
      const Real wx = vx_[j] + t * dx_[j], wy = vy_[j] + t * dy_[j], wz = vz_[j] + t * dz_[j];
      const Real s = wx * k.x + wy * k.y + wz * k.z;
      Real x = wx - s * direction.x, y = wy - s * direction.y, z = wz - s * direction.z;
      // A clamped divisor leaves a rest along n: take it out, dV lies in the surface.
      const Real rest = x * n.x + y * n.y + z * n.z;
      x -= rest * n.x, y -= rest * n.y, z -= rest * n.z;
      const Real l = x * x + y * y + z * z;
      const Real scale = l > most ? limit / std::sqrt(l) : Real(1);
      vx_[j] = scale * x, vy_[j] = scale * y, vz_[j] = scale * z;
    }
  }

  /// Through an event at fixed random numbers: chain rule on every differential, then, unless
  /// specular, the two numbers of this event are appended [PD01 Eq. 4, 5; MATH 1.5 to 1.10].
  /// `jacobian` and `log` are the BRDF's, local; the cosine at the surface is accounted for here.
  /// Specular events leave g alone: their weight has no cosine, and chance follows Fresnel's term.
  void scatter(const ScatterEvent& e, const ScatterJacobian& jacobian, const LogGradient& log,
               bool specular) noexcept {
    const Linear m = linearised(e, jacobian, log, specular);
    const Mat3 vd = m.byNormal * e.motion.dNormal + outer(m.byTwist, e.motion.twist);
    const Vec3 vg = transpose(e.motion.dNormal) * m.gByNormal + m.gByTwist * e.motion.twist;
    for (int j = 0; j < Lanes; ++j) {
      const Vec3 v{vx_[j], vy_[j], vz_[j]}, d{dx_[j], dy_[j], dz_[j]};
      g_[j] += dot(m.gByDirection, d) + dot(vg, v);
      Vec3 next = m.byDirection * d + vd * v;
      next -= dot(next, e.leaving) * e.leaving;  // D' stays a unit vector
      dx_[j] = next.x, dy_[j] = next.y, dz_[j] = next.z;
      turn_[j] = std::max(turn_[j], next.x * next.x + next.y * next.y + next.z * next.z);
    }
    if (specular) return;
    const Vec3 gNext = e.frame.toWorld(log.dNext) + cosineByDirection(e);
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
      all.append(v, d, g_[j] + connectionGradient(e, log, j, d) + dot(lightLog.dFrom, v));
    }
    const Vec3 gNext = e.frame.toWorld(log.dNext) + cosineByDirection(e);
    all.append({}, light.du.c[0], dot(gNext, light.du.c[0]) + lightLog.du.x);
    all.append({}, light.du.c[1], dot(gNext, light.du.c[1]) + lightLog.du.y);
    return all;
  }

  /// One more number; ignored when all lanes are taken (reduce() before).
  void append(Vec3 dV, Vec3 dD, Real g) noexcept {
    if (size_ == Lanes) return;
    set(size_++, dV, dD, g);
  }
  void set(int j, Vec3 dV, Vec3 dD, Real g) noexcept {
    vx_[j] = dV.x, vy_[j] = dV.y, vz_[j] = dV.z;
    dx_[j] = dD.x, dy_[j] = dD.y, dz_[j] = dD.z;
    g_[j] = g;
    turn_[j] = lengthSquared(dD);
  }

 private:
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

  /// dD' = byDirection dD + byNormal dN + byTwist tau, and the same for d(log f cos).
  struct Linear {
    Mat3 byDirection, byNormal;
    Vec3 byTwist, gByDirection, gByNormal;
    Real gByTwist = 0;
  };

  /// The frame turns by omega = N x dN + tau N; seen from it the path arrives from
  /// dp = F^T(-dD + omega x D), and leaves at dD' = omega x D' + F dPrev dp (DESIGN 3.2, MATH 1.7).
  static Linear linearised(const ScatterEvent& e, const ScatterJacobian& jacobian,
                           const LogGradient& log, bool specular) noexcept {
    const Vec3 n = e.frame.n, d = e.arriving, out = e.leaving;
    const Mat3 f{e.frame.s, e.frame.t, n};
    const Mat3 r = f * jacobian.dPrev * transpose(f);
    const Mat3 turnIn = dot(n, d) * identity() - outer(n, d);  // dN -> omega x D
    const Mat3 turnOut = dot(n, out) * identity() - outer(n, out);
    Linear m;
    m.byDirection = Real(-1) * r;
    m.byNormal = turnOut + r * turnIn;
    m.byTwist = cross(n, out) + r * cross(n, d);
    if (specular) return m;
    // d(log f) = gPrev . dp + gNext . F^T(dD' - omega x D'); the cosine: (dN . D' + N . dD') / cos.
    const Vec3 prev = f * log.dPrev, next = f * log.dNext, cosine = cosineByDirection(e);
    const Vec3 byLeaving = next + cosine;
    m.gByDirection = transpose(m.byDirection) * byLeaving - prev;
    m.gByNormal = transpose(m.byNormal) * byLeaving + transpose(turnIn) * prev -
                  transpose(turnOut) * next + out / clampedCosine(e);
    m.gByTwist = dot(byLeaving, m.byTwist) + dot(prev, cross(n, d)) - dot(next, cross(n, out));
    return m;
  }

  static Real clampedCosine(const ScatterEvent& e) noexcept {
    const Real c = dot(e.frame.n, e.leaving);
    return std::copysign(std::max(std::abs(c), kLeastCosine), c);
  }
  static Vec3 cosineByDirection(const ScatterEvent& e) noexcept {
    return e.frame.n / clampedCosine(e);
  }

  alignas(16) Real vx_[Lanes] = {}, vy_[Lanes] = {}, vz_[Lanes] = {};
  Real dx_[Lanes] = {}, dy_[Lanes] = {}, dz_[Lanes] = {};
  Real g_[Lanes] = {};
  Real turn_[Lanes] = {};  ///< longest |dD|^2 so far
  int size_ = 0;
};

}  // namespace vestige
