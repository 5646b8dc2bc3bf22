// SPDX-License-Identifier: Apache-2.0
// Path tracing (Kajiya, The rendering equation, SIGGRAPH 1986) in its shortest form: at each vertex
// emission and direct light, both weighted by multiple importance sampling (direct_light.h).
#include <vestige/plugin.h>
#include <vestige/tools/direct_light.h>
#include <vestige/tools/layers.h>
#include <vestige/tools/roulette.h>

namespace vestige::simple_plugin {

class Simple final : public Integrator {
 public:
  enum Param { kSamples, kDepth };

  static Schema schema() {
    return {.kind = "integrator",
            .name = "simple",
            .summary = "path tracing in ninety lines, to read and to copy",
            .params = {integer("samples", 16).range(1, 1 << 24).doc("paths a pixel"),
                       integer("depth", 16).range(1, 4096).doc("longest path in edges")}};
  }

  explicit Simple(const Values& v)
      : samples_(std::uint32_t(v.integer(kSamples))), depth_(std::uint32_t(v.integer(kDepth))) {}
  int samples() const noexcept override { return int(samples_); }

  Rgb estimate(PathContext& c) const noexcept override {
    Path p{c.ray, {c.ray.origin}};
    for (std::uint32_t vertex = 0; meet(c, p, vertex); ++vertex) {
      if (vertex == 0 && c.aovs) writeAovs(*c.aovs, p.s, p.x);
      if (vertex + 1 == depth_) break;
      p.radiance += p.throughput * directLight(c, p.s, p.x, vertex, c.sampler.index());
      if (!scatter(c, p, vertex)) break;
    }
    return p.radiance;
  }

 private:
  /// A path under way, and the surface that it reached.
  struct Path {
    Ray ray;
    DrawnRay drawn;  ///< the same ray, for multiple importance sampling
    Rgb radiance{}, throughput{1, 1, 1};
    Surface s{};
    InputBuffer inputs{};
    Interaction x{};
  };

  /// To the surface where the path scatters; adds the light that it meets. False: there is none.
  static bool meet(PathContext& c, Path& p, std::uint32_t vertex) noexcept {
    for (std::uint32_t layer = 0; layer < kMaxLayers; ++layer) {
      ++c.counters.rays;
      const bool isMet = c.scene.intersect(p.ray, p.s);
      p.throughput *= c.scene.mediumTransmittance(p.ray, isMet ? p.s.distance : kInfinity);
      p.radiance += p.throughput * (isMet ? metLight(c.scene, p.s, p.drawn)
                                          : background(c.scene, p.drawn, p.ray.direction));
      if (!isMet) return false;
      c.scene.shade(p.s, -p.ray.direction, {}, p.inputs, p.x);
      const Passage passage =
          meetLayer(c.sampler, vertex, layer, c.sampler.index(), p.x.opacity, p.throughput);
      p.throughput *= passage.weight;
      if (passage.stays) return true;
      p.ray = spawnRay(p.s, p.ray.direction, p.ray.kind);
    }
    p.radiance = kEndless;
    return false;
  }

  /// Draws the next ray from the BRDF. False: the path ends.
  static bool scatter(PathContext& c, Path& p, std::uint32_t vertex) noexcept {
    const auto next = drawScatter(p.x, scatterNumbers(c.sampler, p.x, vertex, c.sampler.index()));
    if (!next || isBlack(next->weight)) return false;
    if (vertex == 0 && c.aovs) c.aovs->albedo = next->local.weight;
    p.throughput *= next->weight;
    p.drawn = {p.x.receiver, next->local.specular ? kInfinity : next->local.pdf};
    p.ray = spawnRay(p.s, next->toNext, kindOf(next->local));
    if (vertex + 1 < kRouletteFrom) return true;
    const Real survival = survivalProbability(p.throughput);
    p.throughput = p.throughput / survival;
    return c.sampler.number(dimension::vertex(vertex) + dimension::kRoulette) < survival;
  }

  std::uint32_t samples_, depth_;
};

}  // namespace vestige::simple_plugin

VESTIGE_PLUGIN(vestige::Integrator, vestige::simple_plugin::Simple)
