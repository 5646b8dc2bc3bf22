// SPDX-License-Identifier: Apache-2.0
// Distributed ray tracing: a tree of rays, every scattering split into several, stratified
// [CPC84]; textures filtered over the footprint of the path that leads to them [PD01 Sec. 4.1].
//
// [CPC84] Cook, Porter, Carpenter. Distributed ray tracing. SIGGRAPH 1984.
// [PD01]  Suykens, Willems. Path differentials and applications. EGWR 2001.
#include <vestige/direct_light.h>
#include <vestige/path_report.h>
#include <vestige/plugin.h>

#include <optional>
#include <utility>

namespace vestige {
namespace {

constexpr int kMaxLayers = 64;  ///< passed without scattering, as for shadow rays
constexpr int kMaxSplit = 256;
constexpr int kMaxDepth = 64;  ///< the tree is walked by recursion

/// How N' numbers of a pair are stratified: a net of points where N' is a power of two, else a
/// grid of rows and columns as square as N' allows: 6 as 2 x 3.
struct Split {
  int count = 1, columns = 0, rows = 0;  ///< no columns: a net

  explicit Split(int n) : count(n) {
    if ((n & (n - 1)) == 0) return;
    for (rows = int(std::sqrt(double(n))); n % rows != 0;) --rows;
    columns = n / rows;
  }
  Strata strata() const noexcept {
    if (columns == 0) return squareStrata(count);
    return {Real(columns), Real(rows)};
  }
  Vec2 pair(const Sampler& s, std::uint32_t dim, std::uint32_t index) const noexcept {
    const Vec2 u = s.pair(dim, index);
    if (columns == 0) return u;
    const int cell = int(index % std::uint32_t(count));
    const auto within = [](Real x, int i, int n) {
      return std::min((Real(i) + x) / Real(n), kOneMinusEpsilon);
    };
    return {within(u.x, cell % columns, columns), within(u.y, cell / columns, rows)};
  }
};

/// A ray of the tree.
struct Node {
  Ray ray;
  DrawnRay drawn;
  std::uint32_t index;  ///< among all nodes of its level: sample N' + child, and so on
  int edge;             ///< from the camera, 1 the first
  PathFootprint<>* footprint;
  PathReport report;
};

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
    Node root{c.ray, {c.ray.origin, kInfinity, 1}, c.sampler.index(), 1, nullptr, PathReport(c)};
    PathFootprint<> footprint;
    if (carriesFootprint(c, footprint_)) {
      footprint.begin(c, footprint_);
      root.footprint = &footprint;
    }
    return radiance(c, root, sizeOf(c.scene));
  }

 private:
  /// What comes along a ray: what shines on its way, and the tree behind the surface it meets.
  Rgb radiance(PathContext& c, Node& node, Real size) const noexcept {
    Rgb sum, left{1, 1, 1};
    for (int layer = 0; layer < kMaxLayers; ++layer) {
      ++c.counters.rays;
      const std::optional<Surface> hit = c.scene.intersect(node.ray);
      if (!hit) return sum + left * escaped(c, node);
      PathFootprint<>* f = node.footprint;
      if (f) f->arrive(*hit, size);
      sum += left * metLight(c.scene, *hit, node.drawn);
      InputBuffer buffer;
      const Vec3 toPrev = -node.ray.direction;
      Interaction x;
      if (node.edge > 1 && node.edge == depth_)
        lastSurface(c.scene, *hit, toPrev, x);
      else
        c.scene.shade(*hit, toPrev, regionAt(c.scene, *hit, f), buffer, x);
      if (node.edge == 1 && layer == 0 && c.aovs) writeAovs(*c.aovs, *hit, x);
      if (stays(c, node, x, layer, left)) return sum + left * reflected(c, node, *hit, x, size);
      node.report.end(*hit, x.toPrev, grey(1), "pass", f);
      node.ray = spawnRay(*hit, node.ray.direction, node.ray.kind);
    }
    return sum;
  }

  static Rgb escaped(PathContext& c, Node& node) noexcept {
    node.report.gone("escape", node.ray.direction, grey(1));
    return filteredBackground(c.scene, node.drawn, node.ray.direction, node.footprint);
  }

  /// Whether the ray ends at a surface that may be partly transparent; `left` of its light counts.
  static bool stays(PathContext& c, Node& node, const Interaction& x, int layer,
                    Rgb& left) noexcept {
    if (isOpaque(x.opacity)) return true;
    const std::uint32_t dim = dimension::vertex(std::uint32_t(node.edge - 1)) +
                              dimension::kOpacity + 0x10000u * std::uint32_t(layer);
    const Passage passage = drawPassage(x.opacity, left, c.sampler.number(dim, node.index));
    if (node.footprint) node.footprint->chance(passage.chance);
    left *= passage.weight;
    return passage.stays;
  }

  /// Direct light, and the mean of the split's rays.
  Rgb reflected(PathContext& c, Node& node, const Surface& s, const Interaction& x,
                Real size) const noexcept {
    if (node.edge == depth_ || !x.brdf) {
      node.report.end(s, x.toPrev, grey(1), "end", node.footprint);
      return {};
    }
    Rgb direct;
    for (int i = 0; i < lightSamples_; ++i)
      direct += directLight(c, s, x, std::uint32_t(node.edge - 1),
                            node.index * std::uint32_t(lightSamples_) + std::uint32_t(i),
                            Real(lightSamples_), Real(split_.count), node.footprint);
    return direct / Real(lightSamples_) + scattered(c, node, s, x, size);
  }

  Rgb scattered(PathContext& c, Node& node, const Surface& s, const Interaction& x,
                Real size) const noexcept {
    const std::uint32_t dim = dimension::vertex(std::uint32_t(node.edge - 1));
    Rgb sum;
    SpecularChild specular[kMaxSpecular];
    int lobes = 0;
    Report report{&node.report};
    for (int child = 0; child < split_.count; ++child) {
      const std::uint32_t index = node.index * std::uint32_t(split_.count) + std::uint32_t(child);
      const ScatterNumbers numbers{c.sampler.number(dim + dimension::kLobe, index),
                                   split_.pair(c.sampler, dim + dimension::kDirection, index)};
      const auto next = drawScatter(x, numbers);
      if (!next || isBlack(next->weight)) continue;
      if (node.edge == 1 && c.aovs) c.aovs->albedo += next->local.weight / Real(split_.count);
      if (next->local.specular && joins(specular, lobes, *next)) continue;
      if (next->local.specular && lobes < kMaxSpecular)
        specular[lobes++] = {*next, numbers, index, 1};
      else
        sum += next->weight * followed(c, node, s, x, *next, numbers, index, report, size);
    }
    for (int i = 0; i < lobes; ++i) {
      const SpecularChild& one = specular[i];
      sum += one.count * one.next.weight *
             followed(c, node, s, x, one.next, one.numbers, one.index, report, size);
    }
    if (report.first) node.report.end(s, x.toPrev, grey(1), "absorbed", node.footprint);
    return sum / Real(split_.count);
  }

  /// All rays through one specular lobe are the same ray: one of them stands for them.
  struct SpecularChild {
    Scatter next;
    ScatterNumbers numbers;
    std::uint32_t index;
    Real count;
  };
  static constexpr int kMaxSpecular = 4;  ///< lobes; those of a BRDF that has more go one by one

  static bool joins(SpecularChild* known, int lobes, const Scatter& next) noexcept {
    for (int i = 0; i < lobes; ++i)
      if (known[i].next.local.lobe == next.local.lobe) return ++known[i].count, true;
    return false;
  }

  /// The first ray followed is the one that is told.
  struct Report {
    PathReport* first;
    PathReport* take() noexcept { return std::exchange(first, nullptr); }
  };

  /// The tree behind one drawn ray; `index` among the nodes of its level.
  Rgb followed(PathContext& c, const Node& node, const Surface& s, const Interaction& x,
               const Scatter& next, ScatterNumbers numbers, std::uint32_t index, Report& reports,
               Real size) const noexcept {
    PathReport* report = reports.take();
    if (report) report->scatter(s, x.toPrev, grey(1), next, node.footprint);
    Node below{spawnRay(s, next.toNext, kindOf(next.local)),
               {s.position, next.local.specular ? kInfinity : Real(split_.count) * next.local.pdf,
                Real(lightSamples_)},
               index,
               node.edge + 1,
               nullptr,
               PathReport()};
    std::optional<PathFootprint<>> footprint;
    if (node.footprint && (below.edge < depth_ || lastEdgeCarries(c, next))) {
      footprint.emplace(*node.footprint);
      footprint->scatter(s, x, next, numbers, next.local.specular ? Strata{} : split_.strata());
      below.footprint = &*footprint;
    }
    if (report) {
      report->left(below.footprint);
      below.report = *report;
    }
    return radiance(c, below, size);
  }

  int samples_, lightSamples_, depth_;
  Split split_;
  FootprintSettings footprint_;
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Integrator, vestige::Distributed)
