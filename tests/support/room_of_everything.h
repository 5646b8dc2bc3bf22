// SPDX-License-Identifier: Apache-2.0
// A closed room with a bit of everything that a path can meet.
#pragma once
#include <fstream>

#include "support/catch.h"
#include "support/judge.h"
#include "support/path_judge.h"
#include "support/scenes.h"
#include "support/temp_folder.h"

namespace vestige::test {

inline Value vec(double x, double y, double z) { return vectorValue({x, y, z}); }

/// A smooth ball as an OBJ file, its uv as on a globe, a little squashed.
inline void writeBall(const std::string& file, int columns, int rows) {
  std::ofstream out(file);
  for (int y = 0; y <= rows; ++y)
    for (int x = 0; x <= columns; ++x) {
      const double lon = 2 * M_PI * x / columns, lat = M_PI * (0.02 + 0.96 * y / rows);
      const double n[3] = {std::sin(lat) * std::cos(lon), std::cos(lat),
                           std::sin(lat) * std::sin(lon)};
      out << "v " << n[0] << ' ' << 0.8 * n[1] << ' ' << n[2] << "\nvn " << n[0] << ' '
          << n[1] / 0.8 << ' ' << n[2] << "\nvt " << double(x) / columns << ' ' << double(y) / rows
          << '\n';
    }
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      const int a = 1 + y * (columns + 1) + x, c = a + columns + 1;
      const auto corner = [&](int i) { out << ' ' << i << '/' << i << '/' << i; };
      out << "f", corner(a), corner(a + 1), corner(c + 1), out << "\nf", corner(a), corner(c + 1),
          corner(c), out << '\n';
    }
}

inline Block brdf(const std::string& name, Settings settings) {
  return makeBlock("brdf", name, std::move(settings));
}

inline Block placed(Block shape, const Affine& t) {
  shape.own = shape.world = t;
  for (Block& child : shape.children.edit()) child.world = t;
  return shape;
}

inline Affine at(double x, double y, double z, double size, double squash = 1, double turn = 0) {
  Affine a;
  const double c = std::cos(turn), s = std::sin(turn);
  a.m[0][0] = size * c, a.m[0][1] = -size * squash * s;
  a.m[1][0] = size * s, a.m[1][1] = size * squash * c, a.m[2][2] = size;
  a.m[0][3] = x, a.m[1][3] = y, a.m[2][3] = z;
  return a;
}

/// A closed room with a bit of everything: curved mirrors, glass, glossy and anisotropic metal,
/// meshes with smooth normals, stretched instances, a tilted normal map.
inline SceneDesc everything(const std::string& folder) {
  writeBall(folder + "/ball.obj", 24, 16);
  SceneDesc s = room(0.7, "path");
  std::erase_if(s.blocks,
                [](const Block& b) { return b.kind != "film" && b.kind != "integrator"; });
  s.blocks.push_back(makeBlock("camera", "thin_lens",
                               {{"location", vec(0.2, 0.1, -2.9)},
                                {"look_at", vec(0, 0, 0)},
                                {"angle", numberValue(70)},
                                {"aperture", numberValue(0.1)},
                                {"focal_point", vec(0, 0, 0.5)}}));
  const std::vector<Block> matt = {lambert(0.7)};
  const std::vector<Block> glossy = {
      brdf("phong", {{"specular", colourValue(0.8, 0.8, 0.8)}, {"exponent", numberValue(40)}})};
  s.blocks.push_back(quad({-3, -3, -3}, {6, 0, 0}, {0, 0, 6}, matt));
  s.blocks.push_back(quad({-3, 3, -3}, {6, 0, 0}, {0, 0, 6}, matt));
  s.blocks.push_back(quad({-3, -3, -3}, {6, 0, 0}, {0, 6, 0}, matt));
  s.blocks.push_back(quad({-3, -3, 3}, {6, 0, 0}, {0, 6, 0}, glossy));
  s.blocks.push_back(quad({-3, -3, -3}, {0, 6, 0}, {0, 0, 6}, matt));
  s.blocks.push_back(quad({3, -3, -3}, {0, 6, 0}, {0, 0, 6}, matt));
  // A tilted normal everywhere, as a map would say: both colours of the checker are the same.
  Value tilted;
  const Value map = colourValue(0.7, 0.4, 0.9);
  tilted.kind = Value::Kind::block;
  tilted.block = std::make_shared<const Block>(
      makeBlock("pigment", "checker", {{"first", map}, {"second", map}}));
  const auto unit = numberValue(1);
  s.blocks.push_back(
      placed(makeBlock("shape", "sphere", {{"centre", vec(0, 0, 0)}, {"radius", unit}},
                       {brdf("rough_conductor", {{"alpha", numberValue(0.3)},
                                                 {"anisotropy", numberValue(0.4)},
                                                 {"normal_map", tilted}})}),
             at(2.0, 2.1, 1.0, 0.7, 1.3, 0.2)));
  s.blocks.push_back(
      placed(makeBlock("shape", "sphere", {{"centre", vec(0, 0, 0)}, {"radius", unit}}, glossy),
             at(-1.3, 0.6, 0.5, 0.9)));
  s.blocks.push_back(placed(makeBlock("shape", "mesh", {{"file", textValue(folder + "/ball.obj")}},
                                      {brdf("rough_dielectric", {{"alpha", numberValue(0.15)},
                                                                 {"ior", numberValue(1.5)}})}),
                            at(1.1, 0.7, 0.3, 0.8)));
  s.blocks.push_back(placed(
      makeBlock("shape", "torus", {{"major_radius", unit}, {"minor_radius", numberValue(0.4)}},
                {brdf("rough_conductor",
                      {{"alpha", numberValue(0.3)}, {"anisotropy", numberValue(0.6)}})}),
      at(-1.2, -1.2, 0.6, 0.8, 0.9, 0.5)));
  s.blocks.push_back(
      placed(makeBlock("shape", "cone",
                       {{"base", vec(0, -1, 0)},
                        {"base_radius", unit},
                        {"cap", vec(0, 1, 0)},
                        {"cap_radius", numberValue(0.3)}},
                       {brdf("rough_conductor",
                             {{"alpha", numberValue(0.2)}, {"anisotropy", numberValue(0.5)}})}),
             at(1.2, -1.3, 0.7, 0.7, 1.2, -0.4)));
  s.blocks.push_back(
      placed(makeBlock("shape", "sphere", {{"centre", vec(0, 0, 0)}, {"radius", unit}},
                       {brdf("glass", {{"ior", numberValue(1.5)}})}),
             at(0, 1.7, 1.2, 0.7, 0.6, 0.3)));
  s.blocks.push_back(placed(
      makeBlock(
          "shape", "cylinder", {{"base", vec(0, -1, 0)}, {"cap", vec(0, 1, 0)}, {"radius", unit}},
          {brdf("principled", {{"roughness", numberValue(0.4)}, {"metallic", numberValue(0.5)}})}),
      at(0, -0.2, 2.0, 0.5)));
  s.blocks.push_back(placed(
      makeBlock("shape", "mesh", {{"file", textValue(folder + "/ball.obj")}}, {brdf("mirror", {})}),
      at(-0.1, -2.2, 0.2, 0.6, 1.3, 0.8)));
  return s;
}

/// A setting that no schema knows would be left out in silence.
inline void checkNames(const Block& block) {
  const Schema* schema = registry().schema(block.kind, block.plugin);
  INFO(block.kind << ' ' << block.plugin);
  REQUIRE(schema);
  for (const Setting& s : block.settings) {
    INFO(s.name);
    CHECK(schema->find(s.name));
    if (s.value.block) checkNames(*s.value.block);
  }
  for (const Block& child : block.children) checkNames(child);
}

inline std::unique_ptr<Scene> built(const SceneDesc& description) {
  for (const Block& block : description.blocks) checkNames(block);
  Diagnostics diagnostics;
  auto scene = buildScene(description, registry(), {}, diagnostics);
  for (const Diagnostic& d : diagnostics.list()) UNSCOPED_INFO(d.message);
  REQUIRE(scene);
  return scene;
}

}  // namespace vestige::test
