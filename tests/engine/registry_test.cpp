// SPDX-License-Identifier: Apache-2.0
#include "engine/scene/registry.h"

#include <filesystem>
#include <fstream>

#include "support/catch.h"
#include "support/scenes.h"

using namespace vestige;
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
}
