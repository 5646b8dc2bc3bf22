// SPDX-License-Identifier: Apache-2.0
// Path tracing with all that makes it efficient: next-event estimation and scattering combined by
// multiple importance sampling, Russian roulette, splitting at the first scattering, both lobes
// inside a rough dielectric, and footprints for filtered textures. `simple.cpp` is the same method
// without all this; read that first.
//
// [Kaj86] Kajiya. The rendering equation. SIGGRAPH 1986.
// [Vea97] Veach. Robust Monte Carlo methods for light transport simulation. PhD thesis, 1997.
#include <vestige/footprint/language.h>
#include <vestige/plugin.h>
#include <vestige/tools/path_walk.h>

#include <optional>
#include <utility>

namespace vestige {
namespace {

constexpr int kMaxSplit = 256;
/// Of edges, and of scatterings of a kind. Roulette ends all paths long before.
constexpr int kNoLimit = 4096;

/// The vertex that a path is at, and the one before.
using Vertices = Vertex[2];

/// A path under way.
struct Path : EyePath {
  using EyePath::EyePath;
  int rough = 0;           ///< scatterings so far that were not specular
  int specular = 0;        ///< specular scatterings so far
  int rays = 1;            ///< into which it splits at its first scattering that is not specular
  bool hasForked = false;  ///< followed both lobes inside a rough dielectric
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
        clamp_{v.has(kClamp) ? v.real(kClamp) : kInfinity} {}

  int samples() const noexcept override { return samples_; }

  Rgb estimate(PathContext& context) const noexcept override {
    Path path(context);
    path.rays = split_;
    Vertices vertices;
    if (!carriesFootprint(context, footprint_)) return trace(context, path, vertices);
    PathFootprint<> footprint;
    path.carry(footprint, context, footprint_);
    return trace(context, path, vertices);
  }

 private:
  Rgb trace(PathContext& c, Path& path, Vertices& vertices) const noexcept {
    Rgb radiance;
    for (; path.edge <= depth_; ++path.edge) {
      Vertex& v = vertices[path.edge % 2];
      if (!walk(c, path, v, radiance, {depth_, clamp_})) break;
      if (path.edge == 1 && c.aovs) writeAovs(*c.aovs, v.s, v.x);
      if (path.edge == depth_) {
        path.report.end(v.s, v.x.toPrev, path.throughput, "end", path.footprint);
        break;
      }
      if (path.rough < roughDepth_) radiance += direct(c, path, v);
      if (path.rays > 1) return radiance + split(c, path, v);
      const Continuation next = draw(c, path, v);
      if (!path.hasForked)
        if (const auto other = otherLobe(v.x, next))
          return radiance + fork(c, path, v, next, *other);
      if (!scatter(c, path, v, next)) break;
    }
    return radiance;
  }

  Rgb direct(PathContext& c, const Path& path, const Vertex& v) const noexcept {
    return clamp_(c, path.edge + 1,
                  path.throughput * directLight(c, v.s, v.x, path.vertex(), path.stream.index, 1,
                                                Real(path.rays), path.footprint));
  }

  /// The mean of the radiance along several rays from here.
  Rgb split(PathContext& c, const Path& path, const Vertex& v) const noexcept {
    Rgb sum;
    Vertices vertices;
    for (int i = 0; i < path.rays; ++i) {
      Path ray = path;
      ray.stream = path.stream.child(path.rays, i);
      std::optional<PathFootprint<>> footprint;
      if (path.footprint) ray.footprint = &footprint.emplace(*path.footprint);
      if (i > 0) ray.report = PathReport();  // only the first ray is recorded
      const bool goesOn = scatter(c, ray, v, draw(c, ray, v));
      // A mirror has only one continuation: follow a single ray and split at the next vertex.
      const bool isOnly = i == 0 && ray.rays > 1;
      if (isOnly) ray.stream = path.stream;
      ++ray.edge;
      if (goesOn) sum += trace(c, ray, vertices);
      if (isOnly) return sum;
    }
    return sum / Real(path.rays);
  }

  /// The sum of the radiance of both lobes inside a rough dielectric, which leaves neither to
  /// chance.
  Rgb fork(PathContext& c, const Path& path, const Vertex& v, const Continuation& drawn,
           const Continuation& other) const noexcept {
    Rgb sum;
    Vertices vertices;
    for (const Continuation* next : {&drawn, &other}) {
      Path branch = path;
      branch.hasForked = true;
      std::optional<PathFootprint<>> footprint;
      if (path.footprint) branch.footprint = &footprint.emplace(*path.footprint);
      if (next == &other) {
        branch.report = PathReport();
        // With equal numbers the errors of the two branches would add up.
        branch.stream = path.stream.forked();
      }
      const bool goesOn = scatter(c, branch, v, madeCertain(*next));
      ++branch.edge;
      if (goesOn) sum += trace(c, branch, vertices);
    }
    return sum;
  }

  static Continuation draw(PathContext& c, const Path& path, const Vertex& v) noexcept {
    const ScatterNumbers numbers = path.scatterNumbers(c.sampler, v.x);
    return {numbers, drawScatter(v.x, numbers)};
  }

  /// Takes a continuation, one of a split's unless it is the only one. False: the path ends.
  bool scatter(PathContext& c, Path& path, const Vertex& v,
               const Continuation& next) const noexcept {
    const std::optional<Scatter>& drawn = next.scatter;
    const bool isOnly = drawn && drawn->local.specular && drawn->local.lobeChance == 1;
    const int siblings = isOnly ? 1 : std::exchange(path.rays, 1);
    if (path.edge == 1 && c.aovs && drawn) c.aovs->albedo += drawn->local.weight / Real(siblings);
    if (!drawn || isTooMuch(path, drawn->local.specular)) {
      const char* event = drawn ? "end" : "absorbed";
      path.report.end(v.s, v.x.toPrev, path.throughput, event, path.footprint);
      return false;
    }
    path.report.scatter(v.s, v.x.toPrev, path.throughput, *drawn, path.footprint);
    path.leave(v, *drawn, siblings);
    const bool goesOn =
        !isBlack(path.throughput) &&
        (path.edge < kRouletteFrom || path.survives(path.number(c.sampler, dimension::kRoulette)));
    if (path.edge + 1 == depth_ && !lastEdgeCarries(c, *drawn)) path.footprint = nullptr;
    if (path.footprint && (goesOn || path.report.isWaiting()))
      path.pending = {&v, *drawn, next.numbers, siblings};
    if (path.report.isWaiting()) path.catchUp();
    path.report.left(path.footprint);
    if (!goesOn) path.report.gone("roulette", drawn->toNext, path.throughput);
    return goesOn;
  }

  /// Counts a scattering. True: its kind is used up.
  bool isTooMuch(Path& path, bool specular) const noexcept {
    return specular ? path.specular++ >= specularDepth_ : path.rough++ >= roughDepth_;
  }

  int samples_, split_, depth_, roughDepth_, specularDepth_;
  FootprintSettings footprint_;
  IndirectClamp clamp_;
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Integrator, vestige::PathIntegrator)
