// SPDX-License-Identifier: Apache-2.0
// The builder and the session on scenes written by hand.
#include "engine/scene/scene.h"

#include <cstring>
#include <set>

#include "engine/render/session.h"
#include "support/catch.h"
#include "support/judge.h"
#include "support/room_of_everything.h"
#include "support/scenes.h"

using namespace vestige;
using test::makeBlock;

namespace {

Film rendered(const SceneDesc& description, RenderOptions options) {
  Diagnostics diagnostics;
  auto scene = buildScene(description, test::registry(), {}, diagnostics);
  for (const Diagnostic& d : diagnostics.list()) WARN(d.message);
  REQUIRE(scene);
  Film film = makeFilm(*scene, 0, 0, nullptr, {});
  render(*scene, film, options);
  return film;
}

/// The only error of building a scene.
std::string onlyError(const SceneDesc& description) {
  Diagnostics diagnostics;
  CHECK_FALSE(buildScene(description, test::registry(), {}, diagnostics));
  REQUIRE(diagnostics.errors() == 1);
  for (const Diagnostic& d : diagnostics.list())
    if (d.severity == Severity::error) return d.message;
  return "";
}

/// A sphere of a brdf, alone in a constant environment of radiance 1.
SceneDesc furnace(Block brdf, int depth = 64) {
  SceneDesc s;
  s.blocks = {
      makeBlock("camera", "pinhole",
                {{"location", vectorValue({0, 0, -4})},
                 {"look_at", vectorValue({0, 0, 0})},
                 {"angle", numberValue(20)}}),
      makeBlock("film", "", {{"resolution", vectorValue({8, 8})}}),
      makeBlock("integrator", "path", {{"depth", numberValue(depth)}}),
      makeBlock("light", "environment", {{"radiance", colourValue(1, 1, 1)}}),
      makeBlock("shape", "sphere", {{"centre", vectorValue({0, 0, 0})}, {"radius", numberValue(1)}},
                {std::move(brdf)})};
  return s;
}

}  // namespace

TEST_CASE("white furnace: what reflects everything disappears", "[scene][furnace]") {
  const auto check = [](Block brdf, double expected, double tolerance) {
    const Film::Means m =
        rendered(furnace(std::move(brdf)), {.samples = 256, .threads = 2}).means();
    double sum = 0;
    for (const float v : m.pixels) sum += v;
    CHECK(sum / double(m.pixels.size()) == Approx(expected).margin(tolerance));
  };
  const Value white = colourValue(1, 1, 1);
  check(makeBlock("brdf", "lambert", {{"diffuse", white}}), 1, 2e-3);
  check(makeBlock("brdf", "lambert", {{"diffuse", colourValue(0.5, 0.5, 0.5)}}), 0.5, 2e-3);
  check(makeBlock("brdf", "mirror", {{"specular", white}}), 1, 1e-4);
  check(makeBlock("brdf", "glass", {{"ior", numberValue(1.5)}}), 1, 2e-3);
  check(makeBlock("brdf", "lambert",
                  {{"diffuse", colourValue(0, 0, 0)}, {"opacity", numberValue(0.25)}}),
        0.75 * 0.75, 1e-2);  // through the front and the back
}

TEST_CASE("the same bits for any number of threads and any number of passes", "[session]") {
  const SceneDesc s = test::room(0.7, "path", {{"depth", numberValue(5)}});
  const Film one = rendered(s, {.samples = 7, .seed = 3, .threads = 1});
  const Film two = rendered(s, {.samples = 7, .seed = 3, .threads = 2});
  CHECK(one.means().pixels == two.means().pixels);
  const Film other = rendered(s, {.samples = 7, .seed = 4, .threads = 2});
  CHECK(one.means().pixels != other.means().pixels);
}

TEST_CASE("a render goes on where it stopped", "[session]") {
  const SceneDesc s = test::room(0.7, "path", {{"depth", numberValue(4)}});
  Diagnostics diagnostics;
  auto scene = buildScene(s, test::registry(), {}, diagnostics);
  REQUIRE(scene);
  Film parts = makeFilm(*scene, 0, 0, nullptr, {}), whole = parts;
  for (const int n : {3, 8, 11}) render(*scene, parts, {.samples = n, .threads = 2});
  render(*scene, whole, {.samples = 11, .threads = 1});
  CHECK(parts.means().pixels == whole.means().pixels);
}

TEST_CASE("cancelling keeps what was rendered", "[session]") {
  Diagnostics diagnostics;
  auto scene = buildScene(test::room(0.5, "path"), test::registry(), {}, diagnostics);
  REQUIRE(scene);
  Film film = makeFilm(*scene, 0, 0, nullptr, {});
  std::atomic<bool> cancel{false};
  RenderOptions options{.samples = 1 << 20, .threads = 2, .cancel = &cancel};
  options.progress = [&](const Progress& p) { cancel = p.elapsed > 0.3; };
  const RenderResult r = render(*scene, film, options);
  CHECK(r.end == RenderEnd::cancelled);
  CHECK(r.samples > 0);
  CHECK(r.seconds < 60);
}

TEST_CASE("a crop is a window of the whole picture", "[session]") {
  Diagnostics diagnostics;
  auto scene = buildScene(test::room(0.5, "path"), test::registry(), {}, diagnostics);
  REQUIRE(scene);
  const double window[4] = {0.25, 0.5, 0.75, 1};
  Film whole = makeFilm(*scene, 0, 0, nullptr, {}), part = makeFilm(*scene, 0, 0, window, {});
  render(*scene, whole, {.samples = 2, .threads = 2});
  render(*scene, part, {.samples = 2, .threads = 2});
  const Film::Means a = whole.means(), b = part.means();
  REQUIRE(b.width == 16);
  REQUIRE(b.height == 16);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x)
      CHECK(b.pixels[std::size_t(y * 16 + x) * 3] ==
            a.pixels[std::size_t((y + 16) * 32 + x + 8) * 3]);
}

TEST_CASE("what cannot be built is said in one sentence", "[scene]") {
  SceneDesc noCamera = test::room(0.5, "path");
  noCamera.blocks.erase(noCamera.blocks.begin());
  CHECK_THAT(onlyError(noCamera), containsText("no camera"));

  SceneDesc flat = test::room(0.5, "path");
  flat.blocks.back().world.m[0][0] = 0;
  CHECK_THAT(onlyError(flat), containsText("flatten"));

  SceneDesc shiningPlane = test::room(0.5, "path");
  shiningPlane.blocks.push_back(makeBlock("shape", "plane",
                                          {{"normal", vectorValue({0, 1, 0})},
                                           {"distance", numberValue(-2)},
                                           {"emission", colourValue(1, 1, 1)}}));
  CHECK_THAT(onlyError(shiningPlane), containsText("cannot shine"));

  const auto with = [](Block block) {
    SceneDesc s = test::room(0.5, "path");
    s.blocks.push_back(std::move(block));
    return s;
  };
  CHECK_THAT(onlyError(with(makeBlock("shape", "sphere",
                                      {{"centre", vectorValue({0, 0, 0})},
                                       {"radius", numberValue(1)},
                                       {"visible_to", textValue("camera shadows")}}))),
             containsText("found 'shadows'"));
  CHECK_THAT(onlyError(with(makeBlock("light", "point",
                                      {{"location", vectorValue({0, 0, 0})},
                                       {"intensity", colourValue(1, 1, 1)},
                                       {"no_image", numberValue(1)}}))),
             containsText("has no surface"));
  CHECK_THAT(onlyError(with(makeBlock("light", "area",
                                      {{"corner", vectorValue({0, 0, 0})},
                                       {"edge1", vectorValue({1, 0, 0})},
                                       {"edge2", vectorValue({0, 1, 0})},
                                       {"radiance", colourValue(1, 1, 1)},
                                       {"visible_to", textValue("camera")}}))),
             containsText("must be visible to indirect rays"));

  SceneDesc missing = test::room(0.5, "path");
  Block brdf = makeBlock("brdf", "lambert");
  Value image;
  image.kind = Value::Kind::block;
  image.block = std::make_shared<Block>(
      makeBlock("pigment", "image", {{"file", textValue("no_such_file.png")}}));
  brdf.settings.push_back({"diffuse", image, {}});
  missing.blocks.push_back(test::quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {brdf}));
  CHECK_THAT(onlyError(missing), containsText("no_such_file.png"));
}

TEST_CASE("a surface that is filled in keeps nothing of what it was before", "[scene]") {
  const test::TempFolder folder;
  const auto scene = test::built(test::everything(folder.path()));
  const Camera& camera = scene->camera();
  std::set<int> objects;
  test::Random random(3);
  for (int i = 0; i < 20000; ++i) {
    const auto start = camera.sample({{random.number(), random.number()}, {}, 1});
    if (!start) continue;
    // Two surfaces that differ in every byte, and after the same ray only in what is padding.
    Surface a, b;
    std::memset(static_cast<void*>(&a), 0x44, sizeof a);
    std::memset(static_cast<void*>(&b), 0x55, sizeof b);
    const Ray ray{start->origin, start->direction, 0, kInfinity};
    if (!scene->view().intersect(ray, a)) continue;
    REQUIRE(scene->view().intersect(ray, b));
    objects.insert(a.object);
    std::size_t different = 0;
    for (std::size_t k = 0; k < sizeof(Surface); ++k)
      different += reinterpret_cast<const unsigned char*>(&a)[k] !=
                   reinterpret_cast<const unsigned char*>(&b)[k];
    INFO(scene->object(a.object).shape);
    REQUIRE(different < alignof(Surface));
  }
  CHECK(objects.size() > 5);
}

TEST_CASE("an empty scene renders black and says so", "[scene]") {
  SceneDesc s;
  s.blocks = {makeBlock("camera", "pinhole", {{"location", vectorValue({0, 0, -4})}})};
  Diagnostics diagnostics;
  auto scene = buildScene(s, test::registry(), {}, diagnostics);
  REQUIRE(scene);
  CHECK(diagnostics.list().size() == 1);
  Film film = makeFilm(*scene, 1, 1, nullptr, {});
  render(*scene, film, {.samples = 1});
  for (const float v : film.means().pixels) CHECK(v == 0);
}
