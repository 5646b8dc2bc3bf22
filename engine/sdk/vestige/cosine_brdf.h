// SPDX-License-Identifier: Apache-2.0
// The shortest way to write a broad reflecting BRDF: its author writes only f, as a colour times a
// template over the number type. Directions are cosine distributed; derivatives come from
// forward-mode differentiation. The class derives from CosineBrdf<Itself> and defines, besides
// schema():
//
//     Rgb colour(const ScatterPoint& p) const noexcept;
//     template <class T>   // f / colour, 1/sr, >= 0, finite; both directions on the front side
//     T shape(const ScatterPoint& p, const TVec3<T>& toPrev, const TVec3<T>& toNext) const
//     noexcept;
//
// dual.h lists the rules for the template. Do not use it for lobes much narrower than the cosine:
// the weights of their samples become large.
#pragma once
#include <vestige/brdf.h>
#include <vestige/dual.h>

namespace vestige {

template <class Derived>
class CosineBrdf : public Brdf {
 public:
  ScatterValue evaluate(const ScatterPoint& p, Vec3 toNext) const noexcept override {
    if (!(toNext.z > 0)) return {};
    const Real f = self().shape(p, lifted(p.toPrev), lifted(toNext));
    return {toNext.z * f * self().colour(p), toNext.z / kPi};
  }

  std::optional<ScatterSample> sample(const ScatterPoint& p,
                                      ScatterNumbers n) const noexcept override {
    const Vec3 toNext = cosineHemisphere(n.u).d;
    const ScatterValue v = evaluate(p, toNext);
    if (!(v.pdf > 0)) return std::nullopt;
    return ScatterSample::only(toNext, v.fCos / v.pdf, v.pdf);
  }

  /// The direction does not depend on toPrev.
  ScatterJacobian sampleDerivatives(const ScatterPoint&, ScatterNumbers n) const noexcept override {
    return {.du = cosineHemisphere(n.u).du, .dPrev = {}};
  }

  LogGradient logGradient(const ScatterPoint& p, Vec3 toNext) const noexcept override {
    if (isBlack(evaluate(p, toNext).fCos)) return {};
    const Frame a = Frame::around(p.toPrev), b = Frame::around(toNext);
    const Dual f = self().shape(p, moving(p.toPrev, a.s, a.t, 0), moving(toNext, b.s, b.t, 2));
    const auto slope = [&](int lane) { return f.d[lane] / f.v; };
    const LogGradient g{slope(0) * a.s + slope(1) * a.t, slope(2) * b.s + slope(3) * b.t};
    return isFinite(g.dPrev) && isFinite(g.dNext) ? g : LogGradient{};  // both at the horizon
  }

  bool usesLobeNumber() const noexcept override { return false; }

 private:
  const Derived& self() const noexcept { return static_cast<const Derived&>(*this); }
};

}  // namespace vestige
