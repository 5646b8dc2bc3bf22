// SPDX-License-Identifier: Apache-2.0
// A scene that uses a plugin without derivatives says so, once. Such a plugin is made from a copy
// of lambert's library, by setting the bits in its entry.
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "support/catch.h"
#include "support/scenes.h"

using namespace vestige;
using namespace vestige::test;
namespace fs = std::filesystem;

namespace {

/// A folder with a lambert that lacks these derivatives.
struct BareLambert {
  fs::path folder;
  explicit BareLambert(std::uint32_t lacks)
      : folder(fs::temp_directory_path() / ("vestige_bare_lambert_" + std::to_string(lacks))) {
    std::ifstream in(VESTIGE_PLUGINS "/brdf_lambert.so", std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(in), {}};
    char magic[sizeof kPluginMagic];
    std::memcpy(magic, &kPluginMagic, sizeof magic);
    const std::size_t entry = bytes.find(std::string(magic, sizeof magic));
    REQUIRE(entry != bytes.npos);
    std::memcpy(&bytes[entry + offsetof(VestigePlugin, lacks)], &lacks, sizeof lacks);
    fs::create_directories(folder);
    std::ofstream(folder / "brdf_lambert.so", std::ios::binary) << bytes;
  }
  ~BareLambert() { fs::remove_all(folder); }
};

/// What a room of six lambert walls says.
std::vector<Diagnostic> said(std::uint32_t lacks) {
  const BareLambert bare(lacks);
  std::vector<std::string> refused;
  const Registry r = Registry::load({VESTIGE_PLUGINS, bare.folder.string()}, refused);
  CHECK(refused.empty());
  Diagnostics diagnostics;
  const SceneDesc description = room(0.5, "path");
  CHECK(buildScene(description, r, {}, diagnostics));
  CHECK_FALSE(diagnostics.hasErrors());
  CHECK(diagnostics.warnings() == 0);  // --werror lets it pass
  return diagnostics.list();
}

}  // namespace

TEST_CASE("finite differences in place of derivatives are noted once", "[registry][differences]") {
  CHECK(said(0).empty());
  const auto both = said(kLacksSampleDerivatives | kLacksLogGradient);
  REQUIRE(both.size() == 1);
  CHECK(both[0].severity == Severity::note);
  CHECK_THAT(both[0].message, containsText("brdf 'lambert' gives no derivatives of its own"));
  const auto gradient = said(kLacksLogGradient);
  REQUIRE(gradient.size() == 1);
  CHECK_THAT(gradient[0].message, containsText("no gradient of its value"));
  const auto sampled = said(kLacksSampleDerivatives);
  REQUIRE(sampled.size() == 1);
  CHECK_THAT(sampled[0].message, containsText("no derivatives of its sampled directions"));
}
