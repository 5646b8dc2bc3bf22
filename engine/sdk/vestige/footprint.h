// SPDX-License-Identifier: Apache-2.0
// The footprint of a path: how large a region the path stands for, at every vertex. One module for
// every integrator; header-only; lives on the stack and never crosses the ABI.
//
//     PathFootprint<> f;
//     f.begin(context.jacobian, context.cameraVariables, index, declaredSamples, settings);
//     f.arrive(ray, surface, sceneSize);                     // MATH 1.3, 1.4
//     shade(surface, toPrev, f.footprint(), buffer);         // textures see the footprint
//     f.scatter(interaction, drawn, numbers, split);         // MATH 1.5 to 1.10
//     f.chance(survival);                                    // roulette, opacity
//
// footprint/differentials.h  the chain rule          footprint/deltas.h      how far a number may
// move footprint/footprints.h     regions                 footprint/reduce.h      many numbers into
// four
//
// [PD01] Suykens, Willems. Path differentials and applications. EGWR 2001.
#pragma once
#include <vestige/footprint/deltas.h>
#include <vestige/footprint/differentials.h>
#include <vestige/footprint/footprints.h>
#include <vestige/footprint/reduce.h>
#include <vestige/integrator.h>

namespace vestige {

enum class RegionShape {
  covariance,      ///< the ellipse with the vectors' second moments
  representative,  ///< PD01's two vectors
};

struct FootprintSettings {
  DeltaPolicy deltas;
  RegionShape shape = RegionShape::covariance;
  bool isOn() const noexcept { return deltas.bound != Bound::none; }
};

/// More numbers than this are reduced before the next event appends two.
inline constexpr int kReduceAbove = 6;

template <int Lanes = 8>
class PathFootprint {
 public:
  /// `index`: of the sample in its pixel; `declared`: samples a pixel, 0 if open ended.
  void begin(const RayJacobian& ray, int variables, std::uint64_t index, std::uint64_t declared,
             const FootprintSettings& settings) noexcept {
    settings_ = settings;
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
    differentials_.transfer(direction, s.distance, s.geometricNormal, size);
    const bool behind = dot(direction, s.geometricNormal) > 0;
    const bool turned = dot(s.normal, s.geometricNormal) < 0;
    motion_ = surfaceMotion(s, behind != turned ? Real(-1) : Real(1));
  }

  /// The region around the vertex, in world space and in uv.
  Footprint footprint() const noexcept {
    if (!settings_.isOn()) return {};
    const Frame f = Frame::around(normal_);
    std::array<Vec2, Lanes> v;
    const int k = vectors(f, v);
    Region r;
    if (settings_.shape == RegionShape::representative) {
      r = representative({v.data(), std::size_t(k)});
    } else {
      Covariance m;
      for (int j = 0; j < k; ++j) m.add(v[std::size_t(j)]);
      r = ellipse(m);
    }
    const auto world = [&](Vec2 p) { return p.x * f.s + p.y * f.t; };
    Footprint result{{world(r.a), world(r.b)}, {}};
    for (const int i : {0, 1})
      result.dUv[i] = {dot(motion_.du, result.dP[i]), dot(motion_.dv, result.dP[i])};
    return result;
  }

  /// Exact area of the polygon that the differential vectors span (Minkowski sum) [MATH 2.1].
  Real area() const noexcept {
    std::array<Vec2, Lanes> v;
    const int k = vectors(Frame::around(normal_), v);
    return polygonArea({v.data(), std::size_t(k)});
  }

  /// Through a scattering drawn with these numbers at the vertex arrived at; `split`: into how many
  /// children, strata included (1: none). Reduces first where there is no room.
  void scatter(const Interaction& x, const Scatter& drawn, ScatterNumbers numbers,
               int split = 1) noexcept {
    if (differentials_.size() > std::min(kReduceAbove, Lanes - 2)) reduceNow();
    const ScatterEvent event{x.frame, direction_, drawn.toNext, motion_};
    const int before = differentials_.size();
    differentials_.scatter(event, x.brdf->sampleDerivatives(x.point, numbers),
                           x.brdf->logGradient(x.point, drawn.local.toNext), drawn.local.specular);
    count_.chance(drawn.local.lobeChance);
    count_.split(split);
    if (!drawn.local.specular) count_.drew(2);
    const Real share =
        settings_.deltas.bound == Bound::local ? 1 / std::sqrt(Real(split)) : Real(0);
    for (int j = before; j < differentials_.size(); ++j) frozen_[j] = share;
  }

  /// A discrete choice that the path survived, with its probability.
  void chance(Real probability) noexcept { count_.chance(probability); }

  const Differentials<Lanes>& differentials() const noexcept { return differentials_; }
  const PathCount& count() const noexcept { return count_; }
  const SurfaceMotion& motion() const noexcept { return motion_; }

  /// delta_j: the bound, then the gradient's limit.
  Real delta(int j) const noexcept {
    const bool own = isFrozen();
    const Real bound = own ? frozen_[j] : commonDelta(settings_.deltas, count_);
    return limited(bound, differentials_.gradient(j), settings_.deltas.limit);
  }

 private:
  bool isFrozen() const noexcept {
    return settings_.deltas.bound == Bound::local || settings_.deltas.bound == Bound::pixel;
  }

  /// Differential vectors, delta multiplied in, in the plane of f. Returns how many.
  int vectors(const Frame& f, std::array<Vec2, Lanes>& out) const noexcept {
    const bool own = isFrozen();
    const Real common = own ? 0 : commonDelta(settings_.deltas, count_);
    for (int j = 0; j < differentials_.size(); ++j) {
      const Real d =
          limited(own ? frozen_[j] : common, differentials_.gradient(j), settings_.deltas.limit);
      const Vec3 v = differentials_.dVertex(j);
      out[std::size_t(j)] = {d * dot(v, f.s), d * dot(v, f.t)};
    }
    return differentials_.size();
  }

  /// Frozen deltas go into the columns, which then count whole; common ones stay outside.
  void reduceNow() noexcept {
    Real weights[Lanes];
    for (int j = 0; j < Lanes; ++j) weights[j] = isFrozen() ? frozen_[j] : Real(1);
    reduce(differentials_, normal_, direction_, weights, std::isfinite(settings_.deltas.limit));
    for (int j = 0; j < Lanes; ++j) frozen_[j] = 1;
  }

  Differentials<Lanes> differentials_;
  Real frozen_[Lanes] = {};
  PathCount count_;
  FootprintSettings settings_;
  SurfaceMotion motion_;
  Vec3 normal_, direction_;
};

}  // namespace vestige
