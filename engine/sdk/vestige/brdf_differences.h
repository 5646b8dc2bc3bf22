// SPDX-License-Identifier: Apache-2.0
// The default derivatives of a BRDF: finite differences of sample() and evaluate(). The engine
// notifies the user once if a scene uses such a plugin.
//
// A lobe built in a frame around a moving axis rotates with that frame arbitrarily, and without
// bound near the frame's singularity. Derivatives are free of that spin [MATH 1.9]: the frame is
// read off the lobe (its middle is u = <1/2, 1/2>, azimuth 0 lies towards u = <1, 1/2>), and every
// neighbour is carried back along the shortest turn of its axis.
#pragma once
#include <vestige/brdf.h>
#include <vestige/tools/differences.h>

namespace vestige::differences {

/// The same point seen along another toPrev.
inline ScatterPoint facing(ScatterPoint p, Vec3 toPrev) noexcept {
  p.toPrev = toPrev;
  return p;
}

/// sample() as a map within one lobe and one kind of event.
class LobeMap {
 public:
  LobeMap(const Brdf& brdf, const ScatterPoint& p, ScatterNumbers n) noexcept
      : brdf_(brdf), p_(p), n_(n), drawn_(brdf.sample(p, n)) {
    if (drawn_ && !drawn_->specular) frame_ = frameAt(p);
  }
  bool exists() const noexcept { return drawn_.has_value(); }
  bool isSpecular() const noexcept { return drawn_->specular; }
  Vec3 toNext() const noexcept { return drawn_->toNext; }

  /// The map at other random numbers; nullopt outside the unit square and in other lobes.
  std::optional<Vec3> byNumbers(Vec2 u) const noexcept {
    if (!(u.x >= 0 && u.x < 1 && u.y >= 0 && u.y < 1)) return std::nullopt;
    return within(p_, u);
  }

  /// The map at another toPrev, without the frame's spin; nullopt below the horizon and in other
  /// lobes.
  std::optional<Vec3> byPrev(Vec3 toPrev) const noexcept {
    if (!(toPrev.z > 0)) return std::nullopt;
    const ScatterPoint q = facing(p_, toPrev);
    const auto there = within(q, n_.u);
    if (!there || !frame_) return there;
    const auto frame = frameAt(q);
    if (!frame) return std::nullopt;
    return carried(frame_->n, frame->n, frame_->toWorld(frame->toLocal(*there)));
  }

 private:
  std::optional<Vec3> within(const ScatterPoint& p, Vec2 u) const noexcept {
    const auto s = brdf_.sample(p, {n_.lobe, u});
    if (!s || s->lobe != drawn_->lobe || s->specular != drawn_->specular) return std::nullopt;
    return s->toNext;
  }
  std::optional<Frame> frameAt(const ScatterPoint& p) const noexcept {
    const auto axis = within(p, {Real(0.5), Real(0.5)}), side = within(p, {Real(0.6), Real(0.5)});
    if (!axis || !side) return std::nullopt;
    // Twice: what lies across the axis is a small difference, and not quite across it.
    return Frame::along(*axis, Frame::along(*axis, *side).s);
  }

  const Brdf& brdf_;
  const ScatterPoint& p_;
  ScatterNumbers n_;
  std::optional<ScatterSample> drawn_;
  std::optional<Frame> frame_;  ///< of the lobe; none: differences are taken as they come
};

inline ScatterJacobian ofSample(const Brdf& brdf, const ScatterPoint& p,
                                ScatterNumbers n) noexcept {
  const LobeMap lobe(brdf, p, n);
  if (!lobe.exists()) return {};
  ScatterJacobian j{};
  const auto slope = [&](const auto& map, Real h) {
    const Vec3 d = derivative(map, lobe.toNext(), h);
    return d - dot(d, lobe.toNext()) * lobe.toNext();  // a unit vector moves across itself
  };
  if (!lobe.isSpecular())
    for (const int k : {0, 1})
      j.du.c[k] = slope(
          [&](Real h) {
            return lobe.byNumbers(k == 0 ? Vec2{n.u.x + h, n.u.y} : Vec2{n.u.x, n.u.y + h});
          },
          kStep);
  // One tangent runs up, the other along the horizon: near it, only one of the two is one-sided.
  const Frame f = Frame::along(p.toPrev, {0, 0, 1});
  for (const Vec3 along : {f.s, f.t}) {
    const auto map = [&](Real h) { return lobe.byPrev(turned(p.toPrev, along, h)); };
    j.dPrev = j.dPrev + outer(slope(map, kStep), along);
  }
  return j;
}

/// Gradient of the log of a positive function of both directions, value(point, toNext), which must
/// be about as smooth as the BRDF's density. Zero where the function is zero.
template <class Value>
LogGradient ofLog(const Value& value, const Brdf& brdf, const ScatterPoint& p,
                  Vec3 toNext) noexcept {
  const auto logValue = [&](const ScatterPoint& q, Vec3 next) -> std::optional<Real> {
    if (!(q.toPrev.z > 0) || (next.z > 0) != (toNext.z > 0)) return std::nullopt;
    const Real f = value(q, next);
    return f > std::numeric_limits<Real>::min() ? std::optional(std::log(f)) : std::nullopt;
  };
  const auto here = logValue(p, toNext);
  if (!here) return {};
  // A lobe is as wide as the root of its density is high.
  const Real density = brdf.pdf(p, toNext);
  const Real h = 4 * kStep / (1 + std::sqrt(std::isfinite(density) ? density : Real(0)));
  const Real noise = 2 + std::abs(*here);
  const auto gradient = [&](Vec3 from, const auto& at) {
    const Frame f = Frame::along(from, {0, 0, 1});
    Vec3 sum;
    for (const Vec3 along : {f.s, f.t})
      sum +=
          derivative([&](Real x) { return at(turned(from, along, x)); }, *here, h, noise) * along;
    return sum;
  };
  return {gradient(p.toPrev, [&](Vec3 d) { return logValue(facing(p, d), toNext); }),
          gradient(toNext, [&](Vec3 d) { return logValue(p, d); })};
}

inline LogGradient ofLogF(const Brdf& brdf, const ScatterPoint& p, Vec3 toNext) noexcept {
  const auto f = [&](const ScatterPoint& q, Vec3 next) { return luminance(brdf.f(q, next)); };
  return ofLog(f, brdf, p, toNext);
}
inline LogGradient ofLogPdf(const Brdf& brdf, const ScatterPoint& p, Vec3 toNext) noexcept {
  const auto pdf = [&](const ScatterPoint& q, Vec3 next) { return brdf.pdf(q, next); };
  return ofLog(pdf, brdf, p, toNext);
}

}  // namespace vestige::differences

namespace vestige {

inline ScatterJacobian Brdf::sampleDerivatives(const ScatterPoint& p,
                                               ScatterNumbers n) const noexcept {
  return differences::ofSample(*this, p, n);
}
inline LogGradient Brdf::logGradient(const ScatterPoint& p, Vec3 toNext) const noexcept {
  return differences::ofLogF(*this, p, toNext);
}

}  // namespace vestige
