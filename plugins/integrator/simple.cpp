// SPDX-License-Identifier: Apache-2.0
// Path tracing [Kaj86] in its shortest form: the integrator to read first. Estimates the same
// radiance as `path`, without footprints, splitting and limits.
//
// [Kaj86] Kajiya. The rendering equation. SIGGRAPH 1986.
#include <vestige/direct_light.h>
#include <vestige/layers.h>
#include <vestige/plugin.h>
#include <vestige/roulette.h>

namespace vestige {
namespace {

class Simple final : public Integrator {
 public:
  enum Param { kSamples, kDepth };

  static Schema schema() {
    return {.kind = "integrator",
            .name = "simple",
            .summary = "path tracing in ninety lines, to read and to copy",
            .params = {integer("samples", 16).range(1, 1 << 24).doc("paths a pixel"),
                       integer("depth", 16)
                           .range(1, 4096)
                           .doc("longest path in edges from the camera: 1 sees emitters, 2 direct "
                                "light")}};
  }

  explicit Simple(const Values& v)
      : samples_(int(v.integer(kSamples))), depth_(int(v.integer(kDepth))) {}

  int samples() const noexcept override { return samples_; }

  /// The radiance along one random path: at each vertex the emission that the ray met, and the
  /// direct light. Both see the lights, so multiple importance sampling weighs them.
  Rgb estimate(PathContext& c) const noexcept override {
    Rgb radiance, throughput{1, 1, 1}, flux{1, 1, 1};
    Ray ray = c.ray;
    DrawnRay drawn{ray.origin};
    std::uint32_t layer = 0;
    for (int edge = 1; edge <= depth_ && layer < kMaxLayers;) {
      Surface s;
      ++c.counters.rays;
      if (!c.scene.intersect(ray, s))
        return radiance + throughput * background(c.scene, drawn, ray.direction);
      radiance += throughput * metLight(c.scene, s, drawn);

      InputBuffer inputs;
      const Interaction x = c.scene.shade(s, -ray.direction, {}, inputs);
      const auto vertex = std::uint32_t(edge - 1);
      const LayerEvent event = meetLayer(c.sampler, vertex, layer, c.sampler.index(), x);
      throughput *= event.weight;
      if (event.passes) {
        ray = spawnRay(s, ray.direction);
        ++layer;
        continue;
      }
      layer = 0;
      if (edge == 1 && c.aovs) writeAovs(*c.aovs, s, x);
      if (edge == depth_) break;
      radiance += throughput * directLight(c, s, x, vertex, c.sampler.index());

      // The next ray, in a direction that the BRDF draws.
      const std::uint32_t dim = dimension::vertex(vertex);
      const auto next = drawScatter(x, {c.sampler.number(dim + dimension::kLobe),
                                        c.sampler.pair(dim + dimension::kDirection)});
      if (!next || isBlack(next->weight)) break;
      if (edge == 1 && c.aovs) c.aovs->albedo = next->local.weight;
      throughput *= next->weight;
      flux *= next->local.weight;
      drawn = {s.position, next->local.specular ? kInfinity : next->local.pdf};
      ray = spawnRay(s, next->toNext);

      // Russian roulette ends paths that carry little, and raises the weight of the others.
      if (edge++ < kRouletteFrom) continue;
      const Real survival = survivalProbability(flux);
      if (!(c.sampler.number(dim + dimension::kRoulette) < survival)) break;
      throughput = throughput / survival;
      flux = flux / survival;
    }
    return radiance;
  }

 private:
  int samples_, depth_;
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Integrator, vestige::Simple)
