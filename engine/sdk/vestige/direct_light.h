// SPDX-License-Identifier: Apache-2.0
// What lights bring to a vertex, two ways at once: drawn towards them (next-event estimation), and
// met by the rays that scattering drew. Multiple importance sampling weighs them [Vea97 9.2].
// Shared by all integrators that follow paths from the eye.
//
// [Vea97] Veach. Robust Monte Carlo methods for light transport simulation. PhD thesis, 1997.
#pragma once
#include <vestige/integrator.h>
#include <vestige/sampling.h>

namespace vestige {

/// A ray as multiple importance sampling sees it.
struct DrawnRay {
  Vec3 from;                 ///< where the last scattering was: what light densities are asked from
  Real density = kInfinity;  ///< of its direction times how many were drawn, 1/sr; infinite after
                             ///< the camera and specular events: then no light was drawn against it
  Real lightSamples = 1;     ///< drawn towards lights at `from`
  bool isUnrivalled() const noexcept { return !(density < kInfinity); }
};

/// Whether only shadow rays bring the light that a ray met; `rival`: their density.
inline bool isLeftToShadowRays(const SceneView& scene, const DrawnRay& ray, Real rival) noexcept {
  return rival > 0 && !ray.isUnrivalled() && !scene.shadowsMatchIndirect();
}

/// The radiance of a light that the ray met, weighted.
inline Rgb metLight(const SceneView& scene, const Surface& s, const DrawnRay& ray) noexcept {
  if (s.light < 0) return {};
  const Real rival = ray.lightSamples * scene.lightPdf(s, ray.from);
  if (isLeftToShadowRays(scene, ray, rival)) return {};
  return powerHeuristic(ray.density, rival) * scene.emitted(s, ray.from);
}

/// What lights at infinity add to a ray that left the scene. `spread`: two vectors across the
/// direction over which they are averaged, if any.
inline Rgb background(const SceneView& scene, const DrawnRay& ray, Vec3 direction,
                      const Vec3* spread = nullptr) noexcept {
  Rgb sum;
  for (const int i : scene.infiniteLights()) {
    const Light& light = *scene.lights()[std::size_t(i)];
    LightHit hit{ray.from, direction, kInfinity, {}, {}, {}};
    if (spread) hit.spread[0] = spread[0], hit.spread[1] = spread[1];
    const Real rival = ray.lightSamples * scene.lightChance(i, ray.from) * light.pdf(hit);
    if (isLeftToShadowRays(scene, ray, rival)) continue;
    sum += powerHeuristic(ray.density, rival) * light.eval(hit);
  }
  return sum;
}

/// A point of a light, drawn from a surface.
struct TowardsLight {
  const Light* light = nullptr;
  Vec2 u{};                             ///< the light's own numbers
  Real chance = 0;                      ///< of choosing it
  std::optional<LightSample> sample{};  ///< empty: nothing arrives
};

/// One light, one point of it. `index`: of the sample in its sequences.
inline TowardsLight drawLight(PathContext& c, const Surface& s, std::uint32_t vertex,
                              std::uint32_t index) noexcept {
  const std::uint32_t dim = dimension::vertex(vertex);
  // One pair chooses the light and then its point: so the points are stratified on each light.
  Vec2 u = c.sampler.pair(dim + dimension::kLight, index);
  const auto choice = c.scene.chooseLight(s.position, u.x);
  if (!choice) return {};
  constexpr Real kFewBits = Real(1) / 256;
  u.x = choice->chance > kFewBits ? choice->rest
                                  : c.sampler.number(dim + dimension::kLightChoice, index);
  const Light* light = c.scene.lights()[std::size_t(choice->light)];
  return {light, u, choice->chance, light->sample(s.position, u)};
}

/// What arrives from there and is reflected, weighted as one of `samples`; `scattered` rays are
/// drawn besides.
inline Rgb reflectedLight(PathContext& c, const Surface& s, const Interaction& x,
                          const TowardsLight& towards, Real samples, Real scattered) noexcept {
  if (!towards.sample) return {};
  const LightSample& drawn = *towards.sample;
  const Rgb f = evalScatter(x, drawn.hit.toLight);
  if (isBlack(f) || isBlack(drawn.radiance)) return {};
  ++c.counters.shadowRays;
  const Rgb visible = c.scene.transmittance(shadowRay(s, drawn.hit.toLight, drawn.hit.distance));
  if (isBlack(visible)) return {};
  const Real density = towards.chance * drawn.pdf;
  const Real weight =
      towards.light->isDelta() || !c.scene.shadowsMatchIndirect()
          ? 1
          : powerHeuristic(samples * density, scattered * scatterPdf(x, drawn.hit.toLight));
  return (weight / density) * visible * f * drawn.radiance;
}

/// Next-event estimation: the mean of `samples` of these is the direct light.
inline Rgb directLight(PathContext& c, const Surface& s, const Interaction& x, std::uint32_t vertex,
                       std::uint32_t index, Real samples = 1, Real scattered = 1) noexcept {
  if (!x.brdf) return {};
  return reflectedLight(c, s, x, drawLight(c, s, vertex, index), samples, scattered);
}

}  // namespace vestige
