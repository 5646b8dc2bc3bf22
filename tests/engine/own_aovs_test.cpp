// SPDX-License-Identifier: Apache-2.0
// AOVs that an integrator declares: from its slots to layers of the film, by name.
#include <filesystem>
#include <fstream>

#include "engine/film/checkpoint.h"
#include "engine/render/session.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/temp_folder.h"

using namespace vestige;
using namespace vestige::test;

namespace {

const Registry& plugins() {
  static std::vector<std::string> refused;
  static const Registry all = Registry::load({VESTIGE_PLUGINS, VESTIGE_OWN_AOVS}, refused);
  return all;
}

/// Four pixels, each a unit wide; their middles are at -1.5, -0.5, 0.5 and 1.5 times `size`.
SceneDesc fourPixels(double value, double size = 1, const std::string& declare = "two") {
  SceneDesc s;
  s.blocks = {makeBlock("camera", "orthographic",
                        {{"location", vectorValue({0, 0, -size})},
                         {"look_at", vectorValue({0, 0, 0})},
                         {"width", numberValue(4 * size)}}),
              makeBlock("film", "", {{"resolution", vectorValue({4, 1})}}),
              makeBlock("integrator", "own_aovs",
                        {{"value", numberValue(value)}, {"declare", textValue(declare)}})};
  return s;
}

std::unique_ptr<Scene> built(const SceneDesc& description) {
  Diagnostics diagnostics;
  return buildScene(description, plugins(), {}, diagnostics);
}

}  // namespace

TEST_CASE("an integrator's own AOVs are layers of the film, in the order wanted", "[film][aov]") {
  for (const double size : {1e-3, 1.0, 1e6}) {
    const auto scene = built(fourPixels(-2.5, size));
    REQUIRE(scene);
    Film film = makeFilm(*scene, 0, 0, nullptr, {"aim.x", "depth", "test.value"});
    const RenderResult result = render(*scene, film, {.samples = 1024, .threads = 2});
    CHECK(result.counters.rays == 4 * 1024);
    const Film::Means m = film.means();
    CHECK(m.channels == std::vector<std::string>{"R", "G", "B", "aim.x", "depth.Z", "test.value"});
    for (std::size_t x = 0; x < 4; ++x) {
      const float* p = &m.pixels[6 * x];
      CHECK(p[0] == 0.5f);
      // The pixel's middle: samples are spread evenly, far better than 1 / sqrt(1024).
      CHECK(std::abs(p[3] / size - (double(x) - 1.5)) < 2e-3);
      CHECK(p[4] == 0);
      CHECK(p[5] == -2.5f);
    }
    CHECK(film.cuts()[0] == 0);
  }
}

TEST_CASE("the unit of an own AOV is its step, which follows the scene if it is a length",
          "[film][aov]") {
  constexpr AovSlot kSlots[] = {{"n", "", AovMeasure::number, 0.3},
                                {"l", "", AovMeasure::length, 0x1p-20}};
  CHECK(layerOf("n", 1000, kSlots)->unit == 0.25);  // rounded down to a power of two
  CHECK(layerOf("l", 1, kSlots)->unit == 0x1p-20);
  CHECK(layerOf("l", 1000, kSlots)->unit == 0x1p-10);
  CHECK(layerOf("l", 1, kSlots)->limit() == 0x1p32);
  CHECK_FALSE(layerOf("m", 1, kSlots));
  // 2^52 steps are the limit.
  Film film(1, 1, {0, 0, 1, 1}, {"n"}, 1, kSlots);
  Counters counters;
  Real own[] = {Real(0x1p51), 0};
  Aovs aovs;
  aovs.own = own;
  film.add(0, 0, {}, aovs, counters);
  CHECK(film.cuts()[0] == 1);
  CHECK(film.means().pixels[3] == Approx(0x1p50));
}

TEST_CASE("the names of the common AOVs are those that slots may not take", "[film][aov]") {
  CHECK(aovNames() == std::vector<std::string>(std::begin(kCommonAovs), std::end(kCommonAovs)));
}

TEST_CASE("a film of an unknown AOV is refused", "[film][aov]") {
  const auto scene = built(fourPixels(1));
  REQUIRE(scene);
  CHECK_THROWS_WITH(makeFilm(*scene, 0, 0, nullptr, {"test.valve"}),
                    "there is no AOV 'test.valve'");
}

TEST_CASE("wrong lists of AOVs are refused where the scene is built", "[film][aov]") {
  const std::pair<const char*, const char*> cases[] = {
      {"nine", "integrator own_aovs declares 9 AOVs; 8 are allowed"},
      {"taken", "declares an AOV 'depth', a name that every integrator has already"},
      {"all", "declares an AOV 'all'"},
      {"twice", "declares the AOV 'test.value' twice"},
      {"comma", "declares an AOV 'a,b': names have letters"},
      {"no_name", "declares an AOV '': names have letters"},
      {"zero_step", "with a step of 0; it must be above 0 and finite"},
      {"infinite_step", "with a step of inf; it must be above 0 and finite"}};
  for (const auto& [declare, sentence] : cases) {
    INFO(declare);
    Diagnostics diagnostics;
    CHECK_FALSE(buildScene(fourPixels(1, 1, declare), plugins(), {}, diagnostics));
    REQUIRE(diagnostics.list().size() == 1);
    CHECK_THAT(diagnostics.list()[0].message, containsText(sentence));
  }
}

TEST_CASE("a checkpoint knows own AOVs by name and unit", "[checkpoint][aov]") {
  const TempFolder folder;
  const std::string file = folder / "a.checkpoint";
  const auto scene = built(fourPixels(3));
  REQUIRE(scene);
  const auto film = [&](const std::vector<std::string>& aovs) {
    return makeFilm(*scene, 0, 0, nullptr, aovs);
  };
  Film kept = film({"test.value", "aim.x"});
  render(*scene, kept, {.samples = 4, .threads = 1});
  saveCheckpoint(kept, {}, {}, file);
  Film again = film({"test.value", "aim.x"});
  loadCheckpoint(again, {}, file);
  CHECK(again == kept);
  Film other = film({"aim.x", "test.value"});
  CHECK_THROWS_WITH(
      loadCheckpoint(other, {}, file),
      containsText("the list of AOVs was test.value,aim.x and is aim.x,test.value now"));
}
