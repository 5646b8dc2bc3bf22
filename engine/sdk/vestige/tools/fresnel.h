// SPDX-License-Identifier: Apache-2.0
// Fresnel reflectance and the reflected and refracted directions of a smooth facet, with their
// derivatives. For whole surfaces (glass, phong) and for microfacets.
//
// Throughout: `prev` and the results are unit vectors that leave the facet; `normal` is a unit
// vector on prev's side; eta = n_prev / n_next, the quotient of the refractive indices;
// c = prev . normal in [0,1].
//
// [BW99]  Born, Wolf. Principles of optics, 7th ed. 1999. 1.5 (dielectrics), 14.2 (metals)
// [Sch94] Schlick. An inexpensive BRDF model for physically based rendering. Eurographics 1994.
// [Ige99] Igehy. Tracing ray differentials. SIGGRAPH 1999.             derivatives of directions
#pragma once
#include <vestige/math.h>

namespace vestige {

/// A reflected (or transmitted) fraction of unpolarised light, in [0,1], and its derivative by c.
struct Fresnel {
  Real value, slope;
};

/// Near total reflection the derivative of the refracted direction has no bound; derivatives clamp
/// the cosine to this value.
inline constexpr Real kMinRefractedCosine = Real(1e-4);

/// Cosine on the far side; negative where reflection is total.
inline Real refractedCosine(Real c, Real eta) noexcept {
  // 1 - eta^2 (1 - c^2), in the form that is exact for eta = 1 however small c is.
  const Real k = (1 - eta) * (1 + eta) + sqr(eta * c);
  return k >= 0 ? std::sqrt(k) : Real(-1);
}

/// eta c - t for the refracted cosine t, in a form that keeps its digits near eta = 1. The
/// refracted direction is this times the normal, minus eta prev.
inline Real refractedShift(Real c, Real t, Real eta) noexcept {
  return (eta - 1) * (eta + 1) / std::max(eta * c + t, Real(1e-30));
}

/// Reflectance between two dielectrics, by both cosines: t = refractedCosine(c, eta) >= 0 [BW99
/// 1.5.2].
inline Fresnel fresnelReflected(Real c, Real t, Real eta) noexcept {
  const Real s = std::max(eta * c + t, Real(1e-20)), p = std::max(c + eta * t, Real(1e-20));
  const Real rs = (eta * c - t) / s, rp = (c - eta * t) / p;
  const Real dt = eta * eta * c / std::max(t, kMinRefractedCosine);
  const Real q = 2 * eta * (t - c * dt);
  return {std::min(Real(0.5) * (rs * rs + rp * rp), Real(1)), rs * q / (s * s) + rp * q / (p * p)};
}

/// Transmittance 1 - F, in a form that keeps its digits near total reflection.
inline Fresnel fresnelTransmitted(Real c, Real t, Real eta) noexcept {
  const Real s = std::max(eta * c + t, Real(1e-20)), p = std::max(c + eta * t, Real(1e-20));
  const Real value = 2 * eta * (c / s * (t / s) + c / p * (t / p));
  return {std::min(value, Real(1)), -fresnelReflected(c, t, eta).slope};
}

/// F by the incident cosine; 1 where reflection is total.
inline Fresnel fresnelDielectric(Real c, Real eta) noexcept {
  const Real t = refractedCosine(c, eta);
  return t < 0 ? Fresnel{1, 0} : fresnelReflected(c, t, eta);
}

/// Reflectance of a metal in vacuum with refractive index n + i k, both >= 0 [BW99 14.2].
inline Fresnel fresnelConductor(Real c, Real n, Real k) noexcept {
  const Real c2 = c * c, s2 = 1 - c2;
  // a + i b is the far side's normal wave number: (a + i b)^2 = (n + i k)^2 - s2; m = a^2 + b^2.
  const Real real = n * n - k * k - s2, m = std::hypot(real, 2 * n * k);
  const Real a = safeSqrt((m + real) / 2);
  const Real dm = m > 0 ? 2 * c * real / m : 0, da = (dm + 2 * c) / (4 * std::max(a, Real(1e-6)));
  // Each polarisation reflects (x - y) / (x + y); s first, p relative to s.
  struct Quotient {
    Real value, slope;
  };
  const auto quotient = [](Real x, Real dx, Real y, Real dy) {
    const Real sum = std::max(x + y, Real(1e-20));
    return Quotient{(x - y) / sum, 2 * (dx * y - x * dy) / (sum * sum)};
  };
  const Real y = 2 * a * c, dy = 2 * (a + c * da);
  const Quotient s = quotient(m + c2, dm + 2 * c, y, dy);
  const Quotient p = quotient(c2 * m + s2 * s2, 2 * c * m + c2 * dm - 4 * c * s2,  //
                              y * s2, dy * s2 - 2 * c * y);
  const Real value = Real(0.5) * s.value * (1 + p.value);
  const Real slope = Real(0.5) * (s.slope * (1 + p.value) + s.value * p.slope);
  return {std::clamp(value, Real(0), Real(1)), slope};
}

/// Schlick's reflectance: f0 at normal incidence, 1 at grazing [Sch94 Eq. 24].
inline Fresnel fresnelSchlick(Real c, Real f0) noexcept {
  const Real x = 1 - std::min(c, Real(1)), x2 = x * x;
  return {f0 + (1 - f0) * x2 * x2 * x, -5 * (1 - f0) * x2 * x2};
}

/// A reflected or refracted direction, mu normal - eta prev, with its derivatives by normal and
/// prev: mu is a function of prev . normal alone.
struct Deflection {
  Vec3 direction;
  Vec3 prev, normal;
  Real mu, slope, eta;  ///< slope: d(mu) / d(prev . normal)

  /// Derivatives for four tangents of both unit vectors at once.
  Four3 moved(const Four3& dPrev, const Four3& dNormal) const noexcept {
    const Four c = slope * (dot(normal, dPrev) + dot(prev, dNormal));
    return {c * normal.x + mu * dNormal.x - eta * dPrev.x,
            c * normal.y + mu * dNormal.y - eta * dPrev.y,
            c * normal.z + mu * dNormal.z - eta * dPrev.z};
  }
  /// Derivative by prev at a fixed normal.
  Mat3 dPrev() const noexcept { return slope * outer(normal, normal) - eta * identity(); }
};

/// Mirror direction [Ige99 Eq. 14].
inline Deflection reflectAt(Vec3 prev, Vec3 normal) noexcept {
  const Real mu = 2 * dot(prev, normal);
  return {mu * normal - prev, prev, normal, mu, 2, 1};
}

/// Refracted direction [Ige99 Eq. 16]. Only where reflection is not total.
inline Deflection refractAt(Vec3 prev, Vec3 normal, Real eta) noexcept {
  const Real c = dot(prev, normal), t = refractedCosine(c, eta);
  const Real mu = refractedShift(c, t, eta);
  const Real slope = -eta * mu / std::max(t, kMinRefractedCosine);
  return {mu * normal - eta * prev, prev, normal, mu, slope, eta};
}

}  // namespace vestige
