// SPDX-License-Identifier: Apache-2.0
// A thin clear layer of varnish over another BRDF: the layer reflects by Fresnel's law on GGX
// microfacets, and what passes it twice is scattered by the base.
//
//     f = w R + T(prev.z) T(next.z) base,      T(c) = 1 - w F(c)
//     R = F(prev . h) D(h) G1(prev) G1(next) / (4 prev.z next.z)
//
// w is `weight`, F the layer's reflectance. The layer is thin, so it does not change directions:
// the base receives those outside. Light reflected by the layer back to the base is lost, as in
// glTF's clearcoat. The layer covers the front only: light transmitted by the whole surface passes
// it once.
//
// [Wal07] Walter et al. Microfacet models for refraction through rough surfaces. EGSR 2007. Eq. 20
#include <vestige/brdf.h>
#include <vestige/plugin.h>
#include <vestige/tools/microfacet.h>

namespace vestige {
namespace {

class Coat final : public Brdf {
 public:
  enum Param { kBase };
  enum Input { kWeight, kAlpha, kIndex };

  static Schema schema() {
    return {.kind = "brdf",
            .name = "coat",
            .summary = "a thin clear layer over another BRDF",
            .params = {block("base", "brdf").doc("below the layer (lambert)")},
            .inputs = {real("weight", 1).range(0, 1).doc("how much of the layer there is"),
                       real("alpha", 0.05).range(0, 1).doc("GGX width of the layer: 0.5 is dull"),
                       real("coat_ior", 1.5).range(1, 10).doc("refractive index of the layer")}};
  }

  Coat(const Values& values, Host& host) : base_(host.brdf(values.block(kBase))) {}

  ScatterValue evaluate(const ScatterPoint& p, Vec3 toNext) const noexcept override {
    const Layer layer(p);
    const ScatterValue b = base_.brdf->evaluate(base_.at(p), toNext);
    ScatterValue v{layer.passed(p, toNext) * b.fCos, (1 - layer.chance) * b.pdf};
    const Facet f = facetOf(p, toNext);
    if (!(layer.chance > 0) || !f.exists()) return v;
    v.fCos += grey(toNext.z * layer.reflected(f.cosPrev).value *
                   facetValue(layer.ggx, f, p.toPrev, toNext));
    v.pdf += layer.chance * facetPdf(layer.ggx, f, p.toPrev, toNext);
    return v;
  }

  std::optional<ScatterSample> sample(const ScatterPoint& p,
                                      ScatterNumbers n) const noexcept override {
    const Layer layer(p);
    if (n.lobe < layer.chance) return sampleLayer(p, layer, n.u);
    std::optional<ScatterSample> s = base_.brdf->sample(base_.at(p), {rest(layer, n.lobe), n.u});
    if (!s) return s;
    s->lobe += 1;
    s->lobeChance *= 1 - layer.chance;
    if (s->specular) {
      s->weight = layer.passed(p, s->toNext) / (1 - layer.chance) * s->weight;
      return s;
    }
    return weighted(p, *s);
  }

  ScatterJacobian sampleDerivatives(const ScatterPoint& p,
                                    ScatterNumbers n) const noexcept override {
    const Layer layer(p);
    if (!(n.lobe < layer.chance))
      return base_.brdf->sampleDerivatives(base_.at(p), {rest(layer, n.lobe), n.u});
    const VisibleNormal v = layer.ggx.sampleVisibleDerivatives(p.toPrev, n.u);
    return leavingDerivatives(reflectAt(p.toPrev, v.h), v);
  }

  LogGradient logGradient(const ScatterPoint& p, Vec3 toNext) const noexcept override {
    // d(log(a + b)) = (a d(log a) + b d(log b)) / (a + b)
    const Layer layer(p);
    const ScatterPoint below = base_.at(p);
    const Real base = layer.passed(p, toNext) * luminance(base_.brdf->evaluate(below, toNext).fCos);
    const Facet f = facetOf(p, toNext);
    const Fresnel fresnel = f.exists() ? layer.reflected(f.cosPrev) : Fresnel{0, 0};
    const Real top = fresnel.value > 0
                         ? toNext.z * fresnel.value * facetValue(layer.ggx, f, p.toPrev, toNext)
                         : 0;
    const Real total = base + top;
    LogGradient sum = {};
    if (!(total > 0)) return sum;
    if (base > 0) {
      const LogGradient g = base_.brdf->logGradient(below, toNext);
      const Fresnel in = layer.transmittedOf(p.toPrev, !p.behind);
      const Fresnel out = layer.transmittedOf(toNext, (toNext.z < 0) == p.behind);
      sum.dPrev = base / total * (g.dPrev + Vec3{0, 0, in.slope / in.value});
      sum.dNext = base / total * (g.dNext + Vec3{0, 0, out.slope / out.value});
    }
    if (top > 0) {
      const FacetGradient g =
          facetLogGradient(layer.ggx, f, p.toPrev, toNext, fresnel.slope / fresnel.value);
      sum.dPrev += top / total * g.dPrev;
      sum.dNext += top / total * g.dNext;
    }
    return sum;
  }

  Real etaScale(const ScatterPoint& p, Vec3 toNext) const noexcept override {
    return base_.brdf->etaScale(base_.at(p), toNext);
  }

 private:
  /// The layer at one point.
  struct Layer {
    Real weight, eta;
    Ggx ggx;
    Real chance;  ///< probability of drawing its reflection: its energy, but at least a quarter if
                  ///< there is a layer, since facets may be hit at a flatter angle

    explicit Layer(const ScatterPoint& p) noexcept
        : weight(std::clamp(p.inputs.real(kWeight), Real(0), Real(1))),
          eta(1 / std::max(p.inputs.real(kIndex), Real(1))),
          ggx(p.inputs.real(kAlpha)),
          chance(0) {
      if (!p.behind && weight > 0 && eta < 1)
        chance = std::clamp(reflected(p.toPrev.z).value, Real(0.25), Real(0.75));
    }
    Fresnel reflected(Real c) const noexcept {
      const Fresnel f = fresnelDielectric(c, eta);
      return {weight * f.value, weight * f.slope};
    }
    /// Transmittance along a direction, and its derivative by z. 1 behind the surface.
    Fresnel transmittedOf(Vec3 d, bool isFront) const noexcept {
      if (!isFront) return {1, 0};
      const Fresnel f = reflected(std::abs(d.z));
      return {std::max(1 - f.value, Real(0)), d.z < 0 ? f.slope : -f.slope};
    }
    Real passed(const ScatterPoint& p, Vec3 toNext) const noexcept {
      return transmittedOf(p.toPrev, !p.behind).value *
             transmittedOf(toNext, (toNext.z < 0) == p.behind).value;
    }
  };

  /// The facet of the layer's reflection.
  static Facet facetOf(const ScatterPoint& p, Vec3 toNext) noexcept {
    return toNext.z > 0 && !p.behind ? facetBetween(p.toPrev, toNext, 1) : Facet{};
  }
  static Real rest(const Layer& layer, Real lobe) noexcept {
    return std::min((lobe - layer.chance) / (1 - layer.chance), kOneMinusEpsilon);
  }

  std::optional<ScatterSample> sampleLayer(const ScatterPoint& p, const Layer& layer,
                                           Vec2 u) const noexcept {
    const Vec3 h = layer.ggx.sampleVisible(p.toPrev, u);
    const Vec3 toNext = reflectAt(p.toPrev, h).direction;
    const Facet f = reflectingFacet(p.toPrev, h);
    if (!(toNext.z > 0 && f.exists())) return std::nullopt;
    const Real density = facetPdf(layer.ggx, f, p.toPrev, toNext);
    if (!(density > 0)) return std::nullopt;
    // From the drawn facet, because evaluate() cannot reconstruct a narrow one exactly.
    const ScatterValue b = base_.brdf->evaluate(base_.at(p), toNext);
    const Real pdf = layer.chance * density + (1 - layer.chance) * b.pdf;
    const Rgb fCos =
        layer.passed(p, toNext) * b.fCos + grey(toNext.z * layer.reflected(f.cosPrev).value *
                                                facetValue(layer.ggx, f, p.toPrev, toNext));
    return ScatterSample{toNext, fCos / pdf, pdf, density, layer.chance, 0, false};
  }

  /// A sample of the base with the value and density of the whole.
  std::optional<ScatterSample> weighted(const ScatterPoint& p, ScatterSample s) const noexcept {
    const ScatterValue v = evaluate(p, s.toNext);
    if (!(v.pdf > 0)) return std::nullopt;
    s.weight = v.fCos / v.pdf;
    s.pdf = v.pdf;
    return s;
  }

  NestedBrdf base_;
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Brdf, vestige::Coat)
