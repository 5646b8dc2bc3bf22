// SPDX-License-Identifier: Apache-2.0
#include "viewing.h"

#include <optional>

#include "glossy_part.h"

namespace vestige::particle {
namespace {

/// Roulette starts with this scattering.
constexpr int kRouletteFrom = 4;
constexpr Real kMaxSurvival = Real(0.95);
/// Passing through this many layers without scattering ends a path.
constexpr int kMaxLayers = 64;
/// What is left of the light where an edge of an element is drawn.
constexpr Real kWire = Real(0.3);

}  // namespace

/// An eye path under way, and where it is.
struct Viewing::Path {
  Path(PathContext& context, PathFootprint<>* carried)
      : c(context), footprint(carried), ray(c.ray), drawn{c.ray.origin}, report(c) {}

  std::uint32_t vertex() const noexcept { return std::uint32_t(edge - 1); }
  Real number(std::uint32_t offset) const noexcept {
    return c.sampler.number(dimension::vertex(vertex()) + offset);
  }

  PathContext& c;
  PathFootprint<>* footprint;  ///< null: carries none
  Ray ray;
  DrawnRay drawn;
  PathReport report;
  int edge = 1;
  bool gathers = false;  ///< the next matt surface is lit by rays
  Rgb radiance, throughput{1, 1, 1};
  Rgb flux{1, 1, 1};  ///< throughput without eta^2: what roulette decides by

  Surface s;
  InputBuffer inputs;
  Interaction x;
  std::optional<GlossyPart> rest;  ///< of the surface, if its matt part has been seen
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
    if (isOpaque(p.x.opacity)) return true;
    const Passage passage =
        drawPassage(p.x.opacity, p.throughput, p.number(dimension::kOpacity + 0x10000u * layer));
    if (p.footprint) p.footprint->chance(passage.chance);
    p.throughput *= passage.weight;
    p.flux *= passage.weight;
    if (passage.stays) return true;
    p.report.end(p.s, p.x.toPrev, p.throughput, "pass", p.footprint);
    p.ray = spawnRay(p.s, p.ray.direction, p.ray.kind);
  }
  return false;
}

/// Adds the light that is kept on the surface. False: nothing else is to be seen there.
bool Viewing::look(Path& p) const noexcept {
  const Place place = placeOf(p.s, p.x.toPrev);
  Aovs* const aovs = p.edge == 1 ? p.c.aovs : nullptr;
  if (aovs) {
    writeAovs(*aovs, p.s, p.x);
    const ElementInfo e = light.element(place);
    aovs->elementLevel = Real(e.level), aovs->elementId = Real(e.id);
  }
  const MattPart matt = p.x.brdf ? p.x.brdf->matt(p.x.point) : MattPart{{}, true};
  const bool isKept = !isBlack(matt.albedo) && light.covers(place);
  const bool isShown = isKept && !p.gathers;
  const bool isGathered = isKept && p.gathers;
  if (isKept && p.c.record) p.c.record->saw(light.seen(place));
  if (isShown) {
    const Real edges = wires && p.edge == 1 ? wire(p.c, place) : Real(1);
    p.radiance +=
        edges / kPi * p.throughput * matt.albedo * light.at(place, show != Show::elements);
    if (aovs) aovs->albedo = matt.albedo;
  }
  const bool isAll = matt.isAll && (isShown || isBlack(matt.albedo));
  if (isAll || p.edge == depth || (!glossy && !isGathered)) {
    p.report.rest(p.s, p.x.toPrev, p.throughput, p.footprint);
    return false;
  }
  if (isShown) p.x.brdf = &p.rest.emplace(*p.x.brdf, matt.albedo);
  if (isGathered) p.gathers = false;
  return true;
}

/// Next-event estimation and the next ray. False where the path ends.
bool Viewing::scatter(Path& p) const noexcept {
  PathContext& c = p.c;
  p.radiance += p.throughput * directLight(c, p.s, p.x, p.vertex(), c.sampler.index());
  const std::uint32_t dim = dimension::vertex(p.vertex());
  const ScatterNumbers numbers{p.number(dimension::kLobe),
                               c.sampler.pair(dim + dimension::kDirection)};
  const std::optional<Scatter> next = drawScatter(p.x, numbers);
  if (p.edge == 1 && c.aovs && next) c.aovs->albedo += next->local.weight;
  if (!next || isBlack(next->weight)) {
    p.report.end(p.s, p.x.toPrev, p.throughput, "absorbed", p.footprint);
    return false;
  }
  p.report.scatter(p.s, p.x.toPrev, p.throughput, *next, p.footprint);
  p.throughput *= next->weight, p.flux *= next->local.weight;
  p.drawn = {p.s.position, next->local.specular ? kInfinity : next->local.pdf};
  if (p.footprint) p.footprint->scatter(p.s, p.x, *next, numbers);
  p.report.left(p.footprint);
  p.ray = spawnRay(p.s, next->toNext, kindOf(next->local));
  if (p.edge < kRouletteFrom) return true;

  // A glossy part may be negative where the matt one says too much.
  const Real left = std::max({std::abs(p.flux.r), std::abs(p.flux.g), std::abs(p.flux.b)});
  const Real survival = std::min(kMaxSurvival, std::sqrt(left));
  if (!(p.number(dimension::kRoulette) < survival)) {
    p.report.gone("roulette", next->toNext, p.throughput);
    return false;
  }
  p.throughput = p.throughput / survival, p.flux = p.flux / survival;
  if (p.footprint) p.footprint->chance(survival);
  return true;
}

/// Dark where another element lies one pixel further.
Real Viewing::wire(PathContext& c, const Place& place) const noexcept {
  const std::uint32_t own = light.element(place).id;
  for (const std::size_t j : {0, 1}) {
    const Ray beside{c.ray.origin + c.jacobian.dOrigin[j],
                     normalize(c.ray.direction + c.jacobian.dDirection[j]), 0, kInfinity};
    Surface s;
    ++c.counters.rays;
    if (!c.scene.intersect(beside, s) || light.element(placeOf(s, -beside.direction)).id != own)
      return kWire;
  }
  return 1;
}

}  // namespace vestige::particle
