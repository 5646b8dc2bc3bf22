// SPDX-License-Identifier: Apache-2.0
// Parallel light from infinity: a sun of zero size.
#include <vestige/delta_light.h>

namespace vestige {
namespace {

class Distant final : public DistantSource {
 public:
  enum Row { kDirection, kIrradiance };

  static Schema schema() {
    return {.kind = "light",
            .name = "distant",
            .summary = "parallel light from infinity",
            .params = {vec3("direction", {0, -1, 0}).place().doc("the way the light travels"),
                       rgb("irradiance", 1)
                           .range(0, 1e12)
                           .in("W/m^2")
                           .doc("on a surface across that direction")}};
  }

  explicit Distant(const Values& values)
      : DistantSource(normalize(values.toWorld().vector(values.vec3(kDirection))),
                      values.rgb(kIrradiance)) {
    if (lengthSquared(direction()) == 0)
      throw PluginError(kDirection,
                        "direction has no length: expected a vector such as <0, -1, 0>");
  }
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Light, vestige::Distant)
