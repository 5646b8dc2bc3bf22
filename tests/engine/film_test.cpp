// SPDX-License-Identifier: Apache-2.0
#include "engine/film/film.h"

#include <algorithm>
#include <random>

#include "support/catch.h"

using namespace vestige;

namespace {

constexpr Crop kOnePixel{0, 0, 1, 1};

float meanOf(const Film& film, const std::string& channel) {
  const Film::Means m = film.means();
  const auto at = std::find(m.channels.begin(), m.channels.end(), channel);
  REQUIRE(at != m.channels.end());
  return m.pixels[std::size_t(at - m.channels.begin())];
}

}  // namespace

TEST_CASE("the film's mean is the mean of its samples", "[film]") {
  Film film(1, 1, kOnePixel, {});
  Counters counters;
  film.add(0, 0, {1, Real(0.25), 0}, {}, counters);
  film.add(0, 0, {2, Real(0.5), Real(1e-7)}, {}, counters);
  film.add(0, 0, {6, Real(-0.5), 0}, {}, counters);
  CHECK(meanOf(film, "R") == 3);
  CHECK(meanOf(film, "G") == Approx(0.25 / 3));
  CHECK(meanOf(film, "B") == Approx(1e-7 / 3).margin(0x1p-29));  // half a unit of the film
  CHECK(film.samples(0, 0) == 3);
  CHECK(counters.clamped == 0);
  CHECK(counters.nonFinite == 0);
}

TEST_CASE("a sample is rounded to the nearest unit", "[film]") {
  Film film(1, 1, kOnePixel, {});
  Counters counters;
  const Real unit = Real(kFilmUnit);
  film.add(0, 0, {Real(0.6) * unit, Real(0.4) * unit, Real(-0.6) * unit}, {}, counters);
  CHECK(meanOf(film, "R") == unit);
  CHECK(meanOf(film, "G") == 0);
  CHECK(meanOf(film, "B") == -unit);
}

TEST_CASE("the film does not notice in which order samples come", "[film]") {
  std::mt19937 random(7);
  std::lognormal_distribution<float> bright(0, 4);
  std::vector<Rgb> samples(2000);
  for (Rgb& s : samples) s = {bright(random), bright(random), -bright(random)};
  const auto sum = [&] {
    Film film(1, 1, kOnePixel, {Aov::albedo});
    Counters counters;
    for (const Rgb& s : samples) {
      Aovs aovs{};
      aovs.albedo = s;
      film.add(0, 0, s, aovs, counters);
    }
    return film.means().pixels;
  };
  const auto first = sum();
  std::shuffle(samples.begin(), samples.end(), random);
  CHECK(sum() == first);  // bit by bit
}

TEST_CASE("what is too large is clamped and counted", "[film]") {
  Film film(1, 1, kOnePixel, {});
  Counters counters;
  film.add(0, 0, {Real(1e30), Real(-1e30), 3}, {}, counters);
  CHECK(counters.clamped == 1);  // a sample, not a channel
  CHECK(meanOf(film, "R") == 16777216);
  CHECK(meanOf(film, "G") == -16777216);
  CHECK(meanOf(film, "B") == 3);
  film.add(0, 0, {Real(16777216), 0, 0}, {}, counters);
  CHECK(counters.clamped == 1);  // the limit itself is allowed
  for (int i = 0; i < 5000; ++i) film.add(0, 0, {Real(1e30), 0, 0}, {}, counters);
  CHECK(meanOf(film, "R") > 0);  // never wraps round
}

TEST_CASE("what is not finite is a black sample and counted", "[film]") {
  Film film(1, 1, kOnePixel, {Aov::depth});
  Counters counters;
  Aovs aovs{};
  aovs.depth = kInfinity;
  film.add(0, 0, {kInfinity, 1, 1}, aovs, counters);
  aovs.depth = 5;
  film.add(0, 0, {1, Real(std::nan("")), 1}, aovs, counters);
  film.add(0, 0, {3, 3, 3}, aovs, counters);
  CHECK(counters.nonFinite == 2);
  CHECK(film.samples(0, 0) == 3);
  CHECK(meanOf(film, "R") == 1);
  CHECK(meanOf(film, "G") == 1);
  CHECK(meanOf(film, "depth.Z") == Approx(10.0 / 3));
}

TEST_CASE("AOVs come in the order wanted, under their names", "[film]") {
  Film film(1, 1, kOnePixel, {Aov::uv, Aov::samples, Aov::position, Aov::footprintTexels});
  Counters counters;
  Aovs aovs{};
  aovs.uv = {Real(0.25), Real(0.75)}, aovs.position = {1, -2, 3}, aovs.footprintTexels = 7;
  film.add(0, 0, {}, aovs, counters);
  film.add(0, 0, {}, aovs, counters);
  const Film::Means m = film.means();
  CHECK(m.channels == std::vector<std::string>{"R", "G", "B", "uv.U", "uv.V", "samples",
                                               "position.X", "position.Y", "position.Z",
                                               "footprint.texels"});
  CHECK(m.pixels == std::vector<float>{0, 0, 0, 0.25f, 0.75f, 2, 1, -2, 3, 7});
  CHECK(std::string(name(Aov::footprintTexels)) == "footprint.texels");
}

TEST_CASE("a cropped film holds its window only", "[film]") {
  Film film(100, 50, {90, 40, 93, 42}, {});
  Counters counters;
  film.add(92, 40, {1, 2, 3}, {}, counters);
  film.add(90, 41, {4, 5, 6}, {}, counters);
  const Film::Means m = film.means();
  CHECK(m.width == 3);
  CHECK(m.height == 2);
  CHECK(m.pixels == std::vector<float>{0, 0, 0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 0, 0, 0, 0, 0, 0});
  CHECK(film.samples(92, 40) == 1);
  CHECK(film.minSamples() == 0);
}
