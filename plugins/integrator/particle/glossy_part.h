// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vestige/brdf.h>

namespace vestige::particle {

/// A BRDF without its diffuse part: f - albedo / pi, sampled as the whole is. May be negative.
class GlossyPart final : public Brdf {
 public:
  GlossyPart(const Brdf& whole, Rgb albedo) : whole_(whole), diffuse_(albedo / kPi) {}

  ScatterValue evaluate(const ScatterPoint& p, Vec3 toNext) const noexcept override {
    ScatterValue v = whole_.evaluate(p, toNext);
    if (toNext.z > 0) v.fCos = v.fCos - toNext.z * diffuse_;
    return v;
  }
  std::optional<ScatterSample> sample(const ScatterPoint& p,
                                      ScatterNumbers n) const noexcept override {
    std::optional<ScatterSample> s = whole_.sample(p, n);
    if (s && !s->specular && s->toNext.z > 0)
      s->weight = s->weight - s->toNext.z / s->pdf * diffuse_;
    return s;
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
