// SPDX-License-Identifier: Apache-2.0
// Brushed or polished metal: GGX microfacets that each reflect by Fresnel's law for metals, seen
// once (light that bounces between facets is lost, a few percent for rough ones), from either side.
//
//     f(prev, next) = F(prev . h) D(h) G1(prev) G1(next) / (4 prev.z next.z)
//
// [Wal07] Walter et al. Microfacet models for refraction through rough surfaces. EGSR 2007. Eq. 20
// [Bur12] Burley. Physically based shading at Disney. SIGGRAPH course, 2012.         `anisotropy`
#include <vestige/brdf.h>
#include <vestige/plugin.h>
#include <vestige/tools/microfacet.h>

namespace vestige {
namespace {

class RoughConductor final : public Brdf {
 public:
  enum Input { kAlpha, kAnisotropy, kEta, kK, kSpecular };

  static Schema schema() {
    return {
        .kind = "brdf",
        .name = "rough_conductor",
        .summary = "metal with GGX roughness",
        .inputs = {real("alpha", 0.1).range(0, 1).doc("GGX width: 0.01 polished, 1 rough"),
                   real("anisotropy", 0).range(0, 1).doc("0 round, 1 brushed along u"),
                   rgb("eta", 0).range(0, 100).nonlinear().doc("real part of the refractive index"),
                   rgb("k", 0).range(0, 100).nonlinear().doc("imaginary part; gold 3.98 2.39 1.60"),
                   rgb("specular", 1)
                       .range(0, 1)
                       .doc("reflected fraction at normal incidence, where eta and k are 0")}};
  }

  ScatterValue evaluate(const ScatterPoint& p, Vec3 toNext) const noexcept override {
    const Facet f = facet(p, toNext);
    if (!f.exists()) return {};
    const Ggx surface = ggx(p);
    return {toNext.z * facetValue(surface, f, p.toPrev, toNext) * reflected(p, f.cosPrev).value,
            facetPdf(surface, f, p.toPrev, toNext)};
  }

  std::optional<ScatterSample> sample(const ScatterPoint& p,
                                      ScatterNumbers n) const noexcept override {
    const Ggx surface = ggx(p);
    const Vec3 h = surface.sampleVisible(p.toPrev, n.u);
    const Vec3 toNext = reflectAt(p.toPrev, h).direction;
    const Facet f = reflectingFacet(p.toPrev, h);
    const Real density = facetPdf(surface, f, p.toPrev, toNext);
    if (!(toNext.z > 0 && f.exists() && density > 0)) return std::nullopt;
    return ScatterSample::only(toNext, surface.masking(toNext) * reflected(p, f.cosPrev).value,
                               density);
  }

  bool usesLobeNumber() const noexcept override { return false; }

  ScatterJacobian sampleDerivatives(const ScatterPoint& p,
                                    ScatterNumbers n) const noexcept override {
    const VisibleNormal v = ggx(p).sampleVisibleDerivatives(p.toPrev, n.u);
    return leavingDerivatives(reflectAt(p.toPrev, v.h), v);
  }

  LogGradient logGradient(const ScatterPoint& p, Vec3 toNext) const noexcept override {
    const Facet f = facet(p, toNext);
    if (!f.exists()) return {};
    const Tint tint = reflected(p, f.cosPrev);
    const Real fresnel = luminance(tint.value);
    if (!(fresnel > 0)) return {};
    const FacetGradient g =
        facetLogGradient(ggx(p), f, p.toPrev, toNext, luminance(tint.slope) / fresnel);
    return {g.dPrev, g.dNext};
  }

 private:
  /// Reflected fraction of each channel and its derivative by the cosine.
  struct Tint {
    Rgb value, slope;
  };

  static Ggx ggx(const ScatterPoint& p) noexcept {
    const Real anisotropy = std::clamp(p.inputs.real(kAnisotropy), Real(0), Real(1));
    const Real aspect = std::sqrt(1 - Real(0.9) * anisotropy);  // [Bur12 5.4]
    const Real alpha = p.inputs.real(kAlpha);
    return {alpha / aspect, alpha * aspect};
  }

  static Facet facet(const ScatterPoint& p, Vec3 toNext) noexcept {
    return toNext.z > 0 ? facetBetween(p.toPrev, toNext, 1) : Facet{};
  }

  static Tint reflected(const ScatterPoint& p, Real c) noexcept {
    const Rgb n = p.inputs.rgb(kEta), k = p.inputs.rgb(kK), f0 = p.inputs.rgb(kSpecular);
    const bool measured = !isBlack(n) || !isBlack(k);
    const auto channel = [&](Real n, Real k, Real f0) {
      return measured ? fresnelConductor(c, n, k) : fresnelSchlick(c, f0);
    };
    const Fresnel r = channel(n.r, k.r, f0.r), g = channel(n.g, k.g, f0.g),
                  b = channel(n.b, k.b, f0.b);
    return {{r.value, g.value, b.value}, {r.slope, g.slope, b.slope}};
  }
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Brdf, vestige::RoughConductor)
