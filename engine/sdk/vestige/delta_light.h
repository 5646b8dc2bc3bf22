// SPDX-License-Identifier: Apache-2.0
// Base classes of delta lights, which no ray can hit by chance. A PointSource needs a position and
// an intensity, a DistantSource a direction and an irradiance; the base implements the methods of
// Light.
//
//     class Lamp final : public PointSource {
//      public:
//       explicit Lamp(const Values& v) : PointSource(v.toWorld().point(v.vec3(kLocation))) {}
//       Rgb intensity(Vec3 d) const noexcept override;  // W/sr, in the light's own frame
//     };
#pragma once
#include <vestige/light.h>
#include <vestige/tools/aim.h>
#include <vestige/tools/sampling.h>
#include <vestige/tools/scene_disk.h>

namespace vestige {

class DeltaLight : public Light {
 public:
  LightTraits traits() const noexcept override { return {.isDelta = true}; }
  Real pdf(const Receiver&, const LightHit&) const noexcept final { return 0; }
  Rgb eval(const LightHit&) const noexcept final { return {}; }
};

/// A point light: irradiance is intensity / distance^2.
class PointSource : public DeltaLight {
 public:
  using Differences = PointSource;

  /// Radiant intensity along unit d, W/sr; black where the light does not shine. d is in the
  /// light's own frame, where z is the axis.
  virtual Rgb intensity(Vec3 d) const noexcept = 0;

  /// Gradient of the log of the intensity's luminance by d, 1/rad; what lies along d does not
  /// count. Called only where the intensity is not black. By default: finite differences, and a
  /// note to the user.
  virtual Vec3 logIntensityGradient(Vec3 d) const noexcept {
    const Real here = std::log(luminance(intensity(d)));
    const Frame f = Frame::around(d);
    const auto slope = [&](Vec3 along) {
      const auto map = [&](Real h) -> std::optional<Real> {
        const Real i = luminance(intensity(differences::turned(d, along, h)));
        return i > 0 ? std::optional(std::log(i)) : std::nullopt;
      };
      return differences::derivative(map, here, differences::kStep, 1 + std::abs(here));
    };
    return slope(f.s) * f.s + slope(f.t) * f.t;
  }

  std::optional<LightSample> sample(const Receiver& r, Vec2) const noexcept override {
    const Vec3 way = location_ - r.position, toLight = normalize(way);
    const Real d2 = lengthSquared(way);
    if (!(d2 > 0)) return std::nullopt;
    const Rgb i = intensity(frame_.toLocal(-toLight));
    if (isBlack(i)) return std::nullopt;
    return LightSample{{r.position, toLight, std::sqrt(d2), location_, {}, {}}, i / d2, 1};
  }

  LightJacobian sampleDerivatives(const Receiver& r, Vec2) const noexcept override {
    const Vec3 way = location_ - r.position;
    return {.du = {}, .dFrom = (-1 / length(way)) * projection(normalize(way))};
  }

  LightLogGradient logGradient(const Receiver& r, Vec2) const noexcept override {
    const Vec3 way = location_ - r.position, away = -normalize(way), d = frame_.toLocal(away);
    if (!(luminance(intensity(d)) > 0)) return {};
    // The direction in which the light is left turns with the receiver: projection / distance.
    const Vec3 slope = projection(away) * frame_.toWorld(logIntensityGradient(d)) / length(way);
    return {{}, 2 / lengthSquared(way) * way + slope};
  }

  /// Uniform over the cap around the axis.
  std::optional<Particle> emit(EmissionNumbers u) const noexcept override {
    const Vec3 d = uniformCap(u.direction, cosReach_).d;
    return Particle{.origin = location_,
                    .direction = frame_.toWorld(d),
                    .normal = {},
                    .power = 2 * kPi * (1 - cosReach_) * intensity(d),
                    .variables = 2};
  }

  RayJacobian emissionDerivatives(EmissionNumbers u) const noexcept override {
    const Mat3x2 du = uniformCap(u.direction, cosReach_).du;
    return {.dOrigin = {},
            .dDirection = {Vec3{}, Vec3{}, frame_.toWorld(du.c[0]), frame_.toWorld(du.c[1])}};
  }

  LightExtent extent() const noexcept override {
    if (cosReach_ <= -1) return {{location_, location_}};
    return {{location_, location_}, frame_.n, 0, std::acos(cosReach_)};
  }

  /// By default the mean of the intensity over 64 x 64 directions. Called once a scene, not once a
  /// path.
  Rgb power() const noexcept override {
    constexpr int n = 64;
    Rgb sum;
    for (int i = 0; i < n * n; ++i)
      sum += intensity(
          uniformCap(Vec2{(i % n + Real(0.5)) / n, (i / n + Real(0.5)) / n}, cosReach_).d);
    return 2 * kPi * (1 - cosReach_) / (n * n) * sum;
  }

 protected:
  /// In world space. `cosReach`: cosine of the angle from the axis (frame.n) beyond which the
  /// intensity is black; -1: it shines all around.
  explicit PointSource(Vec3 location, const Frame& frame = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                       Real cosReach = -1) noexcept
      : location_(location), frame_(frame), cosReach_(cosReach) {}
  PointSource(const Aim& aim, Real cosReach) noexcept
      : PointSource(aim.location, aim.frame, cosReach) {}

  const Vec3& location() const noexcept { return location_; }
  const Frame& frame() const noexcept { return frame_; }

 private:
  Vec3 location_;
  Frame frame_;
  Real cosReach_;
};

/// Parallel light from infinity.
class DistantSource : public DeltaLight {
 public:
  LightTraits traits() const noexcept override { return {.isDelta = true, .isInfinite = true}; }
  void setScene(const Bounds& scene) override { disk_ = SceneDisk::around(scene); }

  std::optional<LightSample> sample(const Receiver& r, Vec2) const noexcept override {
    return LightSample{{r.position, -direction_, kInfinity, {}, {}, {}}, irradiance_, 1};
  }
  LightJacobian sampleDerivatives(const Receiver&, Vec2) const noexcept override { return {}; }
  LightLogGradient logGradient(const Receiver&, Vec2) const noexcept override { return {}; }

  std::optional<Particle> emit(EmissionNumbers u) const noexcept override {
    return Particle{.origin = disk_.start(direction_, u.point),
                    .direction = direction_,
                    .normal = {},
                    .power = power(),
                    .variables = 2};
  }
  RayJacobian emissionDerivatives(EmissionNumbers u) const noexcept override {
    const Mat3x2 du = disk_.du(direction_, u.point);
    return {.dOrigin = {du.c[0], du.c[1]}, .dDirection = {}};
  }

  /// The flux through the disk that covers the scene.
  Rgb power() const noexcept override { return disk_.area() * irradiance_; }

 protected:
  /// `direction`: unit, away from the light; `irradiance` across it, W/m^2.
  DistantSource(Vec3 direction, Rgb irradiance) noexcept
      : direction_(direction), irradiance_(irradiance) {}

  const Vec3& direction() const noexcept { return direction_; }

 private:
  Vec3 direction_;
  Rgb irradiance_;
  SceneDisk disk_;
};

}  // namespace vestige
