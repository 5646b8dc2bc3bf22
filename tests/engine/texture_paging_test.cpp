// SPDX-License-Identifier: Apache-2.0
// Textures that are paged in from files: they must show what textures in memory show, to the bit.
#include <OpenImageIO/imagebufalgo.h>
#include <stdlib.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <random>
#include <thread>

#include "engine/picture/image.h"
#include "engine/texture/texture_store.h"
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

/// At most 64 KB of codes.
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

TEST_CASE("textures are held in order of request while the budget has room", "[texture][paging]") {
  const TempFolder folder;
  const CacheFolder cache;
  const std::string files[] = {noisePng(folder, 100, 70, 3, 8), noisePng(folder, 61, 90, 1, 16),
                               noisePng(folder, 50, 50, 4, 8, 2),
                               noiseExr(folder, 45, 80, {"R", "G", "B"}, true),
                               noiseExr(folder, 40, 83, {"R", "G", "B", "A"}, false)};
  for (const std::string& file : files) {
    INFO(file);
    TextureStore all, exact, less;
    load(all, file, Wrap::repeat);
    CHECK(all.use().held == all.bytes());
    exact.setBudget(all.bytes());
    load(exact, file, Wrap::repeat);
    CHECK(exact.bytes() == all.bytes());
    CHECK(exact.use().paged == 0);
    CHECK(exact.use().pagedLimit == 0);
    less.setBudget(all.bytes() - 1);
    load(less, file, Wrap::repeat);
    load(less, file, Wrap::clamp);
    CHECK(less.bytes() == 0);
    CHECK(less.use().paged == 1);
  }
  // The large second one does not fit beside the first, the small third one does.
  TextureStore first, third, store;
  load(first, files[0], Wrap::repeat), load(third, files[2], Wrap::repeat);
  const std::size_t budget = first.bytes() + third.bytes();
  store.setBudget(budget);
  load(store, files[0], Wrap::repeat);
  load(store, noisePng(folder, 120, 110, 1, 16), Wrap::repeat);
  load(store, files[2], Wrap::repeat);
  CHECK(store.use().paged == 1);
  CHECK(store.bytes() == budget);
  CHECK(store.use().pagedLimit >= std::size_t(32) << 20);
}

TEST_CASE("a picture is converted once, by what it holds and its colour space",
          "[texture][paging]") {
  const TempFolder folder;
  const CacheFolder cache;
  const std::string file = noisePng(folder, 80, 80, 3, 8);
  const auto page = [&](const std::string& name, const std::string& space = "") {
    TextureStore store;
    store.setBudget(0);
    return load(store, name, Wrap::repeat, space)->mean();
  };
  const Rgba mean = page(file);
  const std::string paged = cache.file();
  const auto old = fs::file_time_type::clock::now() - std::chrono::hours(1);
  fs::last_write_time(paged, old);
  fs::copy_file(file, folder / "copy.png");
  CHECK(same(page(folder / "copy.png"), mean));
  CHECK(fs::last_write_time(cache.file()) == old);
  page(file, "raw");
  CHECK((*cache).files() == 2);
  fs::copy_file(noisePng(folder, 80, 80, 3, 8, 7), file, fs::copy_options::overwrite_existing);
  CHECK(!same(page(file), mean));
  CHECK((*cache).files() == 3);
}

TEST_CASE("two that convert the same picture at once do not disturb each other",
          "[texture][paging]") {
  const TempFolder folder;
  const CacheFolder cache;
  const std::string file = noisePng(folder, 140, 140, 3, 8);
  TextureStore memory;
  const auto held = load(memory, file, Wrap::repeat);
  for (int round = 0; round < 5; ++round) {
    for (const auto& entry : fs::directory_iterator((*cache).path())) fs::remove(entry);
    std::string errors[4];
    int wrong[4] = {};
    std::vector<std::thread> threads;
    for (int k = 0; k < 4; ++k)
      threads.emplace_back([&, k] {
        TextureStore store;
        store.setBudget(0);
        const auto t = store.texture(file, {file, {}, ""}, errors[k]);
        errors[k] += store.takeWarning();
        std::mt19937 random(3);
        for (int i = 0; t && i < 300; ++i) {
          const RandomLookup look(*held, random);
          wrong[k] += !same(look.in(*t), look.in(*held));
        }
      });
    for (std::thread& t : threads) t.join();
    for (int k = 0; k < 4; ++k) {
      CHECK(errors[k] == "");
      CHECK(wrong[k] == 0);
    }
    CHECK((*cache).files() == 1);
  }
}

TEST_CASE("a file in the cache that is not whole is made again", "[texture][paging]") {
  const TempFolder folder;
  const CacheFolder cache;
  const std::string file = noisePng(folder, 150, 100, 3, 8);
  compare(file);
  const std::string paged = cache.file();
  const auto size = double(fs::file_size(paged));
  const auto checkMadeAgain = [&] {
    compare(file);
    CHECK(cache.file() == paged);
    CHECK(double(fs::file_size(paged)) == size);
  };
  for (const double share : {0.0, 0.01, 0.5, 0.9, 0.999, 0.99998}) {
    INFO(share);
    fs::resize_file(paged, std::uintmax_t(share * size));
    checkMadeAgain();
  }
  std::ofstream(paged) << "something else";
  checkMadeAgain();
  {  // a whole one, of the same size in pixels, that belongs to another picture
    const std::string other = noisePng(folder, 150, 100, 3, 8, 9);
    compare(other);
    for (const auto& entry : fs::directory_iterator((*cache).path()))
      if (entry.path() != paged) fs::rename(entry.path(), paged);
    checkMadeAgain();
  }
}

TEST_CASE("what cannot be read while rendering shows the mean, and is counted",
          "[texture][paging]") {
  const TempFolder folder;
  const CacheFolder cache;
  const std::string file = noisePng(folder, 200, 100, 3, 8);
  compare(file);
  const std::string paged = cache.file();
  {  // spoils tiles, but not the directories between them
    std::fstream out(paged, std::ios::in | std::ios::out | std::ios::binary);
    out.seekp(2000);
    out << std::string(12000, 'x');
  }
  {
    TextureStore store;
    store.setBudget(0);
    const auto t = load(store, file, Wrap::repeat);
    TextureStore memory;
    const auto held = load(memory, file, Wrap::repeat);
    std::mt19937 random(3);
    int means = 0, wrong = 0;
    for (int i = 0; i < 1000; ++i) {
      const RandomLookup look(*t, random);
      const Rgba found = look.in(*t);
      means += same(found, t->mean());
      wrong += !same(found, t->mean()) && !same(found, look.in(*held));
    }
    CHECK(means > 50);
    CHECK(wrong == 0);
    CHECK(store.use().readErrors > 0);
    CHECK(store.use().unreadable == paged);
  }
  CHECK(!fs::exists(paged));
  compare(file);
}

TEST_CASE("without a place for its file a texture is held in memory, with a warning",
          "[texture][paging]") {
  const TempFolder folder;
  const CacheFolder cache;
  const std::string file = noisePng(folder, 150, 100, 3, 8);
  TextureStore memory;
  const auto held = load(memory, file, Wrap::repeat);
  const auto checkHeld = [&](const std::string& why) {
    TextureStore store;
    store.setBudget(0);
    const auto t = load(store, file, Wrap::repeat);
    const std::string warning = store.takeWarning();
    CHECK_THAT(warning, containsText(file) && containsText(why) && containsText("held in memory"));
    CHECK(warning.find('\n') == std::string::npos);
    CHECK(store.takeWarning() == "");
    CHECK(store.bytes() == memory.bytes());
    CHECK(store.use().paged == 0);
    std::mt19937 random(3);
    const RandomLookup look(*held, random);
    CHECK(same(look.in(*t), look.in(*held)));
  };
  SECTION("no folder can be made") {
    std::ofstream(folder / "file") << "not a folder";
    setenv("VESTIGE_CACHE", (folder / "file/below").c_str(), 1);
    checkHeld("file/below");
  }
  SECTION("no folder is known") {
    unsetenv("VESTIGE_CACHE");
    const std::string home = getenv("HOME") ? getenv("HOME") : "";
    const std::string xdg = getenv("XDG_CACHE_HOME") ? getenv("XDG_CACHE_HOME") : "";
    unsetenv("HOME"), unsetenv("XDG_CACHE_HOME");
    checkHeld("VESTIGE_CACHE");
    if (!home.empty()) setenv("HOME", home.c_str(), 1);
    if (!xdg.empty()) setenv("XDG_CACHE_HOME", xdg.c_str(), 1);
  }
  SECTION("the disk is full") {
    rlimit before{}, tight{};
    getrlimit(RLIMIT_FSIZE, &before);
    tight = before, tight.rlim_cur = 30000;
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &tight);
    checkHeld("cannot be paged");
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    CHECK((*cache).files() == 0);
  }
}

namespace {

/// Floats, 34 MB as they are paged: two do not fit into the least cache.
std::string largeExr(const TempFolder& folder, int number) {
  constexpr int kWidth = 2048, kHeight = 1024;
  Image image{kWidth, kHeight, {"R", "G", "B"}, {}, {}};
  image.pixels.resize(std::size_t(kWidth) * kHeight * 3);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = float((i / 3 * std::size_t(number + 7)) % 1021);
  std::string error;
  const std::string file = folder / ("large" + std::to_string(number) + ".exr");
  REQUIRE(writeImage(file, image, {}, error));
  return file;
}

/// Of lookups all over both textures; small ones, so that the finest levels are used.
std::vector<Rgba> lookAround(const Texture& a, const Texture& b) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Rgba> found;
  for (int i = 0; i < 6000; ++i) {
    const Texture& t = i % 2 ? a : b;
    const double length = 4 * unit(random);
    const Vec2 d[2] = {{Real(length / t.width()), 0}, {0, Real(length / t.height())}};
    found.push_back(t.lookup({Real(unit(random)), Real(unit(random))}, d));
  }
  return found;
}

}  // namespace

TEST_CASE("many pages share little memory, and threads see the same bits", "[texture][paging]") {
  const TempFolder folder;
  const CacheFolder cache;
  const std::string one = largeExr(folder, 0), two = largeExr(folder, 1);
  TextureStore memory, pages;
  const auto expected =
      lookAround(*load(memory, one, Wrap::repeat), *load(memory, two, Wrap::repeat));
  pages.setBudget(1000);
  const auto a = load(pages, one, Wrap::repeat), b = load(pages, two, Wrap::repeat);
  REQUIRE(pages.use().paged == 2);
  CHECK(pages.use().pagedLimit == std::size_t(32) << 20);
  std::vector<Rgba> found[3];
  std::vector<std::thread> threads;
  for (auto& list : found) threads.emplace_back([&] { list = lookAround(*a, *b); });
  for (std::thread& t : threads) t.join();
  for (const auto& list : found) {
    REQUIRE(list.size() == expected.size());
    int wrong = 0;
    for (std::size_t i = 0; i < list.size(); ++i) wrong += !same(list[i], expected[i]);
    CHECK(wrong == 0);
  }
  // A tile that is in use stays beyond the limit: a few a thread, 48 KB each.
  CHECK(pages.use().pagedUsed > std::size_t(28) << 20);
  CHECK(pages.use().pagedUsed < std::size_t(34) << 20);
  CHECK(pages.use().readErrors == 0);
}

TEST_CASE("a .tx is a picture as any other", "[texture][paging]") {
  const TempFolder folder;
  const CacheFolder cache;
  const std::string file = noisePng(folder, 100, 60, 3, 8), tx = folder / "made.tx";
  REQUIRE(OIIO::ImageBufAlgo::make_texture(OIIO::ImageBufAlgo::MakeTxTexture, file, tx, {}));
  TextureStore store;
  const auto png = load(store, file, Wrap::repeat), made = load(store, tx, Wrap::repeat);
  REQUIRE(made->width() == 100);
  REQUIRE(made->height() == 60);
  int wrong = 0;
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 100; ++x) wrong += !same(png->texel(x, y), made->texel(x, y));
  CHECK(wrong == 0);
  compare(tx);
}
