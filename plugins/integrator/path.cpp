// SPDX-License-Identifier: Apache-2.0
// Path tracing: next-event estimation and scattering, combined by multiple importance sampling;
// Russian roulette. Paths carry their footprint where a texture looks at it.
//
// [Kaj86] Kajiya. The rendering equation. SIGGRAPH 1986.
// [Vea97] Veach. Robust Monte Carlo methods for light transport simulation. PhD thesis, 1997.
#include <vestige/footprint.h>
#include <vestige/path_report.h>
#include <vestige/plugin.h>
#include <vestige/sampling.h>

namespace vestige {
namespace {

/// Roulette starts after this many scatterings; before, paths are too valuable.
constexpr int kRouletteFrom = 3;
/// Nobody survives for certain: a closed room of white walls still ends.
constexpr Real kMaxSurvival = Real(0.95);
/// Passing through this many layers without scattering ends a path, as it blocks a shadow ray.
constexpr int kMaxLayers = 64;

/// A path under way.
struct Path {
  Ray ray;
  Vec3 from;  ///< last scattering point: what light densities are asked from
  Rgb throughput{1, 1, 1};
  Rgb flux{1, 1, 1};     ///< throughput without eta^2: what roulette decides by
  Real pdf = kInfinity;  ///< of ray.direction, 1/sr; infinite after the camera and specular events
  PathFootprint<>* footprint = nullptr;  ///< null: carries none
  Real sceneSize = 0;
  PathReport report;

  Footprint region() const noexcept { return footprint ? footprint->footprint() : Footprint{}; }
  void chance(Real probability) noexcept {
    if (footprint) footprint->chance(probability);
  }
};

class PathIntegrator final : public Integrator {
 public:
  enum Param { kSamples, kDepth, kFootprint };

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
                    .doc("how large a region of a texture a path looks at (safe)")}};
  }

  explicit PathIntegrator(const Values& v)
      : samples_(int(v.integer(kSamples))),
        depth_(int(v.integer(kDepth))),
        footprint_(footprintSettings(v.block(kFootprint), Bound::global)) {}

  int samples() const noexcept override { return samples_; }

  Rgb estimate(PathContext& context) const noexcept override {
    Path path{.ray = context.ray, .from = context.ray.origin, .report = PathReport(context)};
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
      radiance += path.throughput * directLight(context, *hit, x, edge);
      if (!scatter(context, path, *hit, x, edge)) break;
    }
    return radiance;
  }

  /// Follows the ray to the surface where it scatters; adds what shines on the way. nullopt: it
  /// left the scene.
  static std::optional<Surface> nextSurface(PathContext& c, Path& path, int edge,
                                            InputBuffer& buffer, Interaction& x,
                                            Rgb& radiance) noexcept {
    for (int layer = 0; layer < kMaxLayers; ++layer) {
      ++c.counters.rays;
      const std::optional<Surface> hit = c.scene.intersect(path.ray);
      if (!hit) {
        radiance += path.throughput * background(c.scene, path);
        path.report.escape(path.ray.direction, path.throughput);
        return std::nullopt;
      }
      if (path.footprint) path.footprint->arrive(path.ray.direction, *hit, path.sceneSize);
      if (hit->light >= 0)
        radiance += path.throughput * misWeight(path.pdf, c.scene.lightPdf(*hit, path.from)) *
                    c.scene.emitted(*hit, path.from);
      x = c.scene.shade(*hit, -path.ray.direction, path.region(), buffer);
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

  static Real misWeight(Real scatterDensity, Real lightDensity) noexcept {
    return powerHeuristic(scatterDensity, lightDensity);
  }

  static Rgb background(const SceneView& scene, const Path& path) noexcept {
    Rgb sum;
    for (const int i : scene.infiniteLights()) {
      const Light& light = *scene.lights()[std::size_t(i)];
      const LightHit hit{path.from, path.ray.direction, kInfinity, {}, {}, {}};
      sum += misWeight(path.pdf, scene.lightChance(i) * light.pdf(hit)) * light.eval(hit);
    }
    return sum;
  }

  /// Next-event estimation: one light, one point of it [Vea97 9.2].
  static Rgb directLight(PathContext& c, const Surface& s, const Interaction& x,
                         int edge) noexcept {
    const std::uint32_t dim = dimension::vertex(edge - 1);
    const auto choice = c.scene.chooseLight(c.sampler.number(dim + dimension::kLightChoice));
    if (!choice || !x.brdf) return {};
    const Light& light = *c.scene.lights()[std::size_t(choice->light)];
    const auto drawn = light.sample(s.position, c.sampler.pair(dim + dimension::kLight));
    if (!drawn) return {};
    const Rgb f = evalScatter(x, drawn->hit.toLight);
    if (isBlack(f) || isBlack(drawn->radiance)) return {};
    ++c.counters.shadowRays;
    const Real visible =
        c.scene.transmittance(shadowRay(s, drawn->hit.toLight, drawn->hit.distance));
    if (visible == 0) return {};
    const Real density = choice->chance * drawn->pdf;
    const Real weight =
        light.isDelta() ? 1 : powerHeuristic(density, scatterPdf(x, drawn->hit.toLight));
    return (visible * weight / density) * f * drawn->radiance;
  }

  /// Draws the next ray; false where the path ends.
  static bool scatter(PathContext& c, Path& path, const Surface& s, const Interaction& x,
                      int edge) noexcept {
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
    if (path.footprint) path.footprint->scatter(s, x, *next, numbers);
    path.report.left(path.footprint);
    path.throughput *= next->weight;
    path.flux *= next->local.weight;
    path.pdf = next->local.specular ? kInfinity : next->local.pdf;
    path.from = s.position;
    path.ray = spawnRay(s, next->toNext);
    return !isBlack(path.throughput) &&
           (edge < kRouletteFrom || survives(path, c.sampler.number(dim + dimension::kRoulette)));
  }

  /// Russian roulette by what is left of the flux.
  static bool survives(Path& path, Real u) noexcept {
    const Real survival = std::min(kMaxSurvival, maxComponent(path.flux));
    if (!(u < survival)) return false;
    path.chance(survival);
    path.throughput = path.throughput / survival;
    path.flux = path.flux / survival;
    return true;
  }

  int samples_, depth_;
  FootprintSettings footprint_;
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Integrator, vestige::PathIntegrator)
