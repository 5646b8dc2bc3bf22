// SPDX-License-Identifier: Apache-2.0
// Lights and cameras that are wrong in one place each.
#pragma once
#include <vestige/camera.h>
#include <vestige/light.h>

#include <memory>

namespace vestige::test {

/// Everything as the good one has it.
class AsGoodLight : public Light {
 public:
  explicit AsGoodLight(std::shared_ptr<const Light> good) : good(std::move(good)) {}
  LightTraits traits() const noexcept override { return good->traits(); }
  const TriangleMesh* geometry() const noexcept override { return good->geometry(); }
  std::optional<LightSample> sample(const Receiver& r, Vec2 u) const noexcept override {
    return good->sample(r, u);
  }
  Real pdf(const Receiver& r, const LightHit& hit) const noexcept override {
    return good->pdf(r, hit);
  }
  Rgb eval(const LightHit& hit) const noexcept override { return good->eval(hit); }
  LightJacobian sampleDerivatives(const Receiver& r, Vec2 u) const noexcept override {
    return good->sampleDerivatives(r, u);
  }
  LightLogGradient logGradient(const Receiver& r, Vec2 u) const noexcept override {
    return good->logGradient(r, u);
  }
  std::optional<Particle> emit(EmissionNumbers u) const noexcept override { return good->emit(u); }
  RayJacobian emissionDerivatives(EmissionNumbers u) const noexcept override {
    return good->emissionDerivatives(u);
  }
  Rgb power() const noexcept override { return good->power(); }

 protected:
  std::shared_ptr<const Light> good;
};

struct PowerByPi final : AsGoodLight {
  using AsGoodLight::AsGoodLight;
  Rgb power() const noexcept override { return good->power() / kPi; }
};

/// Per area of the light, not per solid angle; the sample says the same.
struct PdfByArea final : AsGoodLight {
  using AsGoodLight::AsGoodLight;
  static Real byArea(const LightHit& h, Real pdf) {
    return pdf * std::abs(dot(h.normal, h.toLight)) / sqr(h.distance);
  }
  Real pdf(const Receiver& r, const LightHit& h) const noexcept override {
    return byArea(h, good->pdf(r, h));
  }
  std::optional<LightSample> sample(const Receiver& r, Vec2 u) const noexcept override {
    auto s = good->sample(r, u);
    if (s) s->pdf = byArea(s->hit, s->pdf);
    return s;
  }
};

struct DimParticles final : AsGoodLight {
  using AsGoodLight::AsGoodLight;
  std::optional<Particle> emit(EmissionNumbers u) const noexcept override {
    auto p = good->emit(u);
    if (p) p->power = p->power / 2;
    return p;
  }
};

struct WrongEmission final : AsGoodLight {
  using AsGoodLight::AsGoodLight;
  RayJacobian emissionDerivatives(EmissionNumbers u) const noexcept override {
    RayJacobian j = good->emissionDerivatives(u);
    j.dDirection[2] = -j.dDirection[2];
    return j;
  }
};

struct ForgottenFrom final : AsGoodLight {
  using AsGoodLight::AsGoodLight;
  LightJacobian sampleDerivatives(const Receiver& r, Vec2 u) const noexcept override {
    return {good->sampleDerivatives(r, u).du, {}};
  }
};

struct NoLightGradient final : AsGoodLight {
  using AsGoodLight::AsGoodLight;
  LightLogGradient logGradient(const Receiver&, Vec2) const noexcept override { return {}; }
};

class AsGoodCamera : public Camera {
 public:
  explicit AsGoodCamera(std::shared_ptr<const Camera> good) : good(std::move(good)) {}
  std::optional<CameraSample> sample(CameraNumbers n) const noexcept override {
    return good->sample(n);
  }
  Real pdf(Vec3 origin, Vec3 direction, Real aspect) const noexcept override {
    return good->pdf(origin, direction, aspect);
  }
  RayJacobian sampleDerivatives(CameraNumbers n) const noexcept override {
    return good->sampleDerivatives(n);
  }

 protected:
  std::shared_ptr<const Camera> good;
};

/// Degrees, not radians.
struct WrongUnits final : AsGoodCamera {
  using AsGoodCamera::AsGoodCamera;
  RayJacobian sampleDerivatives(CameraNumbers n) const noexcept override {
    RayJacobian j = good->sampleDerivatives(n);
    for (Vec3& d : j.dDirection) d = 180 / kPi * d;
    return j;
  }
};

/// 0 / 0 on the left edge of the film.
struct NanWeight final : AsGoodCamera {
  using AsGoodCamera::AsGoodCamera;
  std::optional<CameraSample> sample(CameraNumbers n) const noexcept override {
    auto s = good->sample(n);
    s->weight = s->weight * (n.film.x / n.film.x);
    return s;
  }
};

struct WrongCameraPdf final : AsGoodCamera {
  using AsGoodCamera::AsGoodCamera;
  Real pdf(Vec3 origin, Vec3 direction, Real aspect) const noexcept override {
    return aspect * good->pdf(origin, direction, aspect);
  }
};

/// Draws with its numbers changed; density and derivatives are as if they were not.
struct WideRays final : AsGoodCamera {
  using AsGoodCamera::AsGoodCamera;
  std::optional<CameraSample> sample(CameraNumbers n) const noexcept override {
    n.film.x = n.film.x * n.film.x;
    return good->sample(n);
  }
};

/// Right on the film, but not 0 beside it.
struct PdfOfEverything final : AsGoodCamera {
  using AsGoodCamera::AsGoodCamera;
  Real pdf(Vec3 origin, Vec3 direction, Real aspect) const noexcept override {
    return std::max(good->pdf(origin, direction, aspect), Real(0.05));
  }
};

}  // namespace vestige::test
