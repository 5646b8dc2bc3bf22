// SPDX-License-Identifier: Apache-2.0
// A smooth interface between air outside and a clear solid of index `ior` inside: reflects by
// Fresnel's law, refracts the rest. With ior 1 it is not there.
#include <vestige/brdf.h>
#include <vestige/fresnel.h>
#include <vestige/plugin.h>

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
        .inputs = {real("ior", 1.5).range(0.1, 10).doc("index of the inside; outside is 1"),
                   rgb("specular", 1).range(0, 1).doc("tint of what is reflected"),
                   rgb("transmission", 1).range(0, 1).doc("tint of what passes, per crossing")}};
  }

  Rgb eval(const ScatterPoint&, Vec3) const noexcept override { return {}; }

  std::optional<ScatterSample> sample(const ScatterPoint& p,
                                      ScatterNumbers n) const noexcept override {
    const Lobes l = lobes(p);
    if (!(l.reflectChance >= 0)) return std::nullopt;
    const bool reflects = n.lobe < l.reflectChance;
    const Real chance = reflects ? l.reflectChance : 1 - l.reflectChance;
    return ScatterSample{.toNext = turn(p, reflects).direction,
                         .weight = (reflects ? l.reflected : l.refracted) / chance,
                         .pdf = 1,
                         .lobePdf = 1,
                         .lobeChance = chance,
                         .lobe = reflects ? kReflected : kRefracted,
                         .specular = true};
  }

  Real pdf(const ScatterPoint&, Vec3) const noexcept override { return 0; }

  ScatterJacobian sampleDerivatives(const ScatterPoint& p,
                                    ScatterNumbers n) const noexcept override {
    return {.du = {}, .dPrev = turn(p, n.lobe < lobes(p).reflectChance).dPrev()};
  }

  LogGradient logGradient(const ScatterPoint&, Vec3) const noexcept override { return {}; }

  Real etaScale(const ScatterPoint& p, Vec3 toNext) const noexcept override {
    return toNext.z < 0 ? sqr(eta(p)) : 1;
  }

 private:
  struct Lobes {
    Rgb reflected, refracted;  ///< energy of each
    Real reflectChance;        ///< by luminance; negative where both are black
  };

  static Real eta(const ScatterPoint& p) noexcept {
    return interfaceEta(p.inputs.real(kIor), p.inside);
  }

  static Lobes lobes(const ScatterPoint& p) noexcept {
    const Real f = fresnelDielectric(p.toPrev.z, eta(p)).value;
    const Rgb reflected = f * p.inputs.rgb(kSpecular);
    const Rgb refracted = (1 - f) * p.inputs.rgb(kTransmission);
    const Real r = luminance(reflected), t = luminance(refracted);
    return {reflected, refracted, r + t > 0 ? r / (r + t) : Real(-1)};
  }

  static Turned turn(const ScatterPoint& p, bool reflects) noexcept {
    constexpr Vec3 normal = {0, 0, 1};
    return reflects ? reflectAt(p.toPrev, normal) : refractAt(p.toPrev, normal, eta(p));
  }
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Brdf, vestige::Glass)
