// SPDX-License-Identifier: Apache-2.0
#include "engine/scene/engine_schemas.h"

#include <vestige/footprint/settings.h>

namespace vestige {

std::vector<Schema> engineSchemas() {
  Value whole = vectorValue({0, 0, 1, 1});
  std::vector<Schema> all = footprintSchemas();
  const Schema blocks[] = {
      {.kind = "film",
       .name = "",
       .summary = "size of the picture and how samples become pixels",
       .params =
           {vec2("resolution", {640, 480})
                .range(1, 16384)
                .in("pixels")
                .place()
                .doc("width and height"),
            choice("filter", {"box", "gaussian", "blackman_harris"})
                .doc("pixel filter, drawn by importance; box is one pixel wide, the others three"),
            parameter("crop", ValueType::vec4, whole)
                .range(0, 1)
                .doc("<left, top, right, bottom> as shares of the picture")},
       .standsAlone = true,
       .isSingle = true,
       .isMovable = false},
      {.kind = "union",
       .name = "",
       .summary = "several shapes as one: a brdf or a transform after them is for all",
       .children = {"shape", "union", "brdf"},
       .standsAlone = true},
  };
  all.insert(all.end(), std::begin(blocks), std::end(blocks));
  return all;
}

Schema withEngineRows(Schema schema) {
  const auto isOneOf = [&](std::initializer_list<const char*> kinds) {
    return std::find(kinds.begin(), kinds.end(), schema.kind) != kinds.end();
  };
  schema.standsAlone |= isOneOf({"camera", "integrator", "light", "shape"});
  schema.isSingle |= isOneOf({"camera", "integrator"});
  schema.isMovable &= schema.kind != "integrator";
  if (schema.kind == "brdf") {
    schema.inputs.push_back(
        parameter("normal_map", ValueType::rgb, colourValue(0.5, 0.5, 1))
            .doc(
                "tangent-space normals, 0..1 for -1..1, y towards growing v; color_space \"raw\""));
    schema.inputs.push_back(
        real("opacity", 1).range(0, 1).doc("share of light that does not pass straight through"));
    for (Parameter& p : schema.inputs) p.texturable = true;
  }
  if (schema.kind == "shape") {
    Parameter emission = rgb(kEmission, 0)
                             .unset()
                             .range(0, 1e12)
                             .in("W/(m^2 sr)")
                             .doc("radiance that the surface gives off: makes it a light");
    emission.texturable = true;
    schema.params.push_back(emission);
    schema.params.push_back(choice(kEmissionSides, {"front", "both"})
                                .doc("front: the side of the normal, outside of solids"));
    schema.children.push_back("brdf");
  }
  return schema;
}

}  // namespace vestige
