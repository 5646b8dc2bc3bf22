// SPDX-License-Identifier: Apache-2.0
// Textures: from files written by the tests' own PNG writer, against values worked out by hand.
#include <cmath>
#include <fstream>
#include <limits>
#include <random>

#include "engine/picture/image.h"
#include "engine/texture/texture_store.h"
#include "support/catch.h"
#include "support/small_png.h"
#include "support/temp_folder.h"

using namespace vestige;
using namespace vestige::test;

namespace {

std::shared_ptr<const Texture> load(TextureStore& store, const std::string& file,
                                    const std::string& space = "", Wrap wrap = Wrap::repeat) {
  std::string error;
  auto texture = store.texture(file, {file, {}, space, wrap, wrap}, error);
  INFO(error);
  REQUIRE(texture);
  return texture;
}

Rgba lookUp(const Texture& t, double u, double v) {
  const Vec2 point[2] = {};
  return t.lookup({Real(u), Real(v)}, point);
}

std::string refusal(const std::string& file, const std::string& space = "") {
  TextureStore store;
  std::string error;
  CHECK(!store.texture(file, {file, {}, space}, error));
  CHECK(error.find('\n') == std::string::npos);
  return error;
}

void writeExr(const std::string& file, int width, int height, std::vector<std::string> channels,
              std::vector<float> pixels, bool half = false) {
  std::string error;
  const Image image{width, height, std::move(channels), std::move(pixels), {}};
  WriteOptions options;
  options.halfFloat = half;
  REQUIRE(writeImage(file, image, options, error));
}

}  // namespace

TEST_CASE("lookups are bilinear, v = 0 at the bottom, centres at (i + 1/2) / n", "[texture]") {
  const TempFolder folder;
  // Top row 10 20 30 40, bottom row 110 120 130 140, as they are.
  writePng(folder / "a.png", 4, 2, 1, 8, {10, 20, 30, 40, 110, 120, 130, 140});
  TextureStore store;
  const auto t = load(store, folder / "a.png", "raw");
  CHECK(t->width() == 4);
  CHECK(t->height() == 2);
  CHECK(!t->hasAlpha());
  CHECK(t->texel(1, 0).colour.r * 255 == Approx(120));
  CHECK(t->texel(3, 1).colour.g * 255 == Approx(40));
  const auto at = [&](double u, double v) { return lookUp(*t, u, v).colour.b * 255; };
  CHECK(at(0.125, 0.25) == Approx(110));
  CHECK(at(0.375, 0.75) == Approx(20));
  CHECK(at(0.25, 0.25) == Approx(115));            // half way between two
  CHECK(at(0.25, 0.5) == Approx(65));              // in the middle of four
  CHECK(at(0.1875, 0.375) == Approx(112.5 - 25));  // a quarter of a texel along each axis
  CHECK(lookUp(*t, 0.25, 0.5).alpha == 1);
  CHECK(t->mean().colour.r * 255 == Approx(75));
}

TEST_CASE("wraps at the edges", "[texture]") {
  const TempFolder folder;
  writePng(folder / "a.png", 2, 1, 1, 8, {0, 200});
  TextureStore store;
  const auto at = [&](Wrap wrap, double u) {
    return double(lookUp(*load(store, folder / "a.png", "raw", wrap), u, 0.5).colour.r * 255);
  };
  CHECK(at(Wrap::repeat, 0) == Approx(100));
  CHECK(at(Wrap::repeat, 0.125) == Approx(50));
  CHECK(at(Wrap::repeat, -0.25) == Approx(200));
  CHECK(at(Wrap::repeat, 17.25) == Approx(0).margin(1e-3));
  CHECK(at(Wrap::clamp, 0) == Approx(0).margin(1e-3));
  CHECK(at(Wrap::clamp, -5) == Approx(0).margin(1e-3));
  CHECK(at(Wrap::clamp, 1.1) == Approx(200));
  CHECK(at(Wrap::mirror, 0) == Approx(0).margin(1e-3));
  CHECK(at(Wrap::mirror, 1.125) == Approx(200));
  CHECK(at(Wrap::mirror, 1.25) == Approx(200));
  CHECK(at(Wrap::mirror, 1.5) == Approx(100));
  CHECK(at(Wrap::mirror, -0.25) == Approx(0).margin(1e-3));
  CHECK(at(Wrap::mirror, -0.75) == Approx(200));
}

namespace {

/// The integer rule of a wrap, said the long way.
int wrapped(int i, int n, Wrap wrap) {
  if (wrap == Wrap::clamp) return std::max(0, std::min(n - 1, i));
  if (wrap == Wrap::repeat) return (i % n + n) % n;
  const int j = (i % (2 * n) + 2 * n) % (2 * n);
  return j < n ? j : 2 * n - 1 - j;
}

}  // namespace

TEST_CASE("lookups agree with the long way of saying it", "[texture]") {
  const TempFolder folder;
  std::mt19937 random(3);
  constexpr int kWidth = 5, kHeight = 3;
  std::vector<int> codes(kWidth * kHeight * 4);
  for (int& c : codes) c = int(random() % 256);
  writePng(folder / "a.png", kWidth, kHeight, 4, 8, codes);
  const auto code = [&](int x, int y, int c) {  // row 0 at the bottom
    return codes[std::size_t(((kHeight - 1 - y) * kWidth + x) * 4 + c)] / 255.0;
  };
  TextureStore store;
  std::uniform_real_distribution<double> anywhere(-3, 4);
  for (const Wrap wrap : {Wrap::repeat, Wrap::clamp, Wrap::mirror}) {
    const auto t = load(store, folder / "a.png", "raw", wrap);
    REQUIRE(t->hasAlpha());
    for (int i = 0; i < 2000; ++i) {
      const double u = anywhere(random), v = anywhere(random);
      const double x = u * kWidth - 0.5, y = v * kHeight - 0.5;
      const int x0 = int(std::floor(x)), y0 = int(std::floor(y));
      double expected[4] = {};
      for (int k = 0; k < 4; ++k) {
        const int dx = k & 1, dy = k >> 1;
        const double w = (dx ? x - x0 : 1 - x + x0) * (dy ? y - y0 : 1 - y + y0);
        for (int c = 0; c < 4; ++c)
          expected[c] +=
              w * code(wrapped(x0 + dx, kWidth, wrap), wrapped(y0 + dy, kHeight, wrap), c);
      }
      const Rgba found = lookUp(*t, u, v);
      CHECK(found.colour.r == Approx(expected[0]).margin(1e-5));
      CHECK(found.colour.g == Approx(expected[1]).margin(1e-5));
      CHECK(found.colour.b == Approx(expected[2]).margin(1e-5));
      CHECK(found.alpha == Approx(expected[3]).margin(1e-5));
    }
  }
}

TEST_CASE("no coordinate leads out of the picture", "[texture]") {
  const TempFolder folder;
  writePng(folder / "a.png", 3, 3, 1, 8, {255, 255, 255, 255, 255, 255, 255, 255, 255});
  TextureStore store;
  for (const Wrap wrap : {Wrap::repeat, Wrap::clamp, Wrap::mirror}) {
    const auto t = load(store, folder / "a.png", "raw", wrap);
    for (const double u : {1e9, -1e9, 1e30, -1e30, double(INFINITY), -double(INFINITY), double(NAN),
                           -1e-9, -1e-20, 0.99999999, 1.0, 2.0, -1.0})
      CHECK(lookUp(*t, u, u).colour.r == Approx(1));
  }
}

TEST_CASE("files are decoded by what they are", "[texture]") {
  const TempFolder folder;
  TextureStore store;
  const auto value = [&](const std::string& space, int bits, int code, double gamma = 0) {
    const std::string file =
        folder / (space + std::to_string(bits) + std::to_string(gamma) + ".png");
    writePng(file, 1, 1, 1, bits, {code}, gamma);
    return double(load(store, file, space)->texel(0, 0).colour.r);
  };
  CHECK(value("", 8, 128) == Approx(0.2158605));
  CHECK(value("srgb", 8, 128) == Approx(0.2158605));
  CHECK(value("sRGB", 8, 128) == Approx(0.2158605));
  CHECK(value("raw", 8, 128) == Approx(128 / 255.0));
  CHECK(value("", 16, 32896) == Approx(0.2158605));
  CHECK(value("raw", 16, 12345) == Approx(12345 / 65535.0));
  CHECK(value("Raw", 8, 128) == Approx(128 / 255.0));                         // the config's
  CHECK(value("sRGB - Texture", 8, 128) == Approx(0.2158605).epsilon(1e-3));  // as a half
  CHECK(value("", 8, 128, 1.0) == Approx(128 / 255.0));                       // says linear
  CHECK(value("", 8, 128, 1.8) == Approx(std::pow(128 / 255.0, 1.8)).epsilon(1e-3));
  CHECK(value("", 8, 128, 2.2) == Approx(0.2158605));  // the usual way to say sRGB

  writeExr(folder / "a.exr", 1, 1, {"R", "G", "B"}, {0.61310f, 0.07019f, 0.02062f});
  const Rgb same = load(store, folder / "a.exr")->texel(0, 0).colour;
  CHECK(same.r == 0.61310f);
  const Rgb red = load(store, folder / "a.exr", "ACEScg")->texel(0, 0).colour;
  CHECK(red.r == Approx(1).margin(1e-4));
  CHECK(red.g == Approx(0).margin(1e-4));
  CHECK(red.b == Approx(0).margin(1e-4));
  writeExr(folder / "b.exr", 1, 1, {"R", "G", "B"}, {-9, 0.5f, 3000}, true);
  const Rgb half = load(store, folder / "b.exr")->texel(0, 0).colour;
  CHECK(half == Rgb{-9, Real(0.5), 3000});
}

TEST_CASE("alpha is kept apart from colour", "[texture]") {
  const TempFolder folder;
  TextureStore store;
  writePng(folder / "a.png", 1, 1, 4, 8, {200, 100, 50, 51});
  const Rgba png = load(store, folder / "a.png", "raw")->texel(0, 0);
  CHECK(png.colour.r * 255 == Approx(200));
  CHECK(png.alpha == Approx(0.2));
  writePng(folder / "ga.png", 1, 1, 2, 8, {128, 128});
  const auto grey = load(store, folder / "ga.png");
  CHECK(grey->hasAlpha());
  CHECK(grey->texel(0, 0).colour.b == Approx(0.2158605));
  CHECK(grey->texel(0, 0).alpha == Approx(128 / 255.0));  // never decoded
  // EXR holds colour times alpha.
  for (const bool half : {false, true}) {
    const std::string file = folder / (half ? "h.exr" : "f.exr");
    writeExr(file, 2, 1, {"R", "G", "B", "A"}, {1, 0.5f, 0.25f, 0.25f, 0, 0, 0, 0}, half);
    const Rgba exr = load(store, file)->texel(0, 0);
    CHECK(exr.colour == Rgb{4, 2, 1});
    CHECK(exr.alpha == Real(0.25));
    CHECK(load(store, file)->texel(1, 0).colour == Rgb{0, 0, 0});
  }
}

TEST_CASE("colour is found among many channels", "[texture]") {
  const TempFolder folder;
  TextureStore store;
  writeExr(folder / "a.exr", 1, 1, {"R", "G", "B", "depth.Z", "normal.X"}, {1, 2, 3, 4, 5});
  CHECK(load(store, folder / "a.exr")->texel(0, 0).colour == Rgb{1, 2, 3});
  CHECK(!load(store, folder / "a.exr")->hasAlpha());
  writeExr(folder / "b.exr", 1, 1, {"Y"}, {7});
  CHECK(load(store, folder / "b.exr")->texel(0, 0).colour == Rgb{7, 7, 7});
}

TEST_CASE("what is not finite in a picture is 0, and counted", "[texture]") {
  const TempFolder folder;
  const float inf = INFINITY, nan = NAN;
  for (const bool half : {false, true}) {
    TextureStore store;
    writeExr(folder / "a.exr", 2, 1, {"R", "G", "B"}, {inf, nan, -inf, 1, 2, -3}, half);
    const auto t = load(store, folder / "a.exr");
    CHECK(t->texel(0, 0).colour == Rgb{0, 0, 0});
    CHECK(t->texel(1, 0).colour == Rgb{1, 2, -3});
    CHECK(t->mean().colour.r == Approx(0.5));
    CHECK(store.nonFinite() == 3);
  }
}

TEST_CASE("a picture is read once and stays as small as it was", "[texture]") {
  const TempFolder folder;
  writePng(folder / "a.png", 16, 16, 3, 8, std::vector<int>(768, 128));
  TextureStore store;
  const auto a = load(store, folder / "a.png");
  const std::size_t once = store.bytes();  // what a pyramid adds: see texture_filter_test.cpp
  CHECK(once >= 768);
  CHECK(once < 2 * 768 + 1024);
  CHECK(load(store, folder / "a.png") == a);
  CHECK(load(store, folder / "a.png", "", Wrap::clamp) != a);
  CHECK(store.bytes() == once);  // the same texels, wrapped another way
  CHECK(load(store, folder / "a.png", "raw") != a);
  CHECK(store.bytes() == 2 * once);
  std::filesystem::remove(folder / "a.png");
  CHECK(load(store, folder / "a.png") == a);
}

TEST_CASE("pictures that cannot be read", "[texture]") {
  const TempFolder folder;
  CHECK_THAT(refusal(folder / "none.png"), containsText("there is no file"));
  CHECK_THAT(refusal(folder.path()), containsText("is a folder"));
  std::ofstream(folder / "text.png") << "this is no picture";
  CHECK_THAT(refusal(folder / "text.png"), containsText("cannot read the picture"));
  std::ofstream(folder / "empty.jpg").flush();
  CHECK_THAT(refusal(folder / "empty.jpg"), containsText("cannot read the picture"));
  std::ofstream(folder / "a.blend") << "what is this";
  CHECK_THAT(refusal(folder / "a.blend"), containsText("no known format"));
  writePng(folder / "ok.png", 64, 64, 3, 8, std::vector<int>(64 * 64 * 3, 90));
  CHECK_THAT(refusal(folder / "ok.png", "no such space"), containsText("no colour space"));
  writeExr(folder / "cut.exr", 64, 64, {"R", "G", "B"}, [] {
    std::vector<float> noise(64 * 64 * 3);
    std::mt19937 random(1);
    for (float& x : noise) x = float(random());
    return noise;
  }());
  for (const char* name : {"ok.png", "cut.exr"}) {
    std::filesystem::resize_file(folder / name, std::filesystem::file_size(folder / name) / 2);
    CHECK_THAT(refusal(folder / name), containsText("cannot read the picture"));
  }
}

TEST_CASE("a header that claims too much is refused before memory is asked for", "[texture]") {
  const TempFolder folder;
  writePng(folder / "a.png", 1, 1, 1, 8, {0});
  std::string header;
  png::put32(header, 1000000), png::put32(header, 900000);
  header += {8, 2, 0, 0, 0};
  std::ofstream(folder / "huge.png", std::ios::binary)
      << "\x89PNG\r\n\x1a\n"
      << png::chunk("IHDR", header) << png::chunk("IEND", "");
  CHECK_THAT(refusal(folder / "huge.png"), containsText("huge.png"));
}
