// SPDX-License-Identifier: Apache-2.0
// --texture-memory: what it accepts, and that it changes no picture.
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <random>

#include "app/run.h"
#include "support/catch.h"

using Json = nlohmann::json;

namespace {

/// A scene whose sphere wears a picture of 100 x 100, which takes some 50 KB.
std::string texturedScene(const Folder& folder) {
  std::string picture = "P6 100 100 255\n";
  std::mt19937 random(1);  // what cannot be packed: files must be as large as they look
  for (int i = 0; i < 100 * 100 * 3; ++i) picture += char(random() >> 24);
  folder.write("noise.ppm", picture);
  return folder.write("a.scene",
                      smallScene("sphere { <0, 1, 0>, 1 brdf lambert { diffuse pigment image { "
                                 "\"noise.ppm\" } } }"));
}

std::string contents(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

struct Rendered {
  Run run;
  std::string picture;
  Json stats;
};

Rendered render(const Folder& folder, const std::string& scene, std::vector<std::string> more,
                long fileSizeLimit = -1) {
  std::vector<std::string> line = {"render",         scene,     "-o",
                                   folder / "a.hdr", "--stats", folder / "stats.json"};
  line.insert(line.end(), more.begin(), more.end());
  Setup setup;
  setup.variables = {{"VESTIGE_CACHE", folder / "cache"}};
  setup.fileSizeLimit = fileSizeLimit;
  Rendered r{runVestige(line, setup), contents(folder / "a.hdr"), {}};
  INFO(r.run.err);
  REQUIRE(r.run.exit == 0);
  r.stats = Json::parse(contents(folder / "stats.json"));
  return r;
}

}  // namespace

TEST_CASE("the picture is the same for any texture memory and number of threads", "[app]") {
  const Folder folder;
  const std::string scene = texturedScene(folder);
  const Rendered held = render(folder, scene, {});
  CHECK(held.stats["texture_bytes"] > 40000);
  CHECK(held.stats["textures_paged"] == 0);
  CHECK(!std::filesystem::exists(folder / "cache"));
  for (const char* size : {"0", "1000", "10K", "0.01M"})
    for (const char* threads : {"1", "2"}) {
      INFO(size);
      const Rendered paged =
          render(folder, scene, {"--texture-memory", size, "--threads", threads});
      CHECK(paged.run.err.find("warning") == std::string::npos);
      CHECK(paged.picture == held.picture);
      CHECK(paged.stats["texture_bytes"] == 0);
      CHECK(paged.stats["textures_paged"] == 1);
      CHECK(paged.stats["texture_cache_bytes"] == 32 << 20);
      CHECK(paged.stats["texture_cache_used_bytes"] > 0);
      CHECK(paged.stats["texture_read_errors"] == 0);
    }
  for (const char* size : {"1M", "100k", "2g", "60000", "1.5M"})
    CHECK(render(folder, scene, {"--texture-memory", size}).stats["textures_paged"] == 0);
}

TEST_CASE("--texture-memory refuses what is no size", "[app]") {
  const Folder folder;
  const std::string scene = texturedScene(folder);
  for (const char* size : {"much", "-1", "2X", "2GB", "1.5", "G", "1e9", "nan", "2 G", "+1G",
                           "1..5G", "99999999999G", "0x10"}) {
    const Run r = runVestige(
        {"render", scene, "-o", folder / "a.hdr", std::string("--texture-memory=") + size});
    INFO(size << '\n' << r.err);
    CHECK(r.exit == 2);
    CHECK_THAT(r.err, containsText("--texture-memory wants a size as 512M, 2G") &&
                          containsText("found '" + std::string(size) + "'"));
  }
  CHECK_THAT(runVestige({"render", "--help"}).out, containsText("--texture-memory SIZE"));
}

TEST_CASE("a full disk costs memory, not the picture", "[app]") {
  const Folder folder;
  const std::string scene = texturedScene(folder);
  const Rendered held = render(folder, scene, {});
  const Rendered full = render(folder, scene, {"--texture-memory", "0"}, 20000);
  CHECK(full.picture == held.picture);
  CHECK(full.stats["textures_paged"] == 0);
  CHECK_THAT(full.run.err, containsText("warning") && containsText("noise.ppm") &&
                               containsText("cannot be paged") && containsText("a.scene:"));
  CHECK(std::filesystem::is_empty(folder / "cache"));
}

TEST_CASE("a piece that cannot be read is told after the render", "[app]") {
  const Folder folder;
  const std::string scene = texturedScene(folder);
  render(folder, scene, {"--texture-memory", "0"});
  const auto paged = std::filesystem::directory_iterator(folder / "cache")->path();
  const auto spoil = [&] {
    std::fstream out(paged, std::ios::in | std::ios::out | std::ios::binary);
    out.seekp(1000);
    out << std::string(3000, 'x');
  };
  spoil();
  const Rendered spoilt = render(folder, scene, {"--texture-memory", "0"});
  CHECK(spoilt.stats["texture_read_errors"] > 0);
  CHECK_THAT(spoilt.run.err, containsText("could not be read while rendering") &&
                                 containsText(paged.filename().string()));
  CHECK(render(folder, scene, {"--texture-memory", "0"}).stats["texture_read_errors"] == 0);
  spoil();
  const std::string kept = folder / "a.checkpoint";  // not of such a picture
  const Run unkept =
      runVestige({scene, "-o", folder / "a.exr", "--texture-memory", "0", "--checkpoint", kept},
                 {.variables = {{"VESTIGE_CACHE", folder / "cache"}}});
  CHECK(unkept.exit == 3);
  CHECK_THAT(unkept.err, containsText("checkpoint '" + kept + "' stays as it was"));
  CHECK_FALSE(std::filesystem::exists(kept));
}
