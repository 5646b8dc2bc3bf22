// SPDX-License-Identifier: Apache-2.0
// Base class of lights that write their sampling routine and factor once, as templates, and inherit
// all derivatives.
//
// clang-format off
//     class Ball final : public DualLight<Ball> {
//      public:
//       template <class T>   // from the receiver to the light, of any length, as sample() draws it
//       TVec3<T> toLight(const TVec3<T>& from, const TVec2<T>& u) const noexcept;
//       template <class T>   // log of the factor of LightLogGradient; called only where there is a sample
//       T logFactor(const TVec3<T>& from, const TVec2<T>& u) const noexcept;
//       template <class T>   // what emit() starts; the direction of any length
//       TRay<T> particle(const TVec2<T>& point, const TVec2<T>& direction) const noexcept;
//       ...                  // and sample(), pdf(), eval(), emit(), power() as in light.h
//     };
// clang-format on
//
// A light that emits no particles omits particle() and emit().
#pragma once
#include <vestige/dual.h>
#include <vestige/light.h>

namespace vestige {

template <class Derived>
class DualLight : public Light {
 public:
  LightJacobian sampleDerivatives(const Receiver& r, Vec2 u) const noexcept override {
    LightJacobian j;
    const TVec3<Dual> byU = normalize(self().toLight(constant<Dual>(r.position), numbers(u)));
    const TVec3<Dual> byFrom = normalize(self().toLight(position(r), still(u)));
    if (!traits().isDelta) j.du = {derivative(byU, 0), derivative(byU, 1)};
    for (int k = 0; k < 3; ++k) j.dFrom.c[k] = derivative(byFrom, k);
    return j;
  }

  LightLogGradient logGradient(const Receiver& r, Vec2 u) const noexcept override {
    const auto here = sample(r, u);
    if (!here || !(luminance(here->radiance) > 0)) return {};
    const Dual byU = self().logFactor(constant<Dual>(r.position), numbers(u));
    const Dual byFrom = self().logFactor(position(r), still(u));
    return {{byU.d[0], byU.d[1]}, {byFrom.d[0], byFrom.d[1], byFrom.d[2]}};
  }

  RayJacobian emissionDerivatives(EmissionNumbers u) const noexcept override {
    RayJacobian j;
    if constexpr (requires(TVec2<Dual> n) { std::declval<const Derived&>().particle(n, n); }) {
      TVec2<Dual> direction{Dual::variable(u.direction.x, 2), Dual::variable(u.direction.y, 3)};
      const TRay<Dual> p = self().particle(numbers(u.point), direction);
      const TVec3<Dual> d = normalize(p.direction);
      for (int k = 0; k < 4; ++k) {
        j.dOrigin[k] = derivative(p.origin, k);
        j.dDirection[k] = derivative(d, k);
      }
    }
    return j;
  }

 private:
  static TVec2<Dual> numbers(Vec2 u) noexcept {
    return {Dual::variable(u.x, 0), Dual::variable(u.y, 1)};
  }
  static TVec2<Dual> still(Vec2 u) noexcept { return {Dual(u.x), Dual(u.y)}; }
  static TVec3<Dual> position(const Receiver& r) noexcept {
    return {Dual::variable(r.position.x, 0), Dual::variable(r.position.y, 1),
            Dual::variable(r.position.z, 2)};
  }
  const Derived& self() const noexcept { return static_cast<const Derived&>(*this); }
};

}  // namespace vestige
