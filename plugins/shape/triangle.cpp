// SPDX-License-Identifier: Apache-2.0
// One triangle; its normal is cross(b - a, c - a). Normals at its corners bend the shading, uv at
// its corners replace barycentric coordinates.
#include <vestige/plugin.h>

#include "exact.h"

namespace vestige {
namespace {

using exact::V;

class Triangle final : public MeshShape {
 public:
  enum Row { kA, kB, kC, kNormalA, kNormalB, kNormalC, kUvA, kUvB, kUvC };

  static Schema schema() {
    return {.kind = "shape",
            .name = "triangle",
            .summary = "its normal is vcross(b - a, c - a)",
            .params = {
                vec3("a", {}).need().place().in("scene units").doc("first corner"),
                vec3("b", {}).need().place().in("scene units").doc("second corner, where u is 1"),
                vec3("c", {}).need().place().in("scene units").doc("third corner, where v is 1"),
                vec3("normal_a", {}).unset().doc("for smooth shading, all three or none"),
                vec3("normal_b", {}).unset().doc("at the second corner"),
                vec3("normal_c", {}).unset().doc("at the third corner"),
                vec2("uv_a", {}).unset().doc("all three or none"),
                vec2("uv_b", {}).unset().doc("at the second corner"),
                vec2("uv_c", {}).unset().doc("at the third corner")}};
  }

  explicit Triangle(const Values& v) {
    const V ab = V(v.vec3(kB)) - V(v.vec3(kA)), ac = V(v.vec3(kC)) - V(v.vec3(kA));
    if (!(length(cross(ab, ac)) > 1e-7 * std::max(dot(ab, ab), dot(ac, ac))))
      throw PluginError(kC, "the three corners lie on one line: the triangle has no area");
    TriangleMesh mesh;
    mesh.triangles = {{0, 1, 2}};
    mesh.positions = {v.vec3(kA), v.vec3(kB), v.vec3(kC)};
    if (allOrNone(v, kNormalA))
      for (int row = kNormalA; row <= kNormalC; ++row) {
        if (!(length(v.vec3(row)) > 0))
          throw PluginError(row, "the normal is <0, 0, 0>, expected a direction");
        mesh.normals.push_back(normalize(v.vec3(row)));
      }
    if (allOrNone(v, kUvA)) mesh.uvs = {v.vec2(kUvA), v.vec2(kUvB), v.vec2(kUvC)};
    parts_.push_back({std::move(mesh), "", nullptr, {}});
  }

 private:
  static bool allOrNone(const Values& v, int first) {
    const int given = v.has(first) + v.has(first + 1) + v.has(first + 2);
    for (int row = first; row < first + 3; ++row)
      if (given % 3 != 0 && v.has(row))
        throw PluginError(row, std::string("given for ") +
                                   (given == 1 ? "one corner" : "two corners") +
                                   " only, expected for all three or none");
    return given == 3;
  }
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Shape, vestige::Triangle)
