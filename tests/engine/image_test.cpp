// SPDX-License-Identifier: Apache-2.0
// Pictures to files and back.
#include "engine/picture/image.h"

#include <sys/mount.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstring>
#include <fstream>
#include <random>

#include "support/catch.h"
#include "support/small_png.h"
#include "support/temp_folder.h"

using namespace vestige;
using namespace vestige::test;

namespace {

Image rgbImage(int width, int height, std::vector<float> pixels) {
  return {width, height, {"R", "G", "B"}, std::move(pixels), {}};
}

Image noiseImage(int width, int height) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> value(0, 1);
  std::vector<float> pixels(std::size_t(width) * height * 3);
  for (float& x : pixels) x = value(random);
  return rgbImage(width, height, std::move(pixels));
}

void write(const std::string& file, const Image& image, const WriteOptions& options = {}) {
  std::string error;
  const bool done = writeImage(file, image, options, error);
  INFO(error);
  REQUIRE(done);
}

Image read(const std::string& file) {
  std::string error;
  Image image = readImage(file, error);
  INFO(error);
  REQUIRE(image.width > 0);
  return image;
}

std::vector<int> codes(const std::string& file) {
  std::vector<int> list;
  for (const float x : read(file).pixels) list.push_back(int(std::lround(x * 255)));
  return list;
}

/// What writeImage() says; the folder must hold as many files after as before.
std::string refusal(const TempFolder& folder, const std::string& file, const Image& image) {
  const int before = folder.files();
  std::string error;
  CHECK(!writeImage(file, image, {}, error));
  CHECK(folder.files() == before);
  CHECK(error.find('\n') == std::string::npos);
  return error;
}

const char* const kEndings[] = {".exr", ".hdr", ".tif", ".png", ".jpg"};

}  // namespace

TEST_CASE("EXR keeps every bit, every channel and the metadata", "[image]") {
  const TempFolder folder;
  Image image{2, 2, {"R", "G", "B", "depth.Z", "normal.X"}, {}, {}};
  image.pixels = {1.f / 3, -9,   1e-40f, 1e30f, 5, 6,  7, 8, 9,   10,
                  11,      0.1f, -0.f,   13,    1, 15, 2, 3, NAN, INFINITY};
  image.metadata = {
      {"vestige:seed", "42"}, {"Software", "Vestige"}, {"vestige:note", "a \"b\"\nc"}};
  write(folder / "a.exr", image);
  const Image back = read(folder / "a.exr");
  CHECK(back.width == 2);
  CHECK(back.height == 2);
  CHECK(back.channels == image.channels);
  REQUIRE(back.pixels.size() == image.pixels.size());
  CHECK(std::memcmp(back.pixels.data(), image.pixels.data(), image.pixels.size() * 4) == 0);
  for (const auto& [name, value] : image.metadata) CHECK(back.metadata.at(name) == value);
  write(folder / "a.tif", image);
  CHECK(std::memcmp(read(folder / "a.tif").pixels.data(), image.pixels.data(),
                    image.pixels.size() * 4) == 0);
}

TEST_CASE("half EXR: colours as halfs within their range, the rest as floats", "[image]") {
  const TempFolder folder;
  Image image{1, 1, {"R", "G", "B", "position.X"}, {0.1f, 1e6f, -1e6f, 123456.78f}, {}};
  WriteOptions options;
  options.halfFloat = true;
  write(folder / "a.exr", image, options);
  const Image back = read(folder / "a.exr");
  CHECK(back.pixels[0] == 0x1.998p-4f);  // nearest half to 0.1
  CHECK(back.pixels[1] == 65504);
  CHECK(back.pixels[2] == -65504);
  CHECK(back.pixels[3] == 123456.78f);
}

TEST_CASE("PNG shows sRGB codes, whatever comes", "[image]") {
  const TempFolder folder;
  const float nan = NAN, inf = INFINITY;
  write(folder / "a.png",
        rgbImage(2, 2, {0, 0.18f, 1, 0.2158605f, 16, -3, nan, inf, -inf, 0.0005f, 1e30f, -0.f}));
  CHECK(codes(folder / "a.png") ==
        std::vector<int>{0, 118, 255, 128, 255, 0, 0, 255, 0, 2, 255, 0});
  WriteOptions aces;
  aces.display.view = "ACES 1.0 SDR";
  write(folder / "b.png", rgbImage(1, 2, {0.18f, 0.18f, 0.18f, 1, 1, 1}), aces);
  CHECK(codes(folder / "b.png") == std::vector<int>{91, 91, 91, 207, 207, 207});
  WriteOptions brighter;
  brighter.display.exposure = 2;
  write(folder / "c.png", rgbImage(1, 1, {0.045f, 0.25f, 0}), brighter);
  CHECK(codes(folder / "c.png") == std::vector<int>{118, 255, 0});
  for (const float radiance : {1e-12f, 1e12f}) {  // exposure brings any radiance into view
    WriteOptions exposed;
    exposed.display.exposure = std::log2(0.18 / double(radiance));
    write(folder / "d.png", rgbImage(1, 1, {radiance, 0, -radiance}), exposed);
    CHECK(codes(folder / "d.png") == std::vector<int>{118, 0, 0});
  }
  write(folder / "grey.png", Image{1, 1, {"Y"}, {0.18f}, {}});
  CHECK(codes(folder / "grey.png") == std::vector<int>{118, 118, 118});
  write(folder / "order.png", Image{1, 1, {"depth.Z", "B", "G", "R"}, {7, 0, 0.18f, 1}, {}});
  CHECK(codes(folder / "order.png") == std::vector<int>{255, 118, 0});
}

TEST_CASE("JPEG and HDR come close", "[image]") {
  const TempFolder folder;
  write(folder / "a.jpg", rgbImage(8, 8, std::vector<float>(192, 0.18f)));
  for (const int code : codes(folder / "a.jpg")) CHECK(std::abs(code - 118) <= 2);
  write(folder / "a.hdr", rgbImage(1, 2, {1000, 500.5f, 4, 1e-3f, -2, NAN}));
  const Image back = read(folder / "a.hdr");
  const float expected[] = {1000, 500.5f, 4, 1e-3f, 0, 0};
  for (int i = 0; i < 6; ++i)  // 8 bits of the largest channel
    CHECK(back.pixels[i] == Approx(expected[i]).margin(i < 3 ? 1000 / 128. : 1e-3 / 128));
}

TEST_CASE("the first row is the top one", "[image]") {
  const TempFolder folder;
  for (const char* ending : kEndings) {
    Image image = rgbImage(8, 16, std::vector<float>(8 * 16 * 3, 0.f));
    std::fill(image.pixels.begin(), image.pixels.begin() + 8 * 8 * 3, 1.f);
    write(folder / (std::string("a") + ending), image);
    const Image back = read(folder / (std::string("a") + ending));
    CHECK(back.at(4, 1)[0] > 0.9f);
    CHECK(back.at(4, 14)[0] < 0.1f);
  }
}

TEST_CASE("integers are read as codes over the largest", "[image]") {
  const TempFolder folder;
  writePng(folder / "a.png", 1, 1, 4, 8, {51, 102, 255, 51});
  const Image image = read(folder / "a.png");
  CHECK(image.channels == std::vector<std::string>{"R", "G", "B", "A"});
  CHECK(image.pixels[0] == Approx(0.2));  // not times alpha, not decoded
  CHECK(image.pixels[3] == Approx(0.2));
}

TEST_CASE("files that cannot be read", "[image]") {
  const TempFolder folder;
  std::string error;
  CHECK(readImage(folder / "none.exr", error).width == 0);
  CHECK_THAT(error, containsText("there is no file") && containsText("none.exr"));
  std::ofstream(folder / "bad.exr") << "nonsense";
  CHECK(readImage(folder / "bad.exr", error).width == 0);
  CHECK_THAT(error, containsText("cannot read the picture") && containsText("bad.exr"));
}

TEST_CASE("what cannot be written is known before", "[image]") {
  const TempFolder folder;
  std::string error;
  const auto says = [&](const std::string& file, const char* text) {
    CHECK(!canWrite(file, error));
    CHECK_THAT(error, containsText(text) && containsText(file));
  };
  says(folder / "a.doc", "ending");
  says(folder / "picture", "ending");
  says(folder / "no/a.png", "there is no folder");
  std::filesystem::create_directory(folder / "dir.png");
  says(folder / "dir.png", "it is a folder");
  std::ofstream(folder / "file") << "x";
  says(folder / "file/a.png", "is not a folder");
  for (const char* name : {"a.EXR", "b.hdr", "c.tif", "d.tiff", "e.PNG", "f.jpg", "g.jpeg"})
    CHECK(canWrite(folder / name, error));
  CHECK(canWrite("here.png", error));
  if (geteuid() != 0) {  // root may do anything
    std::filesystem::create_directory(folder / "locked");
    std::filesystem::permissions(folder / "locked", std::filesystem::perms::owner_read);
    says(folder / "locked/a.png", "permission");
  }
  CHECK_THAT(refusal(folder, folder / "a.png", {}), containsText("no pixels"));
}

TEST_CASE("a picture replaces an older one, through a link too", "[image]") {
  const TempFolder folder;
  std::ofstream(folder / "real.png") << "older";
  std::filesystem::create_symlink("real.png", folder / "link.png");
  write(folder / "link.png", rgbImage(1, 1, {1, 1, 1}));
  CHECK(std::filesystem::is_symlink(folder / "link.png"));
  CHECK(codes(folder / "real.png") == std::vector<int>{255, 255, 255});
  CHECK(folder.files() == 2);
}

TEST_CASE("a file that may not grow leaves no half picture", "[image]") {
  const TempFolder folder;
  std::ofstream(folder / "old.png") << "older";
  const Image image = noiseImage(200, 200);
  rlimit old;
  REQUIRE(getrlimit(RLIMIT_FSIZE, &old) == 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  // At 4 kB most formats fail while they write; near the end some fail only when they close.
  for (const char* ending : kEndings) {
    const std::string file = folder / (std::string("a") + ending);
    write(file, image);
    const auto whole = std::filesystem::file_size(file);
    std::filesystem::remove(file);
    for (const rlim_t limit : {rlim_t(4096), rlim_t(whole - 10), rlim_t(whole - 1)}) {
      const rlimit small{limit, old.rlim_max};
      REQUIRE(setrlimit(RLIMIT_FSIZE, &small) == 0);
      const std::string error = refusal(folder, file, image);
      setrlimit(RLIMIT_FSIZE, &old);
      INFO(ending << " " << limit);
      CHECK_THAT(error, containsText("cannot write") && containsText("the file would grow"));
    }
  }
  std::signal(SIGXFSZ, handler);
}

TEST_CASE("a full disk is called by its name", "[image]") {
  const TempFolder folder;
  if (mount("none", folder.path().c_str(), "tmpfs", 0, "size=64k") != 0) {
    WARN("not tried: only root may mount a small disk");
    return;
  }
  for (const char* ending : kEndings)
    CHECK_THAT(refusal(folder, folder / (std::string("a") + ending), noiseImage(300, 300)),
               containsText("the disk is full"));
  umount(folder.path().c_str());
}

TEST_CASE("versions of the libraries", "[image]") {
  CHECK_THAT(imageLibraryVersions(),
             containsText("OpenImageIO 2.") || containsText("OpenImageIO 3."));
  CHECK_THAT(imageLibraryVersions(), containsText("OpenColorIO 2."));
}
