// SPDX-License-Identifier: Apache-2.0
// The pictures of a report: there, of one size, and showing what is wrong.
#include "judge/pictures.h"

#include <filesystem>

#include "broken_light.h"
#include "support/catch.h"
#include "support/plugins.h"
#include "support/temp_folder.h"

using namespace vestige;
using namespace vestige::test;

namespace {

constexpr judge::Effort kEffort = {.samples = 1 << 13};

bool isOneColour(const Image& image) {
  for (std::size_t i = 3; i < image.pixels.size(); ++i)
    if (image.pixels[i] != image.pixels[i % 3]) return false;
  return true;
}

/// Mean red of one of `n` panels, which stand 4 pixels apart.
double meanOfPanel(const Image& image, int panel, int n) {
  const int width = (image.width + 4) / n - 4, left = panel * (width + 4);
  double sum = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < width; ++x) sum += double(image.at(left + x, y)[0]);
  return sum / width / image.height;
}

const Image& imageOf(const std::vector<judge::Picture>& pictures, const std::string& file) {
  for (const judge::Picture& p : pictures)
    if (p.file == file) return p.image;
  throw std::runtime_error("no " + file);
}

struct Expected {
  const char *kind, *name;
  std::vector<std::string> files;
};

template <class Broken>
std::vector<judge::Picture> picturesOfLight(const char* name) {
  judge::LightCase c = judge::lightCases(pluginNamed("light", name), 1, 1)[0];
  c.light = std::make_shared<Broken>(c.light);
  return judge::lightPictures(c, kEffort);
}

template <class Broken>
std::vector<judge::Picture> picturesOfCamera(const char* name) {
  judge::CameraCase c = judge::cameraCases(pluginNamed("camera", name), 1, 1)[0];
  c.camera = std::make_shared<Broken>(c.camera);
  return judge::cameraPictures(c, kEffort);
}

}  // namespace

TEST_CASE("judge: pictures of a BRDF, of lights and of cameras", "[judge][pictures]") {
  const Expected all[] = {
      {"brdf", "rough_conductor", {"density.png", "derivative.png"}},
      {"light", "area", {"density.png", "derivative.png", "flux.png", "emission.png"}},
      {"light", "environment", {"density.png", "derivative.png", "flux.png", "emission.png"}},
      {"light", "spot", {"flux.png", "emission.png"}},
      {"light", "distant", {"flux.png", "emission.png"}},
      {"camera", "thin_lens", {"density.png", "derivative.png"}},
      {"camera", "orthographic", {"density.png", "derivative.png"}},
      {"camera", "panorama", {"density.png", "derivative.png"}},
      {"pigment", "checker", {}}};
  for (const Expected& e : all) {
    INFO(e.kind << " " << e.name);
    const auto pictures = judge::picturesOf(pluginNamed(e.kind, e.name), kEffort);
    const TempFolder folder;
    std::string error;
    CHECK(judge::writePictures(pictures, folder.path(), error));
    REQUIRE(pictures.size() == e.files.size());
    for (std::size_t i = 0; i < pictures.size(); ++i) {
      const judge::Picture& p = pictures[i];
      INFO(p.file);
      CHECK(p.file == e.files[i]);
      CHECK(std::filesystem::file_size(folder.path() + "/" + p.file) > 100);
      CHECK(p.image.width >= 300);
      CHECK(p.image.height >= 190);
      CHECK(p.image.pixels.size() == std::size_t(3) * p.image.width * p.image.height);
      const bool isFlat = std::string(e.name) == "orthographic";  // no density, and linear
      CHECK((isFlat || !isOneColour(p.image)));
      CHECK_THAT(p.legend, containsText("Across: "));
    }
  }
}

TEST_CASE("judge: a sample lies beside its density", "[judge][pictures]") {
  for (const char* name : {"area", "environment"}) {
    INFO(name);
    const auto pictures = judge::picturesOf(pluginNamed("light", name), kEffort);
    for (const char* file : {"density.png", "flux.png"}) {
      const Image& image = imageOf(pictures, file);
      CHECK(meanOfPanel(image, 1, 2) > 1e-3);
      CHECK(meanOfPanel(image, 0, 2) == Approx(meanOfPanel(image, 1, 2)).epsilon(0.05));
    }
    CHECK(meanOfPanel(imageOf(pictures, "derivative.png"), 0, 1) < 0.1);
  }
}

TEST_CASE("judge: pictures show what is wrong", "[judge][pictures]") {
  const auto dim = picturesOfLight<DimParticles>("point");
  const Image& flux = imageOf(dim, "flux.png");
  CHECK(meanOfPanel(flux, 0, 2) == Approx(meanOfPanel(flux, 1, 2) / 2).epsilon(0.05));

  const auto emission = picturesOfLight<WrongEmission>("point");
  CHECK(meanOfPanel(imageOf(emission, "emission.png"), 0, 2) < 0.1);
  CHECK(meanOfPanel(imageOf(emission, "emission.png"), 1, 2) > 0.5);

  const auto units = picturesOfCamera<WrongUnits>("pinhole");
  CHECK(meanOfPanel(imageOf(units, "derivative.png"), 0, 1) > 0.9);

  const auto pdf = picturesOfCamera<WrongCameraPdf>("panorama");
  const Image& density = imageOf(pdf, "density.png");
  CHECK(meanOfPanel(density, 0, 3) < 0.9 * meanOfPanel(density, 1, 3));
}
