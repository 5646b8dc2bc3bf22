// SPDX-License-Identifier: Apache-2.0
// Round cylinder between the centres of its two lids.
#include <vestige/plugin.h>

#include "frustum.h"

namespace vestige {
namespace {

class Cylinder final : public Frustum {
 public:
  enum Row { kBase, kCap, kRadius, kOpen };

  static Schema schema() {
    return {
        .kind = "shape",
        .name = "cylinder",
        .summary = "round, between the centres of its two lids",
        .params = {vec3("base", {}).need().place().in("scene units").doc("middle of one lid"),
                   vec3("cap", {}).need().place().in("scene units").doc("middle of the other lid"),
                   real("radius", 1).need().place().positive().in("scene units").doc("of the side"),
                   boolean("open", false).doc("without lids")}};
  }
  explicit Cylinder(const Values& v)
      : Frustum(v.vec3(kBase), v.real(kRadius), checked(v), v.real(kRadius), v.flag(kOpen)) {}

 private:
  static Vec3 checked(const Values& v) {
    if (v.vec3(kBase) == v.vec3(kCap))
      throw PluginError(kCap, "both ends of the cylinder are at the same point");
    return v.vec3(kCap);
  }
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Shape, vestige::Cylinder)
