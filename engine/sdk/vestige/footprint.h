// SPDX-License-Identifier: Apache-2.0
// The footprint of a path: how large a region the path stands for, at every vertex. One module for
// every integrator; header-only; lives on the stack and never crosses the ABI.
//
//     PathFootprint<> f;
//     f.begin(context, settings);
//     f.arrive(ray.direction, surface, sceneSize);           // MATH 1.3, 1.4
//     shade(surface, toPrev, f.footprint(), buffer);         // textures see the footprint
//     f.scatter(surface, interaction, drawn, numbers);       // MATH 1.5 to 1.10
//     f.chance(survival);                                    // roulette, opacity
//
// footprint/differentials.h  the chain rule      footprint/deltas.h    how far a number may move
// footprint/footprints.h     regions             footprint/reduce.h    many numbers into four
// footprint/settings.h       the scene's word on all this
//
// [PD01] Suykens, Willems. Path differentials and applications. EGWR 2001.
#pragma once
#include <vestige/footprint/deltas.h>
#include <vestige/footprint/differentials.h>
#include <vestige/footprint/footprints.h>
#include <vestige/footprint/reduce.h>
#include <vestige/footprint/settings.h>
#include <vestige/integrator.h>

namespace vestige {

/// Into how many children a scattering splits: strata of its first times of its second number. Not
/// whole where a net of points fills the square: 2 points are 1.41 x 1.41.
struct Strata {
  Real u = 1, v = 1;
};

/// Lanes: the most numbers that are followed; when the next event would not fit, they are reduced.
template <int Lanes = 8>
class PathFootprint {
 public:
  /// A path from the camera.
  void begin(const PathContext& c, const FootprintSettings& settings) noexcept {
    begin(c.jacobian, c.cameraVariables, c.sampler.index(), c.declaredSamples, settings,
          settings.deltas.limit < kInfinity || c.wantsFootprint || c.record);
    leaving_ = c.ray.direction;
  }
  /// `index`: of the sample in its pixel; `declared`: samples a pixel, particles of all lights; 0
  /// if open ended. A limit needs the gradient; without either it need not be followed.
  void begin(const RayJacobian& ray, int variables, std::uint64_t index, std::uint64_t declared,
             const FootprintSettings& settings, bool followsGradient = true) noexcept {
    settings_ = settings;
    followsGradient_ = followsGradient;
    differentials_.begin(ray, variables);
    count_.begin(index, declared, variables);
    const Real share = commonDelta(settings.deltas, count_);
    for (int j = 0; j < Lanes; ++j) frozen_[j] = share;
    // Igehy's bound knows the film only, not the lens.
    if (settings.deltas.bound == Bound::pixel)
      for (int j = 2; j < Lanes; ++j) frozen_[j] = 0;
  }

  /// To a surface; `size` is the scene's, which no differential outgrows.
  void arrive(Vec3 direction, const Surface& s, Real size) noexcept {
    normal_ = s.geometricNormal;
    direction_ = direction;
    differentials_.transfer(direction, s.distance, s.geometricNormal, std::max(size, s.distance));
    motion_ = surfaceMotion(s, direction);
  }

  /// The region around the vertex, in world space and in uv: two vectors, full length (pigment.h).
  Footprint footprint() const noexcept {
    if (!settings_.isOn()) return {};
    const Frame f = Frame::around(normal_);
    const Region r = region(f);
    const auto world = [&](Vec2 p) { return p.x * f.s + p.y * f.t; };
    Footprint result{{world(r.a), world(r.b)}, {}};
    for (const int i : {0, 1})
      result.dUv[i] = {dot(motion_.du, result.dP[i]), dot(motion_.dv, result.dP[i])};
    return result;
  }

  /// The same for the direction of the ray that left the last surface: two vectors across it.
  void directions(Vec3 spread[2]) const noexcept {
    const Frame f = Frame::around(leaving_);
    const Region r = ellipse(directionCovariance(f));
    spread[0] = r.a.x * f.s + r.a.y * f.t, spread[1] = r.b.x * f.s + r.b.y * f.t;
  }

  /// Exact area of the polygon that the differential vectors span (Minkowski sum) [MATH 2.1].
  Real area() const noexcept { return polygonArea(vectors(Frame::around(normal_)).all()); }

  /// Through a scattering drawn with these numbers at the surface arrived at. Where the path splits
  /// into strata x strata children, `strata` says so (1: not at all). Reduces first where there is
  /// no room.
  void scatter(const Surface& s, const Interaction& x, const Scatter& drawn, ScatterNumbers numbers,
               Strata strata = {}) noexcept {
    if (!drawn.local.specular && differentials_.size() > Lanes - 2) reduceNow();
    const int before = differentials_.size();
    LogGradient log;
    const bool steepens = followsGradient_ && !drawn.local.specular;
    if (steepens) log = x.brdf->logGradient(x.point, drawn.local.toNext);
    differentials_.scatter(event(s, x, drawn.toNext), x.brdf->sampleDerivatives(x.point, numbers),
                           steepens ? &log : nullptr, drawn.local.specular);
    leaving_ = drawn.toNext;
    count_.chance(drawn.local.lobeChance);
    count_.split(strata.u * strata.v);
    if (drawn.local.specular) return;
    count_.drew(2);
    const bool isLocal = settings_.deltas.bound == Bound::local;
    // Only a share of the split's rays are drawn from this lobe.
    const Real spread = settings_.deltas.scale / std::sqrt(drawn.local.lobeChance);
    const auto own = [&](Real n) { return isLocal ? std::min(spread / n, Real(1)) : Real(0); };
    if (before < Lanes) frozen_[before] = own(strata.u);
    if (before + 1 < Lanes) frozen_[before + 1] = own(strata.v);
  }

  /// What a connection to a light moves by: the light's two numbers come last.
  Differentials<Lanes + 4> connect(const Surface& s, const Interaction& x, Vec3 toLight,
                                   const LightJacobian& light,
                                   const LightLogGradient& lightLog) const noexcept {
    return differentials_.connect(event(s, x, toLight),
                                  x.brdf->logGradient(x.point, x.frame.toLocal(toLight)), light,
                                  lightLog);
  }

  /// A discrete choice that the path survived, with its probability.
  void chance(Real probability) noexcept { count_.chance(probability); }

  const Differentials<Lanes>& differentials() const noexcept { return differentials_; }
  const PathCount& count() const noexcept { return count_; }

  /// delta_j: the bound, then the gradient's limit, then the width of a sphere.
  Real delta(int j) const noexcept { return deltas(j / 4)[j % 4]; }

  /// The steepest relative change of the contribution with any of the numbers.
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

  Four deltas(int block) const noexcept {
    const Real* own = frozen_ + 4 * block;
    const Four bound = isFrozen() ? Four{own[0], own[1], own[2], own[3]}
                                  : detail::four(commonDelta(settings_.deltas, count_));
    return differentials_.deltas(block, bound, settings_.deltas.limit);
  }

  ScatterEvent event(const Surface& s, const Interaction& x, Vec3 leaving) const noexcept {
    return {x.frame, direction_, leaving, frameMotion(s, motion_, x.frame)};
  }

  /// Of dD, delta multiplied in, across the ray.
  Covariance directionCovariance(const Frame& f) const noexcept {
    Covariance m;
    for (int b = 0; b < differentials_.blocks(); ++b) {
      const auto d = differentials_.directionsAlong(b, f.s, f.t);
      m.add(deltas(b), d.x, d.y);
    }
    return m;
  }

  /// Two numbers are their own parallelogram; more become the ellipse, or PD01's pair.
  Region region(const Frame& f) const noexcept {
    if (differentials_.size() == 2 || settings_.shape == RegionShape::representative) {
      const Vectors v = vectors(f);
      return v.size == 2 ? Region{v.list[0], v.list[1]} : representative(v.all());
    }
    Covariance m;
    for (int b = 0; b < differentials_.blocks(); ++b) {
      const auto v = differentials_.verticesAlong(b, f.s, f.t);
      m.add(deltas(b), v.x, v.y);
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
    for (int b = 0; b < differentials_.blocks(); ++b) {
      const auto v = differentials_.verticesAlong(b, f.s, f.t);
      const Four delta = deltas(b), x = delta * v.x, y = delta * v.y;
      for (int i = 0; i < 4; ++i) r.list[4 * b + i] = {x[i], y[i]};
    }
    return r;
  }

  /// Frozen deltas go into the columns, which then count whole; common ones stay outside. Merged
  /// numbers keep a gradient only where a limit goes by it: asking for it must not change a
  /// picture.
  void reduceNow() noexcept {
    Four weights[Lanes / 4];
    for (int j = 0; j < Lanes; ++j) weights[j / 4][j % 4] = isFrozen() ? frozen_[j] : Real(1);
    reduce(differentials_, normal_, direction_, weights, settings_.deltas.limit < kInfinity);
    for (int j = 0; j < Lanes; ++j) frozen_[j] = 1;
  }

  Differentials<Lanes> differentials_;
  Real frozen_[Lanes] = {};
  PathCount count_;
  FootprintSettings settings_;
  SurfaceMotion motion_;
  bool followsGradient_ = false;
  Vec3 normal_, direction_;  ///< of the surface arrived at, and D
  Vec3 leaving_;             ///< the ray under way
};

}  // namespace vestige
