// SPDX-License-Identifier: Apache-2.0
// The smooth surface of a clear solid of index `ior`: reflects by Fresnel's law, refracts the rest.
// It has no effect if both indices are equal.
#include <vestige/brdf.h>
#include <vestige/plugin.h>
#include <vestige/tools/fresnel.h>

namespace vestige {
namespace {

class Glass final : public Brdf {
 public:
  enum Input { kIor, kSpecular, kTransmission };
  enum Lobe { kReflected, kRefracted };

  static Schema schema() {
    return {
        .kind = "brdf",
        .name = "glass",
        .summary = "smooth clear solid: reflects and refracts",
        .inputs = {
            real("ior", 1.5).range(0.1, 10).refractiveIndex().doc("refractive index of the inside"),
            rgb("specular", 1).range(0, 1).doc("tint of what is reflected"),
            rgb("transmission", 1).range(0, 1).doc("tint of what passes, per crossing")}};
  }

  ScatterValue evaluate(const ScatterPoint&, Vec3) const noexcept override { return {}; }

  std::optional<ScatterSample> sample(const ScatterPoint& p,
                                      ScatterNumbers n) const noexcept override {
    const Lobes l = lobes(p);
    if (!(l.reflectChance >= 0)) return std::nullopt;
    const bool reflects = n.lobe < l.reflectChance;
    const Vec3 toNext = bend(p, reflects).direction;
    return reflects ? ScatterSample::mirror(toNext, l.reflected, l.reflectChance, kReflected)
                    : ScatterSample::mirror(toNext, l.refracted, 1 - l.reflectChance, kRefracted);
  }

  ScatterJacobian sampleDerivatives(const ScatterPoint& p,
                                    ScatterNumbers n) const noexcept override {
    return {.du = {}, .dPrev = bend(p, n.lobe < lobes(p).reflectChance).dPrev()};
  }

  LogGradient logGradient(const ScatterPoint&, Vec3) const noexcept override { return {}; }

 private:
  struct Lobes {
    Rgb reflected, refracted;  ///< energy of each
    Real reflectChance;        ///< by luminance; negative where both are black
  };

  static Lobes lobes(const ScatterPoint& p) noexcept {
    const Real f = fresnelDielectric(p.toPrev.z, p.eta()).value;
    const Rgb reflected = f * p.inputs.rgb(kSpecular);
    const Rgb refracted = (1 - f) * p.inputs.rgb(kTransmission);
    const Real r = luminance(reflected), t = luminance(refracted);
    return {reflected, refracted, r + t > 0 ? r / (r + t) : Real(-1)};
  }

  static Deflection bend(const ScatterPoint& p, bool reflects) noexcept {
    constexpr Vec3 normal = {0, 0, 1};
    return reflects ? reflectAt(p.toPrev, normal) : refractAt(p.toPrev, normal, p.eta());
  }
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Brdf, vestige::Glass)
