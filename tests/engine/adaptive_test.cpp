// SPDX-License-Identifier: Apache-2.0
// Adaptive sampling: samples go where noise is, the noise asked for is the noise that comes out,
// and stopping early does not make the picture darker.
#include "engine/render/adaptive.h"

#include <limits>
#include <random>

#include "engine/render/session.h"
#include "support/catch.h"
#include "support/scenes.h"

using namespace vestige;
using test::makeBlock;

namespace {

struct Rendered {
  Film film;
  RenderResult result;
};

Rendered rendered(const SceneDesc& description, const RenderOptions& options) {
  Diagnostics diagnostics;
  auto scene = buildScene(description, test::registry(), {}, diagnostics);
  REQUIRE(scene);
  Film film = makeFilm(*scene, 0, 0, nullptr, {"samples"});
  const RenderResult result = render(*scene, film, options);
  return {film, result};
}

/// 64 x 32 pixels: left the plain sky, without any noise; right a wall lit by the sky and by two
/// squares, of which each sample asks one.
SceneDesc skyAndWall() {
  const auto light = [](double x, double radiance) {
    return makeBlock("light", "area",
                     {{"corner", vectorValue({x, 3, -2})},
                      {"edge1", vectorValue({1, 0, 0})},
                      {"edge2", vectorValue({0, 0, 1})},
                      {"radiance", colourValue(radiance, radiance, radiance)}});
  };
  SceneDesc s;
  s.blocks = {makeBlock("camera", "pinhole",
                        {{"location", vectorValue({0, 0, -4})},
                         {"look_at", vectorValue({0, 0, 0})},
                         {"angle", numberValue(60)}}),
              makeBlock("film", "", {{"resolution", vectorValue({64, 32})}}),
              makeBlock("integrator", "path", {{"depth", numberValue(2)}}),
              makeBlock("light", "environment", {{"radiance", colourValue(1, 1, 1)}}),
              light(0.5, 10),
              light(2.5, 30),
              test::quad({0, -9, 0}, {9, 0, 0}, {0, 18, 0}, {test::lambert(0.5)})};
  return s;
}

/// A wall in a dim sky before a lamp within a glass ball, which few samples find: most pixels look
/// quiet, and too dark, for long.
SceneDesc lampInGlass() {
  SceneDesc s;
  s.blocks = {makeBlock("camera", "pinhole",
                        {{"location", vectorValue({0, 0, -4})},
                         {"look_at", vectorValue({0, 0, 0})},
                         {"angle", numberValue(20)}}),
              makeBlock("film", "", {{"resolution", vectorValue({24, 24})}}),
              makeBlock("integrator", "path", {{"depth", numberValue(5)}}),
              makeBlock("light", "environment", {{"radiance", colourValue(0.1, 0.1, 0.1)}}),
              makeBlock("light", "area",
                        {{"corner", vectorValue({-0.3, 2, -2})},
                         {"edge1", vectorValue({0.6, 0, 0})},
                         {"edge2", vectorValue({0, 0.2, 0.6})},
                         {"radiance", colourValue(20, 20, 20)}}),
              makeBlock("shape", "sphere",
                        {{"centre", vectorValue({0, 2, -1.7})}, {"radius", numberValue(0.6)}},
                        {makeBlock("brdf", "glass", {{"ior", numberValue(1.2)}})}),
              test::quad({-9, -9, 0}, {18, 0, 0}, {0, 18, 0}, {test::lambert(0.5)})};
  return s;
}

/// Root mean square of (luminance - reference) / reference over pixels [x0, x1) of all rows.
double relativeError(const Film& film, const Film& reference, int x0, int x1) {
  double sum = 0;
  for (int y = 0; y < film.height(); ++y)
    for (int x = x0; x < x1; ++x) {
      const double right = reference.luminance(x, y);
      sum += std::pow((film.luminance(x, y) - right) / right, 2);
    }
  return std::sqrt(sum / (double(x1 - x0) * film.height()));
}

/// Mean luminance of the picture over several seeds, and its standard error.
struct Estimate {
  double mean, error;
};
Estimate meanLuminance(const SceneDesc& s, RenderOptions options, int seeds) {
  double sum = 0, squares = 0;
  for (int seed = 0; seed < seeds; ++seed, ++options.seed) {
    const Film film = rendered(s, options).film;
    double mean = 0;
    for (int y = 0; y < film.height(); ++y)
      for (int x = 0; x < film.width(); ++x)
        mean += film.luminance(x, y) / (double(film.width()) * film.height());
    sum += mean, squares += mean * mean;
  }
  const double mean = sum / seeds;
  return {mean, std::sqrt((squares / seeds - mean * mean) / (seeds - 1))};
}

}  // namespace

TEST_CASE("samples go where the noise is", "[adaptive]") {
  const auto [film, result] = rendered(skyAndWall(), {.noise = 0.01, .threads = 2});
  CHECK(result.end == RenderEnd::finished);
  CHECK(result.quiet == 1);
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 24; ++x) CHECK(film.samples(x, y) == 16);
    for (int x = 32; x < 64; ++x) CHECK(film.samples(x, y) >= 64);
  }
  CHECK(result.samples == 16);
  CHECK(result.mostSamples == int(film.maxSamples()));
  CHECK(result.meanSamples > 32);
  CHECK(result.meanSamples < result.mostSamples);
  const Film::Means m = film.means();  // the map is among the channels
  CHECK(m.channels.back() == "samples");
  CHECK(m.pixels[3] == 16);
}

TEST_CASE("the noise asked for is the noise that comes out", "[adaptive]") {
  // Samples of a pixel lie better than independent ones, most so where few of their numbers matter:
  // the wall's noise is overestimated, the room's hardly.
  const auto check = [](const SceneDesc& s, int from, int to, double noise, double least,
                        const Film& reference) {
    const auto [film, result] = rendered(s, {.noise = noise, .seed = 1, .threads = 2});
    const double error = relativeError(film, reference, from, to);
    INFO("wanted " << noise << ", got " << error << " by up to " << result.mostSamples);
    CHECK(error < 1.5 * noise);
    CHECK(error > least * noise);
  };
  const RenderOptions many{.samples = 2048, .seed = 99, .threads = 2};
  const SceneDesc wall = skyAndWall(), room = test::room(0.7, "path", {{"depth", numberValue(4)}});
  const Film wallReference = rendered(wall, many).film, roomReference = rendered(room, many).film;
  check(wall, 32, 64, 0.06, 1 / 6.0, wallReference);
  check(wall, 32, 64, 0.015, 1 / 3.0, wallReference);
  check(room, 0, 32, 0.1, 1 / 1.5, roomReference);
  check(room, 0, 32, 0.05, 1 / 1.5, roomReference);
}

TEST_CASE("stopping where it looks quiet does not make the picture darker", "[adaptive]") {
  const SceneDesc s = lampInGlass();
  const Estimate right = meanLuminance(s, {.samples = 512, .seed = 100, .threads = 2}, 8);
  const RenderOptions quiet{.noise = 0.2, .threads = 2},
      shared{.samples = 256, .adaptive = true, .threads = 2};
  for (const RenderOptions& options : {quiet, shared}) {
    const Estimate adaptive = meanLuminance(s, options, 16);
    const double error = std::hypot(right.error, adaptive.error);
    INFO(adaptive.mean << " +- " << adaptive.error << ", right " << right.mean << " +- "
                       << right.error);
    CHECK(std::abs(adaptive.mean - right.mean) < 3.5 * error);
    CHECK(error < 0.02 * right.mean);  // else the line above says nothing
  }
}

TEST_CASE("a mean of samples is shared out by what each part needs", "[adaptive]") {
  // Three fields whose pixels scatter by 0.1, 0.2 and 0.4 of their mean: for the least mean square
  // 1 : 2 : 4 samples, whatever the budget.
  Film film(240, 40, {0, 0, 240, 40}, {});
  Counters counters;
  Adaptive adaptive(film, {.samples = 150});
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const auto field = [](int x) { return x / 80; };
  for (int n = 1; n <= 1024 && !adaptive.isDone(); n *= 2) {
    for (int y = 0; y < 40; ++y)
      for (int x = 0; x < 240; ++x)
        while (adaptive.wants(x, y) && int(film.samples(x, y)) < n)
          film.add(x, y, grey(Real(1 + 0.1 * (1 << field(x)) * normal(random))), {}, counters);
    adaptive.judge(film, n);
  }
  CHECK(adaptive.isDone());
  CHECK(film.meanSamples() <= 150);
  CHECK(film.meanSamples() > 0.9 * 150);
  double mean[3] = {};
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 240; ++x)
      if (x % 80 >= 16 && x % 80 < 64) mean[field(x)] += film.samples(x, y) / (48 * 40.0);
  CHECK(mean[1] / mean[0] == Approx(2).epsilon(0.2));
  CHECK(mean[2] / mean[1] == Approx(2).epsilon(0.2));
}

TEST_CASE("shared out, as many samples make a better picture", "[adaptive]") {
  const SceneDesc s = skyAndWall();  // the sky needs nothing
  const Film reference = rendered(s, {.samples = 4096, .seed = 99, .threads = 2}).film;
  const auto squaredError = [&](bool adaptive) {
    double sum = 0;
    for (std::uint32_t seed = 0; seed < 8; ++seed) {
      const auto [film, result] =
          rendered(s, {.samples = 128, .adaptive = adaptive, .seed = seed, .threads = 2});
      CHECK(result.meanSamples <= 128);
      CHECK(result.meanSamples > 110);
      sum += std::pow(relativeError(film, reference, 0, film.width()), 2);
    }
    return sum;
  };
  const double even = squaredError(false), shared = squaredError(true);
  INFO("even " << even << ", shared " << shared);
  CHECK(shared < 0.7 * even);
}

TEST_CASE("few samples are the same for all pixels", "[adaptive]") {
  for (const int samples : {1, 7}) {
    const auto [film, result] = rendered(skyAndWall(), {.samples = samples, .adaptive = true});
    CHECK(result.samples == samples);
    CHECK(result.mostSamples == samples);
  }
  CHECK(rendered(skyAndWall(), {.samples = 8, .adaptive = true}).result.mostSamples > 8);
}

TEST_CASE("one thread or two: the same samples, the same bits", "[adaptive]") {
  const SceneDesc s = skyAndWall();
  for (const bool shared : {false, true}) {
    RenderOptions options{.noise = 0.02, .seed = 3, .threads = 1};
    if (shared) options.samples = 32, options.noise = 0, options.adaptive = true;
    const Film one = rendered(s, options).film;
    options.threads = 2;
    const Film two = rendered(s, options).film;
    CHECK(one.minSamples() < one.maxSamples());
    CHECK(one.means().pixels == two.means().pixels);
  }
}

TEST_CASE("a pixel of n samples is the pixel of a render of n samples", "[adaptive]") {
  const SceneDesc s = test::room(0.7, "path", {{"depth", numberValue(4)}});
  const Film film = rendered(s, {.noise = 0.1, .seed = 3, .threads = 2}).film;
  int compared = 0;
  for (int n = 16; n <= int(film.maxSamples()); n *= 2) {
    const Film plain = rendered(s, {.samples = n, .seed = 3, .threads = 2}).film;
    for (int y = 0; y < film.height(); ++y)
      for (int x = 0; x < film.width(); ++x)
        if (int(film.samples(x, y)) == n) {
          CHECK(film.luminance(x, y) == plain.luminance(x, y));
          ++compared;
        }
  }
  CHECK(compared == film.width() * film.height());
}

TEST_CASE("samples, time and noise: the first reached ends the render", "[adaptive]") {
  const SceneDesc s = skyAndWall();
  const auto [few, capped] = rendered(s, {.samples = 40, .noise = 1e-3, .threads = 2});
  CHECK(capped.end == RenderEnd::finished);
  CHECK(few.maxSamples() == 40);
  CHECK(few.samples(0, 0) == 16);
  CHECK(capped.quiet < 0.6);
  const auto [late, timed] = rendered(s, {.seconds = 0.3, .noise = 1e-4, .threads = 2});
  CHECK(timed.end == RenderEnd::timeUp);
  CHECK(late.samples(0, 0) == 16);
  CHECK(late.samples(63, 0) >= 16);
  const auto [quick, quiet] = rendered(s, {.samples = 1 << 20, .seconds = 100, .noise = 0.1});
  CHECK(quiet.end == RenderEnd::finished);
  CHECK(quiet.mostSamples < 1024);
}

TEST_CASE("the share of the work done rises to its end", "[adaptive]") {
  RenderOptions options{.noise = 0.002, .threads = 2};
  double share = 0, quiet = 0;
  int told = 0;
  options.progress = [&](const Progress& p) {
    CHECK(p.share >= share);
    CHECK(p.share <= 1);
    CHECK(p.quiet >= quiet);
    share = p.share, quiet = p.quiet, ++told;
  };
  rendered(skyAndWall(), options);
  CHECK(told > 2);
  CHECK(share > 0.5);
}

TEST_CASE("a block waits for a neighbour that is far from quiet", "[adaptive]") {
  Film film(40, 8, {0, 0, 40, 8}, {});
  Counters counters;
  Adaptive adaptive(film, {.noise = 0.1});
  // The first block's samples change after the eighth; those of the others never.
  const auto add = [&](int from, int to) {
    for (int i = from; i < to; ++i)
      for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 40; ++x)
          if (adaptive.wants(x, y))
            film.add(x, y, grey(x < 8 ? Real(i < 8 ? 0.45 : 1) : Real(1)), {}, counters);
    adaptive.judge(film, to);
  };
  add(0, 8);
  CHECK(adaptive.wants(0, 0));  // too early
  add(8, 16);
  CHECK(adaptive.wants(7, 7));  // moved from 0.45 to 0.725
  CHECK(adaptive.wants(8, 0));
  CHECK_FALSE(adaptive.wants(16, 0));
  CHECK(adaptive.quiet() == Approx(0.6));
  add(16, 32);                  // to 0.8625, by 0.16 of it
  CHECK(adaptive.wants(0, 0));  // 0.11 over it and its neighbour
  CHECK(adaptive.wants(8, 0));  // 0.09 over three blocks, but one of them is above 0.15
  add(32, 64);
  CHECK(adaptive.isDone());
}

TEST_CASE("a picture that is black on average, and negative somewhere, ends too", "[adaptive]") {
  Film film(16, 16, {0, 0, 16, 16}, {});
  Counters counters;
  Adaptive adaptive(film, {.samples = 64});
  for (int n = 1; n <= 1024 && !adaptive.isDone(); n *= 2) {
    while (int(film.minSamples()) < n)
      for (int i = 0; i < 256; ++i)
        film.add(i % 16, i / 16, grey(i == 0 ? -Real(n) : Real(0)), {}, counters);
    adaptive.judge(film, n);
  }
  CHECK(adaptive.isDone());
}

TEST_CASE("a black picture is quiet", "[adaptive]") {
  Film film(8, 8, {0, 0, 8, 8}, {});
  Counters counters;
  Adaptive adaptive(film, {.noise = 0.01});
  for (const int n : {8, 16}) {
    while (int(film.minSamples()) < n)
      for (int i = 0; i < 64; ++i) film.add(i % 8, i / 8, {}, {}, counters);
    adaptive.judge(film, n);
  }
  CHECK(adaptive.isDone());
}
