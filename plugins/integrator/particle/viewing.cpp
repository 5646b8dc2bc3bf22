// SPDX-License-Identifier: Apache-2.0
#include "viewing.h"

#include <optional>

#include "glossy_part.h"

namespace vestige::particle {
namespace {

/// Share of the radiance that is left where an edge of an element is drawn.
constexpr Real kWire = Real(0.3);

void noteElement(PathRecord& record, const SeenElement& e) {
  record.note({"element.level", "", {double(e.level)}});
  record.note({"element.id", "", {double(e.id)}});
  record.note({"element.area", "scene units^2", {double(e.area)}});
  record.note({"element.flux", "W", {double(e.flux.r), double(e.flux.g), double(e.flux.b)}, 3});
  record.note({"element.particles", "", {double(e.hits)}});
}

}  // namespace

/// A path from the eye, and the vertex where it is.
struct Viewing::Path : EyePath {
  explicit Path(PathContext& context) : EyePath(context), c(context) {}

  PathContext& c;
  bool gathers = false;  ///< rays light the next diffuse surface
  Rgb radiance;
  Vertex v;
  std::optional<GlossyPart> rest;  ///< of the BRDF, where the diffuse part has been added
};

Rgb Viewing::radiance(PathContext& c) const noexcept {
  const FootprintSettings settings;  // safe, as other paths from the eye
  PathFootprint<> footprint;
  Path path(c);
  if (carriesFootprint(c, settings)) path.carry(footprint, c, settings);
  path.gathers = show == Show::gather;
  while (walk(c, path, path.v, path.radiance) && look(path) && scatter(path)) ++path.edge;
  return path.radiance;
}

/// Adds the diffuse part from the solution's irradiance. False: nothing else is to be added there.
bool Viewing::look(Path& p) const noexcept {
  Vertex& v = p.v;
  const PatchPoint at = patchPointOf(v.s, v.x.toPrev);
  Aovs* const aovs = p.edge == 1 ? p.c.aovs : nullptr;
  if (aovs) {
    writeAovs(*aovs, v.s, v.x);
    const ElementInfo e = light.element(at);
    aovs->own[kElementLevel] = Real(e.level);
    aovs->own[kElementId] = Real(e.id);
  }
  const DiffusePart diffuse = v.x.brdf ? v.x.brdf->diffuse(v.x.point) : DiffusePart{{}, true};
  const bool isDiffuse = !isBlack(diffuse.albedo);
  const bool isKept = isDiffuse && light.covers(at);
  const bool isShown = isKept && !p.gathers;
  if (isKept && p.c.record) noteElement(*p.c.record, light.seen(at));
  if (isShown) {
    const Real edges = wires && p.edge == 1 ? wire(p.c, at) : Real(1);
    p.radiance +=
        edges / kPi * p.throughput * diffuse.albedo * light.at(at, show != Show::elements);
    if (aovs) aovs->albedo = diffuse.albedo;
  }
  const bool isDone = isShown || !isDiffuse;  // rays need not find the diffuse part
  if (isDone && (diffuse.isAll || !glossy)) return end(p);
  if (p.edge == depth) return end(p);
  if (isShown) v.x.brdf = &p.rest.emplace(*v.x.brdf, diffuse.albedo);
  if (isKept) p.gathers = false;
  return true;
}

bool Viewing::end(Path& p) noexcept {
  p.report.rest(p.v.s, p.v.x.toPrev, p.throughput, p.footprint);
  return false;
}

/// Next-event estimation and the next ray. False: the path ends.
bool Viewing::scatter(Path& p) const noexcept {
  PathContext& c = p.c;
  const Vertex& v = p.v;
  p.radiance += p.throughput * directLight(c, v.s, v.x, p.vertex(), p.stream.index);
  const ScatterNumbers numbers = p.scatterNumbers(c.sampler, v.x);
  const std::optional<Scatter> next = drawScatter(v.x, numbers);
  if (p.edge == 1 && c.aovs && next) c.aovs->albedo += next->local.weight;
  if (!next || isBlack(next->weight)) {
    p.report.end(v.s, v.x.toPrev, p.throughput, "absorbed", p.footprint);
    return false;
  }
  p.report.scatter(v.s, v.x.toPrev, p.throughput, *next, p.footprint);
  p.leave(v, *next, 1);
  if (p.footprint) p.footprint->scatter(v.s, v.x, *next, numbers);
  p.report.left(p.footprint);
  if (p.edge < kRouletteFrom || p.survives(p.number(c.sampler, dimension::kRoulette))) return true;
  p.report.gone("roulette", next->toNext, p.throughput);
  return false;
}

/// Darkens the pixel where the next pixel shows another element.
Real Viewing::wire(PathContext& c, const PatchPoint& at) const noexcept {
  const std::uint32_t own = light.element(at).id;
  for (const std::size_t j : {0, 1}) {
    const Ray beside{c.ray.origin + c.jacobian.dOrigin[j],
                     normalize(c.ray.direction + c.jacobian.dDirection[j]),
                     0,
                     kInfinity,
                     0,
                     RayKind::any,
                     c.ray.media};
    Surface s;
    ++c.counters.rays;
    if (!c.scene.intersect(beside, s) ||
        light.element(patchPointOf(s, -beside.direction)).id != own)
      return kWire;
  }
  return 1;
}

}  // namespace vestige::particle
