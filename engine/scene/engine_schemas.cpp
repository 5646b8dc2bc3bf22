// SPDX-License-Identifier: Apache-2.0
#include "engine/scene/engine_schemas.h"

#include <vestige/footprint/language.h>

namespace vestige {

namespace {

std::vector<Parameter> visibilityRows() {
  return {
      text(kVisibleTo, "")
          .unset()
          .doc("kinds of rays that meet it, some of \"camera shadow reflection refraction "
               "indirect\"; default: all, or what the union around it says"),
      boolean(kNoShadow, false).doc("shadow rays do not meet it"),
      boolean(kNoImage, false).doc("camera rays do not meet it, nor those through smooth glass"),
      boolean(kNoReflection, false).doc("rays from mirrors do not meet it")};
}

void append(std::vector<Parameter>& rows, std::vector<Parameter> more) {
  rows.insert(rows.end(), more.begin(), more.end());
}

/// Whether a BRDF may cover a dielectric solid.
bool mayRefract(const Schema& brdf) {
  const auto isIndex = [](const Parameter& p) { return p.isRefractiveIndex; };
  const auto holdsBrdf = [](const Parameter& p) { return p.blockKind == "brdf"; };
  return std::any_of(brdf.inputs.begin(), brdf.inputs.end(), isIndex) ||
         std::any_of(brdf.params.begin(), brdf.params.end(), holdsBrdf);
}

std::vector<Parameter> solidRows() {
  return {
      integer(kPriority, 0)
          .range(-1000, 1000)
          .doc("where solids overlap, the one of the highest priority fills the place; of equal "
               "ones the smaller"),
      rgb(kAbsorption, 0)
          .range(0, 1e12)
          .in("1/scene unit")
          .doc("inside a closed shape, a share exp(-absorption d) of the light gets d far")};
}

}  // namespace

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
       .params = visibilityRows(),
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
        parameter(kNormalMap, ValueType::rgb, colourValue(0.5, 0.5, 1))
            .doc(
                "tangent-space normals, 0..1 for -1..1, y towards growing v; color_space \"raw\""));
    schema.inputs.push_back(
        rgb(kOpacity, 1)
            .range(0, 1)
            .nonlinear()
            .doc("share of light that does not pass straight through; a colour: by channel"));
    for (Parameter& p : schema.inputs) p.texturable = true;
    schema.params.push_back(real(kOpacityCutoff, 0.5)
                                .unset()
                                .range(0, 1)
                                .doc("a cut-out: opacity from here on is 1, below it 0"));
    if (mayRefract(schema)) append(schema.params, solidRows());
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
    append(schema.params, visibilityRows());
    schema.children.push_back("brdf");
  }
  if (schema.kind == "light") append(schema.params, visibilityRows());
  return schema;
}

}  // namespace vestige
