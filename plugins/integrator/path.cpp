// SPDX-License-Identifier: Apache-2.0
// Path tracing: next-event estimation and scattering, combined by multiple importance sampling;
// Russian roulette. Paths carry their footprint where a texture looks at it.
//
// [Kaj86] Kajiya. The rendering equation. SIGGRAPH 1986.
// [Vea97] Veach. Robust Monte Carlo methods for light transport simulation. PhD thesis, 1997.
#include <vestige/direct_light.h>
#include <vestige/path_report.h>
#include <vestige/plugin.h>

namespace vestige {
namespace {

/// Roulette starts after this many scatterings; before, paths are too valuable.
constexpr int kRouletteFrom = 4;
/// Nobody survives for certain: a closed room of white walls still ends.
constexpr Real kMaxSurvival = Real(0.95);
/// Passing through this many layers without scattering ends a path, as it blocks a shadow ray.
constexpr int kMaxLayers = 64;

/// A path under way.
struct Path {
  Ray ray;
  DrawnRay drawn;
  Rgb throughput{1, 1, 1};
  Rgb flux{1, 1, 1};                     ///< throughput without eta^2: what roulette decides by
  PathFootprint<>* footprint = nullptr;  ///< null: carries none
  Real sceneSize = 0;
  PathReport report;

  void chance(Real probability) noexcept {
    if (footprint) footprint->chance(probability);
  }
};

class PathIntegrator final : public Integrator {
 public:
  enum Param { kSamples, kDepth, kFootprint, kClamp };

  static Schema schema() {
    return {.kind = "integrator",
            .name = "path",
            .summary = "path tracing with next-event estimation and multiple importance sampling",
            .params = {
                integer("samples", 16).range(1, 1 << 24).doc("paths a pixel"),
                integer("depth", 16)
                    .range(1, 4096)
                    .doc("longest path in edges from the camera: 1 sees emitters, 2 direct light"),
                block("footprint", "footprint")
                    .doc("how large a region of a texture a path looks at (safe)"),
                real("clamp", 0)
                    .unset()
                    .range(1e-6, 1e12)
                    .in("W/(m^2 sr)")
                    .doc("most that light of more than two edges may bring at once: fewer specks, "
                         "and too little light; default: no limit")}};
  }

  explicit PathIntegrator(const Values& v)
      : samples_(int(v.integer(kSamples))),
        depth_(int(v.integer(kDepth))),
        footprint_(footprintSettings(v.block(kFootprint), Bound::global)),
        clamp_(v.has(kClamp) ? v.real(kClamp) : kInfinity) {}

  int samples() const noexcept override { return samples_; }

  Rgb estimate(PathContext& context) const noexcept override {
    Path path{.ray = context.ray, .drawn = {context.ray.origin}, .report = PathReport(context)};
    if (!carriesFootprint(context, footprint_)) return trace(context, path);
    PathFootprint<> footprint;
    footprint.begin(context, footprint_);
    path.footprint = &footprint, path.sceneSize = sizeOf(context.scene);
    return trace(context, path);
  }

 private:
  Rgb trace(PathContext& context, Path& path) const noexcept {
    Rgb radiance;
    for (int edge = 1; edge <= depth_; ++edge) {
      InputBuffer buffer;
      Interaction x;
      const std::optional<Surface> hit = nextSurface(context, path, edge, buffer, x, radiance);
      if (!hit) break;
      if (edge == 1 && context.aovs) writeAovs(*context.aovs, *hit, x);
      if (edge == depth_) {
        path.report.end(*hit, x.toPrev, path.throughput, "end", path.footprint);
        break;
      }
      radiance += clamped(context, edge + 1,
                          path.throughput * directLight(context, *hit, x, std::uint32_t(edge - 1),
                                                        context.sampler.index()));
      if (!scatter(context, path, *hit, x, edge)) break;
    }
    return radiance;
  }

  /// Follows the ray to the surface where it scatters; adds what shines on the way. nullopt: it
  /// left the scene.
  std::optional<Surface> nextSurface(PathContext& c, Path& path, int edge, InputBuffer& buffer,
                                     Interaction& x, Rgb& radiance) const noexcept {
    for (int layer = 0; layer < kMaxLayers; ++layer) {
      ++c.counters.rays;
      const std::optional<Surface> hit = c.scene.intersect(path.ray);
      if (!hit) {
        radiance +=
            clamped(c, edge,
                    path.throughput * filteredBackground(c.scene, path.drawn, path.ray.direction,
                                                         path.footprint));
        path.report.gone("escape", path.ray.direction, path.throughput);
        return std::nullopt;
      }
      if (path.footprint) path.footprint->arrive(*hit, path.sceneSize);
      radiance += clamped(c, edge, path.throughput * metLight(c.scene, *hit, path.drawn));
      const Vec3 toPrev = -path.ray.direction;
      x = edge > 1 && edge == depth_
              ? lastSurface(c.scene, *hit, toPrev)
              : c.scene.shade(*hit, toPrev, regionAt(c.scene, *hit, path.footprint), buffer);
      const std::uint32_t dim = dimension::vertex(edge - 1) + dimension::kOpacity;
      // Layers beyond the first have numbers of their own, far from those of any vertex.
      if (x.opacity >= 1) return hit;
      const bool stays = c.sampler.number(dim + 0x10000u * layer) < x.opacity;
      path.chance(stays ? x.opacity : 1 - x.opacity);
      if (stays) return hit;
      path.report.end(*hit, x.toPrev, path.throughput, "pass", path.footprint);
      path.ray = spawnRay(*hit, path.ray.direction);
    }
    return std::nullopt;
  }

  /// What light brings that came along so many edges, cut down to the scene's `clamp`.
  Rgb clamped(PathContext& c, int edges, Rgb light) const noexcept {
    if (edges <= 2 || !(maxComponent(light) > clamp_)) return light;
    ++c.counters.clampedIndirect;
    return clamp_ / maxComponent(light) * light;
  }

  /// Draws the next ray; false where the path ends.
  bool scatter(PathContext& c, Path& path, const Surface& s, const Interaction& x,
               int edge) const noexcept {
    const std::uint32_t dim = dimension::vertex(edge - 1);
    const ScatterNumbers numbers{c.sampler.number(dim + dimension::kLobe),
                                 c.sampler.pair(dim + dimension::kDirection)};
    const std::optional<Scatter> next = drawScatter(x, numbers);
    if (edge == 1 && c.aovs && next) c.aovs->albedo = next->local.weight;
    if (!next) {
      path.report.end(s, x.toPrev, path.throughput, "absorbed", path.footprint);
      return false;
    }
    path.report.scatter(s, x.toPrev, path.throughput, *next, path.footprint);
    path.throughput *= next->weight;
    path.flux *= next->local.weight;
    path.drawn = {s.position, next->local.specular ? kInfinity : next->local.pdf};
    path.ray = spawnRay(s, next->toNext);
    const bool goesOn =
        !isBlack(path.throughput) &&
        (edge < kRouletteFrom || survives(path, c.sampler.number(dim + dimension::kRoulette)));
    if (edge + 1 == depth_ && !lastEdgeCarries(c, *next)) path.footprint = nullptr;
    if (path.footprint && (goesOn || path.report.isWaiting()))
      path.footprint->scatter(s, x, *next, numbers);
    path.report.left(path.footprint);
    if (!goesOn) path.report.gone("roulette", next->toNext, path.throughput);
    return goesOn;
  }

  /// Russian roulette by the root of what is left of the flux: by the flux itself the few that
  /// survive weigh so much that cornell's noise, times its cost, is a fifth larger.
  static bool survives(Path& path, Real u) noexcept {
    const Real survival = std::min(kMaxSurvival, std::sqrt(maxComponent(path.flux)));
    if (!(u < survival)) return false;
    path.chance(survival);
    path.throughput = path.throughput / survival;
    path.flux = path.flux / survival;
    return true;
  }

  int samples_, depth_;
  FootprintSettings footprint_;
  Real clamp_;  ///< infinite: none
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Integrator, vestige::PathIntegrator)
