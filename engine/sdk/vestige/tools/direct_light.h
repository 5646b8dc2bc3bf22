// SPDX-License-Identifier: Apache-2.0
// Direct light at a vertex, estimated by two strategies: directions drawn towards lights
// (next-event estimation), and scattered rays that hit a light. Multiple importance sampling
// weights both [Vea97 9.2]. Shared by all integrators that follow paths from the eye.
//
// [Vea97] Veach. Robust Monte Carlo methods for light transport simulation. PhD thesis, 1997.
#pragma once
#include <vestige/integrator.h>
#include <vestige/tools/sampling.h>

namespace vestige {

/// A ray as multiple importance sampling needs it.
struct DrawnRay {
  Receiver from;             ///< the last scattering, where directions to lights were drawn too
  Real density = kInfinity;  ///< pdf of its direction times the number of such rays, 1/sr; infinite
                             ///< for rays from the camera and from specular lobes
  Real lightSamples = 1;     ///< directions drawn towards lights at `from`
  /// Whether next-event estimation cannot find the same light. The MIS weight is 1 then, and the
  /// light's own pdf need not be evaluated.
  bool isUnrivalled() const noexcept { return !(density < kInfinity); }
};

/// Whether only shadow rays count for the light that a ray hit; `rival`: their density.
inline bool isLeftToShadowRays(const SceneView& scene, Real rival) noexcept {
  return rival > 0 && !scene.shadowsMatchIndirect();
}

/// Weighted radiance of the light that the ray hit.
inline Rgb metLight(const SceneView& scene, const Surface& s, const DrawnRay& ray) noexcept {
  if (s.light < 0) return {};
  const Rgb radiance = scene.emitted(s, ray.from);
  if (ray.isUnrivalled()) return radiance;
  const Real rival = ray.lightSamples * scene.lightPdf(s, ray.from);
  if (isLeftToShadowRays(scene, rival)) return {};
  return powerHeuristic(ray.density, rival) * radiance;
}

/// Weighted radiance of the lights at infinity along a ray that left the scene. `spread`: two
/// vectors perpendicular to the direction, over which the radiance is averaged; may be null.
inline Rgb background(const SceneView& scene, const DrawnRay& ray, Vec3 direction,
                      const Vec3* spread = nullptr) noexcept {
  Rgb sum;
  for (const int i : scene.infiniteLights()) {
    const Light& light = *scene.lights()[std::size_t(i)];
    LightHit hit{ray.from.position, direction, kInfinity, {}, {}, {}};
    if (spread) {
      hit.spread[0] = spread[0];
      hit.spread[1] = spread[1];
    }
    const Rgb radiance = light.eval(hit);
    if (ray.isUnrivalled()) {
      sum += radiance;
      continue;
    }
    const Real rival = ray.lightSamples * scene.lightChance(i, ray.from) * light.pdf(ray.from, hit);
    if (isLeftToShadowRays(scene, rival)) continue;
    sum += powerHeuristic(ray.density, rival) * radiance;
  }
  return sum;
}

/// A point of a light, drawn for a receiver.
struct TowardsLight {
  const Light* light = nullptr;
  Vec2 u{};                             ///< random numbers of the point
  Real chance = 0;                      ///< probability of choosing the light
  std::optional<LightSample> sample{};  ///< empty: nothing arrives
};

/// Draws a light and a point on it. `index`: index of the sample in its sequences.
inline TowardsLight drawLight(PathContext& c, const Receiver& r, std::uint32_t vertex,
                              std::uint32_t index) noexcept {
  const std::uint32_t dim = dimension::vertex(vertex);
  // One pair chooses the light and then the point on it, so points are stratified on each light.
  Vec2 u = c.sampler.pair(dim + dimension::kLight, index);
  const auto choice = c.scene.chooseLight(r, u.x);
  if (!choice) return {};
  constexpr Real kFewBits = Real(1) / 256;
  u.x = choice->chance > kFewBits ? choice->rest
                                  : c.sampler.number(dim + dimension::kLightChoice, index);
  const Light* light = c.scene.lights()[std::size_t(choice->light)];
  return {light, u, choice->chance, light->sample(r, u)};
}

/// Reflected radiance of that point, with the weight of one of `samples` light samples against
/// `scattered` scattered rays.
inline Rgb reflectedLight(PathContext& c, const Surface& s, const Interaction& x,
                          const TowardsLight& towards, Real samples, Real scattered) noexcept {
  if (!towards.sample) return {};
  const LightSample& drawn = *towards.sample;
  const ScatterValue value = evaluateScatter(x, drawn.hit.toLight);
  if (isBlack(value.fCos) || isBlack(drawn.radiance)) return {};
  ++c.counters.shadowRays;
  const Rgb visible = c.scene.transmittance(shadowRay(s, drawn.hit));
  if (isBlack(visible)) return {};
  const Real density = towards.chance * drawn.pdf;
  const bool isAlone = towards.light->traits().isDelta || !c.scene.shadowsMatchIndirect();
  const Real weight = isAlone ? 1 : powerHeuristic(samples * density, scattered * value.pdf);
  return (weight / density) * visible * value.fCos * drawn.radiance;
}

/// Next-event estimation: the mean of `samples` of these is the direct light.
inline Rgb directLight(PathContext& c, const Surface& s, const Interaction& x, std::uint32_t vertex,
                       std::uint32_t index, Real samples = 1, Real scattered = 1) noexcept {
  if (!x.brdf) return {};
  return reflectedLight(c, s, x, drawLight(c, x.receiver, vertex, index), samples, scattered);
}

}  // namespace vestige
