// SPDX-License-Identifier: Apache-2.0
// Derivatives of a path by its random numbers: first derivatives of its vertex, direction and
// contribution, propagated from event to event by the chain rule.
//
// A *differential* is a change per unit of a random number; no delta is multiplied in, because some
// deltas change at every vertex [MATH 0]. Only components perpendicular to the ray are stored:
// moving a vertex along its ray does not change the next hit, and the derivative of a unit
// direction has no other components. So four components (two of dV, two of dD) and the gradient are
// a row, one row a number; four rows go through each step at once.
//
// [PD01]  Suykens, Willems. Path differentials and applications. EGWR 2001.
// [Ige99] Igehy. Tracing ray differentials. SIGGRAPH 1999.
#pragma once
#include <vestige/brdf.h>
#include <vestige/light.h>

#include <cstdint>
#include <cstring>

namespace vestige {

/// Cosine below which a divisor is clamped: a footprint grows to 1 / kGrazing of its head-on size
/// and no further.
inline constexpr Real kGrazing = Real(0.03);
/// The least cosine in d(log cos): the gradient saturates at the horizon.
inline constexpr Real kLeastCosine = Real(1e-3);

// These two are filled in place: a structure of scalars that is copied right after it was written
// stalls the processor, and costs more than the derivatives in it.

/// Derivatives of uv and of the normal along a surface.
struct SurfaceMotion {
  Vec3 normal;         ///< unit shading normal that faces the path, before any normal map
  Vec3 du, dv;         ///< gradients of u and v: d(uv) = (du . dV, dv . dV)
  Vec3 dNdu, dNdv;     ///< of that normal, per unit of u and v
  bool isFlat = true;  ///< normal and tangents are constant

  /// [MATH 1.4]. For a path that arrives along `direction`: the derivative of a normal that was
  /// flipped to face the path has the opposite sign. Degenerate uv: zero.
  void arrive(const SurfacePoint& s, Vec3 direction) noexcept {
    const bool behind = dot(direction, s.geometricNormal) > 0;
    const bool turned = dot(s.normal, s.geometricNormal) < 0;
    const Real facing = behind != turned ? Real(-1) : Real(1);
    normal = facing * s.normal;
    const Real uu = dot(s.dPdu, s.dPdu), uv = dot(s.dPdu, s.dPdv), vv = dot(s.dPdv, s.dPdv);
    const Real det = uu * vv - uv * uv;
    const bool isRegular = det > Real(1e-10) * uu * vv;
    const Real scale = isRegular ? 1 / det : Real(0);
    du = (scale * vv) * s.dPdu - (scale * uv) * s.dPdv;
    dv = (scale * uu) * s.dPdv - (scale * uv) * s.dPdu;
    constexpr auto isZero = [](Vec3 a, Vec3 b) { return lengthSquared(a) + lengthSquared(b) == 0; };
    isFlat = !isRegular || (isZero(s.dNdu, s.dNdv) && isZero(s.dPduu, s.dPduv));
    dNdu = facing * s.dNdu, dNdv = facing * s.dNdv;
  }
};

/// Rotation of a shading frame along its surface: omega per unit of u and of v. Its s lies along
/// dP/du: the least turn that carries n along, and a twist about n that keeps s there.
struct FrameMotion {
  Vec3 spinU, spinV;  ///< rad: ds = omega x s, likewise t and n
  bool isStill;       ///< both are zero

  /// Where a map or the engine has tilted n away from the smooth normal, n is carried along with
  /// the smooth frame: a map's own curvature is ignored [MATH 1.4].
  FrameMotion(const SurfacePoint& s, const SurfaceMotion& m, const Frame& f) noexcept
      : isStill(m.isFlat) {
    if (isStill) return;
    if (lengthSquared(f.n - m.normal) <= Real(1e-8)) {
      spin(s, f, m.dNdu, m.dNdv);
    } else {
      spin(s, Frame::along(m.normal, s.dPdu), m.dNdu, m.dNdv);
      spin(s, f, cross(spinU, f.n), cross(spinV, f.n));
    }
  }

 private:
  void spin(const SurfacePoint& s, const Frame& f, Vec3 dNdu, Vec3 dNdv) noexcept {
    spinU = cross(f.n, dNdu), spinV = cross(f.n, dNdv);
    // t . ds for s along the part of dP/du across n.
    const Real along = dot(f.n, s.dPdu), across = dot(f.s, s.dPdu);
    if (!(across > Real(1e-4) * std::abs(along)) || !(across > 0)) return;
    const Real scale = 1 / across;
    spinU += (scale * dot(f.t, s.dPduu - along * dNdu)) * f.n;
    spinV += (scale * dot(f.t, s.dPduv - along * dNdv)) * f.n;
  }
};

/// The part of one event that is the same for all differentials. World space.
struct ScatterEvent {
  const Frame& frame;  ///< shading frame, n faces the path
  Vec3 leaving;        ///< D', unit
  const SurfaceMotion& surface;
  const FrameMotion& motion;
};

/// Gradient of the log of the contribution at one event; local.
struct EventGradient {
  Vec3 byPrev;  ///< for a change of toPrev
  Vec3 byNext;  ///< for a change of toNext
};

/// Gradient of log(f cos) [PD01 Eq. 13].
inline EventGradient contributionGradient(const ScatterEvent& e, const LogGradient& log) noexcept {
  const Real c = dot(e.frame.n, e.leaving);
  const Real byCosine = std::copysign(1 / std::max(std::abs(c), kLeastCosine), c);
  return {log.dPrev, log.dNext + Vec3{0, 0, byCosine}};
}

namespace detail {

using FourBool = decltype(Four{} < Four{});
inline bool any(const FourBool& lanes) noexcept {
  std::uint64_t words[sizeof(lanes) / 8], all = 0;
  std::memcpy(words, &lanes, sizeof lanes);
  for (const std::uint64_t w : words) all |= w;
  return all != 0;
}
/// f with one lane replaced, in registers: a lane written to memory makes the next read of the
/// whole wait.
inline Four withLane(const Four& f, int lane, Real v) noexcept {
  using Index = std::conditional_t<sizeof(Real) == 4, std::int32_t, std::int64_t>;
  typedef Index FourIndex __attribute__((vector_size(4 * sizeof(Index))));
  constexpr FourIndex lanes = {0, 1, 2, 3};
  return lanes == Index(lane) ? four(v) : f;
}
inline Four inverseRoot(const Four& v) noexcept {
  Four r;
  for (int i = 0; i < 4; ++i) r[i] = 1 / std::sqrt(v[i]);
  return r;
}

}  // namespace detail

/// K differentials of a path, K <= Lanes; Lanes is a multiple of 4.
template <int Lanes>
class Differentials {
 public:
  int size() const noexcept { return size_; }
  int blocks() const noexcept { return (size_ + 3) / 4; }
  Vec3 direction() const noexcept { return ray_.n; }  ///< D of the ray under way, or just arrived
  /// dV/dx_j, of the point met; before the first surface, of the ray's start, across the ray.
  Vec3 dVertex(int j) const noexcept {
    const Block& r = blocks_[j / 4];
    return r.v.x[j % 4] * slideS_ + r.v.y[j % 4] * slideT_;
  }
  Vec3 dDirection(int j) const noexcept {  ///< dD/dx_j
    const Block& r = blocks_[j / 4];
    return r.d.x[j % 4] * ray_.s + r.d.y[j % 4] * ray_.t;
  }
  Real gradient(int j) const noexcept { return blocks_[j / 4].g[j % 4]; }  ///< g_j [PD01 Eq. 12]

  /// Two components of four numbers.
  struct FourVec2 {
    Four x, y;
  };
  /// Four numbers. Lanes beyond size() rest at zero.
  struct Block {
    FourVec2 v, d;  ///< dV and dD across the ray, along s and t of ray()
    Four g;
    Four longest;  ///< |dD|^2, the most so far, or 1: delta is at most 1 over its root
  };
  const Block& block(int b) const noexcept { return blocks_[b]; }
  const Frame& ray() const noexcept { return ray_; }  ///< axes across the ray; n = D
  Vec3 slideS() const noexcept { return slideS_; }    ///< dV on the surface, per unit along s
  Vec3 slideT() const noexcept { return slideT_; }
  /// dV of random numbers 4 b to 4 b + 3, as components along two directions.
  FourVec2 verticesAlong(int b, Vec3 s, Vec3 t) const noexcept {
    const FourVec2& v = blocks_[b].v;
    return {dot(s, slideS_) * v.x + dot(s, slideT_) * v.y,
            dot(t, slideS_) * v.x + dot(t, slideT_) * v.y};
  }

  /// Deltas of four random numbers: the bound, limited by the gradient [PD01 Eq. 14] and by the
  /// width of a sphere, beyond which a direction differential has no meaning [MATH 2.5]. A zero
  /// gradient sets no limit.
  Four deltas(int b, Four bound, Real limit) const noexcept {
    const Block& r = blocks_[b];
    Four d = bound;
    if (limit < kInfinity) {
      const Four steep = r.g < 0 ? -r.g : r.g;
      d = d * steep > limit ? limit / steep : d;
    }
    // |dD| delta <= 1, by squares: the root is seldom needed.
    if (!detail::any(d * d * r.longest > 1)) return d;
    const Four widest = detail::inverseRoot(r.longest);
    return d < widest ? d : widest;
  }

  /// Starts with the random numbers of a camera, or of a light's emission.
  void begin(const RayJacobian& ray, Vec3 direction, int variables) noexcept {
    size_ = 0;
    leave(Frame::around(direction));
    for (int j = 0; j < variables; ++j)
      append(ray.dOrigin[std::size_t(j)], ray.dDirection[std::size_t(j)], 0);
  }

  /// Moves to the surface hit at distance t [Ige99 Eq. 10, 12; MATH 1.3]. n is the geometric
  /// normal, either side. `limit`: no dV grows beyond it (the scene's size).
  void transfer(Real t, Vec3 n, Real limit) noexcept {
    const Real c = dot(ray_.n, n), divisor = std::copysign(std::max(std::abs(c), kGrazing), c);
    slideS_ = ray_.s - (dot(n, ray_.s) / divisor) * ray_.n;
    slideT_ = ray_.t - (dot(n, ray_.t) / divisor) * ray_.n;
    if (c != divisor) {  // a clamped divisor leaves a rest along n: take it out
      slideS_ -= dot(n, slideS_) * n;
      slideT_ -= dot(n, slideT_) * n;
    }
    const Real ss = dot(slideS_, slideS_), st = dot(slideS_, slideT_), tt = dot(slideT_, slideT_);
    const Four most = four(limit * limit);
    for (int b = 0; b < blocks(); ++b) {
      FourVec2& v = blocks_[b].v;
      v.x += t * blocks_[b].d.x, v.y += t * blocks_[b].d.y;
      const Four l = ss * v.x * v.x + 2 * st * v.x * v.y + tt * v.y * v.y;
      if (!detail::any(l > most)) continue;
      const Four k = limit * detail::inverseRoot(l > most ? l : most);
      v.x *= k, v.y *= k;
    }
  }

  /// Moves through an event at fixed random numbers: applies the chain rule to every differential,
  /// then, unless specular, appends the two random numbers of this event [PD01 Eq. 4, 5; MATH 1.5
  /// to 1.10]. Null `gradient` leaves g unchanged: if no limit uses it, and at specular events,
  /// whose weight has no cosine and whose probability follows Fresnel's term.
  ///
  /// The frame turns by omega; seen from it the path arrives from dp = F^T(-dD + omega x D), and
  /// leaves at F dPrev dp + omega x D' (DESIGN 3.2, MATH 1.7). Linear in dD across the ray and in
  /// the walk on the surface: so it is worked out for a unit of each, and every number takes its
  /// share of the four.
  void scatter(const ScatterEvent& e, const ScatterJacobian& jacobian,
               const EventGradient* gradient, bool specular) noexcept {
    const Frame& f = e.frame;
    const Frame next = Frame::around(e.leaving);
    const Vec3 nextS = f.toLocal(next.s), nextT = f.toLocal(next.t);

    // Columns: a unit of dD along the ray's s, along its t, a walk of a unit of u, of v.
    Vec3 turnU, turnV;
    const bool isStill = e.motion.isStill;
    if (!isStill) turnU = cross(e.motion.spinU, ray_.n), turnV = cross(e.motion.spinV, ray_.n);
    const Four3 turned = columns(-ray_.s, -ray_.t, turnU, turnV);
    const Four3 dPrev = {dot(f.s, turned), dot(f.t, turned), dot(f.n, turned)};
    const Four3 dNext = jacobian.dPrev * dPrev;
    Four x = dot(nextS, dNext), y = dot(nextT, dNext);
    if (!isStill) {  // omega x D', along s and t of D'
      const auto along = [&](Vec3 axis) {
        return Four{0, 0, dot(e.motion.spinU, axis), dot(e.motion.spinV, axis)};
      };
      x += along(next.t), y -= along(next.s);
    }
    // Both cosines turn with the frame: d(log f cos) = gPrev . dp + gNext . F^T(dD' - omega x D').
    const EventGradient steep = gradient ? *gradient : EventGradient{};
    const Four g = gradient ? dot(steep.byPrev, dPrev) + dot(steep.byNext, dNext) : four(0);

    const auto bySlide = [&](Vec3 slide, const Four& column) {
      return dot(e.surface.du, slide) * column[2] + dot(e.surface.dv, slide) * column[3];
    };
    const Real xs = bySlide(slideS_, x), xt = bySlide(slideT_, x);
    const Real ys = bySlide(slideS_, y), yt = bySlide(slideT_, y);
    const Real gs = bySlide(slideS_, g), gt = bySlide(slideT_, g);
    const Real vss = dot(next.s, slideS_), vst = dot(next.s, slideT_);
    const Real vts = dot(next.t, slideS_), vtt = dot(next.t, slideT_);
    for (int b = 0; b < blocks(); ++b) {
      Block& r = blocks_[b];
      const FourVec2 v = r.v, d = r.d;
      r.d = {x[0] * d.x + x[1] * d.y + xs * v.x + xt * v.y,
             y[0] * d.x + y[1] * d.y + ys * v.x + yt * v.y};
      r.v = {vss * v.x + vst * v.y, vts * v.x + vtt * v.y};
      r.g += g[0] * d.x + g[1] * d.y + gs * v.x + gt * v.y;
      narrow(r);
    }
    leave(next);
    if (specular) return;
    const Vec3 p = jacobian.du.c[0], q = jacobian.du.c[1];
    appendPair({dot(nextS, p), dot(nextT, p)}, {dot(nextS, q), dot(nextT, q)}, dot(steep.byNext, p),
               dot(steep.byNext, q));
  }

  /// The connection to a light in the direction e.leaving: differentials of that direction and of f
  /// cos L, with the light's two random numbers last [MATH 1.11, 1.14]. The path's own
  /// differentials are unchanged.
  Differentials<Lanes + 4> connect(const ScatterEvent& e, const LogGradient& log,
                                   const LightJacobian& light,
                                   const LightLogGradient& lightLog) const noexcept {
    Differentials<Lanes + 4> all;
    all.begin({}, e.leaving, 0);
    const Vec3 gNext = contributionGradient(e, log).byNext;
    for (int j = 0; j < size_; ++j) {
      const Vec3 moved = dVertex(j), dNext = light.dFrom * moved;
      const Vec3 omega =
          dot(e.surface.du, moved) * e.motion.spinU + dot(e.surface.dv, moved) * e.motion.spinV;
      const Real own = dot(log.dPrev, e.frame.toLocal(cross(omega, ray_.n) - dDirection(j))) +
                       dot(gNext, e.frame.toLocal(dNext - cross(omega, e.leaving)));
      all.append(moved, dNext, gradient(j) + own + dot(lightLog.dFrom, moved));
    }
    for (const int j : {0, 1}) {
      const Vec3 d = light.du.c[j];
      all.append({}, d, dot(gNext, e.frame.toLocal(d)) + (j ? lightLog.du.y : lightLog.du.x));
    }
    return all;
  }

  /// Appends a random number; keeps the components perpendicular to the ray. Ignored if all lanes
  /// are taken (call reduce() first).
  void append(Vec3 dV, Vec3 dD, Real g) noexcept {
    append(Vec2{dot(ray_.s, dV), dot(ray_.t, dV)}, {dot(ray_.s, dD), dot(ray_.t, dD)}, g);
  }

  /// The same for components along s and t of ray().
  void append(Vec2 v, Vec2 d, Real g) noexcept {
    if (size_ == Lanes) return;
    Block& r = blocks_[size_ / 4];
    const int lane = size_++ % 4;
    if (lane == 0) {  // a new block: its other lanes rest at zero
      r.v.x = r.v.y = r.d.x = r.d.y = r.g = Four{};
      r.longest = four(1);
    }
    const auto set = [lane](Four& f, Real value) { f = detail::withLane(f, lane, value); };
    set(r.v.x, v.x), set(r.v.y, v.y), set(r.d.x, d.x), set(r.d.y, d.y), set(r.g, g);
    set(r.longest, std::max(dot(d, d), Real(1)));
  }
  void clear() noexcept { size_ = 0; }

  /// Copies the gradients of the random numbers that both paths share, the first ones of `other`.
  template <int More>
  void takeGradients(const Differentials<More>& other) noexcept {
    for (int b = 0; b < blocks(); ++b) blocks_[b].g = other.block(b).g;
  }

 private:
  /// Appends the two random numbers of one event, which change the direction only. Built in
  /// registers: lanes written one by one make the next read of their block wait.
  void appendPair(Vec2 p, Vec2 q, Real gp, Real gq) noexcept {
    if (size_ % 2 == 1 || size_ == Lanes) {
      append(Vec2{}, p, gp), append(Vec2{}, q, gq);
      return;
    }
    Block& r = blocks_[size_ / 4];
    const bool isNew = size_ % 4 == 0;
    const auto pair = [isNew](const Four& old, Real a, Real b) {
      return isNew ? Four{a, b, 0, 0} : Four{old[0], old[1], a, b};
    };
    if (isNew) r.v.x = r.v.y = Four{}, r.longest = four(1);
    r.d.x = pair(r.d.x, p.x, q.x), r.d.y = pair(r.d.y, p.y, q.y), r.g = pair(r.g, gp, gq);
    narrow(r);
    size_ += 2;
  }
  static void narrow(Block& r) noexcept {
    const Four turn = r.d.x * r.d.x + r.d.y * r.d.y;
    r.longest = turn > r.longest ? turn : r.longest;
  }

  void leave(const Frame& ray) noexcept { ray_ = ray, slideS_ = ray.s, slideT_ = ray.t; }

  Block blocks_[Lanes / 4];
  Frame ray_;             ///< n = D
  Vec3 slideS_, slideT_;  ///< dV of the point met, for a unit along s and t
  int size_ = 0;
};

}  // namespace vestige
