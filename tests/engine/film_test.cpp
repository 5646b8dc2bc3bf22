// SPDX-License-Identifier: Apache-2.0
#include "engine/film/film.h"

#include <algorithm>
#include <random>
#include <stdexcept>

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

/// From 1e-15 to 1e15, and of both signs.
std::vector<Rgb> wideSamples(int count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> exponent(-15, 15);
  const auto draw = [&] { return Real(std::pow(10.0, exponent(random))); };
  std::vector<Rgb> samples(std::size_t(count), Rgb{});
  for (Rgb& s : samples) s = {draw(), draw(), -draw()};
  return samples;
}

/// The samples as radiance and as an AOV.
Film filmOf(const std::vector<Rgb>& samples) {
  Film film(1, 1, kOnePixel, {"albedo"});
  Counters counters;
  for (const Rgb& s : samples) {
    Aovs aovs{};
    aovs.albedo = {std::min(s.r, Real(1000)), std::min(s.g, Real(1000)), 0};
    film.add(0, 0, s, aovs, counters);
  }
  return film;
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
  CHECK(meanOf(film, "B") == Approx(1e-7 / 3).epsilon(1e-6));
  CHECK(film.samples(0, 0) == 3);
  CHECK(counters.clamped == 0);
  CHECK(counters.nonFinite == 0);
}

TEST_CASE("a sample is rounded to the nearest unit", "[film]") {
  Film film(1, 1, kOnePixel, {});
  Counters counters;
  const Real unit = Real(kRadianceUnit);
  film.add(0, 0, {Real(0.6) * unit, Real(0.4) * unit, Real(-0.6) * unit}, {}, counters);
  CHECK(meanOf(film, "R") == unit);
  CHECK(meanOf(film, "G") == 0);
  CHECK(meanOf(film, "B") == -unit);
}

TEST_CASE("the film does not notice in which order samples come", "[film]") {
  std::vector<Rgb> samples = wideSamples(2000);
  const Film first = filmOf(samples);
  std::mt19937 random(8);
  std::shuffle(samples.begin(), samples.end(), random);
  CHECK(filmOf(samples) == first);  // bit by bit
}

TEST_CASE("parts of the samples merge to the film of all of them", "[film]") {
  const std::vector<Rgb> samples = wideSamples(3000);
  const Film whole = filmOf(samples);
  for (const int split : {0, 1, 1234, 3000}) {
    const Film a = filmOf({samples.begin(), samples.begin() + split});
    const Film b = filmOf({samples.begin() + split, samples.end()});
    Counters counters;
    Film ab = a, ba = b;
    ab.merge(b, counters);
    ba.merge(a, counters);
    CHECK(ab == whole);
    CHECK(ba == whole);
    CHECK(counters.clamped == 0);
  }
}

TEST_CASE("films that differ are not merged", "[film]") {
  Counters counters;
  Film film(4, 4, {0, 0, 2, 2}, {"depth"});
  const Film before = film;
  CHECK_THROWS_AS(film.merge(Film(4, 5, {0, 0, 2, 2}, {"depth"}), counters), std::runtime_error);
  CHECK_THROWS_AS(film.merge(Film(4, 4, {0, 0, 2, 3}, {"depth"}), counters), std::runtime_error);
  CHECK_THROWS_AS(film.merge(Film(4, 4, {0, 0, 2, 2}, {"uv"}), counters), std::runtime_error);
  CHECK_THROWS_AS(film.merge(Film(4, 4, {0, 0, 2, 2}, {"depth"}, 100), counters),
                  std::runtime_error);
  CHECK(film == before);
}

TEST_CASE("a sum holds 2^24 samples of 1e12", "[film]") {
  Film film(1, 1, kOnePixel, {});
  Counters counters;
  film.add(0, 0, {Real(1e12), Real(-1e12), Real(1e-12)}, {}, counters);
  for (int i = 0; i < 24; ++i) film.merge(Film(film), counters);
  CHECK(film.samples(0, 0) == 1u << 24);
  CHECK(counters.clamped == 0);
  CHECK(meanOf(film, "R") == float(1e12));
  CHECK(meanOf(film, "G") == -float(1e12));
  CHECK(meanOf(film, "B") == Approx(1e-12).epsilon(0x1p-20));
}

TEST_CASE("what is too large is clamped and counted", "[film]") {
  Film film(1, 1, kOnePixel, {});
  Counters counters;
  film.add(0, 0, {Real(1e30), Real(-1e30), 3}, {}, counters);
  CHECK(counters.clamped == 1);  // a sample, not a channel
  CHECK(meanOf(film, "R") == 0x1p50f);
  CHECK(meanOf(film, "G") == -0x1p50f);
  CHECK(meanOf(film, "B") == 3);
  film.add(0, 0, {Real(0x1p50), 0, 0}, {}, counters);
  CHECK(counters.clamped == 1);  // the limit itself is allowed
  for (int i = 0; i < 20; ++i) film.merge(Film(film), counters);
  CHECK(meanOf(film, "R") > 0);  // never wraps round
  CHECK(counters.clamped > 1);
}

TEST_CASE("an AOV that is cut is counted", "[film]") {
  Film film(1, 1, kOnePixel, {"depth", "position"});
  Counters counters;
  Aovs aovs{};
  aovs.depth = 2, aovs.position = {1, -2, 3};
  film.add(0, 0, {}, aovs, counters);
  CHECK(std::ranges::equal(film.cuts(), std::vector<std::uint64_t>{0, 0}));
  aovs.position = {Real(1e30), Real(-1e30), 3};
  film.add(0, 0, {}, aovs, counters);
  CHECK(std::ranges::equal(film.cuts(), std::vector<std::uint64_t>{0, 1}));  // not a channel
  aovs.depth = kInfinity, aovs.position = {0, Real(std::nan("")), 0};
  film.add(0, 0, {}, aovs, counters);
  CHECK(std::ranges::equal(film.cuts(), std::vector<std::uint64_t>{1, 2}));
  // Sums that overflow are counted as well.
  aovs.depth = Real(film.layers()[0].limit()), aovs.position = {};
  for (int i = 0; i < 2100; ++i) film.add(0, 0, {}, aovs, counters);
  CHECK(film.cuts()[0] > 1);
  CHECK(film.cuts()[0] < 60);
  CHECK(meanOf(film, "depth.Z") > 0);
  const std::uint64_t before = film.cuts()[1];
  film.merge(Film(film), counters);
  CHECK(film.cuts()[1] == 2 * before);
}

TEST_CASE("units of lengths follow the scene's size", "[film]") {
  for (const double size : {1e-12, 1e-3, 1.0, 1e4, 1e12}) {
    INFO("size " << size);
    Film film(1, 1, kOnePixel, {"depth", "position", "footprint"}, size);
    Counters counters;
    Aovs aovs{};
    aovs.depth = Real(1e-3 * size), aovs.footprint = Real(1e-4 * size);
    aovs.position = {Real(size), Real(-size), Real(1000 * size)};
    for (int i = 0; i < 3; ++i) film.add(0, 0, {}, aovs, counters);
    CHECK(meanOf(film, "depth.Z") == Approx(1e-3 * size).epsilon(1e-6));
    CHECK(meanOf(film, "footprint") == Approx(1e-4 * size).epsilon(1e-5));
    CHECK(meanOf(film, "position.Y") == Approx(-size).epsilon(1e-6));
    CHECK(meanOf(film, "position.Z") == Approx(1000 * size).epsilon(1e-6));
    CHECK(std::ranges::equal(film.cuts(), std::vector<std::uint64_t>{0, 0, 0}));
  }
}

TEST_CASE("what is not finite is a black sample and counted", "[film]") {
  Film film(1, 1, kOnePixel, {"depth"});
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
  Film film(1, 1, kOnePixel, {"uv", "samples", "position", "footprint.texels"});
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
  CHECK(layerOf("footprint.texels", 1).value().name == "footprint.texels");
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
