// SPDX-License-Identifier: Apache-2.0
// Schemas written by hand, so that the language is tested with no plugin at all; and short ways to
// run it.
#pragma once
#include "support/catch.h"

#include <sstream>
#include <string>
#include <vector>

#include "lang/lang.h"
#include "support/schema_list.h"

namespace vestige::lang::test {

inline Parameter textured(Parameter p) {
  p.texturable = true;
  return p;
}

/// Blocks that hold blocks of their own kind, lists, maps and functions.
inline void addCompound(std::vector<Schema>& s) {
  s.push_back({"brdf", "mix", "", {real("amount", 0.5).range(0, 1)}, {}, {"brdf"}});
  s.push_back({"brdf", "coat", "", {block("base", "brdf").need()}});
  s.push_back({"pigment",
               "tiles",
               "",
               {rgb("first", 1).place().textured(), rgb("second", 0).place().textured()}});
  s.push_back({"pigment",
               "ramp",
               "",
               {map("colour_map", ValueType::rgb).textured().keys(0, 1).range(0, 1).need(),
                list("seeds", ValueType::integer).entries(3, 3)}});
  s.push_back({"pigment", "layers", "", {list("parts", ValueType::block).of("pigment")}});
  s.push_back(
      {"shape",
       "lathe",
       "",
       {list("profile", ValueType::vec2)
            .need()
            .place()
            .range(-100, 100)
            .entries(2, 2'000'000)
            .in("scene units"),
        list("files", ValueType::file), list("weights", ValueType::real), function("bend", 1)},
       {},
       {"brdf"}});
  s.push_back({"shape", "isosurface", "", {function("function", 3).need()}, {}, {"brdf"}});
}

inline const SchemaSource& schemas() {
  static const vestige::test::SchemaList all = [] {
    const std::vector<std::string> shapeParts = {"brdf"};
    const auto point = [](const char* name) { return vec3(name, {}).need().place(); };
    std::vector<Schema> s;
    s.push_back({"camera",
                 "pinhole",
                 "a pinhole camera",
                 {vec3("location", {}), vec3("look_at", {0, 0, 1}),
                  real("angle", 67).range(0, 180).in("degrees").doc("full horizontal")}});
    s.push_back({"film",
                 "",
                 "the picture",
                 {vec2("resolution", {640, 480}).range(1, 65536),
                  choice("filter", {"box", "gaussian", "blackman_harris"})}});
    s.push_back({"integrator",
                 "path",
                 "path tracing",
                 {integer("samples", 16).range(1, 1e9), integer("depth", 8).range(1, 1000),
                  block("footprint", "footprint")}});
    s.push_back({"footprint", "local", "", {real("limit", 0).positive(), real("scale", 1)}});
    s.push_back({"footprint", "pixel", ""});
    s.push_back({"light",
                 "point",
                 "",
                 {vec3("location", {}).need().doc("where it is"), rgb("intensity", 1)}});
    s.push_back({"light",
                 "area",
                 "",
                 {point("corner"), point("edge1"), point("edge2"), rgb("radiance", 1),
                  boolean("two_sided", false)}});
    s.push_back(
        {"light", "slide", "", {rgb("radiance", 1), choice("filter", {"nearest", "linear"})}});
    s.push_back({"light", "environment", "", {rgb("radiance", 1), block("image", "pigment")}});
    s.push_back({"brdf", "lambert", "", {}, {textured(rgb("diffuse", 0.5).range(0, 1))}});
    s.push_back(
        {"brdf",
         "phong",
         "",
         {real("ior", 1.5).range(1, 10)},
         {textured(rgb("specular", 0).range(0, 1)), textured(real("exponent", 50).range(0, 1e6)),
          textured(rgb("transmission", 0).range(0, 1))}});
    s.push_back(
        {"pigment", "checker", "", {}, {rgb("first", 1).place(), rgb("second", 0).place()}});
    s.push_back({"pigment",
                 "image",
                 "",
                 {file("file").need().place(), choice("wrap", {"repeat", "clamp", "mirror"})}});
    s.push_back({"shape",
                 "sphere",
                 "",
                 {point("centre"), real("radius", 1)
                                       .positive()
                                       .need()
                                       .place()
                                       .in("scene units")
                                       .doc("from the centre to the surface")},
                 {textured(rgb("emission", 0))},
                 shapeParts});
    s.push_back({"shape", "box", "", {point("low"), point("high")}, {}, shapeParts});
    s.push_back(
        {"shape", "plane", "", {point("normal"), real("distance", 0).place()}, {}, shapeParts});
    s.push_back({"shape", "mesh", "", {file("file").need().place()}, {}, shapeParts});
    s.push_back({"union", "", "shapes together", {}, {}, {"shape", "union", "brdf"}});
    addCompound(s);
    for (Schema& each : s) {
      const auto isOneOf = [&](std::initializer_list<const char*> kinds) {
        return std::find(kinds.begin(), kinds.end(), each.kind) != kinds.end();
      };
      each.standsAlone = isOneOf({"camera", "film", "integrator", "light", "shape", "union"});
      each.isSingle = isOneOf({"camera", "film", "integrator"});
      each.isMovable = !isOneOf({"film", "integrator", "footprint"});
    }
    return vestige::test::SchemaList(s);
  }();
  return all;
}

inline Result read(const std::string& text, Options options = {}) {
  if (!options.debug) options.debug = [](const std::string&) {};
  return readSceneText("test.scene", text, schemas(), options);
}

/// All diagnostics as printed.
inline std::string printed(const Result& result) {
  std::ostringstream out;
  for (const Diagnostic& d : result.diagnostics.list()) print(out, d, *result.sources, false);
  return out.str();
}

/// What #debug said, then the messages of all errors.
inline std::string debugOf(const std::string& text, Options options = {},
                           const SchemaSource& source = schemas()) {
  std::string said;
  options.debug = [&](const std::string& s) { said += s; };
  const Result result = readSceneText("test.scene", text, source, options);
  for (const Diagnostic& d : result.diagnostics.list())
    if (d.severity == Severity::error) said += "error: " + d.message + '\n';
  return said;
}

/// A scene that has to be without errors.
inline SceneDesc scene(const std::string& text) {
  const Result result = read(text);
  INFO(printed(result));
  REQUIRE(!result.diagnostics.hasErrors());
  return result.scene;
}

}  // namespace vestige::lang::test
