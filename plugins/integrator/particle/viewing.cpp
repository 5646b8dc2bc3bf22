// SPDX-License-Identifier: Apache-2.0
#include "viewing.h"

#include <optional>

#include "glossy_part.h"

namespace vestige::particle {
namespace {

/// The first scattering that is followed by roulette.
constexpr int kRouletteFrom = 4;
constexpr Real kMaxSurvival = Real(0.95);
/// Passing through this many layers without scattering ends a path.
constexpr int kMaxLayers = 64;
/// What is left of the light where an edge of an element is drawn.
constexpr Real kWire = Real(0.3);

}  // namespace

/// The state of an eye path.
struct Viewing::Path {
  Path(PathContext& context, PathFootprint<>* carried)
      : c(context), footprint(carried), ray(c.ray), drawn{c.ray.origin}, report(c) {}

  std::uint32_t vertex() const noexcept { return std::uint32_t(edge - 1); }
  Real random(std::uint32_t offset) const noexcept {
    return c.sampler.number(dimension::vertex(vertex()) + offset);
  }

  PathContext& c;
  PathFootprint<>* footprint;  ///< null: carries none
  Ray ray;
  DrawnRay drawn;
  PathReport report;
  int edge = 1;
  bool gathers = false;  ///< the next surface that keeps light is lit by rays
  Rgb radiance, throughput{1, 1, 1};
  Rgb flux{1, 1, 1};  ///< throughput without eta^2: what roulette decides by

  Surface s;
  InputBuffer inputs;
  Interaction x;
  std::optional<GlossyPart> rest;  ///< of the surface, if its diffuse part has been added
};

Rgb Viewing::radiance(PathContext& c) const noexcept {
  const FootprintSettings settings;  // safe, as other paths from the eye
  std::optional<PathFootprint<>> footprint;
  if (carriesFootprint(c, settings)) footprint.emplace().begin(c, settings);
  Path path(c, footprint ? &*footprint : nullptr);
  path.gathers = show == Show::gather;
  while (meet(path) && look(path) && scatter(path)) ++path.edge;
  return path.radiance;
}

/// To the next surface that is not passed through; adds what shines. False: there is none.
bool Viewing::meet(Path& p) const noexcept {
  const SceneView& scene = p.c.scene;
  for (std::uint32_t layer = 0; layer < kMaxLayers; ++layer) {
    ++p.c.counters.rays;
    if (!scene.intersect(p.ray, p.s)) {
      p.report.gone("escape", p.ray.direction, p.throughput);
      p.radiance += p.throughput * filteredBackground(scene, p.drawn, p.ray.direction, p.footprint);
      return false;
    }
    if (p.footprint) p.footprint->arrive(p.s, sizeOf(scene));
    p.radiance += p.throughput * metLight(scene, p.s, p.drawn);
    scene.shade(p.s, -p.ray.direction, regionAt(scene, p.s, p.footprint), p.inputs, p.x);
    if (p.x.opacity >= 1) return true;
    const bool stays = p.random(dimension::kOpacity + 0x10000u * layer) < p.x.opacity;
    if (p.footprint) p.footprint->chance(stays ? p.x.opacity : 1 - p.x.opacity);
    if (stays) return true;
    p.report.end(p.s, p.x.toPrev, p.throughput, "pass", p.footprint);
    p.ray = spawnRay(p.s, p.ray.direction);
  }
  return false;
}

/// Adds the light that is kept on the surface. False: the path ends there.
bool Viewing::look(Path& p) const noexcept {
  const PatchPoint at = patchPointOf(p.s, p.x.toPrev);
  Aovs* const aovs = p.edge == 1 ? p.c.aovs : nullptr;
  if (aovs) {
    writeAovs(*aovs, p.s, p.x);
    const ElementInfo e = light.element(at);
    aovs->elementLevel = Real(e.level), aovs->elementId = Real(e.id);
  }
  const MattPart diffuse = p.x.brdf ? p.x.brdf->matt(p.x.point) : MattPart{{}, true};
  const bool isDiffuse = !isBlack(diffuse.albedo);
  const bool isKept = isDiffuse && light.covers(at);
  const bool isShown = isKept && !p.gathers;
  if (isKept && p.c.record) p.c.record->saw(light.seen(at));
  if (isShown) {
    const Real edges = wires && p.edge == 1 ? wire(p.c, at) : Real(1);
    p.radiance +=
        edges / kPi * p.throughput * diffuse.albedo * light.at(at, show != Show::elements);
    if (aovs) aovs->albedo = diffuse.albedo;
  }
  const bool isDone = isShown || !isDiffuse;  // rays need not find the diffuse part
  if (isDone && (diffuse.isAll || !glossy)) return end(p);
  if (p.edge == depth) return end(p);
  if (isShown) p.x.brdf = &p.rest.emplace(*p.x.brdf, diffuse.albedo);
  if (isKept) p.gathers = false;
  return true;
}

bool Viewing::end(Path& p) noexcept {
  p.report.rest(p.s, p.x.toPrev, p.throughput, p.footprint);
  return false;
}

/// Next-event estimation and the next ray. False where the path ends.
bool Viewing::scatter(Path& p) const noexcept {
  PathContext& c = p.c;
  p.radiance += p.throughput * directLight(c, p.s, p.x, p.vertex(), c.sampler.index());
  const std::uint32_t dim = dimension::vertex(p.vertex());
  const ScatterNumbers random{p.random(dimension::kLobe),
                              c.sampler.pair(dim + dimension::kDirection)};
  const std::optional<Scatter> next = drawScatter(p.x, random);
  if (p.edge == 1 && c.aovs && next) c.aovs->albedo += next->local.weight;
  if (!next || isBlack(next->weight)) {
    p.report.end(p.s, p.x.toPrev, p.throughput, "absorbed", p.footprint);
    return false;
  }
  p.report.scatter(p.s, p.x.toPrev, p.throughput, *next, p.footprint);
  p.throughput *= next->weight, p.flux *= next->local.weight;
  p.drawn = {p.s.position, next->local.specular ? kInfinity : next->local.pdf};
  if (p.footprint) p.footprint->scatter(p.s, p.x, *next, random);
  p.report.left(p.footprint);
  p.ray = spawnRay(p.s, next->toNext);
  if (p.edge < kRouletteFrom) return true;

  // The glossy part is negative where the diffuse one exceeds f.
  const Real left = std::max({std::abs(p.flux.r), std::abs(p.flux.g), std::abs(p.flux.b)});
  const Real survival = std::min(kMaxSurvival, std::sqrt(left));
  if (!(p.random(dimension::kRoulette) < survival)) {
    p.report.gone("roulette", next->toNext, p.throughput);
    return false;
  }
  p.throughput = p.throughput / survival, p.flux = p.flux / survival;
  if (p.footprint) p.footprint->chance(survival);
  return true;
}

/// Dark where another element lies one pixel further.
Real Viewing::wire(PathContext& c, const PatchPoint& at) const noexcept {
  const std::uint32_t own = light.element(at).id;
  for (const std::size_t j : {0, 1}) {
    const Ray beside{c.ray.origin + c.jacobian.dOrigin[j],
                     normalize(c.ray.direction + c.jacobian.dDirection[j]), 0, kInfinity};
    Surface s;
    ++c.counters.rays;
    if (!c.scene.intersect(beside, s) ||
        light.element(patchPointOf(s, -beside.direction)).id != own)
      return kWire;
  }
  return 1;
}

}  // namespace vestige::particle
