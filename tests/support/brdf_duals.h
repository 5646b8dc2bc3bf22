// SPDX-License-Identifier: Apache-2.0
// Three built-in models written a second time, as templates over the number, so that dual numbers
// derive them: the witness against the derivatives that the plugins write by hand. Parameters are
// read from the same inputs, in the order of the plugins' schemas.
//
// Formulas that cancel are written as the plugins write them (log1p, expm1): what is compared are
// derivatives, not roundings.
#pragma once
#include <vestige/dual_brdf.h>
#include <vestige/tools/fresnel.h>
#include <vestige/tools/microfacet.h>

#include "support/forwarding_brdf.h"

namespace vestige::test {

/// A model that has derivatives by duals and all else from the plugin.
template <class Model>
class Twin : public Forwarding<DualBrdf<Model>> {
 public:
  using Forwarding<DualBrdf<Model>>::Forwarding;
};

template <class T>
TVec3<T> halfway(const TVec3<T>& a, const TVec3<T>& b) noexcept {
  return normalize(a + b);
}

class DualLambert : public Twin<DualLambert> {
 public:
  using Twin::Twin;
  template <class T>
  TVec3<T> direction(const ScatterPoint&, const TVec3<T>&, Real, const TVec2<T>& u) const noexcept {
    using std::sqrt;
    const TVec2<T> d = concentricDisk(u);
    return {d.x, d.y, sqrt(T(1) - (d.x * d.x + d.y * d.y))};
  }
  template <class T>
  T logValue(const ScatterPoint& p, const TVec3<T>&, const TVec3<T>&) const noexcept {
    return T(std::log(luminance(p.inputs.rgb(0)) / kPi));
  }
  static double condition(const ScatterPoint&) noexcept { return 1; }
};

/// Both lobes.
class DualPhong : public Twin<DualPhong> {
 public:
  using Twin::Twin;
  template <class T>
  TVec3<T> direction(const ScatterPoint& p, const TVec3<T>& toPrev, Real lobe,
                     const TVec2<T>& u) const noexcept {
    using std::exp, std::expm1, std::log1p, std::sqrt;
    const TVec2<T> d = concentricDisk(u);
    const T e = T(1 / (exponent(p) + 1)), q = d.x * d.x + d.y * d.y, power = e * log1p(-q);
    const T g = sqrt(-expm1(T(2) * power) / q);  // sine over |d|
    return inFrameAround(axis(p, toPrev, isReflected(p, lobe)), {g * d.x, g * d.y, exp(power)});
  }
  template <class T>
  T logValue(const ScatterPoint& p, const TVec3<T>& toPrev, const TVec3<T>& toNext) const noexcept {
    using std::log, std::log1p;
    const bool reflected = value(toNext.z) > 0;
    const Real n = exponent(p), scale = (n + 2) / (2 * kPi) * luminance(fraction(p, reflected));
    const TVec3<T> middle = axis(p, toPrev, reflected);
    const T c = dot(middle, toNext);
    if (value(c) < Real(0.5)) return T(std::log(scale)) + T(n) * log(c);
    const TVec3<T> sine = cross(middle, toNext);
    return T(std::log(scale)) + T(n / 2) * log1p(-dot(sine, sine));
  }

  /// Cosine of the refracted axis; below the plugin's limit its derivatives are cut.
  static Real refracted(const ScatterPoint& p) noexcept {
    return refractedCosine(p.toPrev.z, eta(p));
  }
  /// How many times rounding is made larger: near total reflection.
  static double condition(const ScatterPoint& p) noexcept {
    const double t = double(refracted(p));
    return t > 0 ? std::max(1.0, sqr(eta(p)) / (t * t)) : 1;
  }

 private:
  static Real exponent(const ScatterPoint& p) noexcept { return p.inputs.real(1); }
  static Real eta(const ScatterPoint& p) noexcept { return p.eta(); }
  static Rgb fraction(const ScatterPoint& p, bool reflected) noexcept {
    const Rgb s = p.inputs.rgb(0), t = p.inputs.rgb(2), own = reflected ? s : t;
    const auto fit = [](Real x, Real total) { return x / std::max(total, Real(1)); };
    return {fit(own.r, s.r + t.r), fit(own.g, s.g + t.g), fit(own.b, s.b + t.b)};
  }
  static bool isReflected(const ScatterPoint& p, Real lobe) noexcept {
    const Real s = luminance(fraction(p, true));
    const Real t = refracted(p) < 0 ? 0 : luminance(fraction(p, false));
    return lobe < s / (s + t);
  }
  template <class T>
  static TVec3<T> axis(const ScatterPoint& p, const TVec3<T>& prev, bool reflected) noexcept {
    using std::sqrt;
    if (reflected) return {-prev.x, -prev.y, prev.z};
    const Real n = eta(p);
    return {T(-n) * prev.x, T(-n) * prev.y,
            -sqrt(T((1 - n) * (1 + n)) + T(n * n) * prev.z * prev.z)};
  }
};

/// Anisotropic, tinted or measured.
class DualConductor : public Twin<DualConductor> {
 public:
  using Twin::Twin;
  template <class T>
  TVec3<T> direction(const ScatterPoint& p, const TVec3<T>& toPrev, Real,
                     const TVec2<T>& u) const noexcept {
    using std::sqrt;
    const Vec2 a = widths(p);
    const auto stretched = [&](const TVec3<T>& v) -> TVec3<T> {
      return {T(a.x) * v.x, T(a.y) * v.y, v.z};
    };
    const TVec3<T> v = normalize(stretched(toPrev));
    const TVec2<T> d = concentricDisk(u);
    const T q = d.x * d.x + d.y * d.y, high = T(1) + v.z;
    const T m = sqrt(high * (T(2) - high * q));
    const TVec3<T> h = normalize(stretched({m * d.x + v.x, m * d.y + v.y, high * (T(1) - q)}));
    return T(2) * dot(toPrev, h) * h - toPrev;
  }
  template <class T>
  T logValue(const ScatterPoint& p, const TVec3<T>& toPrev, const TVec3<T>& toNext) const noexcept {
    using std::log, std::sqrt;
    const Vec2 a = widths(p);
    const TVec3<T> h = halfway(toPrev, toNext);
    const auto shade = [&](const TVec3<T>& w) {
      const T x = T(a.x) * w.x, y = T(a.y) * w.y;
      return T(2) / (w.z + sqrt(x * x + y * y + w.z * w.z));
    };
    const T x = h.x / T(a.x), y = h.y / T(a.y), s = x * x + y * y + h.z * h.z;
    const T geometry = shade(toPrev) * shade(toNext) / (T(4 * kPi * a.x * a.y) * s * s);
    return log(geometry) + log(fresnel(p, dot(toPrev, h)));
  }

  static Vec2 widths(const ScatterPoint& p) noexcept {
    const Real aspect = std::sqrt(1 - Real(0.9) * p.inputs.real(1)), alpha = p.inputs.real(0);
    const auto clamped = [](Real x) { return std::clamp(x, kMinAlpha, Real(1)); };
    return {clamped(alpha / aspect), clamped(alpha * aspect)};
  }
  /// A narrow lobe's width is a small difference of unit vectors.
  static double condition(const ScatterPoint& p) noexcept { return 1 / double(widths(p).y); }

 private:
  /// Luminance of the reflected fraction.
  template <class T>
  static T fresnel(const ScatterPoint& p, const T& c) noexcept {
    const Rgb n = p.inputs.rgb(2), k = p.inputs.rgb(3), f0 = p.inputs.rgb(4);
    const bool measured = !isBlack(n) || !isBlack(k);
    const auto channel = [&](Real n, Real k, Real f0) {
      return measured ? metal(c, n, k) : schlick(c, f0);
    };
    return T(Real(0.2126)) * channel(n.r, k.r, f0.r) + T(Real(0.7152)) * channel(n.g, k.g, f0.g) +
           T(Real(0.0722)) * channel(n.b, k.b, f0.b);
  }
  template <class T>
  static T schlick(const T& c, Real f0) noexcept {
    const T x = T(1) - c, x2 = x * x;
    return T(f0) + T(1 - f0) * x2 * x2 * x;
  }
  /// Both polarisations of the complex wave number a + i b [Born, Wolf 14.2].
  template <class T>
  static T metal(const T& c, Real n, Real k) noexcept {
    using std::sqrt;
    const T s2 = T(1) - c * c, real = T(n * n - k * k) - s2;
    const T m = sqrt(real * real + T(4 * n * n * k * k)), a = sqrt(T(Real(0.5)) * (m + real));
    const auto ratio = [](const T& x, const T& y) { return (x - y) / (x + y); };
    const T y = T(2) * a * c, rs = ratio(m + c * c, y), rp = ratio(c * c * m + s2 * s2, y * s2);
    return T(Real(0.5)) * rs * (T(1) + rp);
  }
};

}  // namespace vestige::test
