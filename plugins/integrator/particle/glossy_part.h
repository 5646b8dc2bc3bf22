// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vestige/brdf.h>

namespace vestige::particle {

/// What a BRDF does besides its diffuse part: f - albedo / pi, drawn as the whole is.
class GlossyPart final : public Brdf {
 public:
  GlossyPart(const Brdf& whole, Rgb albedo) : whole_(whole), diffuse_(albedo / kPi) {}

  Rgb eval(const ScatterPoint& p, Vec3 toNext) const noexcept override {
    const Rgb f = whole_.eval(p, toNext);
    return toNext.z > 0 ? f - diffuse_ : f;
  }
  std::optional<ScatterSample> sample(const ScatterPoint& p,
                                      ScatterNumbers n) const noexcept override {
    std::optional<ScatterSample> s = whole_.sample(p, n);
    if (s && !s->specular && s->toNext.z > 0)
      s->weight = s->weight - s->toNext.z / s->pdf * diffuse_;
    return s;
  }
  Real pdf(const ScatterPoint& p, Vec3 toNext) const noexcept override {
    return whole_.pdf(p, toNext);
  }
  ScatterJacobian sampleDerivatives(const ScatterPoint& p,
                                    ScatterNumbers n) const noexcept override {
    return whole_.sampleDerivatives(p, n);
  }
  LogGradient logGradient(const ScatterPoint& p, Vec3 toNext) const noexcept override {
    return whole_.logGradient(p, toNext);
  }
  Real etaScale(const ScatterPoint& p, Vec3 toNext) const noexcept override {
    return whole_.etaScale(p, toNext);
  }

 private:
  const Brdf& whole_;
  Rgb diffuse_;
};

}  // namespace vestige::particle
