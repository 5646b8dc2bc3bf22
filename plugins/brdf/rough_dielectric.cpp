// SPDX-License-Identifier: Apache-2.0
// Ground glass: GGX microfacets that each reflect and refract by Fresnel's law. A single scattering
// is followed, so rough surfaces lose a few percent.
//
//     f(prev, next) = F D G1 G1 / (4 prev.z next.z)                             reflection
//                   = (1 - F) |prev . h| |next . h| D G1 G1
//                     / (prev.z |next.z| (eta prev . h + next . h)^2)           transmission
//
// for flux; eta = n_prev / n_next. A normal is drawn from u, then its own Fresnel factor decides
// which lobe `lobe` picks.
//
// [Wal07] Walter et al. Microfacet models for refraction through rough surfaces. EGSR 2007. Eq. 20,
//         21 (there for radiance from next to prev: the same function, since n_next is its n_o)
#include <vestige/brdf.h>
#include <vestige/plugin.h>
#include <vestige/tools/microfacet.h>

namespace vestige {
namespace {

class RoughDielectric final : public Brdf {
 public:
  enum Input { kAlpha, kIor };
  enum Lobe { kReflected, kRefracted };

  static Schema schema() {
    return {.kind = "brdf",
            .name = "rough_dielectric",
            .summary = "clear solid with GGX roughness: reflects and refracts",
            .inputs = {real("alpha", 0.1).range(0, 1).doc("GGX width: 0.01 clear, 0.5 frosted"),
                       real("ior", 1.5)
                           .range(0.1, 10)
                           .refractiveIndex()
                           .doc("refractive index of the inside")}};
  }

  ScatterValue evaluate(const ScatterPoint& p, Vec3 toNext) const noexcept override {
    const Facet f = facetBetween(p.toPrev, toNext, eta(p));
    if (!f.exists()) return {};
    const Ggx surface = ggx(p);
    const Real part = share(f, p, toNext).value, z = std::abs(toNext.z);
    return {grey(part * z * facetValue(surface, f, p.toPrev, toNext)),
            part * facetPdf(surface, f, p.toPrev, toNext)};
  }

  std::optional<ScatterSample> sample(const ScatterPoint& p,
                                      ScatterNumbers n) const noexcept override {
    const Ggx surface = ggx(p);
    const Vec3 h = surface.sampleVisible(p.toPrev, n.u);
    const Choice choice = choose(p, h, n.lobe);
    const Vec3 toNext = bend(p, h, choice.reflects).direction;
    const Facet f =
        choice.reflects ? reflectingFacet(p.toPrev, h) : refractingFacet(p.toPrev, h, eta(p));
    const Real density = facetPdf(surface, f, p.toPrev, toNext);
    const bool rightSide = choice.reflects ? toNext.z > 0 : toNext.z < 0;
    if (!(rightSide && f.exists() && density * choice.chance > 0)) return std::nullopt;
    return ScatterSample{.toNext = toNext,
                         .weight = grey(surface.masking(toNext)),
                         .pdf = density * choice.chance,
                         .lobePdf = density,
                         .lobeChance = choice.chance,
                         .lobe = choice.reflects ? kReflected : kRefracted,
                         .specular = false};
  }

  ScatterJacobian sampleDerivatives(const ScatterPoint& p,
                                    ScatterNumbers n) const noexcept override {
    const VisibleNormal v = ggx(p).sampleVisibleDerivatives(p.toPrev, n.u);
    return leavingDerivatives(bend(p, v.h, choose(p, v.h, n.lobe).reflects), v);
  }

  LogGradient logGradient(const ScatterPoint& p, Vec3 toNext) const noexcept override {
    const Facet f = facetBetween(p.toPrev, toNext, eta(p));
    if (!f.exists()) return {};
    const Fresnel part = share(f, p, toNext);
    if (!(part.value > 0)) return {};
    const FacetGradient g = facetLogGradient(ggx(p), f, p.toPrev, toNext, part.slope / part.value);
    return {g.dPrev, g.dNext};
  }

  Real etaScale(const ScatterPoint& p, Vec3 toNext) const noexcept override {
    return toNext.z < 0 ? sqr(eta(p)) : 1;  // the index used for facets
  }

 private:
  struct Choice {
    bool reflects;
    Real chance;  ///< probability of the chosen lobe
  };

  static Ggx ggx(const ScatterPoint& p) noexcept { return Ggx(p.inputs.real(kAlpha)); }
  static Real eta(const ScatterPoint& p) noexcept { return roughEta(p); }

  static Choice choose(const ScatterPoint& p, Vec3 h, Real lobe) noexcept {
    const Real f = fresnelDielectric(std::max(dot(p.toPrev, h), Real(0)), eta(p)).value;
    return lobe < f ? Choice{true, f} : Choice{false, 1 - f};
  }

  static Deflection bend(const ScatterPoint& p, Vec3 h, bool reflects) noexcept {
    return reflects ? reflectAt(p.toPrev, h) : refractAt(p.toPrev, h, eta(p));
  }

  /// F or 1 - F at the facet, and its derivative by prev . h.
  static Fresnel share(const Facet& f, const ScatterPoint& p, Vec3 toNext) noexcept {
    return toNext.z > 0 ? fresnelDielectric(f.cosPrev, eta(p))
                        : fresnelTransmitted(f.cosPrev, f.cosNext, eta(p));
  }
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Brdf, vestige::RoughDielectric)
