// SPDX-License-Identifier: Apache-2.0
// vestige plugin list, and where plugins are looked for.
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "app/run.h"
#include "support/catch.h"

namespace fs = std::filesystem;

namespace {

const fs::path kLambert = VESTIGE_PLUGINS "/brdf_lambert.so";

std::string fileOf(const Run& r, const std::string& kind, const std::string& name) {
  const nlohmann::json all = nlohmann::json::parse(r.out);
  for (const auto& p : all["plugins"])
    if (p["kind"] == kind && p["name"] == name) return p["file"];
  return "";
}

/// A folder `name` in `home` with a plugin lambert in it.
std::string withLambert(const Folder& home, const std::string& name) {
  fs::create_directories(home.path() / name);
  fs::copy_file(kLambert, home.path() / name / "brdf_lambert.so");
  return home / name;
}

}  // namespace

TEST_CASE("every plugin is listed with versions and library", "[app][plugin]") {
  const Run r = runVestige({"plugin", "list"});
  CHECK(r.exit == 0);
  CHECK(r.err == "");
  CHECK_THAT(r.out, containsText("brdf_lambert.so") && containsText("SDK ") &&
                        containsText(VESTIGE_PLUGINS "\n") && containsText(" plugins, for SDK ") &&
                        containsText(" built as lib"));
  const nlohmann::json all = nlohmann::json::parse(runVestige({"plugin", "list", "--json"}).out);
  CHECK(all["plugins"].size() > 40);
  for (const auto& p : all["plugins"])
    CHECK_THAT(p["abi"].get<std::string>(), containsText(" real=") && containsText(" pointer="));
  CHECK(all["refused"].empty());
}

TEST_CASE("the nearer folder goes before", "[app][plugin]") {
  const Folder home;
  const std::string own = withLambert(home, ".local/lib/vestige"),
                    named = withLambert(home, "named"), option = withLambert(home, "option");
  const std::string home_ = home.path().string();
  const auto list = [&](std::vector<std::string> more, const std::string& path) {
    more.insert(more.begin(), {"plugin", "list", "--json"});
    return fileOf(runVestige(more, {.variables = {{"HOME", home_}, {"VESTIGE_PLUGIN_PATH", path}}}),
                  "brdf", "lambert");
  };
  CHECK(list({"--plugin-path", option}, named) == option + "/brdf_lambert.so");
  CHECK(list({}, named) == named + "/brdf_lambert.so");
  CHECK(list({}, "") == own + "/brdf_lambert.so");
}

TEST_CASE("of two with one name it is told which is used", "[app][plugin]") {
  const Folder home;
  const std::string named = withLambert(home, "named");
  const Run r = runVestige({"plugin", "list", "--plugin-path", named});
  CHECK(r.exit == 0);
  CHECK_THAT(r.err, containsText("brdf_lambert.so' is not used: '" + named +
                                 "/brdf_lambert.so' is "
                                 "also brdf 'lambert' and goes before it"));
}

TEST_CASE("libraries that are refused are told with reasons, the others are listed",
          "[app][plugin]") {
  const Folder folder;
  folder.write("brdf_text.so", "not a library");
  folder.write("brdf_lambert.so", "nor this");
  const std::uintmax_t size = fs::file_size(kLambert);
  for (const auto& [name, share] : {std::pair{"brdf_half.so", 0.5}, {"brdf_tenth.so", 0.1}}) {
    fs::copy_file(kLambert, folder.path() / name);
    fs::resize_file(folder.path() / name, std::uintmax_t(double(size) * share));
  }
  const Run r = runVestige({"plugin", "list", "--plugin-path", folder.path().string()});
  INFO(r.err);
  CHECK(r.exit == 0);
  CHECK_THAT(r.out, containsText("brdf_lambert.so"));
  CHECK_THAT(r.err, containsText("brdf_text.so' was not loaded") &&
                        containsText("brdf_lambert.so' was not loaded"));
  CHECK(r.err.find("is not used") == r.err.npos);
  for (const char* name : {"brdf_half.so", "brdf_tenth.so"})
    CHECK_THAT(r.err, containsText(folder / name + "' was not loaded: it is cut short: "));
}

TEST_CASE("a folder that cannot be listed is told", "[app][plugin]") {
  const Folder folder;
  const std::string file = folder.write("plain.txt", "");
  const Run plain = runVestige({"plugin", "list"}, {.variables = {{"VESTIGE_PLUGIN_PATH", file}}});
  CHECK(plain.exit == 0);
  CHECK_THAT(plain.err, containsText(file + "': it is no folder"));
  fs::create_directory_symlink("ring", folder.path() / "ring");
  CHECK_THAT(
      runVestige({"plugin", "list"}, {.variables = {{"VESTIGE_PLUGIN_PATH", folder / "ring"}}}).err,
      containsText("no plugin is looked for in '" + folder / "ring"));
  if (geteuid() == 0) return;  // to whom no folder is closed
  fs::create_directory(folder.path() / "closed");
  fs::permissions(folder.path() / "closed", fs::perms::none);
  const Run closed = runVestige({"plugin", "list", "--plugin-path", folder / "closed"});
  fs::permissions(folder.path() / "closed", fs::perms::owner_all);
  CHECK(closed.exit == 0);
  CHECK_THAT(closed.err,
             containsText(folder / "closed") && containsText("no plugin is looked for"));
}
