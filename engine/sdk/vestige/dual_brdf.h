// SPDX-License-Identifier: Apache-2.0
// A BRDF whose author writes the sampling routine and log f once, as templates over the number
// type, and gets both derivatives by forward-mode differentiation. The class derives from
// DualBrdf<Itself>. Besides evaluate() and sample() (which may call direction()) it defines:
//
// clang-format off
//     template <class T>   // the direction of one lobe, for numbers that do not end the path
//     TVec3<T> direction(const ScatterPoint& p, const TVec3<T>& toPrev, Real lobe, const TVec2<T>& u) const noexcept;
//     template <class T>   // log of the luminance of f; called only where f > 0
//     T logValue(const ScatterPoint& p, const TVec3<T>& toPrev, const TVec3<T>& toNext) const noexcept;
// clang-format on
#pragma once
#include <vestige/brdf.h>
#include <vestige/dual.h>

namespace vestige {

template <class Derived>
class DualBrdf : public Brdf {
 public:
  ScatterJacobian sampleDerivatives(const ScatterPoint& p,
                                    ScatterNumbers n) const noexcept override {
    const Frame f = Frame::around(p.toPrev);
    const TVec2<Dual> u{Dual::variable(n.u.x, 0), Dual::variable(n.u.y, 1)};
    const TVec3<Dual> toPrev = moving(p.toPrev, f.s, f.t, 2);
    const TVec3<Dual> d = self().direction(p, toPrev, n.lobe, u);
    return scatterJacobian(f, {d.x.d, d.y.d, d.z.d});
  }

  LogGradient logGradient(const ScatterPoint& p, Vec3 toNext) const noexcept override {
    if (isBlack(evaluate(p, toNext).fCos)) return {};
    const Frame a = Frame::around(p.toPrev), b = Frame::around(toNext);
    const Dual l = self().logValue(p, moving(p.toPrev, a.s, a.t, 0), moving(toNext, b.s, b.t, 2));
    return {l.d[0] * a.s + l.d[1] * a.t, l.d[2] * b.s + l.d[3] * b.t};
  }

 private:
  const Derived& self() const noexcept { return static_cast<const Derived&>(*this); }
};

}  // namespace vestige
