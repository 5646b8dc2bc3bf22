// SPDX-License-Identifier: Apache-2.0
// Path tracing: next-event estimation and scattering, combined by multiple importance sampling;
// Russian roulette. Paths carry their footprint where a texture looks at it.
//
// [Kaj86] Kajiya. The rendering equation. SIGGRAPH 1986.
// [Vea97] Veach. Robust Monte Carlo methods for light transport simulation. PhD thesis, 1997.
#include <vestige/direct_light.h>
#include <vestige/path_report.h>
#include <vestige/plugin.h>

#include <optional>
#include <utility>

namespace vestige {
namespace {

/// Roulette starts with this scattering; before, paths are too valuable.
constexpr int kRouletteFrom = 4;
/// Nobody survives for certain: a closed room of white walls still ends.
constexpr Real kMaxSurvival = Real(0.95);
/// Passing through this many layers without scattering ends a path: it does not get ahead.
constexpr int kMaxLayers = 1 << 15;

constexpr int kMaxSplit = 256;
/// Of edges, and of scatterings of a kind; roulette ends all paths long before.
constexpr int kNoLimit = 4096;

/// Where a path scatters.
struct Vertex {
  Surface s;
  Interaction x;
  InputBuffer inputs;
};

/// The vertex that a path is at, and the one before.
using Vertices = Vertex[2];

/// A continuation as it was drawn, and the numbers it was drawn with.
struct Way {
  ScatterNumbers numbers;
  std::optional<Scatter> scatter;  ///< empty: absorbed
};

/// A path under way.
struct Path {
  Ray ray;
  DrawnRay drawn;
  std::uint32_t index = 0;  ///< of its numbers: the sample's; behind the split sample * rays + ray
  int edge = 1;             ///< under way, from the camera
  int rough = 0, specular = 0;  ///< scatterings so far
  int rays = 1;                 ///< into which it is still to split
  bool hasForked = false;       ///< went both ways inside ground glass
  Rgb throughput{1, 1, 1};
  Rgb flux{1, 1, 1};                     ///< throughput without eta^2: what roulette decides by
  PathFootprint<>* footprint = nullptr;  ///< null: carries none
  Real sceneSize = 0;
  PathReport report;

  /// The last scattering, as long as the footprint has not gone through it: half of all rays leave
  /// the scene or meet a light, and nobody asks. Null: it has.
  const Vertex* scatteredAt = nullptr;
  Scatter scattered{};
  ScatterNumbers numbers{};
  int siblings = 1;

  void arrive(const Surface& s) noexcept {
    if (!footprint) return;
    catchUp();
    footprint->arrive(s, sceneSize);
  }
  void catchUp() noexcept {
    if (footprint && scatteredAt)
      footprint->scatter(scatteredAt->s, scatteredAt->x, scattered, numbers,
                         squareStrata(siblings));
    scatteredAt = nullptr;
  }

  void chance(Real probability) noexcept {
    if (footprint) footprint->chance(probability);
  }
};

class PathIntegrator final : public Integrator {
 public:
  enum Param { kSamples, kSplit, kDepth, kRoughDepth, kSpecularDepth, kFootprint, kClamp };

  static Schema schema() {
    return {.kind = "integrator",
            .name = "path",
            .summary = "path tracing with next-event estimation and multiple importance sampling",
            .params = {
                integer("samples", 16).range(1, 1 << 24).doc("paths a pixel"),
                integer("split", 1)
                    .range(1, kMaxSplit)
                    .doc("rays from where a path first scatters: what it sees directly is quiet "
                         "long before what is lit by others"),
                integer("depth", 16)
                    .range(1, kNoLimit)
                    .doc("longest path in edges from the camera: 1 sees emitters, 2 direct light"),
                integer("rough_depth", kNoLimit)
                    .range(0, kNoLimit)
                    .doc("most scatterings that are not specular: 0 leaves emitters, 1 direct "
                         "light, 2 one bounce"),
                integer("specular_depth", kNoLimit)
                    .range(0, kNoLimit)
                    .doc("most mirrors and smooth glass surfaces on the way"),
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
        split_(int(v.integer(kSplit))),
        depth_(int(v.integer(kDepth))),
        roughDepth_(int(v.integer(kRoughDepth))),
        specularDepth_(int(v.integer(kSpecularDepth))),
        footprint_(footprintSettings(v.block(kFootprint), Bound::global)),
        clamp_(v.has(kClamp) ? v.real(kClamp) : kInfinity) {}

  int samples() const noexcept override { return samples_; }

  Rgb estimate(PathContext& context) const noexcept override {
    Path path{.ray = context.ray,
              .drawn = {context.ray.origin},
              .index = context.sampler.index(),
              .rays = split_,
              .report = PathReport(context)};
    Vertices vertices;
    if (!carriesFootprint(context, footprint_)) return trace(context, path, vertices);
    PathFootprint<> footprint;
    footprint.begin(context, footprint_);
    path.footprint = &footprint, path.sceneSize = sizeOf(context.scene);
    return trace(context, path, vertices);
  }

 private:
  Rgb trace(PathContext& c, Path& path, Vertices& vertices) const noexcept {
    Rgb radiance;
    for (; path.edge <= depth_; ++path.edge) {
      Vertex& v = vertices[path.edge % 2];
      if (!next(c, path, v, radiance)) break;
      if (path.edge == 1 && c.aovs) writeAovs(*c.aovs, v.s, v.x);
      if (path.edge == depth_) {
        path.report.end(v.s, v.x.toPrev, path.throughput, "end", path.footprint);
        break;
      }
      if (path.rough < roughDepth_) radiance += direct(c, path, v);
      if (path.rays > 1) return radiance + split(c, path, v);
      const Way way = draw(c, path, v);
      if (!path.hasForked)
        if (const auto other = otherWay(v, way)) return radiance + fork(c, path, v, way, *other);
      if (!scatter(c, path, v, way)) break;
    }
    return radiance;
  }

  Rgb direct(PathContext& c, const Path& path, const Vertex& v) const noexcept {
    const auto vertex = std::uint32_t(path.edge - 1);
    return clamped(c, path.edge + 1,
                   path.throughput * directLight(c, v.s, v.x, vertex, path.index, 1,
                                                 Real(path.rays), path.footprint));
  }

  /// The mean of what comes along several rays from here.
  Rgb split(PathContext& c, const Path& path, const Vertex& v) const noexcept {
    Rgb sum;
    Vertices vertices;
    for (int i = 0; i < path.rays; ++i) {
      Path ray = path;
      ray.index = path.index * std::uint32_t(path.rays) + std::uint32_t(i);
      std::optional<PathFootprint<>> footprint;
      if (path.footprint) ray.footprint = &footprint.emplace(*path.footprint);
      if (i > 0) ray.report = PathReport();  // the first is told
      const bool goesOn = scatter(c, ray, v, draw(c, ray, v));
      // A mirror leaves no choice: one ray stands for all, and splits where it comes to.
      const bool isOnly = i == 0 && ray.rays > 1;
      if (isOnly) ray.index = path.index;
      ++ray.edge;
      if (goesOn) sum += trace(c, ray, vertices);
      if (isOnly) return sum;
    }
    return sum / Real(path.rays);
  }

  /// The other way on, where ground glass is met from inside: one ray of 25 is reflected
  /// there, and may bring all of a lamp. Empty: there are not just these two ways. Whether there
  /// are depends on what moved `way`, not on which of the two it is.
  static std::optional<Way> otherWay(const Vertex& v, const Way& way) noexcept {
    if (!v.x.point.inside || !way.scatter || way.scatter->local.specular) return std::nullopt;
    const ScatterSample& drawn = way.scatter->local;
    if (!(drawn.lobeChance < 1)) return std::nullopt;
    constexpr Real kFirst = 0, kLast = Real(0x1.fffffep-1);
    for (const Real lobe : {kFirst, kLast}) {
      const ScatterNumbers numbers{lobe, way.numbers.u};
      const Way other{numbers, drawScatter(v.x, numbers)};
      if (!other.scatter) return std::nullopt;
      const ScatterSample& found = other.scatter->local;
      if (found.lobe == drawn.lobe) continue;
      if (found.specular || (found.toNext.z > 0) == (drawn.toNext.z > 0)) return std::nullopt;
      const bool areAll = std::abs(drawn.lobeChance + found.lobeChance - 1) < Real(1e-4);
      return areAll ? std::optional(other) : std::nullopt;
    }
    return std::nullopt;
  }

  /// What comes along both ways: neither is left to chance.
  Rgb fork(PathContext& c, const Path& path, const Vertex& v, const Way& drawn,
           const Way& other) const noexcept {
    Rgb sum;
    Vertices vertices;
    for (const Way* way : {&drawn, &other}) {
      Path branch = path;
      branch.hasForked = true;
      std::optional<PathFootprint<>> footprint;
      if (path.footprint) branch.footprint = &footprint.emplace(*path.footprint);
      if (way == &other) branch.report = PathReport();
      Way certain = *way;
      Scatter& s = *certain.scatter;
      const Real chance = std::exchange(s.local.lobeChance, 1);
      s.weight = chance * s.weight, s.local.weight = chance * s.local.weight;
      const bool goesOn = scatter(c, branch, v, certain);
      ++branch.edge;
      if (goesOn) sum += trace(c, branch, vertices);
    }
    return sum;
  }

  /// Follows the ray to the surface where it scatters; adds what shines on the way. False: it left
  /// the scene.
  bool next(PathContext& c, Path& path, Vertex& v, Rgb& radiance) const noexcept {
    for (int layer = 0; layer < kMaxLayers; ++layer) {
      ++c.counters.rays;
      if (!c.scene.intersect(path.ray, v.s)) {
        if (path.drawn.isUnrivalled()) path.catchUp();
        radiance +=
            clamped(c, path.edge,
                    path.throughput * filteredBackground(c.scene, path.drawn, path.ray.direction,
                                                         path.footprint));
        path.report.gone("escape", path.ray.direction, path.throughput);
        return false;
      }
      path.arrive(v.s);
      radiance += clamped(c, path.edge, path.throughput * metLight(c.scene, v.s, path.drawn));
      const Vec3 toPrev = -path.ray.direction;
      if (path.edge > 1 && path.edge == depth_)
        lastSurface(c.scene, v.s, toPrev, v.x);
      else
        c.scene.shade(v.s, toPrev, regionAt(c.scene, v.s, path.footprint), v.inputs, v.x);
      if (isOpaque(v.x.opacity)) return true;
      const std::uint32_t dim = dimension::vertex(path.edge - 1) + dimension::kOpacity;
      // Layers beyond the first have numbers of their own, far from those of any vertex.
      const Passage passage = drawPassage(v.x.opacity, path.throughput,
                                          c.sampler.number(dim + 0x10000u * layer, path.index));
      path.chance(passage.chance);
      path.throughput *= passage.weight;
      path.flux *= passage.weight;
      if (passage.stays) return true;
      path.report.end(v.s, toPrev, path.throughput, "pass", path.footprint);
      path.ray = spawnRay(v.s, path.ray.direction, path.ray.kind);
    }
    return false;
  }

  /// What light brings that came along so many edges, cut down to the scene's `clamp`.
  Rgb clamped(PathContext& c, int edges, Rgb light) const noexcept {
    if (edges <= 2 || !(maxComponent(light) > clamp_)) return light;
    ++c.counters.clampedIndirect;
    return clamp_ / maxComponent(light) * light;
  }

  static Way draw(PathContext& c, const Path& path, const Vertex& v) noexcept {
    const std::uint32_t dim = dimension::vertex(path.edge - 1);
    const ScatterNumbers numbers{c.sampler.number(dim + dimension::kLobe, path.index),
                                 c.sampler.pair(dim + dimension::kDirection, path.index)};
    return {numbers, drawScatter(v.x, numbers)};
  }

  /// Takes that way, one of the split's unless there is no choice. False where the path ends.
  bool scatter(PathContext& c, Path& path, const Vertex& v, const Way& way) const noexcept {
    const std::optional<Scatter>& drawn = way.scatter;
    const bool isOnly = drawn && drawn->local.specular && drawn->local.lobeChance == 1;
    const int siblings = isOnly ? 1 : std::exchange(path.rays, 1);
    if (path.edge == 1 && c.aovs && drawn) c.aovs->albedo += drawn->local.weight / Real(siblings);
    if (!drawn || isTooMuch(path, drawn->local.specular)) {
      const char* event = drawn ? "end" : "absorbed";
      path.report.end(v.s, v.x.toPrev, path.throughput, event, path.footprint);
      return false;
    }
    path.report.scatter(v.s, v.x.toPrev, path.throughput, *drawn, path.footprint);
    path.throughput *= drawn->weight;
    path.flux *= drawn->local.weight;
    path.drawn.from = v.s.position;
    path.drawn.density = drawn->local.specular ? kInfinity : Real(siblings) * drawn->local.pdf;
    path.ray = spawnRay(v.s, drawn->toNext, kindOf(drawn->local));
    const bool goesOn =
        !isBlack(path.throughput) &&
        (path.edge < kRouletteFrom ||
         survives(path, c.sampler.number(dimension::vertex(path.edge - 1) + dimension::kRoulette,
                                         path.index)));
    if (path.edge + 1 == depth_ && !lastEdgeCarries(c, *drawn)) path.footprint = nullptr;
    if (path.footprint && (goesOn || path.report.isWaiting())) {
      path.scatteredAt = &v, path.scattered = *drawn;
      path.numbers = way.numbers, path.siblings = siblings;
    }
    if (path.report.isWaiting()) path.catchUp();
    path.report.left(path.footprint);
    if (!goesOn) path.report.gone("roulette", drawn->toNext, path.throughput);
    return goesOn;
  }

  /// Counts a scattering; true if its kind is used up.
  bool isTooMuch(Path& path, bool specular) const noexcept {
    return specular ? path.specular++ >= specularDepth_ : path.rough++ >= roughDepth_;
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

  int samples_, split_, depth_, roughDepth_, specularDepth_;
  FootprintSettings footprint_;
  Real clamp_;  ///< infinite: none
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Integrator, vestige::PathIntegrator)
