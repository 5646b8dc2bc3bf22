// SPDX-License-Identifier: Apache-2.0
// A path from the eye, and its way from one scattering to the next: through transparent layers,
// collecting the radiance met. Shared by the integrators that follow such paths.
//
//     EyePath path(context);
//     while (walk(context, path, vertex, radiance)) {
//       ... direct light; a continuation drawn with path.scatterNumbers(sampler, x) ...
//       path.leave(vertex, scatter, 1);
//       ++path.edge;
//     }
#pragma once
#include <vestige/tools/branching.h>
#include <vestige/tools/layers.h>
#include <vestige/tools/path_report.h>
#include <vestige/tools/roulette.h>

namespace vestige {

/// A surface that a path reached, with its material looked up.
struct Vertex {
  Surface s;
  Interaction x;
  InputBuffer inputs;
};

/// A path from the eye.
struct EyePath {
  Ray ray;
  DrawnRay drawn;  ///< the same ray, for multiple importance sampling
  RandomStream stream;
  int edge = 1;  ///< the current one; 1 leaves the camera
  Rgb throughput{1, 1, 1};
  Rgb flux{1, 1, 1};                     ///< throughput without eta^2, for roulette
  PathFootprint<>* footprint = nullptr;  ///< null: carries none
  Real sceneSize = 0;                    ///< known if there is a footprint
  PathReport report;

  /// A scattering that the footprint has not followed yet. Pending until the next hit, because half
  /// of all rays never need it.
  struct Pending {
    const Vertex* at = nullptr;  ///< null: nothing is pending
    Scatter scattered{};
    ScatterNumbers numbers{};
    int siblings = 1;
  } pending;

  EyePath() = default;
  explicit EyePath(PathContext& c) noexcept
      : ray(c.ray), drawn{.from = {c.ray.origin}}, stream{c.sampler.index()}, report(c) {}

  /// Starts to carry a footprint, which must outlive the path.
  void carry(PathFootprint<>& f, const PathContext& c, const FootprintSettings& settings) noexcept {
    f.begin(c, settings);
    footprint = &f;
    sceneSize = sizeOf(c.scene);
  }
  void arrive(const Surface& s) noexcept {
    if (!footprint) return;
    catchUp();
    footprint->arrive(s, sceneSize);
  }
  /// Takes the footprint through the pending scattering.
  void catchUp() noexcept {
    if (footprint && pending.at)
      footprint->scatter(pending.at->s, pending.at->x, pending.scattered, pending.numbers,
                         squareStrata(pending.siblings));
    pending.at = nullptr;
  }
  /// Counts what is absorbed between the origin of the ray and the next surface, or infinity.
  void absorb(const SceneView& scene, Real distance) noexcept {
    if (ray.media.isEmpty()) return;
    const Rgb share = scene.mediumTransmittance(ray, distance);
    throughput *= share;
    flux *= share;
  }
  /// A discrete choice that the path survived, with its probability.
  void chance(Real probability) noexcept {
    if (footprint) footprint->chance(probability);
  }

  /// Number of the vertex at the end of the current edge.
  std::uint32_t vertex() const noexcept { return stream.vertex(edge); }
  /// A random number at that vertex; `offset`: of its dimension there.
  Real number(const Sampler& s, std::uint32_t offset) const noexcept {
    return s.number(dimension::vertex(vertex()) + offset, stream.index);
  }
  ScatterNumbers scatterNumbers(const Sampler& s, const Interaction& x) const noexcept {
    return vestige::scatterNumbers(s, x, vertex(), stream.index);
  }

  /// Leaves a vertex along a drawn ray, one of `siblings`.
  void leave(const Vertex& v, const Scatter& next, int siblings) noexcept {
    throughput *= next.weight;
    flux *= next.local.weight;
    drawn.from = v.x.receiver;
    drawn.density = next.local.specular ? kInfinity : Real(siblings) * next.local.pdf;
    ray = spawnRay(v.s, next.toNext, kindOf(next.local));
  }

  /// Russian roulette. False: the path ends.
  bool survives(Real u) noexcept {
    const Real survival = survivalProbability(flux);
    if (!(u < survival)) return false;
    chance(survival);
    throughput = throughput / survival;
    flux = flux / survival;
    return true;
  }
};

/// Limits what light brings at once that came along more than two edges, and counts how often.
struct IndirectClamp {
  Real most = kInfinity;

  Rgb operator()(PathContext& c, int edges, Rgb light) const noexcept {
    if (edges <= 2 || !(maxComponent(light) > most)) return light;
    ++c.counters.clampedIndirect;
    return most / maxComponent(light) * light;
  }
};

struct WalkRules {
  int lastEdge = 0;  ///< at its end only the opacity is looked up; 0: there is no such edge
  IndirectClamp clamp = {};
  std::uint32_t maxLayers = kMaxLayers;
};

/// Passes through the surface if chance says so. False: the path scatters there.
inline bool passes(PathContext& c, EyePath& path, const Vertex& v, std::uint32_t layer) noexcept {
  const Passage p =
      meetLayer(c.sampler, path.vertex(), layer, path.stream.index, v.x.opacity, path.throughput);
  path.chance(p.chance);
  if (!p.stays) path.report.end(v.s, v.x.toPrev, path.throughput, "pass", path.footprint);
  path.throughput *= p.weight;
  path.flux *= p.weight;
  if (!p.stays) path.ray = spawnRay(v.s, path.ray.direction, path.ray.kind);
  return !p.stays;
}

/// Radiance of the lights at infinity, for a ray that left the scene.
inline Rgb escaped(PathContext& c, EyePath& path) noexcept {
  if (path.drawn.isUnrivalled()) path.catchUp();
  path.report.gone("escape", path.ray.direction, path.throughput);
  return path.throughput *
         filteredBackground(c.scene, path.drawn, path.ray.direction, path.footprint);
}

/// Follows a path to the surface where it scatters, through any number of transparent layers. Adds
/// the radiance met on the way. False: the path left the scene, or the radiance is kEndless after
/// `maxLayers`.
inline bool walk(PathContext& c, EyePath& path, Vertex& v, Rgb& radiance,
                 const WalkRules& rules = {}) noexcept {
  for (std::uint32_t layer = 0; layer < rules.maxLayers; ++layer) {
    ++c.counters.rays;
    const bool isMet = c.scene.intersect(path.ray, v.s);
    path.absorb(c.scene, isMet ? v.s.distance : kInfinity);
    if (!isMet) {
      radiance += rules.clamp(c, path.edge, escaped(c, path));
      return false;
    }
    path.arrive(v.s);
    radiance += rules.clamp(c, path.edge, path.throughput * metLight(c.scene, v.s, path.drawn));
    const Vec3 toPrev = -path.ray.direction;
    if (path.edge > 1 && path.edge == rules.lastEdge)
      lastSurface(c.scene, v.s, toPrev, v.x);
    else
      c.scene.shade(v.s, toPrev, regionAt(c.scene, v.s, path.footprint), v.inputs, v.x);
    if (isOpaque(v.x.opacity) || !passes(c, path, v, layer)) return true;
  }
  radiance = kEndless;
  return false;
}

}  // namespace vestige
