// SPDX-License-Identifier: Apache-2.0
// Round cone, pointed or cut off, between the centres of its two ends.
#include <vestige/plugin.h>

#include "frustum.h"

namespace vestige {
namespace {

class Cone final : public Frustum {
 public:
  enum Row { kBase, kBaseRadius, kCap, kCapRadius, kOpen };

  static Schema schema() {
    const double inf = std::numeric_limits<double>::infinity();
    return {
        .kind = "shape",
        .name = "cone",
        .summary = "round, pointed or cut off, between the centres of its two ends",
        .params = {vec3("base", {}).need().place().in("scene units").doc("middle of one lid"),
                   real("base_radius", 1)
                       .need()
                       .place()
                       .range(0, inf)
                       .in("scene units")
                       .doc("of that lid; 0: a point"),
                   vec3("cap", {}).need().place().in("scene units").doc("middle of the other lid"),
                   real("cap_radius", 0)
                       .need()
                       .place()
                       .range(0, inf)
                       .in("scene units")
                       .doc("of that lid; 0: a point"),
                   boolean("open", false).doc("without lids")}};
  }
  explicit Cone(const Values& v)
      : Frustum(v.vec3(kBase), v.real(kBaseRadius), checked(v), v.real(kCapRadius), v.flag(kOpen)) {
  }

 private:
  static Vec3 checked(const Values& v) {
    if (v.vec3(kBase) == v.vec3(kCap))
      throw PluginError(kCap, "both ends of the cone are at the same point");
    if (v.real(kBaseRadius) == 0 && v.real(kCapRadius) == 0)
      throw PluginError(kCapRadius, "both radii of the cone are 0: it has no surface");
    return v.vec3(kCap);
  }
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Shape, vestige::Cone)
