// SPDX-License-Identifier: Apache-2.0
// The footprint of a path: how large a region the path stands for, at every vertex. One module for
// every integrator; header-only; lives on the stack and never crosses the ABI.
//
//     PathFootprint<> f;
//     f.begin(context, settings);
//     f.arrive(surface, sceneSize);                          // MATH 1.3, 1.4
//     shade(surface, toPrev, f.footprint(), buffer);         // textures see the footprint
//     f.scatter(surface, interaction, drawn, numbers);       // MATH 1.5 to 1.10
//     f.chance(survival);                                    // roulette, opacity
//
// footprint/differentials.h  the chain rule      footprint/deltas.h    how far a number may move
// footprint/footprints.h     regions             footprint/reduce.h    many numbers into four
// footprint/settings.h what is followed footprint/language.h the scene's words footprint/score.h
// the gradient of F/p footprint/cone.h others' heuristics
//
// [PD01] Suykens, Willems. Path differentials and applications. EGWR 2001.
#pragma once
#include <vestige/footprint/cone.h>
#include <vestige/footprint/deltas.h>
#include <vestige/footprint/differentials.h>
#include <vestige/footprint/footprints.h>
#include <vestige/footprint/reduce.h>
#include <vestige/footprint/score.h>
#include <vestige/footprint/settings.h>
#include <vestige/integrator.h>

namespace vestige {

/// How many children a scattering splits into, as strata of the first times strata of the second
/// random number. Not integers where a net of points fills the square: 2 points count as 1.41 x
/// 1.41.
struct Strata {
  Real u = 1, v = 1;
};
inline Strata squareStrata(int children) noexcept {
  const Real side = children > 1 ? std::sqrt(Real(children)) : 1;
  return {side, side};
}

/// Lanes: the largest number of differentials. They are reduced when the next event would exceed
/// it.
template <int Lanes = 8>
class PathFootprint {
 public:
  /// A path from the camera.
  void begin(const PathContext& c, const FootprintSettings& settings) noexcept {
    begin(c.jacobian, c.ray.direction, c.cameraVariables, c.sampler.index(), c.declaredSamples,
          settings, settings.deltas.limit < kInfinity || c.wantsFootprint || c.record);
  }
  /// `index`: the sample's index in its pixel; `declared`: samples a pixel, or particles of all
  /// lights; 0 if open ended. `followsGradient`: needed by a limit, the AOV and `inspect` only.
  void begin(const RayJacobian& ray, Vec3 direction, int variables, std::uint64_t index,
             std::uint64_t declared, const FootprintSettings& settings,
             bool followsGradient = true) noexcept {
    settings_ = settings;
    followsGradient_ = followsGradient;
    differentials_.begin(ray, direction, variables);
    count_.begin(index, declared, variables);
    if (isCone(settings.deltas.bound)) cone_.begin(ray, commonDelta(settings.deltas, count_));
    if (!isFrozen()) return;
    const Real share = commonDelta(settings.deltas, count_);
    // Igehy's bound applies to the film's random numbers, not to the lens's.
    const Real lens = settings.deltas.bound == Bound::pixel ? 0 : share;
    for (Four& block : frozen_) block = four(0);
    frozen_[0] = Four{share, share, lens, lens};
  }

  /// A particle. Two of a light's four random numbers may have no effect (a point light's point, a
  /// distant light's direction); they are omitted.
  void begin(const Particle& p, const RayJacobian& ray, std::uint64_t index, std::uint64_t declared,
             const FootprintSettings& settings) noexcept {
    RayJacobian moving = ray;
    const auto isStill = [&](std::size_t j) {
      return lengthSquared(ray.dOrigin[j]) + lengthSquared(ray.dDirection[j]) == 0;
    };
    if (p.variables == 2 && isStill(0) && isStill(1))
      for (const std::size_t j : {0, 1})
        moving.dOrigin[j] = ray.dOrigin[j + 2], moving.dDirection[j] = ray.dDirection[j + 2];
    begin(moving, p.direction, p.variables, index, declared, settings);
  }

  /// Moves to the surface that the current ray hits. `size`: size of the scene, the upper limit of
  /// all differentials.
  void arrive(const Surface& s, Real size) noexcept {
    normal_ = s.geometricNormal;
    differentials_.transfer(s.distance, s.geometricNormal, std::max(size, s.distance));
    motion_.arrive(s, differentials_.direction());
    cone_.travel(s.distance);
  }

  /// The region around the vertex, in world space and in uv: two vectors, full length (pigment.h).
  Footprint footprint() const noexcept {
    if (!settings_.isOn() || settings_.deltas.scale == 0) return {};
    const Frame f = Frame::around(normal_);
    const Region r = isCone(settings_.deltas.bound) ? cone(f) : region(f);
    const auto world = [&](Vec2 p) { return p.x * f.s + p.y * f.t; };
    Footprint result{{world(r.a), world(r.b)}, {}, settings_.alongMajor};
    for (const int i : {0, 1})
      result.dUv[i] = {dot(motion_.du, result.dP[i]), dot(motion_.dv, result.dP[i])};
    return result;
  }

  /// The region of directions around the ray that left the last surface: two vectors perpendicular
  /// to it.
  void directions(Vec3 spread[2]) const noexcept {
    const Frame& ray = differentials_.ray();
    if (isCone(settings_.deltas.bound)) {
      spread[0] = cone_.spread * ray.s, spread[1] = cone_.spread * ray.t;
      return;
    }
    Covariance m;  // of dD, delta multiplied in, across the ray
    const Four shared = common();
    for (int b = 0; b < differentials_.blocks(); ++b) {
      const auto& d = differentials_.block(b).d;
      m.add(deltas(b, shared), d.x, d.y);
    }
    const Region r = ellipse(m);
    spread[0] = r.a.x * ray.s + r.a.y * ray.t, spread[1] = r.b.x * ray.s + r.b.y * ray.t;
  }

  /// Exact area of the polygon that the differential vectors span (Minkowski sum) [MATH 2.1].
  Real area() const noexcept { return polygonArea(vectors(Frame::around(normal_)).all()); }

  /// Moves through a scattering at the current surface, drawn with these random numbers. `strata`:
  /// how many children the path splits into (1: no split). Reduces the differentials first if there
  /// is no room.
  void scatter(const Surface& s, const Interaction& x, const Scatter& drawn, ScatterNumbers numbers,
               Strata strata = {}) noexcept {
    if (!drawn.local.specular && differentials_.size() > Lanes - 2) reduceNow();
    const int before = differentials_.size();
    const FrameMotion motion(s, motion_, x.frame);
    const ScatterEvent event{x.frame, drawn.toNext, motion_, motion};
    EventGradient gradient;
    const bool steepens = followsGradient_ && !drawn.local.specular;
    if (steepens)
      gradient =
          settings_.limited == Limited::score
              ? scoreGradient(event, *x.brdf, x.point, drawn.local.toNext)
              : contributionGradient(event, x.brdf->logGradient(x.point, drawn.local.toNext));
    differentials_.scatter(event, x.brdf->sampleDerivatives(x.point, numbers),
                           steepens ? &gradient : nullptr, drawn.local.specular);
    if (isCone(settings_.deltas.bound))
      cone_.scatter(settings_.deltas.bound, x, drawn.local, numbers);
    count_.chance(drawn.local.lobeChance);
    count_.split(strata.u * strata.v);
    if (drawn.local.specular) return;
    count_.drew(2);
    if (settings_.deltas.bound != Bound::local) return;
    // Only a share of the split's rays is drawn from this lobe.
    const Real spread = settings_.deltas.scale / std::sqrt(drawn.local.lobeChance);
    freeze(before, std::min(spread / strata.u, Real(1)));
    freeze(before + 1, std::min(spread / strata.v, Real(1)));
  }

  /// The differentials of a connection to a light; the light's two random numbers come last.
  Differentials<Lanes + 4> connect(const Surface& s, const Interaction& x, Vec3 toLight,
                                   const LightJacobian& light,
                                   const LightLogGradient& lightLog) const noexcept {
    const FrameMotion motion(s, motion_, x.frame);
    return differentials_.connect({x.frame, toLight, motion_, motion},
                                  x.brdf->logGradient(x.point, x.frame.toLocal(toLight)), light,
                                  lightLog);
  }

  /// Whether a connection to a light has its own footprint (LightTerm::exact).
  bool heedsLight() const noexcept {
    return settings_.light == LightTerm::exact && settings_.deltas.limit < kInfinity;
  }
  /// This path, limited by the gradient of its connection to a light instead of its own.
  [[gnu::noinline]] PathFootprint connected(const Surface& s, const Interaction& x,
                                            const LightHit& hit, const LightJacobian& light,
                                            const LightLogGradient& lightLog) const noexcept {
    PathFootprint result = *this;
    result.differentials_.takeGradients(connect(s, x, hit.toLight, light, lightLog));
    return result;
  }

  /// Records a discrete choice that the path survived, with its probability.
  void chance(Real probability) noexcept { count_.chance(probability); }

  const Differentials<Lanes>& differentials() const noexcept { return differentials_; }
  const PathCount& count() const noexcept { return count_; }

  /// delta_j: the bound, then the gradient's limit, then the width of a sphere.
  Real delta(int j) const noexcept { return deltas(j / 4, common())[j % 4]; }

  /// The largest relative derivative of the contribution by any random number.
  Real steepest() const noexcept {
    Real g = 0;
    for (int j = 0; j < differentials_.size(); ++j)
      g = std::max(g, std::abs(differentials_.gradient(j)));
    return g;
  }

 private:
  bool isFrozen() const noexcept {
    return settings_.deltas.bound == Bound::local || settings_.deltas.bound == Bound::pixel;
  }

  /// Delta of all random numbers without a frozen one.
  Four common() const noexcept {
    return four(isFrozen() ? Real(0) : commonDelta(settings_.deltas, count_));
  }
  Four deltas(int block, const Four& common) const noexcept {
    return differentials_.deltas(block, isFrozen() ? frozen_[block] : common,
                                 settings_.deltas.limit);
  }
  void freeze(int j, Real delta) noexcept {
    if (j < Lanes) frozen_[j / 4] = detail::withLane(frozen_[j / 4], j % 4, delta);
  }

  /// The cone's round section, slid into the tangent plane.
  Region cone(const Frame& f) const noexcept {
    const auto across = [&](Vec3 slide) {
      return cone_.width * Vec2{dot(slide, f.s), dot(slide, f.t)};
    };
    return {across(differentials_.slideS()), across(differentials_.slideT())};
  }

  /// Two numbers are their own parallelogram; more become the ellipse, or PD01's pair.
  Region region(const Frame& f) const noexcept {
    const Four shared = common();
    if (differentials_.size() == 2) {
      const auto v = differentials_.verticesAlong(0, f.s, f.t);
      const Four delta = deltas(0, shared), x = delta * v.x, y = delta * v.y;
      return {{x[0], y[0]}, {x[1], y[1]}};
    }
    if (settings_.shape == RegionShape::representative) return representative(vectors(f).all());
    Covariance m;
    for (int b = 0; b < differentials_.blocks(); ++b) {
      const auto v = differentials_.verticesAlong(b, f.s, f.t);
      m.add(deltas(b, shared), v.x, v.y);
    }
    return ellipse(m);
  }

  /// Differential vectors, delta multiplied in, in the plane of a frame.
  struct Vectors {
    Vec2 list[Lanes];
    int size;
    std::span<const Vec2> all() const noexcept { return {list, std::size_t(size)}; }
  };
  Vectors vectors(const Frame& f) const noexcept {
    Vectors r;
    r.size = differentials_.size();
    const Four shared = common();
    for (int b = 0; b < differentials_.blocks(); ++b) {
      const auto v = differentials_.verticesAlong(b, f.s, f.t);
      const Four delta = deltas(b, shared), x = delta * v.x, y = delta * v.y;
      for (int i = 0; i < 4; ++i) r.list[4 * b + i] = {x[i], y[i]};
    }
    return r;
  }

  /// Frozen deltas are multiplied into the columns, which then have delta 1; common deltas stay
  /// outside. Merged columns keep a gradient only if a limit uses it: an AOV of the gradient must
  /// not change the picture.
  void reduceNow() noexcept {
    Four weights[Lanes / 4];
    for (int b = 0; b < Lanes / 4; ++b) weights[b] = isFrozen() ? frozen_[b] : four(1);
    reduce(differentials_, weights, settings_.deltas.limit < kInfinity);
    for (Four& block : frozen_) block = four(1);
  }

  Differentials<Lanes> differentials_;
  Four frozen_[Lanes / 4];  ///< deltas that no later event changes, where there are any
  PathCount count_;
  FootprintSettings settings_;
  SurfaceMotion motion_;
  Cone cone_;
  bool followsGradient_ = false;
  Vec3 normal_;  ///< geometric, of the surface arrived at
};

}  // namespace vestige
