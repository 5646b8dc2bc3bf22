// SPDX-License-Identifier: Apache-2.0
// Distributed ray tracing: a tree of rays in which every scattering splits into several, stratified
// [CPC84]. Textures are filtered over the footprint of the path that leads to them [PD01 Sec. 4.1].
//
// [CPC84] Cook, Porter, Carpenter. Distributed ray tracing. SIGGRAPH 1984.
// [PD01]  Suykens, Willems. Path differentials and applications. EGWR 2001.
#include <vestige/footprint/language.h>
#include <vestige/plugin.h>
#include <vestige/tools/path_walk.h>

#include <optional>
#include <utility>

namespace vestige {
namespace {

constexpr int kMaxSplit = 256;
constexpr int kMaxDepth = 64;  ///< the tree is walked by recursion

class Distributed final : public Integrator {
 public:
  enum Param { kSamples, kSplit, kLightSamples, kDepth, kFootprint };

  static Schema schema() {
    return {.kind = "integrator",
            .name = "distributed",
            .summary = "a tree of rays: every scattering splits, textures filtered over footprints",
            .params = {
                integer("samples", 4).range(1, 1 << 24).doc("trees a pixel"),
                integer("split", 4).range(1, kMaxSplit).doc("rays a scattering, stratified"),
                integer("light_samples", 1)
                    .range(1, kMaxSplit)
                    .doc("points of lights drawn at a scattering"),
                integer("depth", 5)
                    .range(1, kMaxDepth)
                    .doc("longest path in edges from the camera: 1 sees emitters, 2 direct light"),
                block("footprint", "footprint")
                    .doc("how large a region of a texture a path looks at (safe)")}};
  }

  explicit Distributed(const Values& v)
      : samples_(int(v.integer(kSamples))),
        lightSamples_(int(v.integer(kLightSamples))),
        depth_(int(v.integer(kDepth))),
        split_(int(v.integer(kSplit))),
        footprint_(footprintSettings(v.block(kFootprint), Bound::local)) {}

  int samples() const noexcept override { return samples_; }

  Rgb estimate(PathContext& c) const noexcept override {
    EyePath root(c);
    PathFootprint<> footprint;
    if (carriesFootprint(c, footprint_)) root.carry(footprint, c, footprint_);
    return radiance(c, root);
  }

 private:
  /// A drawn ray of a split. All rays through one specular lobe are the same ray: one is followed
  /// and counts for all.
  struct Child {
    Scatter next;
    ScatterNumbers numbers;
    RandomStream stream;
    Real count = 1;
  };
  static constexpr int kMaxSpecular = 4;  ///< lobes; further ones are followed ray by ray

  /// Radiance along the ray of a node, with the tree behind the surface that it reaches.
  Rgb radiance(PathContext& c, EyePath& node) const noexcept {
    Rgb sum;
    Vertex v;
    if (!walk(c, node, v, sum, {.lastEdge = depth_})) return sum;
    if (node.edge == 1 && c.aovs) writeAovs(*c.aovs, v.s, v.x);
    return sum + node.throughput * reflected(c, node, v);
  }

  /// Direct light, and the mean of the split's rays.
  Rgb reflected(PathContext& c, EyePath& node, const Vertex& v) const noexcept {
    if (node.edge == depth_ || !v.x.brdf) {
      node.report.end(v.s, v.x.toPrev, grey(1), "end", node.footprint);
      return {};
    }
    Rgb direct;
    for (int i = 0; i < lightSamples_; ++i) {
      const RandomStream stream = node.stream.child(lightSamples_, i);
      direct += directLight(c, v.s, v.x, stream.vertex(node.edge), stream.index,
                            Real(lightSamples_), Real(split_.count), node.footprint);
    }
    return direct / Real(lightSamples_) + scattered(c, node, v);
  }

  Rgb scattered(PathContext& c, EyePath& node, const Vertex& v) const noexcept {
    Rgb sum;
    Child specular[kMaxSpecular];
    int lobes = 0;
    PathReport* report = &node.report;
    for (int i = 0; i < split_.count; ++i) {
      const std::optional<Child> child = draw(c, node, v, i);
      if (!child) continue;
      const bool isSpecular = child->next.local.specular;
      if (isSpecular && joins(specular, lobes, child->next)) continue;
      if (isSpecular && lobes < kMaxSpecular)
        specular[lobes++] = *child;
      else
        sum += followed(c, node, v, *child, report);
    }
    for (int i = 0; i < lobes; ++i) sum += followed(c, node, v, specular[i], report);
    if (report) report->end(v.s, v.x.toPrev, grey(1), "absorbed", node.footprint);
    return sum / Real(split_.count);
  }

  /// Child i of the split; empty if it is absorbed.
  std::optional<Child> draw(PathContext& c, const EyePath& node, const Vertex& v,
                            int i) const noexcept {
    const RandomStream stream = node.stream.child(split_.count, i);
    const std::uint32_t dim = dimension::vertex(stream.vertex(node.edge));
    const ScatterNumbers numbers{
        c.sampler.number(dim + dimension::kLobe, stream.index),
        split_.pair(c.sampler, dim + dimension::kDirection, stream.index, i)};
    const std::optional<Scatter> next = drawScatter(v.x, numbers);
    if (!next || isBlack(next->weight)) return std::nullopt;
    if (node.edge == 1 && c.aovs) c.aovs->albedo += next->local.weight / Real(split_.count);
    return Child{*next, numbers, stream};
  }

  /// Counts a specular ray to one through the same lobe. False: there is none yet.
  static bool joins(Child* known, int lobes, const Scatter& next) noexcept {
    for (int i = 0; i < lobes; ++i) {
      if (known[i].next.local.lobe != next.local.lobe) continue;
      ++known[i].count;
      return true;
    }
    return false;
  }

  /// Weighted radiance of one drawn ray and the tree behind it. Only the first ray followed is
  /// recorded: it takes `report`.
  Rgb followed(PathContext& c, const EyePath& node, const Vertex& v, const Child& child,
               PathReport*& report) const noexcept {
    const Scatter& next = child.next;
    PathReport* recorded = std::exchange(report, nullptr);
    if (recorded) recorded->scatter(v.s, v.x.toPrev, grey(1), next, node.footprint);
    EyePath below;
    below.leave(v, next, split_.count);
    below.throughput = grey(1);  // the sum is weighted on the way back
    below.drawn.lightSamples = Real(lightSamples_);
    below.stream = child.stream;
    below.edge = node.edge + 1;
    below.sceneSize = node.sceneSize;
    std::optional<PathFootprint<>> footprint;
    if (node.footprint && (below.edge < depth_ || lastEdgeCarries(c, next))) {
      below.footprint = &footprint.emplace(*node.footprint);
      const Strata strata = next.local.specular ? Strata{} : split_.strata();
      below.footprint->scatter(v.s, v.x, next, child.numbers, strata);
    }
    if (recorded) {
      recorded->left(below.footprint);
      below.report = *recorded;
    }
    return child.count * next.weight * radiance(c, below);
  }

  int samples_, lightSamples_, depth_;
  SplitStrata split_;
  FootprintSettings footprint_;
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Integrator, vestige::Distributed)
