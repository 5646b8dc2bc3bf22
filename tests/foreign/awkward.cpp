// SPDX-License-Identifier: Apache-2.0
// A library that loads, and whose words are full of what Markdown takes for its own.
#include <vestige/brdf.h>
#include <vestige/plugin.h>

namespace vestige {
namespace {

class Awkward final : public Brdf {
 public:
  static Schema schema() {
    return {.kind = "brdf",
            .name = "awkward",
            .summary = "1. a | b, *c*, _d_, <b>e</b>, `f`, [g](h), \\i, &amp; $j$\nand # k",
            .params = {real("a_b", 1).in("W/(m^2 sr) | *").doc("<i>|`x`|</i>"),
                       choice("c", {"d|e", "f`g"}).place().doc("- not a list"),
                       vec3("v", {1, 2, 3}).need()},
            .inputs = {}};
  }
  ScatterValue evaluate(const ScatterPoint&, Vec3) const noexcept override { return {}; }
  std::optional<ScatterSample> sample(const ScatterPoint&, ScatterNumbers) const noexcept override {
    return std::nullopt;
  }
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Brdf, vestige::Awkward)
