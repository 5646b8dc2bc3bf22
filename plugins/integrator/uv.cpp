// SPDX-License-Identifier: Apache-2.0
// For inspection: surface coordinates as colours: u red, v green, repeating.
#include <vestige/integrator.h>
#include <vestige/plugin.h>

namespace vestige {
namespace {

class Uv final : public Integrator {
 public:
  static Schema schema() {
    return {.kind = "integrator",
            .name = "uv",
            .summary = "surface coordinates as colours: u red, v green, repeating"};
  }

  int samples() const noexcept override { return 4; }

  Rgb estimate(PathContext& context) const noexcept override {
    ++context.counters.rays;
    const std::optional<Surface> hit = context.scene.intersect(context.ray);
    if (!hit) return {};
    InputBuffer buffer;
    const Interaction x = context.scene.shade(*hit, -context.ray.direction, {}, buffer);
    if (context.aovs) writeAovs(*context.aovs, *hit, x);
    return Rgb{hit->uv.x - std::floor(hit->uv.x), hit->uv.y - std::floor(hit->uv.y), 0};
  }
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Integrator, vestige::Uv)
