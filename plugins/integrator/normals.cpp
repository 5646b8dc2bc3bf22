// SPDX-License-Identifier: Apache-2.0
// For inspection: shading normals as colours: 0..1 for -1..1.
#include <vestige/integrator.h>
#include <vestige/plugin.h>

namespace vestige {
namespace {

class Normals final : public Integrator {
 public:
  static Schema schema() {
    return {.kind = "integrator",
            .name = "normals",
            .summary = "shading normals as colours: 0..1 for -1..1"};
  }

  int samples() const noexcept override { return 4; }

  Rgb estimate(PathContext& context) const noexcept override {
    ++context.counters.rays;
    const std::optional<Surface> hit = context.scene.intersect(context.ray);
    if (!hit) return {};
    InputBuffer buffer;
    const Interaction x = context.scene.shade(*hit, -context.ray.direction, {}, buffer);
    if (context.aovs) writeAovs(*context.aovs, *hit, x);
    return Rgb{x.frame.n.x, x.frame.n.y, x.frame.n.z} * Real(0.5) + grey(Real(0.5));
  }
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Integrator, vestige::Normals)
