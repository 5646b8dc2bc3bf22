// SPDX-License-Identifier: Apache-2.0
// A render is scale free: radiance from 1e-12 to 1e12 and scenes of any size come out alike, and
// adaptive sampling decides alike.
#include <cmath>
#include <numeric>

#include "engine/picture/image.h"
#include "engine/render/adaptive.h"
#include "engine/render/session.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/temp_folder.h"

using namespace vestige;
using test::makeBlock;

namespace {

struct Rendered {
  Film film;
  RenderResult result;
};

Rendered rendered(const SceneDesc& description, const RenderOptions& options,
                  std::vector<std::string> aovs = {}) {
  Diagnostics diagnostics;
  auto scene = buildScene(description, test::registry(), {}, diagnostics);
  REQUIRE(scene);
  Film film = makeFilm(*scene, 0, 0, nullptr, std::move(aovs));
  const RenderResult result = render(*scene, film, options);
  return {std::move(film), result};
}

Block pinhole(Vec3 location, Vec3 lookAt, double angle) {
  return makeBlock("camera", "pinhole",
                   {{"location", vectorValue({location.x, location.y, location.z})},
                    {"look_at", vectorValue({lookAt.x, lookAt.y, lookAt.z})},
                    {"angle", numberValue(angle)}});
}

Block environment(double radiance) {
  return makeBlock("light", "environment",
                   {{"radiance", colourValue(radiance, radiance, radiance)}});
}

/// A grey ball of radius `size` that fills the film, in a constant environment.
SceneDesc furnace(double radiance, double grey, double size = 1) {
  SceneDesc s;
  s.blocks = {pinhole({0, 0, Real(-4 * size)}, {0, 0, 0}, 10),
              makeBlock("film", "", {{"resolution", vectorValue({8, 8})}}),
              makeBlock("integrator", "path", {{"depth", numberValue(4)}}), environment(radiance),
              makeBlock("shape", "sphere",
                        {{"centre", vectorValue({0, 0, 0})}, {"radius", numberValue(size)}},
                        {test::lambert(grey)})};
  return s;
}

/// Left the plain sky without noise, right a wall that two lamps light, of which a sample picks
/// one.
SceneDesc skyAndWall(double radiance) {
  const auto lamp = [&](double x, double times) {
    const double l = radiance * times;
    return makeBlock("light", "area",
                     {{"corner", vectorValue({x, 3, -2})},
                      {"edge1", vectorValue({1, 0, 0})},
                      {"edge2", vectorValue({0, 0, 1})},
                      {"radiance", colourValue(l, l, l)}});
  };
  SceneDesc s;
  s.blocks = {pinhole({0, 0, -4}, {0, 0, 0}, 60),
              makeBlock("film", "", {{"resolution", vectorValue({32, 16})}}),
              makeBlock("integrator", "path", {{"depth", numberValue(2)}}),
              environment(radiance * 0.03),
              lamp(0.5, 0.3),
              lamp(2.5, 1),
              test::quad({0, -9, 0}, {9, 0, 0}, {0, 18, 0}, {test::lambert(0.5)})};
  return s;
}

double meanOf(const std::vector<float>& pixels) {
  return std::accumulate(pixels.begin(), pixels.end(), 0.0) / double(pixels.size());
}

constexpr double kRadiances[] = {1e-12, 1e-6, 1, 1e6, 1e12};

}  // namespace

TEST_CASE("furnace: radiance from 1e-12 to 1e12 comes out of the film", "[film][furnace]") {
  const test::TempFolder folder;
  for (const double radiance : kRadiances) {
    INFO("radiance " << radiance);
    const Rendered r = rendered(furnace(radiance, 0.5), {.samples = 256, .threads = 2});
    const Film::Means m = r.film.means();
    CHECK(meanOf(m.pixels) == Approx(0.5 * radiance).epsilon(1e-3));
    CHECK(r.result.counters.clamped == 0);
    // ... and out of a file.
    std::string error;
    const std::string file = folder / "furnace.exr";
    REQUIRE(writeImage(file, {m.width, m.height, m.channels, m.pixels, {}}, {}, error));
    CHECK(meanOf(readImage(file, error).pixels) == Approx(0.5 * radiance).epsilon(1e-3));
  }
}

TEST_CASE("a constant environment alone is exact at any radiance", "[film][furnace]") {
  for (const double radiance : kRadiances) {
    INFO("radiance " << radiance);
    SceneDesc s = furnace(radiance, 0.5);
    s.blocks.pop_back();
    const Film film = rendered(s, {.samples = 7, .threads = 2}).film;
    for (const float x : film.means().pixels) CHECK(x == Approx(radiance).epsilon(1e-6));
  }
}

TEST_CASE("the noise wanted comes out at any radiance", "[film][adaptive]") {
  const Rendered middle = rendered(skyAndWall(1), {.noise = 0.01, .threads = 2});
  CHECK(middle.result.mostSamples > 2 * middle.result.samples);
  const Rendered shared = rendered(skyAndWall(1), {.samples = 64, .adaptive = true, .threads = 2});
  CHECK(shared.result.mostSamples > 2 * shared.result.samples);
  for (const double radiance : {1e-12, 1e12}) {
    INFO("radiance " << radiance);
    const Rendered noise = rendered(skyAndWall(radiance), {.noise = 0.01, .threads = 2});
    CHECK(noise.result.quiet == 1);
    CHECK(noise.result.meanSamples == Approx(middle.result.meanSamples).epsilon(0.02));
    CHECK(noise.result.mostSamples == middle.result.mostSamples);
    const Rendered mean =
        rendered(skyAndWall(radiance), {.samples = 64, .adaptive = true, .threads = 2});
    CHECK(mean.result.meanSamples == Approx(shared.result.meanSamples).epsilon(0.02));
    CHECK(mean.result.mostSamples == shared.result.mostSamples);
  }
}

TEST_CASE("depth and position come out of scenes of any size", "[film]") {
  for (const double size : {1e-9, 1e-3, 1.0, 1e6, 1e9}) {
    INFO("size " << size);
    const Rendered r =
        rendered(furnace(1, 0.5, size), {.samples = 64, .threads = 2}, {"depth", "position"});
    const Film::Means m = r.film.means();
    const std::size_t stride = m.channels.size();
    // The pixels at the centre see the ball at (0, 0, -size), 3 sizes away.
    const float* centre = &m.pixels[(3 * 8 + 3) * stride];
    CHECK(centre[3] / size == Approx(3).epsilon(0.01));
    CHECK(centre[6] / size == Approx(-1).epsilon(0.01));
  }
}
