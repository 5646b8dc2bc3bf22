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
#include <vestige/shape.h>

namespace vestige {

/// Cosine below which a divisor is clamped: a footprint grows to 1 / kGrazing of its head-on size
/// and no further.
inline constexpr Real kGrazing = Real(0.03);
/// The least cosine in d(log cos): the gradient saturates at the horizon.
inline constexpr Real kLeastCosine = Real(1e-3);

/// How normal, uv and tangent frame move along with a point of a surface. Linear maps of dV.
struct SurfaceMotion {
  Mat3 dNormal{};  ///< [3 x 3], of the facing unit shading normal; per scene unit
  Vec3 du, dv;     ///< gradients of u and v: d(uv) = (du . dV, dv . dV)
  Vec3 twist;      ///< spin of the tangents about the normal, rad = twist . dV
};

/// [MATH 1.4]. `facing` is +1 where the path sees the side of the surface's own normal, -1 where it
/// sees its back: the normal was turned, so its change is turned as well. Degenerate uv: no change.
inline SurfaceMotion surfaceMotion(const SurfacePoint& s, Real facing) noexcept {
  const Real uu = dot(s.dPdu, s.dPdu), uv = dot(s.dPdu, s.dPdv), vv = dot(s.dPdv, s.dPdv);
  const Real det = uu * vv - uv * uv;
  if (!(det > Real(1e-10) * uu * vv)) return {};
  SurfaceMotion m;
  m.du = (vv * s.dPdu - uv * s.dPdv) / det;
  m.dv = (uu * s.dPdv - uv * s.dPdu) / det;
  m.dNormal = facing * (outer(s.dNdu, m.du) + outer(s.dNdv, m.dv));
  return m;
}

/// Everything about one event that is the same for all differentials. World space.
struct ScatterEvent {
  Frame frame;    ///< shading frame, n faces the path
  Vec3 arriving;  ///< D, unit, into the surface
  Vec3 leaving;   ///< D', unit
  SurfaceMotion motion;
};

/// K differentials of a path. Lanes is the most that fit; a multiple of 4.
template <int Lanes>
class Differentials {
 public:
  int size() const noexcept { return size_; }
  Vec3 dVertex(int j) const noexcept { return {vx_[j], vy_[j], vz_[j]}; }     ///< dV/dx_j
  Vec3 dDirection(int j) const noexcept { return {dx_[j], dy_[j], dz_[j]}; }  ///< dD/dx_j
  Real gradient(int j) const noexcept { return g_[j]; }  ///< g_j = (dF/dx_j) / F [PD01 Eq. 12]

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
  void scatter(const ScatterEvent& e, const ScatterJacobian& jacobian, const LogGradient& log,
               bool specular) noexcept {
    const Linear m = linearised(e, jacobian, log);
    const Mat3 vd = m.byNormal * e.motion.dNormal + outer(m.byTwist, e.motion.twist);
    const Vec3 vg = transpose(e.motion.dNormal) * m.gByNormal + m.gByTwist * e.motion.twist;
    for (int j = 0; j < Lanes; ++j) {
      const Vec3 v{vx_[j], vy_[j], vz_[j]}, d{dx_[j], dy_[j], dz_[j]};
      g_[j] += dot(m.gByDirection, d) + dot(vg, v);
      Vec3 next = m.byDirection * d + vd * v;
      next -= dot(next, e.leaving) * e.leaving;  // D' stays a unit vector
      dx_[j] = next.x, dy_[j] = next.y, dz_[j] = next.z;
    }
    if (specular) return;
    const Vec3 gNext = e.frame.toWorld(log.dNext) + cosineByDirection(e);
    for (const Vec3 column : jacobian.du.c) {
      Vec3 d = e.frame.toWorld(column);
      d -= dot(d, e.leaving) * e.leaving;
      append({}, d, dot(gNext, d));
    }
  }

  /// The gradient of f cos for a direction that a light chose: adds to g, leaves directions alone.
  /// dNext[j] is how that direction moves with number j, its own two numbers included.
  Real connectionGradient(const ScatterEvent& e, const LogGradient& log, int j,
                          Vec3 dNext) const noexcept {
    const Vec3 v = dVertex(j), dN = e.motion.dNormal * v;
    const Real tau = dot(e.motion.twist, v);
    const Vec3 omega = cross(e.frame.n, dN) + tau * e.frame.n;
    const Vec3 dPrev = e.frame.toLocal(-dDirection(j) + cross(omega, e.arriving));
    const Vec3 dOut = e.frame.toLocal(dNext - cross(omega, e.leaving));
    const Real c = clampedCosine(e);
    return dot(log.dPrev, dPrev) + dot(log.dNext, dOut) +
           (dot(dN, e.leaving) + dot(e.frame.n, dNext)) / c;
  }

  /// Adds to the gradient of one number.
  void addGradient(int j, Real g) noexcept { g_[j] += g; }

  /// One more number; ignored when all lanes are taken (reduce() before).
  void append(Vec3 dV, Vec3 dD, Real g) noexcept {
    if (size_ == Lanes) return;
    set(size_++, dV, dD, g);
  }
  void set(int j, Vec3 dV, Vec3 dD, Real g) noexcept {
    vx_[j] = dV.x, vy_[j] = dV.y, vz_[j] = dV.z;
    dx_[j] = dD.x, dy_[j] = dD.y, dz_[j] = dD.z;
    g_[j] = g;
  }

 private:
  /// dD' = byDirection dD + byNormal dN + byTwist tau, and the same for d(log f cos).
  struct Linear {
    Mat3 byDirection, byNormal;
    Vec3 byTwist, gByDirection, gByNormal;
    Real gByTwist;
  };

  /// The frame turns by omega = N x dN + tau N; seen from it the path arrives from
  /// dp = F^T(-dD + omega x D), and leaves at dD' = omega x D' + F dPrev dp (DESIGN 3.2, MATH 1.7).
  static Linear linearised(const ScatterEvent& e, const ScatterJacobian& jacobian,
                           const LogGradient& log) noexcept {
    const Vec3 n = e.frame.n, d = e.arriving, out = e.leaving;
    const Mat3 f{e.frame.s, e.frame.t, n};
    const Mat3 r = f * jacobian.dPrev * transpose(f);
    const Mat3 turnIn = dot(n, d) * identity() - outer(n, d);  // dN -> omega x D
    const Mat3 turnOut = dot(n, out) * identity() - outer(n, out);
    Linear m;
    m.byDirection = Real(-1) * r;
    m.byNormal = turnOut + r * turnIn;
    m.byTwist = cross(n, out) + r * cross(n, d);
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
  int size_ = 0;
};

}  // namespace vestige
