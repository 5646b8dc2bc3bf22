// SPDX-License-Identifier: Apache-2.0
// The default derivatives of a light: finite differences of sample() and emit(). The engine
// notifies the user once if a scene uses such a plugin.
#pragma once
#include <vestige/light.h>
#include <vestige/tools/differences.h>

namespace vestige::differences {

/// sample() as a function of its random numbers and of the receiver's position.
class LightMap {
 public:
  LightMap(const Light& light, const Receiver& r, Vec2 u) noexcept
      : light_(light), r_(r), u_(u), here_(light.sample(r, u)) {}

  const std::optional<LightSample>& here() const noexcept { return here_; }
  bool isFinite() const noexcept { return here_ && std::isfinite(here_->hit.distance); }
  /// Scene units that count as a step of 1: what is smooth is smooth on the scale of the distance.
  Real unit() const noexcept { return here_->hit.distance; }
  /// Magnitude of the values that sample() rounds, in those units.
  Real noise() const noexcept {
    return isFinite() ? 1 + length(r_.position) / here_->hit.distance : 1;
  }

  /// Number k moved by h; nullopt outside of the unit square.
  std::optional<LightSample> byNumber(int k, Real h) const noexcept {
    Vec2 u = u_;
    (k == 0 ? u.x : u.y) += h;
    if (!(u.x >= 0 && u.x < 1 && u.y >= 0 && u.y < 1)) return std::nullopt;
    return light_.sample(r_, u);
  }
  /// The receiver moved by h units along axis k.
  std::optional<LightSample> byPosition(int k, Real h) const noexcept {
    Receiver r = r_;
    r.position[k] += h * unit();
    return light_.sample(r, u_);
  }

 private:
  const Light& light_;
  const Receiver& r_;
  Vec2 u_;
  std::optional<LightSample> here_;
};

inline LightJacobian ofLightSample(const Light& light, const Receiver& r, Vec2 u) noexcept {
  const LightMap map(light, r, u);
  LightJacobian j;
  if (!map.here()) return j;
  const Vec3 toLight = map.here()->hit.toLight;
  const auto slope = [&](const auto& moved) {
    const auto direction = [&](Real h) {
      const auto s = moved(h);
      return s ? std::optional(s->hit.toLight) : std::nullopt;
    };
    // The derivative of a unit vector is perpendicular to it.
    return projection(toLight) * derivative(direction, toLight, kStep, map.noise());
  };
  if (!light.traits().isDelta)
    for (const int k : {0, 1}) j.du.c[k] = slope([&](Real h) { return map.byNumber(k, h); });
  if (!map.isFinite()) return j;
  for (const int k : {0, 1, 2}) {
    const Vec3 d = slope([&](Real h) { return map.byPosition(k, h); }) / map.unit();
    j.dFrom.c[k] = isFinite(d) ? d : Vec3{};
  }
  return j;
}

inline LightLogGradient ofLightFactor(const Light& light, const Receiver& r, Vec2 u) noexcept {
  const LightMap map(light, r, u);
  const bool isByArea = light.geometry() != nullptr;
  const auto logFactor = [&](const std::optional<LightSample>& s) -> std::optional<Real> {
    if (!s) return std::nullopt;
    const Real measure =
        isByArea ? std::abs(dot(s->hit.normal, s->hit.toLight)) / sqr(s->hit.distance) : 1;
    const Real f = luminance(s->radiance) * measure;
    return f > std::numeric_limits<Real>::min() ? std::optional(std::log(f)) : std::nullopt;
  };
  const auto here = logFactor(map.here());
  LightLogGradient g{};
  if (!here) return g;
  const auto slope = [&](const auto& moved) {
    return derivative([&](Real h) { return logFactor(moved(h)); }, *here, kStep,
                      map.noise() + std::abs(*here));
  };
  if (!light.traits().isDelta)
    g.du = {slope([&](Real h) { return map.byNumber(0, h); }),
            slope([&](Real h) { return map.byNumber(1, h); })};
  if (!map.isFinite()) return g;
  for (const int k : {0, 1, 2}) {
    const Real d = slope([&](Real h) { return map.byPosition(k, h); }) / map.unit();
    g.dFrom[k] = std::isfinite(d) ? d : 0;
  }
  return g;
}

/// emit() as a map from its numbers, without the spin of the frame that it builds around the normal
/// (or, at infinity, around the direction): the frame is read off the map, and every neighbour
/// carried back along the shortest turn of its axis [MATH 1.9].
class EmissionMap {
 public:
  EmissionMap(const Light& light, EmissionNumbers u) noexcept
      : light_(light), u_(u), isInfinite_(light.traits().isInfinite), here_(light.emit(u)) {
    if (here_) frame_ = frameAt(u, *here_);
  }
  const std::optional<Particle>& here() const noexcept { return here_; }

  /// emit() with random number k (0, 1: point; 2, 3: direction) moved by h; nullopt outside the
  /// unit squares.
  std::optional<Particle> moved(int k, Real h) const noexcept {
    EmissionNumbers n = u_;
    Vec2& pair = k < 2 ? n.point : n.direction;
    Real& x = k % 2 == 0 ? pair.x : pair.y;
    x += h;
    if (!(x >= 0 && x < 1)) return std::nullopt;
    std::optional<Particle> p = light_.emit(n);
    // Only the axis of a frame can rotate it: the point of a surface, or a direction at infinity.
    if (!p || !frame_ || isInfinite_ != (k >= 2)) return p;
    const auto there = frameAt(n, *p);
    if (!there) return std::nullopt;
    const auto back = [&](Vec3 v) {
      return carried(frame_->frame.n, there->frame.n,
                     frame_->frame.toWorld(there->frame.toLocal(v)));
    };
    if (isInfinite_)
      p->origin = there->pivot + back(p->origin - there->pivot);
    else
      p->direction = back(p->direction);
    return p;
  }

 private:
  struct Pivoted {
    Frame frame;
    Vec3 pivot;
  };
  /// The frame of the disk of a direction at infinity, else of the hemisphere of a point.
  std::optional<Pivoted> frameAt(EmissionNumbers n, const Particle& p) const noexcept {
    Vec2& across = isInfinite_ ? n.point : n.direction;
    across = {Real(0.5), Real(0.5)};
    const auto middle = light_.emit(n);
    across.x = Real(0.6);
    const auto side = light_.emit(n);
    if (!middle || !side) return std::nullopt;
    if (isInfinite_)
      return Pivoted{Frame::along(p.direction, side->origin - middle->origin), middle->origin};
    // Twice: what lies across the axis is a small difference, and not quite across it.
    const Frame once = Frame::along(middle->direction, side->direction);
    return Pivoted{Frame::along(once.n, once.s), {}};
  }

  const Light& light_;
  EmissionNumbers u_;
  bool isInfinite_;
  std::optional<Particle> here_;
  std::optional<Pivoted> frame_;
};

inline RayJacobian ofEmission(const Light& light, EmissionNumbers u) noexcept {
  const EmissionMap map(light, u);
  RayJacobian j;
  if (!map.here()) return j;
  const Vec3 start = map.here()->origin, direction = map.here()->direction;
  for (int k = 0; k < 4; ++k) {
    const auto origin = [&](Real h) {
      const auto p = map.moved(k, h);
      return p ? std::optional(p->origin) : std::nullopt;
    };
    const auto along = [&](Real h) {
      const auto p = map.moved(k, h);
      return p ? std::optional(p->direction) : std::nullopt;
    };
    j.dOrigin[k] = derivative(origin, start, kStep, 1 + length(start));
    j.dDirection[k] = projection(direction) * derivative(along, direction, kStep);
  }
  return j;
}

}  // namespace vestige::differences

namespace vestige {

inline LightJacobian Light::sampleDerivatives(const Receiver& r, Vec2 u) const noexcept {
  return differences::ofLightSample(*this, r, u);
}
inline LightLogGradient Light::logGradient(const Receiver& r, Vec2 u) const noexcept {
  return differences::ofLightFactor(*this, r, u);
}
inline RayJacobian Light::emissionDerivatives(EmissionNumbers u) const noexcept {
  return differences::ofEmission(*this, u);
}

}  // namespace vestige
