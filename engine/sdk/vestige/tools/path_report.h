// SPDX-License-Identifier: Apache-2.0
// Reports on a path under way: footprint AOVs, and the record that `inspect` prints and the window
// draws. Costs nothing if neither is requested.
#pragma once
#include <vestige/footprint.h>
#include <vestige/tools/direct_light.h>

namespace vestige {

/// Whether this path needs differentials at all.
inline bool carriesFootprint(const PathContext& c, const FootprintSettings& settings) noexcept {
  return settings.isOn() && (c.wantsFootprint || c.record || c.scene.usesFootprints());
}

/// The region over which shade() looks textures up; empty where the path carries no footprint or
/// the material uses none.
template <int Lanes>
Footprint regionAt(const SceneView& scene, const Surface& s,
                   const PathFootprint<Lanes>* f) noexcept {
  return f && scene.usesFootprint(s) ? f->footprint() : Footprint{};
}

/// Whether the last edge of a path, once drawn, still needs its footprint. No texture is evaluated
/// at its end, so only filtered emission after a specular event, an AOV or `inspect` needs it.
inline bool lastEdgeCarries(const PathContext& c, const Scatter& drawn) noexcept {
  return drawn.local.specular || c.record || c.wantsFootprint;
}

/// The radiance of the lights at infinity, filtered over the directions that the path stands for.
/// Not filtered where next-event estimation competes, because that evaluates them at a point [MATH
/// T7].
template <int Lanes>
Rgb filteredBackground(const SceneView& scene, const DrawnRay& ray, Vec3 direction,
                       const PathFootprint<Lanes>* f) noexcept {
  if (!f || !ray.isUnrivalled()) return background(scene, ray, direction);
  Vec3 spread[2];
  f->directions(spread);
  return background(scene, ray, direction, spread);
}

/// Direct light where the connection's own gradient limits the footprint: draws the light first,
/// then shades the surface again over the limited footprint.
template <int Lanes>
[[gnu::noinline]] Rgb limitedDirectLight(PathContext& c, const Surface& s, const Interaction& x,
                                         std::uint32_t vertex, std::uint32_t index, Real samples,
                                         Real scattered, const PathFootprint<Lanes>& f) noexcept {
  const Receiver& receiver = x.receiver;
  const TowardsLight towards = drawLight(c, receiver, vertex, index);
  if (!x.brdf || !towards.sample) return {};
  const LightHit& hit = towards.sample->hit;
  // The logarithm of f has no slope where f is 0.
  if (isBlack(evaluateScatter(x, hit.toLight).fCos) || isBlack(towards.sample->radiance)) return {};
  const PathFootprint<Lanes> connected =
      f.connected(s, x, hit, towards.light->sampleDerivatives(receiver, towards.u),
                  towards.light->logGradient(receiver, towards.u));
  InputBuffer inputs;
  Interaction again;
  c.scene.shade(s, x.toPrev, connected.footprint(), inputs, again);
  return reflectedLight(c, s, again, towards, samples, scattered);
}

/// directLight() of a path that may carry a footprint.
template <int Lanes>
Rgb directLight(PathContext& c, const Surface& s, const Interaction& x, std::uint32_t vertex,
                std::uint32_t index, Real samples, Real scattered,
                const PathFootprint<Lanes>* f) noexcept {
  if (f && f->heedsLight() && c.scene.usesFootprint(s))
    return limitedDirectLight(c, s, x, vertex, index, samples, scattered, *f);
  return directLight(c, s, x, vertex, index, samples, scattered);
}

/// Diameter of all finite objects; infinite where there are none.
inline Real sizeOf(const SceneView& scene) noexcept {
  const Bounds b = scene.bounds();
  return b.isEmpty() ? kInfinity : length(b.size());
}

/// Side of the square that has the area of the parallelogram of a footprint.
inline Real sideOf(const Footprint& f) noexcept {
  return std::sqrt(length(cross(f.dP[0], f.dP[1])));
}
/// The same in texels.
inline Real texelSideOf(const Footprint& f, Vec2 texels) noexcept {
  return std::sqrt(std::abs(cross(f.dUv[0], f.dUv[1])) * texels.x * texels.y);
}

/// The same ellipse given by its axes, the longer one first, as people read it.
inline Footprint principal(const Footprint& f) noexcept {
  const Vec3 n = cross(f.dP[0], f.dP[1]);
  const Frame frame = Frame::around(lengthSquared(n) > 0 ? normalize(n) : Vec3{0, 0, 1});
  const auto flat = [&](Vec3 v) { return Vec2{dot(v, frame.s), dot(v, frame.t)}; };
  Covariance m;
  m.add(flat(f.dP[0]));
  m.add(flat(f.dP[1]));
  const Real det = cross(flat(f.dP[0]), flat(f.dP[1]));
  if (det == 0) return f;  // a line, or a point
  const Region r = ellipse(m);
  Footprint result;
  const Vec2 axes[2] = {r.a, r.b};
  for (int i = 0; i < 2; ++i) {
    result.dP[i] = axes[i].x * frame.s + axes[i].y * frame.t;
    // The same linear combination of the two vectors, in uv.
    const Real a = cross(axes[i], flat(f.dP[1])) / det, b = cross(flat(f.dP[0]), axes[i]) / det;
    result.dUv[i] = a * f.dUv[0] + b * f.dUv[1];
  }
  return result;
}

class PathReport {
 public:
  /// A report that discards everything.
  PathReport() = default;
  explicit PathReport(PathContext& c) noexcept
      : scene_(&c.scene), aovs_(c.wantsFootprint ? c.aovs : nullptr), record_(c.record) {}

  /// Records a scattering at a surface. Call it before PathFootprint::scatter().
  template <int Lanes>
  void scatter(const Surface& s, Vec3 toPrev, Rgb throughput, const Scatter& drawn,
               const PathFootprint<Lanes>* f) noexcept {
    if (record_) record_->add(vertex(s, toPrev, throughput, "scatter", f, drawn.local));
    if (!aovs_ || !f || drawn.local.specular) return;
    see(s, *f);
    isWaiting_ = true;
  }
  /// The path ends at a surface with precomputed irradiance, which the AOVs treat as a scattering.
  template <int Lanes>
  void rest(const Surface& s, Vec3 toPrev, Rgb throughput, const PathFootprint<Lanes>* f) noexcept {
    end(s, toPrev, throughput, "end", f);
    if (!aovs_ || !f) return;
    see(s, *f);
    aovs_ = nullptr;
  }
  /// Whether an AOV needs the footprint behind the scattering.
  bool isWaiting() const noexcept { return isWaiting_; }
  /// Call it after PathFootprint::scatter().
  template <int Lanes>
  void left(const PathFootprint<Lanes>* f) noexcept {
    if (!isWaiting_) return;
    aovs_->gradient = f->steepest();
    // The AOV holds the first scattering only.
    aovs_ = nullptr;
    isWaiting_ = false;
  }

  /// Records that the path passed through a surface, or ended there.
  template <int Lanes>
  void end(const Surface& s, Vec3 toPrev, Rgb throughput, const char* event,
           const PathFootprint<Lanes>* f) noexcept {
    if (record_) record_->add(vertex(s, toPrev, throughput, event, f, std::nullopt));
  }

  /// Records that the path left the scene ("escape"), or was ended by roulette ("roulette").
  void gone(const char* event, Vec3 direction, Rgb throughput) noexcept {
    if (!record_) return;
    PathVertex v;
    v.toPrev = -direction;
    v.throughput = throughput;
    v.event = event;
    record_->add(v);
  }

 private:
  template <int Lanes>
  void see(const Surface& s, const PathFootprint<Lanes>& f) noexcept {
    const Footprint region = f.footprint();
    aovs_->footprint = sideOf(region);
    aovs_->footprintTexels = texelSideOf(region, scene_->texels(s));
  }

  template <int Lanes>
  PathVertex vertex(const Surface& s, Vec3 toPrev, Rgb throughput, const char* event,
                    const PathFootprint<Lanes>* f,
                    const std::optional<ScatterSample>& scattered) const noexcept {
    PathVertex v;
    v.surface = s;
    v.toPrev = toPrev;
    v.throughput = throughput;
    v.event = event;
    v.scattered = scattered;
    v.texels = scene_->texels(s);
    if (!f) return v;
    VertexDifferentials& d = v.differentials;
    d.size = std::min(f->differentials().size(), VertexDifferentials::kMost);
    for (int j = 0; j < d.size; ++j) {
      d.dVertex[j] = f->differentials().dVertex(j);
      d.dDirection[j] = f->differentials().dDirection(j);
      d.gradient[j] = f->differentials().gradient(j);
      d.delta[j] = f->delta(j);
    }
    d.count = f->count();
    d.footprint = principal(f->footprint());
    d.area = f->area();
    return v;
  }

  const SceneView* scene_ = nullptr;
  Aovs* aovs_ = nullptr;
  PathRecord* record_ = nullptr;
  bool isWaiting_ = false;
};

}  // namespace vestige
