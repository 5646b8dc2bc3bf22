// SPDX-License-Identifier: Apache-2.0
// Rays that leave a surface, and its BRDF in world space with all corrections.
//
// [Vea97] Veach. Robust Monte Carlo methods for light transport simulation. PhD thesis, 1997.
#pragma once
#include <vestige/sampler.h>
#include <vestige/scene_view.h>

namespace vestige {

/// A ray that leaves a surface. Its origin is offset to the side of `direction`, so that rounding
/// cannot make it hit the same surface again.
inline Ray spawnRay(const Surface& s, Vec3 direction, RayKind kind = RayKind::any) noexcept {
  const Real side = dot(direction, s.geometricNormal) < 0 ? Real(-1) : Real(1);
  const MediumStack& media = side < 0 ? s.mediaBehind : s.mediaInFront;
  return {s.position + side * s.offset * s.geometricNormal,
          direction,
          0,
          kInfinity,
          s.time,
          kind,
          media};
}
/// A shadow ray from a surface to a point of a light. Both ends are offset from their surfaces, and
/// the ray connects the offset points, so that neither surface shadows the other at grazing angles.
inline Ray shadowRay(const Surface& s, const LightHit& light) noexcept {
  Ray r = spawnRay(s, light.toLight);
  if (!std::isfinite(light.distance)) return r;
  const Real off = light.offset + kRayError * (light.distance + maxAbsComponent(light.position));
  // A point light's end is offset back along the ray.
  const Real cosine = dot(light.normal, light.toLight);
  const Vec3 away = cosine < 0 ? light.normal : cosine > 0 ? -light.normal : -light.toLight;
  const Vec3 way = light.position + off * away - r.origin;
  const Real distance = length(way);
  r.tMax = distance > 0 ? distance * (1 - kRayError) : Real(0);
  if (distance > 0) r.direction = way / distance;
  return r;
}
/// A shadow ray of a given length without a light, as for ambient occlusion; it ends slightly
/// before that distance.
inline Ray shadowRay(const Surface& s, Vec3 direction, Real distance) noexcept {
  Ray r = spawnRay(s, direction);
  if (std::isfinite(distance)) r.tMax = distance - 2 * s.offset - distance * Real(1e-5);
  return r;
}

/// The kind of a scattered ray: `indirect` if and only if light sampling competes with it.
inline RayKind kindOf(const ScatterSample& s) noexcept {
  if (!s.specular) return RayKind::indirect;
  return s.toNext.z < 0 ? RayKind::refraction : RayKind::reflection;
}

inline bool isOpaque(Rgb opacity) noexcept {
  return opacity.r >= 1 && opacity.g >= 1 && opacity.b >= 1;
}

/// The quantity that a path carries: radiance (from the sensor) is scaled by etaScale(), flux (from
/// a light) is corrected for shading normals [Vea97 5.2, 5.3].
enum class Carries { radiance, flux };

/// One drawn continuation of a path, in world space.
struct Scatter {
  Vec3 toNext;
  Rgb weight;  ///< f cos / pdf with all corrections
  ScatterSample local;
};

/// Correction for shading normals on particle paths, 1 on eye paths [Vea97 Eq. 5.19].
inline Real shadingCorrection(const Interaction& x, Vec3 toNext, Carries what) noexcept {
  if (what == Carries::radiance) return 1;
  const Real in = std::abs(dot(x.toPrev, x.frame.n) * dot(toNext, x.geometricNormal));
  const Real out = std::abs(dot(x.toPrev, x.geometricNormal) * dot(toNext, x.frame.n));
  return out > 0 ? std::min(in / out, Real(100)) : 0;  // grazing: bounded, not refused
}

/// Whether the geometric and the shading normal agree on which side toNext lies.
inline bool sidesAgree(const Interaction& x, Vec3 toNext, Real localZ) noexcept {
  return dot(toNext, x.geometricNormal) * localZ > 0;
}

/// Scale of radiance that crosses an interface; 1 for flux and for reflection.
inline Real etaScale(const Interaction& x, Vec3 local, Carries what) noexcept {
  return what == Carries::radiance && local.z < 0 ? x.brdf->etaScale(x.point, local) : Real(1);
}

/// f |cos| towards a world direction, with all corrections, and the density of drawScatter() there.
/// Zero where the BRDF is zero or the normals disagree about the side.
inline ScatterValue evaluateScatter(const Interaction& x, Vec3 toNext,
                                    Carries what = Carries::radiance) noexcept {
  if (!x.brdf) return {};
  const Vec3 local = x.frame.toLocal(toNext);
  if (!sidesAgree(x, toNext, local.z)) return {};
  ScatterValue v = x.brdf->evaluate(x.point, local);
  v.fCos = etaScale(x, local, what) * shadingCorrection(x, toNext, what) * v.fCos;
  return v;
}

/// The random numbers of a vertex's continuation. `vertex`: its number, `index`: of the path in its
/// sequences.
inline ScatterNumbers scatterNumbers(const Sampler& s, const Interaction& x, std::uint32_t vertex,
                                     std::uint32_t index) noexcept {
  const std::uint32_t dim = dimension::vertex(vertex);
  const bool isLobeDrawn = x.brdf && x.brdf->usesLobeNumber();
  return {isLobeDrawn ? s.number(dim + dimension::kLobe, index) : Real(0),
          s.pair(dim + dimension::kDirection, index)};
}

/// Draws a continuation; nullopt where the path is absorbed.
inline std::optional<Scatter> drawScatter(const Interaction& x, ScatterNumbers numbers,
                                          Carries what = Carries::radiance) noexcept {
  if (!x.brdf) return std::nullopt;
  const std::optional<ScatterSample> s = x.brdf->sample(x.point, numbers);
  if (!s) return std::nullopt;
  const Vec3 toNext = normalize(x.frame.toWorld(s->toNext));
  if (!sidesAgree(x, toNext, s->toNext.z)) return std::nullopt;
  const Real eta = etaScale(x, s->toNext, what);
  return Scatter{toNext, eta * shadingCorrection(x, toNext, what) * s->weight, *s};
}

}  // namespace vestige
