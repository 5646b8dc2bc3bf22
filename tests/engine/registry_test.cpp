// SPDX-License-Identifier: Apache-2.0
#include "engine/scene/registry.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>

#include "support/catch.h"
#include "support/scenes.h"
#include "support/temp_folder.h"

using namespace vestige;
using vestige::test::TempFolder;
namespace fs = std::filesystem;

TEST_CASE("every built-in is found where it is built", "[registry]") {
  const Registry& r = test::registry();
  for (const auto& [kind, name] : {std::pair{"brdf", "lambert"},
                                   {"brdf", "phong"},
                                   {"light", "area"},
                                   {"camera", "pinhole"},
                                   {"integrator", "path"},
                                   {"shape", "sphere"},
                                   {"pigment", "image"}})
    CHECK(r.find(kind, name));
  CHECK_FALSE(r.find("brdf", "no such thing"));
}

TEST_CASE("folder, file and word are one name", "[registry]") {
  for (const Plugin& p : test::registry().plugins()) {
    CHECK(fs::path(p.file).stem() == p.kind + "_" + p.name);
    CHECK(p.schema->kind == p.kind);
    CHECK(p.schema->name == p.name);
    CHECK_FALSE(p.schema->summary.empty());
    for (const auto* rows : {&p.schema->params, &p.schema->inputs})
      for (const Parameter& row : *rows) {
        INFO(p.kind << " " << p.name << " " << row.name);
        CHECK_FALSE(row.help.empty());
      }
  }
}

TEST_CASE("the engine adds its rows to brdfs and shapes", "[registry]") {
  const Schema* lambert = test::registry().schema("brdf", "lambert");
  REQUIRE(lambert);
  CHECK(lambert->inputs.back().name == "opacity");
  CHECK(lambert->find("normal_map"));
  for (const Parameter& p : lambert->inputs) CHECK(p.texturable);
  CHECK(test::registry().schema("shape", "sphere")->find("emission"));
}

TEST_CASE("a library that is no plugin is refused with a reason", "[registry]") {
  const fs::path folder = fs::temp_directory_path() / "vestige_registry_test";
  fs::create_directories(folder);
  std::ofstream(folder / "garbage.so") << "not a library";
  std::vector<std::string> refused;
  const Registry r = Registry::load({folder.string(), "/no/such/folder"}, refused);
  fs::remove_all(folder);
  CHECK(r.plugins().empty());
  REQUIRE(refused.size() == 1);
  CHECK_THAT(refused[0], containsText("garbage.so"));
}

TEST_CASE("a plugin built for another engine is refused with both sides named", "[registry]") {
  std::vector<std::string> refused;
  CHECK(Registry::load({VESTIGE_FOREIGN}, refused).plugins().empty());
  const auto reason = [&](const std::string& library) {
    for (const std::string& r : refused)
      if (r.find("foreign_" + library + ".so") != r.npos) return r;
    return std::string("taken");
  };
  CHECK_THAT(reason("magic"), containsText("magic number"));
  CHECK_THAT(reason("size"), containsText("8 bytes"));
  CHECK_THAT(reason("sdk"), containsText("SDK 99"));
  CHECK_THAT(reason("tag"), containsText("elsewhere"));
  CHECK_THAT(reason("tag"), containsText(kAbiTag));
  CHECK_THAT(reason("empty"), containsText("empty fields"));
  CHECK_THAT(reason("nothing"), containsText("exports no symbol 'vestige_plugin'"));
  CHECK_THAT(reason("older"),
             containsText("built for SDK " + std::to_string(kSdkMajor - 1) + ".") &&
                 containsText("this engine has " + std::to_string(kSdkMajor) + "."));
  CHECK_THAT(reason("real"), containsText(sizeof(Real) == 8 ? "real=float" : "real=double"));
}

TEST_CASE("a library is loaded when its plugin is asked for", "[registry][lazy]") {
  std::vector<std::string> refused;
  const Registry r = Registry::load({VESTIGE_PLUGINS}, refused);
  CHECK(r.loaded() == 0);
  const std::vector<std::string> kinds = r.kinds();
  CHECK(std::count(kinds.begin(), kinds.end(), "brdf") == 1);
  CHECK(r.schema("film", ""));
  CHECK_FALSE(r.find("brdf", "no such thing"));
  CHECK(r.loaded() == 0);
  Diagnostics diagnostics;
  CHECK(buildScene(test::room(0.5, "path"), r, {}, diagnostics));
  CHECK(r.loaded() == 5);  // pinhole, path, area, quad, lambert
  const Schema* lambert = r.schema("brdf", "lambert");
  CHECK(r.names("brdf").size() > 1);
  const std::size_t all = r.plugins().size();
  CHECK(all == r.loaded());
  CHECK(all > 40);
  CHECK(r.schema("brdf", "lambert") == lambert);
}

TEST_CASE("a broken library is refused when its plugin is asked for", "[registry][lazy]") {
  const TempFolder folder;
  std::ofstream(folder / "brdf_broken.so") << std::string(100, '?');
  std::ofstream(folder / "brdf_lambert.so") << "not a library";
  std::vector<std::string> refused;
  const Registry r = Registry::load({VESTIGE_PLUGINS, folder.path()}, refused);
  CHECK(refused.empty());
  CHECK(r.refused().empty());
  CHECK(r.has("brdf", "broken"));
  CHECK_FALSE(r.find("brdf", "broken"));
  CHECK(r.has("brdf", "broken"));
  REQUIRE(r.refused().size() == 1);
  CHECK_THAT(r.whyMissing("brdf", "broken"), containsText("brdf_broken.so' was not loaded: ") &&
                                                 containsText("invalid ELF header"));
  CHECK(r.whyMissing("brdf", "no such thing").empty());

  CHECK(r.find("brdf", "lambert"));  // that of the folder before
  CHECK(r.whyMissing("brdf", "lambert").empty());
  r.plugins();
  CHECK(r.refused().size() == 2);
}

TEST_CASE("a library must hold what its name promises", "[registry][lazy]") {
  const TempFolder folder;
  const fs::path lambert = VESTIGE_PLUGINS "/brdf_lambert.so";
  fs::copy_file(lambert, folder / "brdf_velvet.so");
  std::vector<std::string> refused;
  const Registry r = Registry::load({folder.path()}, refused);
  CHECK_FALSE(r.find("brdf", "velvet"));
  CHECK_FALSE(r.find("brdf", "lambert"));
  CHECK_THAT(r.whyMissing("brdf", "velvet"),
             containsText("promises brdf 'velvet'") && containsText("holds brdf 'lambert'"));
}

TEST_CASE("a library may have any name that promises nothing", "[registry][lazy]") {
  const TempFolder early, late;
  const fs::path lambert = VESTIGE_PLUGINS "/brdf_lambert.so";
  fs::copy_file(lambert, early / "mine.so");
  fs::copy_file(lambert, late / "brdf_lambert.so");
  const auto fileFor = [](const std::vector<std::string>& folders) {
    std::vector<std::string> refused;
    const Registry r = Registry::load(folders, refused);
    CHECK(refused.empty());
    return r.find("brdf", "lambert")->file;
  };
  CHECK(fileFor({early.path()}) == early / "mine.so");
  CHECK(fileFor({early.path(), late.path()}) == late / "brdf_lambert.so");
  CHECK(fileFor({late.path(), early.path()}) == early / "mine.so");
}

TEST_CASE("a library that was built anew is loaded anew", "[registry]") {
  const TempFolder folder;
  const fs::path file = fs::path(folder.path()) / "brdf_lambert.so";
  const auto entry = [&] {
    std::vector<std::string> refused;
    const Registry r = Registry::load({folder.path()}, refused);
    const Plugin* plugin = r.find("brdf", "lambert");
    REQUIRE(plugin);
    return plugin->entry;
  };
  fs::copy_file(VESTIGE_PLUGINS "/brdf_lambert.so", file);
  const VestigePlugin* first = entry();
  CHECK(entry() == first);
  // As a linker does: not into the file that is in use.
  fs::remove(file);
  fs::copy_file(VESTIGE_PLUGINS "/brdf_lambert.so", file);
  fs::last_write_time(file, fs::last_write_time(file) + std::chrono::seconds(2));
  const VestigePlugin* second = entry();
  CHECK(second != first);
  CHECK(entry() == second);
}
