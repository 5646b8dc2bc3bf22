// SPDX-License-Identifier: Apache-2.0
// The GGX microfacet surface: density of normals, Smith's masking, sampling of visible normals
// without a pole, and the gradients for path differentials. Local frame, toPrev.z > 0.
//
//     f(prev, next) = F(prev . h) D(h) shade(prev) shade(next) / 4                    reflection
//                   = (1 - F) D shade(prev) shade(next) |prev . h| |next . h| / m^2  transmission
//     with h = +-(eta prev + next) / m,   m = |eta prev + next|,   eta = n_prev / n_next (1 and +
//     in reflection),   shade(w) = G1(w) / |w.z|,   and masking separable: G1(prev) G1(next).
//
// [Wal07] Walter, Marschner, Li, Torrance. Microfacet models for refraction through rough surfaces.
//         EGSR 2007.                                                                 the model
// [DB23]  Dupuy, Benyoub. Sampling visible GGX normals with spherical caps. HPG 2023. the sampler;
//         here with the concentric disk in place of a polar cap, whose derivative has a pole.
#pragma once
#include <vestige/brdf.h>
#include <vestige/tools/fresnel.h>
#include <vestige/tools/sampling.h>

namespace vestige {

/// Smaller widths are clamped to this one: a float cannot resolve directions inside a narrower
/// lobe.
inline constexpr Real kMinAlpha = Real(1e-4);

/// If both indices are nearly equal, the refracted direction does not depend on the facet's normal.
/// So a relative index this close to 1 is moved away from 1.
inline constexpr Real kMinIndexStep = Real(1e-3);

/// n_prev / n_next for facets.
inline Real roughEta(const ScatterPoint& p) noexcept {
  const Real n = p.behind ? p.eta() : 1 / p.eta();  // of the far side of the normal, relative
  const Real apart = n >= 1 ? std::max(n, 1 + kMinIndexStep) : std::min(n, 1 - kMinIndexStep);
  return p.behind ? apart : 1 / apart;
}

/// The component of a perpendicular to the unit vector n, by cross products because I - n n^T loses
/// the small components of a vector almost along n, and a smooth surface has no others.
inline Vec3 across(Vec3 n, Vec3 a) noexcept { return cross(cross(n, a), n); }
inline Four3 across(Vec3 n, const Four3& a) noexcept { return cross(cross(n, a), n); }

/// A drawn normal with its derivatives.
struct VisibleNormal {
  Vec3 h;       ///< unit, z >= 0, prev . h >= 0 but for rounding
  Frame prev;   ///< around toPrev
  Four3 moved;  ///< derivatives of h by u.x, by u.y, by rotating toPrev along s and t of `prev`
};

class Ggx {
 public:
  /// Widths along x and y, clamped to [kMinAlpha, 1].
  Ggx(Real alphaX, Real alphaY) noexcept
      : x_(std::clamp(alphaX, kMinAlpha, Real(1))), y_(std::clamp(alphaY, kMinAlpha, Real(1))) {}
  explicit Ggx(Real alpha) noexcept : Ggx(alpha, alpha) {}

  /// D(h), 1/sr [Wal07 Eq. 33, with two widths]. h.z >= 0.
  Real density(Vec3 h) const noexcept { return 1 / (kPi * x_ * y_ * sqr(stretched(h))); }

  /// G1(w) / |w.z| [Wal07 Eq. 34]: finite at grazing, where both factors vanish.
  Real shade(Vec3 w) const noexcept { return 2 / (std::abs(w.z) + slant(w)); }
  /// G1(w) in [0,1], the visible fraction of the facets that face w.
  Real masking(Vec3 w) const noexcept { return shade(w) * std::abs(w.z); }

  /// A normal with the density shade(prev) (prev . h) D(h), per steradian of h: unit, z >= 0,
  /// prev . h >= 0 but for rounding.
  Vec3 sampleVisible(Vec3 prev, Vec2 u) const noexcept { return draw(prev, u).h; }
  VisibleNormal sampleVisibleDerivatives(Vec3 prev, Vec2 u) const noexcept;

  /// Gradient of log D by h, across h.
  Vec3 logDensityGradient(Vec3 h) const noexcept {
    const Vec3 g = {h.x / sqr(x_), h.y / sqr(y_), h.z};
    return Real(-4) / stretched(h) * across(h, g);
  }
  /// Gradient of log shade by w.
  Vec3 logShadeGradient(Vec3 w) const noexcept {
    const Real root = slant(w);
    const Vec3 g = (1 / root) * Vec3{sqr(x_) * w.x, sqr(y_) * w.y, w.z};
    return Real(-1) / (std::abs(w.z) + root) * (g + Vec3{0, 0, std::copysign(Real(1), w.z)});
  }

 private:
  Real stretched(Vec3 h) const noexcept { return sqr(h.x / x_) + sqr(h.y / y_) + sqr(h.z); }
  Real slant(Vec3 w) const noexcept { return std::sqrt(sqr(x_ * w.x) + sqr(y_ * w.y) + sqr(w.z)); }
  Vec3 stretch(Vec3 a) const noexcept { return {x_ * a.x, y_ * a.y, a.z}; }
  Four3 stretch(const Four3& a) const noexcept { return {x_ * a.x, y_ * a.y, a.z}; }

  /// In the stretched space where the surface is a hemisphere, the normals seen by v are halfway
  /// between v and a point c of the cap z > -v.z, uniform by area [DB23 Sec. 4].
  struct Drawn {
    Disk k;
    Real q;      ///< |k|^2
    Real scale;  ///< |stretched prev|
    Vec3 v;      ///< its direction
    Real m;      ///< c = (m k, 1 - (1 + v.z) q)
    Real size;   ///< |stretched (c + v)|
    Vec3 h;
  };
  Drawn draw(Vec3 prev, Vec2 u) const noexcept {
    Drawn d;
    d.k = concentricDisk(u), d.q = std::min(dot(d.k.d, d.k.d), Real(1));
    d.scale = slant(prev), d.v = (1 / d.scale) * stretch(prev);
    const Real top = 1 + d.v.z;
    d.m = std::sqrt(std::max(top * (2 - top * d.q), Real(1e-12)));  // 0: the cap's far point
    // c + v, exact at the rim
    const Vec3 y = stretch(Vec3{d.m * d.k.d.x + d.v.x, d.m * d.k.d.y + d.v.y, top * (1 - d.q)});
    d.size = std::max(length(y), Real(1e-20));
    d.h = (1 / d.size) * y;
    return d;
  }

  Real x_, y_;
};

inline VisibleNormal Ggx::sampleVisibleDerivatives(Vec3 prev, Vec2 u) const noexcept {
  const Drawn d = draw(prev, u);
  const Frame f = Frame::around(prev);
  const Vec2 p = d.k.du[0], q = d.k.du[1];
  const Four kx = {p.x, q.x, 0, 0}, ky = {p.y, q.y, 0, 0};
  const Four3 dv = (1 / d.scale) * across(d.v, stretch(columns({}, {}, f.s, f.t)));
  const Real top = 1 + d.v.z, z = 1 - top * d.q;
  const Four dz = -d.q * dv.z - (2 * top) * (d.k.d.x * kx + d.k.d.y * ky);
  const Four dm = ((1 + z) * dv.z + top * dz) / (2 * d.m);  // m^2 = (1 + v.z) (1 + z)
  const Four3 sum = {d.m * kx + d.k.d.x * dm + dv.x, d.m * ky + d.k.d.y * dm + dv.y, dz + dv.z};
  return {d.h, f, (1 / d.size) * across(d.h, stretch(sum))};
}

/// The facet that carries prev into next, by reflection (next.z > 0) or refraction.
struct Facet {
  Vec3 h;        ///< unit, z > 0; zero vector: there is none
  Real cosPrev;  ///< prev . h, > 0
  Real cosNext;  ///< |next . h|, > 0
  Real length;   ///< |eta prev + next|, with eta = 1 in reflection
  Real eta;      ///< n_prev / n_next; 1 in reflection
  Real sign;     ///< h = sign (eta prev + next) / length

  bool exists() const noexcept { return cosPrev > 0; }
};

/// eta: n_prev / n_next of the interface, not near 1 where next.z < 0.
inline Facet facetBetween(Vec3 prev, Vec3 next, Real eta) noexcept {
  const bool reflects = next.z > 0;
  if (reflects) eta = 1;
  const Vec3 sum = eta * prev + next;
  const Real size = length(sum), sign = reflects || eta > 1 ? Real(1) : Real(-1);
  if (!(size > 0) || next.z == 0) return {};
  const Vec3 h = (sign / size) * sum;
  const Real p = dot(prev, h), n = dot(next, h);
  if (!(h.z > 0 && p > 0 && (reflects ? n > 0 : n < 0))) return {};
  return {h, p, std::abs(n), size, eta, sign};
}

/// The facets of a drawn normal, exact where facetBetween() rounds. Refraction requires that
/// reflection is not total.
inline Facet reflectingFacet(Vec3 prev, Vec3 h) noexcept {
  const Real c = dot(prev, h);
  return {h, c, c, 2 * c, 1, 1};
}
inline Facet refractingFacet(Vec3 prev, Vec3 h, Real eta) noexcept {
  const Real c = dot(prev, h), t = refractedCosine(c, eta);
  return {h, c, t, std::abs(refractedShift(c, t, eta)), eta, eta > 1 ? Real(1) : Real(-1)};
}

/// f / (F or 1 - F), 1/sr: the geometric factor of the BRDF.
inline Real facetValue(const Ggx& ggx, const Facet& f, Vec3 prev, Vec3 next) noexcept {
  const Real common = ggx.density(f.h) * ggx.shade(prev) * ggx.shade(next);
  return next.z > 0 ? common / 4 : common * (f.cosPrev / f.length) * (f.cosNext / f.length);
}

/// Density of next for h drawn by sampleVisible, 1/sr, without the chance of the lobe
/// [Wal07 Eq. 14, 17].
inline Real facetPdf(const Ggx& ggx, const Facet& f, Vec3 prev, Vec3 next) noexcept {
  const Real common = ggx.density(f.h) * ggx.shade(prev);
  return next.z > 0 ? common / 4 : common * (f.cosPrev / f.length) * (f.cosNext / f.length);
}

/// Gradients of log f by prev and next; `logF` is d(log of the Fresnel factor) / d(prev . h).
struct FacetGradient {
  Vec3 dPrev, dNext;
};
inline FacetGradient facetLogGradient(const Ggx& ggx, const Facet& f, Vec3 prev, Vec3 next,
                                      Real logF) noexcept {
  // Cosines and length depend on x = prev . next alone: cosPrev = sign (eta + x) / m,
  // next . h = sign (eta x + 1) / m, m^2 = 1 + eta^2 + 2 eta x.
  const Real m = f.length, m2 = m * m, n = next.z > 0 ? f.cosNext : -f.cosNext;
  const Real dPrevCos = (f.sign - f.eta * f.cosPrev / m) / m;
  const Real dNextCos = f.eta * (f.sign - n / m) / m;
  Real k = logF * dPrevCos;
  if (next.z < 0) k += dPrevCos / f.cosPrev + dNextCos / n - 2 * f.eta / m2;
  const Vec3 d = (f.sign / m) * ggx.logDensityGradient(f.h);
  return {k * next + f.eta * d + ggx.logShadeGradient(prev),
          k * prev + d + ggx.logShadeGradient(next)};
}

/// Derivatives of a direction reflected or refracted at a drawn normal.
inline ScatterJacobian leavingDerivatives(const Deflection& t, const VisibleNormal& n) noexcept {
  return scatterJacobian(n.prev, t.moved(columns({}, {}, n.prev.s, n.prev.t), n.moved));
}

}  // namespace vestige
