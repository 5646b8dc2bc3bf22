// SPDX-License-Identifier: Apache-2.0
// Metal, plastic, paint and coloured glass from a few parameters, as in glTF.
//
//     f = metallic           M
//       + (1 - metallic) (1 - transmission) (S + B)
//       + (1 - metallic) transmission       (S' + T)
//
//   M     GGX reflection, Schlick's Fresnel from base_color at normal incidence to white at grazing
//   S, S' GGX reflection, F = specular * dielectric Fresnel of `ior`; S seen from outside always,
//   S'
//         from whichever side of a solid
//   B base_color / pi (1 - F(prev.z)) (1 - F(next.z)): light that passed the surface twice T GGX
//   refraction, (1 - F) base_color
//
// A convex sum of models that each conserve energy and are reciprocal. glTF's own B, base_color /
// pi (1 - F(prev . h)), gives more than it gets at grazing angles, so B has the separable form of
// [AS00], without its constant: where the surface is smooth that would gain.
//
// [KHR]   Khronos. glTF 2.0 specification, appendix B; KHR_materials_{ior,specular,transmission}.
// [AS00]  Ashikhmin, Shirley. An anisotropic Phong BRDF model. JGT 5(2), 2000.
// [Wal07] Walter et al. Microfacet models for refraction through rough surfaces. EGSR 2007.
#include <vestige/brdf.h>
#include <vestige/plugin.h>
#include <vestige/tools/microfacet.h>

namespace vestige {
namespace {

class Principled final : public Brdf {
 public:
  enum Input { kBaseColor, kMetallic, kRoughness, kSpecular, kTransmission, kIor };
  enum Lobe { kDiffuse, kReflected, kRefracted };

  static Schema schema() {
    return {
        .kind = "brdf",
        .name = "principled",
        .summary = "metal, plastic, paint and glass from a few numbers, as in glTF",
        .inputs = {rgb("base_color", 0.8).range(0, 1).doc("of the diffuse part, metal or glass"),
                   real("metallic", 0).range(0, 1).doc("0 plastic, paint or glass; 1 metal"),
                   real("roughness", 0.5).range(0, 1).doc("square root of the GGX width"),
                   real("specular", 1).range(0, 1).doc("scales the reflection of non-metals"),
                   real("transmission", 0).range(0, 1).doc("0 opaque, 1 clear (or ground) glass"),
                   real("ior", 1.5)
                       .range(0.1, 10)
                       .refractiveIndex()
                       .doc("refractive index of the inside")}};
  }

  ScatterValue evaluate(const ScatterPoint& p, Vec3 toNext) const noexcept override {
    const Model m(p);
    return m.value(facetBetween(p.toPrev, toNext, m.eta), toNext);
  }

  std::optional<ScatterSample> sample(const ScatterPoint& p,
                                      ScatterNumbers n) const noexcept override {
    const Model m(p);
    const Drawn d = draw(m, n);
    const Real density = m.lobePdf(d);
    const bool rightSide = d.lobe == kRefracted ? d.toNext.z < 0 : d.toNext.z > 0;
    if (!(rightSide && d.chance * density > 0)) return std::nullopt;
    // Weight by one facet, so that narrow lobes cancel exactly; a diffuse direction has its own
    // half vector.
    const Facet f = d.lobe == kDiffuse ? facetBetween(p.toPrev, d.toNext, m.eta) : d.facet;
    const ScatterValue value = m.value(f, d.toNext);
    return ScatterSample{.toNext = d.toNext,
                         .weight = value.fCos / value.pdf,
                         .pdf = value.pdf,
                         .lobePdf = density,
                         .lobeChance = d.chance,
                         .lobe = d.lobe,
                         .specular = false};
  }

  ScatterJacobian sampleDerivatives(const ScatterPoint& p,
                                    ScatterNumbers n) const noexcept override {
    const Model m(p);
    if (n.lobe < m.diffuseChance) return {.du = cosineHemisphere(n.u).du, .dPrev = {}};
    const VisibleNormal v = m.ggx.sampleVisibleDerivatives(m.prev, n.u);
    const Choice facet = choose(m, v.h, n.lobe);
    return leavingDerivatives(
        facet.lobe == kReflected ? reflectAt(m.prev, v.h) : refractAt(m.prev, v.h, m.eta), v);
  }

  LogGradient logGradient(const ScatterPoint& p, Vec3 toNext) const noexcept override {
    const Model m(p);
    const Facet f = facetBetween(p.toPrev, toNext, m.eta);
    const Diffuse d = m.diffuse(toNext.z);
    const Real diffuse = luminance(d.value);
    Real facets = 0;
    FacetGradient g = {};
    if (f.exists()) {
      const Tint t = m.share(f, toNext);
      const Real fresnel = luminance(t.value);
      facets = facetValue(m.ggx, f, p.toPrev, toNext) * fresnel;
      if (fresnel > 0)
        g = facetLogGradient(m.ggx, f, p.toPrev, toNext, luminance(t.slope) / fresnel);
    }
    if (!(diffuse + facets > 0)) return {};
    const Real a = diffuse / (diffuse + facets), b = facets / (diffuse + facets);
    return {a * Vec3{0, 0, d.byPrev} + b * g.dPrev, a * Vec3{0, 0, d.byNext} + b * g.dNext};
  }

  /// B's directional albedo. Over the hemisphere f cos is a mean over cos^2: Gauss and Legendre's
  /// rule of three nodes.
  DiffusePart diffuse(const ScatterPoint& p) const noexcept override {
    const Model m(p);
    return {kPi / 18 *
            (5 * m.diffuse(Real(0.335711)).value + 8 * m.diffuse(Real(0.707107)).value +
             5 * m.diffuse(Real(0.941965)).value)};
  }

  Real etaScale(const ScatterPoint& p, Vec3 toNext) const noexcept override {
    return toNext.z < 0 ? sqr(roughEta(p)) : 1;
  }

 private:
  /// A share of each channel that is reflected or refracted by a facet, and its derivative by prev
  /// . h.
  struct Tint {
    Rgb value, slope;
  };
  /// f of the diffuse part, 1/sr, and d(log f) by prev.z and by next.z.
  struct Diffuse {
    Rgb value;
    Real byPrev, byNext;
  };
  struct Chances {
    Real reflect = 0, refract = 0;
  };
  /// A direction chosen by the random numbers, before the test whether it leaves on the right side.
  struct Drawn {
    Lobe lobe;
    Real chance;
    Vec3 toNext;
    Facet facet;  ///< unless diffuse
  };

  /// The inputs at one point, in the terms of the formula above.
  struct Model {
    Vec3 prev;
    Ggx ggx;
    Real eta, etaOutside;  ///< n_prev / n_next: as it is, and as if prev were outside
    Rgb base;
    Real specular;
    Real metal, opaque, clear;  ///< weights, sum 1
    Real diffuseChance;

    explicit Model(const ScatterPoint& p) noexcept
        : prev(p.toPrev),
          ggx(sqr(p.inputs.real(kRoughness))),
          eta(roughEta(p)),
          etaOutside(p.behind ? 1 / eta : eta),
          base(p.inputs.rgb(kBaseColor)),
          specular(unit(p.inputs.real(kSpecular))),
          metal(unit(p.inputs.real(kMetallic))),
          opaque((1 - metal) * (1 - unit(p.inputs.real(kTransmission)))),
          clear((1 - metal) * unit(p.inputs.real(kTransmission))) {
      // By energy at normal facets, but never below a tenth: facets may be hit at other angles.
      const Real d = kPi * luminance(diffuse(1).value);
      const Real s = luminance(reflected(prev.z).value) +
                     luminance(refracted(prev.z, refractedCosine(prev.z, eta)).value);
      diffuseChance = d > 0 ? std::clamp(d / (d + s), Real(0.1), s > 0 ? Real(0.9) : Real(1)) : 0;
    }

    /// A texture may hold any number.
    static Real unit(Real x) noexcept { return std::clamp(x, Real(0), Real(1)); }

    /// Reflectance and transmittance of a dielectric facet, by both cosines; t < 0 where reflection
    /// is total.
    Fresnel stopped(Real c, Real t, Real eta) const noexcept {
      const Fresnel f = t < 0 ? Fresnel{1, 0} : fresnelReflected(c, t, eta);
      return {specular * f.value, specular * f.slope};
    }
    Fresnel passed(Real c, Real t, Real eta) const noexcept {
      const Fresnel f = t < 0 ? Fresnel{0, 0} : fresnelTransmitted(c, t, eta);
      return {1 - specular + specular * f.value, specular * f.slope};
    }

    Diffuse diffuse(Real nextZ) const noexcept {
      if (!(nextZ > 0) || isBlack(base)) return {};
      const Fresnel in = passed(prev.z, refractedCosine(prev.z, etaOutside), etaOutside);
      const Fresnel out = passed(nextZ, refractedCosine(nextZ, etaOutside), etaOutside);
      if (!(in.value * out.value > 0)) return {};
      return {opaque * in.value * out.value / kPi * base, in.slope / in.value,
              out.slope / out.value};
    }
    Tint reflected(Real c) const noexcept {
      const Fresnel out = stopped(c, refractedCosine(c, etaOutside), etaOutside);
      const Fresnel any = stopped(c, refractedCosine(c, eta), eta);
      const Rgb f = grey(opaque * out.value + clear * any.value);
      const Rgb slope = grey(opaque * out.slope + clear * any.slope);
      const Fresnel r = fresnelSchlick(c, base.r), g = fresnelSchlick(c, base.g),
                    b = fresnelSchlick(c, base.b);
      return {f + metal * Rgb{r.value, g.value, b.value},
              slope + metal * Rgb{r.slope, g.slope, b.slope}};
    }
    Tint refracted(Real c, Real t) const noexcept {
      if (t < 0) return {};
      const Fresnel f = passed(c, t, eta);
      return {clear * f.value * base, clear * f.slope * base};
    }
    Tint share(const Facet& f, Vec3 toNext) const noexcept {
      return toNext.z > 0 ? reflected(f.cosPrev) : refracted(f.cosPrev, f.cosNext);
    }

    /// Probabilities of reflection and refraction at a facet, at cosine c; both 0 where it absorbs
    /// all light.
    Chances chances(Real c) const noexcept {
      const Real r = luminance(reflected(c).value);
      const Real t = luminance(refracted(c, refractedCosine(c, eta)).value);
      return r + t > 0 ? Chances{r / (r + t), t / (r + t)} : Chances{};
    }
    Real lobePdf(const Drawn& d) const noexcept {
      if (d.lobe == kDiffuse) return d.toNext.z / kPi;
      return d.facet.exists() ? facetPdf(ggx, d.facet, prev, d.toNext) : 0;
    }
    ScatterValue value(const Facet& f, Vec3 toNext) const noexcept {
      Rgb value = diffuse(toNext.z).value;
      if (f.exists()) value += facetValue(ggx, f, prev, toNext) * share(f, toNext).value;
      return {std::abs(toNext.z) * value, pdf(f, toNext)};
    }
    Real pdf(const Facet& f, Vec3 toNext) const noexcept {
      Real sum = diffuseChance * std::max(toNext.z, Real(0)) / kPi;
      if (!f.exists()) return sum;
      const Chances chance = chances(f.cosPrev);
      sum += (1 - diffuseChance) * (toNext.z > 0 ? chance.reflect : chance.refract) *
             facetPdf(ggx, f, prev, toNext);
      return sum;
    }
  };

  /// Reflection or refraction at a facet, with its probability among facets.
  struct Choice {
    Lobe lobe;
    Real chance;  ///< 0: it absorbs
  };

  /// Chosen by the rescaled random number that chose facets.
  static Choice choose(const Model& m, Vec3 h, Real lobe) noexcept {
    const Real rest = (lobe - m.diffuseChance) / (1 - m.diffuseChance);
    const Chances chance = m.chances(std::max(dot(m.prev, h), Real(0)));
    if (rest < chance.reflect) return {kReflected, chance.reflect};
    return {kRefracted, chance.refract};
  }

  /// `lobe` picks the diffuse lobe or facets; u the direction or the facet's normal. Chance 0:
  /// absorbed.
  static Drawn draw(const Model& m, ScatterNumbers n) noexcept {
    if (n.lobe < m.diffuseChance) return {kDiffuse, m.diffuseChance, cosineHemisphere(n.u).d, {}};
    const Vec3 h = m.ggx.sampleVisible(m.prev, n.u);
    const Choice facet = choose(m, h, n.lobe);
    const Real chance = (1 - m.diffuseChance) * facet.chance;
    if (facet.lobe == kReflected)
      return {kReflected, chance, reflectAt(m.prev, h).direction, reflectingFacet(m.prev, h)};
    if (!(chance > 0)) return {};
    return {kRefracted, chance, refractAt(m.prev, h, m.eta).direction,
            refractingFacet(m.prev, h, m.eta)};
  }
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Brdf, vestige::Principled)
