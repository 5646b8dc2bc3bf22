// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vestige/inputs.h>
#include <vestige/math.h>
#include <optional>

/// Scattering at one surface point: the whole contract between a BRDF plugin and the engine. The
/// word BRDF covers transmission here, as in the method's paper: f is defined for both sides.
///
/// Conventions of every method below:
///   * Directions are unit vectors in the local shading frame and leave the surface. The frame
///     faces the known direction: toPrev.z > 0 always; toNext.z < 0 is the far side. The engine
///     bends a shading normal that looks away, and discards a toNext for which the geometric and
///     the shading normal disagree about the side (in evaluate() and sample() alike).
///   * `toPrev` is the known direction, `toNext` the sampled one; neither means eye or light. f is
///     defined for FLUX travelling prev -> next: without the 1/eta^2 of radiance. The engine
///     applies etaScale() on eye paths and the shading-normal correction on particle paths.
///   * Densities are per steradian of solid angle (1/sr). Colours are linear, in rendering space.
///   * A BRDF never evaluates a texture. It declares inputs in its schema; `inputs` holds their
///     values, filtered over the path's footprint.
///   * The engine supplies both refractive indices. The footprint module adds how the frame turns
///     on a curved surface.
///   * Methods are const, thread-safe and noexcept; they allocate nothing. "No sample" is an
///     ordinary value, not an error. The schema has already refused unsuitable parameters.
namespace vestige {

/// The point as a BRDF sees it.
struct ScatterPoint {
  Vec3 toPrev;          ///< unit, local, z > 0
  bool behind = false;  ///< toPrev runs behind the surface's own normal: inside, if it is a solid
  Real etaPrev = 1;     ///< refractive index on toPrev's side, >= 0.1: that of air, of the solid
                        ///< that the surface bounds, or of another one around it
  Real etaNext = 1;     ///< ... and beyond the surface. The same unless the schema has an input
                        ///< marked .refractiveIndex()
  Inputs inputs = {};   ///< in the order of the schema

  /// n_prev / n_next.
  Real eta() const noexcept { return etaPrev / etaNext; }
};

/// Random numbers for one sampled direction. `lobe` only chooses among lobes (no derivative is
/// taken by it); the direction is a smooth function of `u`.
struct ScatterNumbers {
  Real lobe;  ///< [0,1)
  Vec2 u;     ///< [0,1)^2
};

/// Scattering between two given directions. Phase functions and hair use the same struct with the
/// cosine of their own measure (1 for phase functions).
struct ScatterValue {
  Rgb fCos;      ///< f |cos toNext|, 1/sr, finite, >= 0, without etaScale
  Real pdf = 0;  ///< density of sample() at toNext, 1/sr
};

struct ScatterSample {
  Vec3 toNext;      ///< unit, local
  Rgb weight;       ///< f |cos| / pdf, dimensionless, finite, >= 0, without etaScale
  Real pdf;         ///< 1/sr, > 0, of the whole BRDF at toNext; unused if specular
  Real lobePdf;     ///< 1/sr, of the drawn lobe alone
  Real lobeChance;  ///< (0,1], probability of drawing this lobe; 1 if sample() always draws it
  int lobe;         ///< index of the lobe drawn; finite differences stay within one lobe
  bool specular;    ///< no new random variable (mirror, smooth glass); then weight = f |cos| /
                    ///< lobeChance

  /// A sample of a BRDF with a single lobe.
  static ScatterSample only(Vec3 toNext, Rgb weight, Real pdf) noexcept {
    return {toNext, weight, pdf, pdf, 1, 0, false};
  }
  /// A sample of one specular lobe; `energy` is f |cos|, not yet divided by the chance.
  static ScatterSample mirror(Vec3 toNext, Rgb energy, Real lobeChance = 1, int lobe = 0) noexcept {
    return {toNext, energy / lobeChance, 1, 1, lobeChance, lobe, true};
  }
};

/// First derivatives of the sampled direction at fixed lobe. A differential is propagated by
///   d(toNext) = du d(u) + dPrev d(toPrev),   all local.
struct ScatterJacobian {
  Mat3x2 du;   ///< [3 x 2], per unit of random number; zero if specular
  Mat3 dPrev;  ///< [3 x 3], per radian of toPrev; applied to tangents of toPrev only
};

/// The Jacobian from four derivatives: by u.x, by u.y, and by rotating toPrev along s and t of a
/// frame around it.
inline ScatterJacobian scatterJacobian(const Frame& toPrev, const Four3& d) noexcept {
  return {.du = {column(d, 0), column(d, 1)},
          .dPrev = outer(column(d, 2), toPrev.s) + outer(column(d, 3), toPrev.t)};
}

/// Gradient of log f (luminance of f, without the cosine): the relative change of the contribution,
/// 1/rad [PD01 Eq. 12].
struct LogGradient {
  Vec3 dPrev, dNext;  ///< [3] each
};

/// The diffuse part of f, constant over the hemisphere of toPrev: albedo / pi.
struct DiffusePart {
  Rgb albedo;          ///< [0, 1]; black: there is none
  bool isAll = false;  ///< nothing else is scattered
};

class Brdf {
 public:
  virtual ~Brdf() = default;

  /// f |cos toNext| and the density of sample() at toNext. Both are zero where the BRDF scatters
  /// nothing, or scatters by a specular lobe only. The density integrates over the sphere to 1 -
  /// P(nullopt or specular).
  virtual ScatterValue evaluate(const ScatterPoint& p, Vec3 toNext) const noexcept = 0;

  /// Draws toNext; nullopt where the model absorbs. The derivative of this map is needed too, so
  /// the map from u must not have a pole where pdf > 0: prefer the concentric to the polar disk.
  virtual std::optional<ScatterSample> sample(const ScatterPoint& p,
                                              ScatterNumbers n) const noexcept = 0;

  /// Derivatives of the map inside sample(), for the numbers that it was called with [PD01 2.3].
  /// Every lobe that is not specular has |du.c0 x du.c1| lobePdf = 1. By default: finite
  /// differences of sample(), some forty calls of it, and a note to the user.
  virtual ScatterJacobian sampleDerivatives(const ScatterPoint& p, ScatterNumbers n) const noexcept;

  /// Gradient of log f for any toNext, sampled or chosen by a light [PD01 Sec. 3.2]. Zero where f
  /// is zero. By default: finite differences of evaluate(), and a note to the user.
  virtual LogGradient logGradient(const ScatterPoint& p, Vec3 toNext) const noexcept;

  /// The diffuse part of f. Integrators that store irradiance on surfaces store the light for this
  /// part and trace rays for f - albedo / pi (which may be slightly negative).
  virtual DiffusePart diffuse(const ScatterPoint&) const noexcept { return {}; }

  /// Radiance that crosses an interface is scaled by (n_prev / n_next)^2, flux is not [Vea97 5.2].
  /// 1 where toNext stays on its side. Reciprocity then reads f(b, a) = etaScale(a, b) f(a, b).
  virtual Real etaScale(const ScatterPoint& p, Vec3 toNext) const noexcept {
    return toNext.z < 0 ? sqr(p.eta()) : 1;
  }

  /// Whether sample() depends on ScatterNumbers::lobe. False, if there is one lobe, saves
  /// integrators a random number; they pass 0 then.
  virtual bool usesLobeNumber() const noexcept { return true; }

  /// f(toPrev, toNext) alone, 1/sr, from evaluate(): for tests and tools. Zero at toNext.z = 0.
  Rgb f(const ScatterPoint& p, Vec3 toNext) const noexcept {
    return toNext.z != 0 ? evaluate(p, toNext).fCos / std::abs(toNext.z) : Rgb{};
  }
  /// The density alone, 1/sr.
  Real pdf(const ScatterPoint& p, Vec3 toNext) const noexcept { return evaluate(p, toNext).pdf; }
};

}  // namespace vestige

#include <vestige/brdf_differences.h>  // the two defaults
