// SPDX-License-Identifier: Apache-2.0
// BRDFs that hold others: their inputs, their textures, and what a scene may not say.
#include "engine/render/session.h"
#include "support/catch.h"
#include "support/scenes.h"

using namespace vestige;
using test::makeBlock;

namespace {

Value holding(Block block) {
  Value v;
  v.kind = Value::Kind::block;
  v.block = std::make_shared<const Block>(std::move(block));
  return v;
}

Block mixOf(Block first, Block second, double amount) {
  return makeBlock("brdf", "mix",
                   {{"first", holding(std::move(first))},
                    {"second", holding(std::move(second))},
                    {"amount", numberValue(amount)}});
}

/// A wall in light of radiance 1 from everywhere, seen along its normal: each pixel is its
/// directional albedo.
double furnace(Block brdf) {
  SceneDesc s;
  s.blocks = {makeBlock("camera", "orthographic",
                        {{"location", vectorValue({0, 0, -2})},
                         {"look_at", vectorValue({0, 0, 0})},
                         {"width", numberValue(1)}}),
              makeBlock("film", "", {{"resolution", vectorValue({16, 16})}}),
              makeBlock("integrator", "path", {{"depth", numberValue(32)}}),
              makeBlock("light", "environment", {{"radiance", colourValue(1, 1, 1)}}),
              test::quad({-5, -5, 0}, {0, 10, 0}, {10, 0, 0}, {std::move(brdf)})};
  Diagnostics diagnostics;
  auto scene = buildScene(s, test::registry(), {}, diagnostics);
  for (const Diagnostic& d : diagnostics.list()) UNSCOPED_INFO(d.message);
  REQUIRE(scene);
  Film film = makeFilm(*scene, 0, 0, nullptr, {});
  render(*scene, film, {.samples = 256, .threads = 2});
  double sum = 0;
  const auto means = film.means();
  for (const float v : means.pixels) sum += v;
  return sum / double(means.pixels.size());
}

std::string refusal(Block brdf) {
  SceneDesc s = test::room(0.5, "path");
  s.blocks.back().children = {std::move(brdf)};
  Diagnostics diagnostics;
  CHECK_FALSE(buildScene(s, test::registry(), {}, diagnostics));
  std::string text;
  for (const Diagnostic& d : diagnostics.list()) text += d.message + '\n';
  return text;
}

}  // namespace

TEST_CASE("a mixture reflects the mean of its parts", "[brdf][nested]") {
  using test::lambert;
  CHECK(furnace(mixOf(lambert(0.8), lambert(0.2), 0.25)) == Approx(0.65).margin(5e-3));
  CHECK(furnace(mixOf(lambert(0.8), lambert(0.2), 0)) == Approx(0.8).margin(5e-3));
  CHECK(furnace(mixOf(lambert(0.8), lambert(0.2), 1)) == Approx(0.2).margin(5e-3));
  const Block mirror = makeBlock("brdf", "mirror", {{"specular", colourValue(1, 1, 1)}});
  CHECK(furnace(mixOf(lambert(0), mirror, 0.3)) == Approx(0.3).margin(5e-3));
  // A mixture of mixtures: inputs of the third level are found as well.
  CHECK(furnace(mixOf(mixOf(lambert(0.9), lambert(0.1), 0.5), lambert(0.3), 0.5)) ==
        Approx(0.4).margin(5e-3));
}

TEST_CASE("inputs of a BRDF inside another may be textured", "[brdf][nested]") {
  Block checker = makeBlock("pigment", "checker",
                            {{"first", colourValue(1, 1, 1)}, {"second", colourValue(0, 0, 0)}});
  for (int i = 0; i < 3; ++i) checker.own.m[i][i] = 0.05;
  checker.world = checker.own;
  const Block textured = makeBlock("brdf", "lambert", {{"diffuse", holding(checker)}});
  CHECK(furnace(mixOf(test::lambert(0.2), textured, 0.5)) == Approx(0.35).margin(2e-2));
}

TEST_CASE("a coat reflects by Fresnel's law and lets the rest through twice", "[brdf][nested]") {
  const auto coated = [](double base) {
    return makeBlock("brdf", "coat",
                     {{"base", holding(test::lambert(base))},
                      {"alpha", numberValue(0)},
                      {"coat_ior", numberValue(1.5)}});
  };
  CHECK(furnace(coated(0)) == Approx(0.04).margin(1e-3));
  // 0.0918 is the reflectance of an index of 1.5 for diffuse light: the base's gets out past it.
  CHECK(furnace(coated(1)) == Approx(0.04 + 0.96 * (1 - 0.0918)).margin(3e-3));
}

TEST_CASE("what a nested BRDF may not say is an error", "[brdf][nested]") {
  Block clear = test::lambert(0.5);
  clear.settings.push_back({"opacity", numberValue(0.5), {}});
  CHECK_THAT(refusal(mixOf(clear, test::lambert(0.5), 0.5)),
             containsText("'opacity' belongs to the surface"));
  CHECK_THAT(refusal(mixOf(makeBlock("brdf", "nonsense"), test::lambert(0.5), 0.5)),
             containsText("there is no brdf called 'nonsense'"));
  Block deep = test::lambert(0.5);
  for (int i = 0; i < 40; ++i) deep = mixOf(deep, test::lambert(0.5), 0.5);
  CHECK_THAT(refusal(deep), containsText("at most 48 are possible"));
}
