// SPDX-License-Identifier: Apache-2.0
// Textures that are paged in from files: they must show what textures in memory show, to the bit.
#include <stdlib.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <thread>

#include "engine/image/image.h"
#include "support/catch.h"
#include "support/small_png.h"
#include "support/temp_folder.h"

using namespace vestige;
using namespace vestige::test;
namespace fs = std::filesystem;

namespace {

constexpr Wrap kWraps[] = {Wrap::repeat, Wrap::clamp, Wrap::mirror};

/// A cache folder of the test's own.
class CacheFolder {
 public:
  CacheFolder() { setenv("VESTIGE_CACHE", folder_.path().c_str(), 1); }
  ~CacheFolder() { unsetenv("VESTIGE_CACHE"); }
  const TempFolder& operator*() const { return folder_; }
  /// The one file in it.
  std::string file() const {
    REQUIRE(folder_.files() == 1);
    return fs::directory_iterator(folder_.path())->path().string();
  }

 private:
  TempFolder folder_;
};

std::shared_ptr<const Texture> load(TextureStore& store, const std::string& file, Wrap wrap,
                                    const std::string& space = "") {
  std::string error;
  auto texture = store.texture(file, {file, {}, space, wrap, wrap}, error);
  INFO(error);
  REQUIRE(texture);
  return texture;
}

std::string noisePng(const TempFolder& folder, int width, int height, int channels, int bits,
                     unsigned seed = 1) {
  std::mt19937 random(seed);
  std::vector<int> codes;
  for (int i = 0; i < width * height * channels; ++i) codes.push_back(int(random() >> (32 - bits)));
  const std::string file = folder / ("noise" + std::to_string(seed) + "_" + std::to_string(width) +
                                     "x" + std::to_string(height) + "_" + std::to_string(channels) +
                                     "_" + std::to_string(bits) + ".png");
  writePng(file, width, height, channels, bits, codes);
  return file;
}

std::string noiseExr(const TempFolder& folder, int width, int height,
                     std::vector<std::string> channels, bool half, bool broken = false) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> stops(-12, 12);
  Image image{width, height, std::move(channels), {}, {}};
  const bool alpha = image.channels.size() == 4;
  for (std::size_t i = 0; i < image.channels.size() * std::size_t(width) * height; ++i)
    image.pixels.push_back(alpha && i % 4 == 3 ? float(random() % 1000 + 1) / 1000
                                               : std::exp2(stops(random)));
  if (broken) image.pixels[7] = NAN;
  WriteOptions options;
  options.halfFloat = half;
  std::string error;
  const std::string file = folder / ("noise" + std::to_string(image.channels.size()) +
                                     (half ? "half.exr" : "float.exr"));
  REQUIRE(writeImage(file, image, options, error));
  return file;
}

/// Lookups anywhere: aspects from 1 to 40, a tenth of a texel to ten thousand, turned.
struct RandomLookup {
  Vec2 uv, d[2];
  RandomLookup(const Texture& t, std::mt19937& random) {
    std::uniform_real_distribution<double> unit(0, 1);
    const double length = std::pow(10, 5 * unit(random) - 1);
    const double width = length / std::pow(40, unit(random)), angle = 7 * unit(random);
    const double c = std::cos(angle), s = std::sin(angle);
    uv = {Real(5 * unit(random) - 2), Real(5 * unit(random) - 2)};
    d[0] = {Real(length * c / t.width()), Real(length * s / t.height())};
    d[1] = {Real(-width * s / t.width()), Real(width * c / t.height())};
  }
  Rgba in(const Texture& t) const { return t.lookup(uv, d); }
};

bool same(const Rgba& a, const Rgba& b) { return a.colour == b.colour && a.alpha == b.alpha; }

/// Paged and held show the same bits, in lookups and in texels.
void compare(const std::string& file, const std::string& space = "") {
  TextureStore memory, pages;
  pages.setBudget(0);
  for (const Wrap wrap : kWraps) {
    const auto held = load(memory, file, wrap, space), paged = load(pages, file, wrap, space);
    INFO(file << " wrap " << int(wrap) << ' ' << pages.takeWarning());
    CHECK(pages.bytes() == 0);
    CHECK(pages.use().paged == 1);
    CHECK(memory.use().paged == 0);
    CHECK(pages.nonFinite() == memory.nonFinite());
    CHECK(paged->width() == held->width());
    CHECK(paged->height() == held->height());
    CHECK(paged->hasAlpha() == held->hasAlpha());
    CHECK(same(paged->mean(), held->mean()));
    std::mt19937 random(3);
    int wrong = 0;
    for (int i = 0; i < 1500; ++i) {
      const RandomLookup look(*held, random);
      wrong += !same(look.in(*paged), look.in(*held));
    }
    CHECK(wrong == 0);
    for (int y = 0; y < held->height(); y += 7)
      for (int x = 0; x < held->width(); ++x) wrong += !same(paged->texel(x, y), held->texel(x, y));
    CHECK(wrong == 0);
    CHECK(pages.use().readErrors == 0);
  }
}

}  // namespace

TEST_CASE("a paged texture shows what one in memory shows, to the bit", "[texture][paging]") {
  const TempFolder folder;
  const CacheFolder cache;
  SECTION("8 bits, odd and not square") { compare(noisePng(folder, 201, 77, 3, 8)); }
  SECTION("8 bits with alpha") { compare(noisePng(folder, 130, 64, 4, 8)); }
  SECTION("8 bits, raw") { compare(noisePng(folder, 65, 65, 1, 8), "raw"); }
  SECTION("8 bits through the colour config") {
    compare(noisePng(folder, 70, 90, 3, 8), "sRGB - Texture");
  }
  SECTION("16 bits") { compare(noisePng(folder, 64, 300, 1, 16)); }
  SECTION("16 bits, grey and alpha") { compare(noisePng(folder, 99, 129, 2, 16)); }
  SECTION("16 bits through the colour config") {
    compare(noisePng(folder, 30, 31, 3, 16), "ACEScg");
  }
  SECTION("one column") { compare(noisePng(folder, 1, 150, 3, 8)); }
  SECTION("one texel") { compare(noisePng(folder, 1, 1, 4, 8)); }
  SECTION("half") { compare(noiseExr(folder, 150, 100, {"R", "G", "B"}, true)); }
  SECTION("half as sRGB") { compare(noiseExr(folder, 50, 10, {"R", "G", "B"}, true), "srgb"); }
  SECTION("half with alpha") { compare(noiseExr(folder, 67, 129, {"R", "G", "B", "A"}, true)); }
  SECTION("float") { compare(noiseExr(folder, 129, 65, {"R", "G", "B"}, false, true)); }
  SECTION("float with alpha") { compare(noiseExr(folder, 33, 65, {"R", "G", "B", "A"}, false)); }
}
