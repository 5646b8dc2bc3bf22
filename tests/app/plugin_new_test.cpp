// SPDX-License-Identifier: Apache-2.0
// vestige plugin new. That what it makes can be built: tests/install/install_test.sh.
#include <algorithm>
#include <fstream>
#include <iterator>

#include "app/run.h"
#include "support/catch.h"

namespace {

std::string contents(const std::string& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

Run make(const Folder& folder, std::vector<std::string> words) {
  words.insert(words.begin(), {"plugin", "new"});
  return runVestige(words, {.folder = folder.path()});
}

}  // namespace

TEST_CASE("a new plugin has source, scene, recipe and page", "[app][plugin]") {
  const Folder folder;
  for (const char* kind : {"brdf", "light", "camera", "pigment", "shape", "integrator"}) {
    const std::string name = std::string("soft_") + kind;
    const Run r = make(folder, {kind, name});
    INFO(r.err);
    CHECK(r.exit == 0);
    CHECK_THAT(r.out, containsText("cmake --build build"));
    const std::string in = folder / name + '/';
    const std::string source = contents(in + name + ".cpp");
    CHECK_THAT(source, containsText("VESTIGE_PLUGIN") && containsText("class Soft"));
    CHECK_THAT(contents(in + "CMakeLists.txt"),
               containsText("vestige_add_plugin(" + std::string(kind) + ' ' + name));
    CHECK_THAT(contents(in + name + ".scene"), containsText(name));
    for (const std::string& file :
         {in + name + ".cpp", in + "CMakeLists.txt", in + "README.md", in + name + ".scene"}) {
      INFO(file);
      CHECK_FALSE(contents(file).empty());
      CHECK(contents(file).find('@') == std::string::npos);
    }
  }
}

TEST_CASE("--dual and --into are heard", "[app][plugin]") {
  const Folder folder;
  std::filesystem::create_directory(folder.path() / "mine");
  CHECK(make(folder, {"brdf", "fur", "--dual", "--into", "mine"}).exit == 0);
  CHECK_THAT(contents(folder / "mine/fur/fur.cpp"), containsText("DualBrdf<Fur>"));
  CHECK(make(folder, {"light", "dome", "--dual"}).exit == 0);
  CHECK_THAT(contents(folder / "dome/dome.cpp"), containsText("DualLight<Dome>"));
  CHECK(make(folder, {"camera", "eye", "--dual"}).exit == 0);
  CHECK_THAT(contents(folder / "eye/eye.cpp"), containsText("DualCamera<Eye>"));
  CHECK(make(folder, {"shape", "fur", "--dual"}).exit == 2);
  CHECK_THAT(make(folder, {"brdf", "silk", "--into", "yours"}).err,
             containsText("no folder 'yours'"));
}

TEST_CASE("a namesake is told", "[app][plugin]") {
  const Folder folder;
  CHECK_THAT(make(folder, {"brdf", "phong"}).err, containsText("there is a brdf 'phong' already"));
  CHECK(make(folder, {"light", "lambert"}).err.empty());
}

TEST_CASE("what cannot be a plugin is refused in one sentence, and nothing is written",
          "[app][plugin]") {
  const Folder folder;
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"bsdf", "fur"}, "did you mean 'brdf'?"},
      {{"brdf", "2fast"}, "begins with a letter"},
      {{"brdf", "soft-fur"}, "as soft_box"},
      {{"brdf", "../fur"}, "as soft_box"},
      {{"brdf", "Fur"}, "as soft_box"},
      {{"brdf", "fur_"}, "as soft_box"},
      {{"brdf", "a__b"}, "as soft_box"},
      {{"brdf", ""}, "as soft_box"},
      {{"brdf", "class"}, "a word of C++"},
      {{"shape", "sin"}, "a word of the scene language"},
      {{"shape", "film"}, "a word of the scene language"},
      {{"shape", "texture"}, "a word of the scene language"},
      {{"shape", "rotate"}, "a word of the scene language"},
      {{"light", "values"}, "its class would be called Values"},
      {{"shape", "vec3"}, "its class would be called Vec3"},
  };
  for (const auto& [words, message] : cases) {
    const Run r = make(folder, words);
    INFO(words[0] << ' ' << words[1] << '\n' << r.err);
    CHECK(r.exit == 2);
    CHECK(std::count(r.err.begin(), r.err.end(), '\n') == 1);
    CHECK_THAT(r.err, containsText(message));
  }
  CHECK(folder.names().empty());
}

TEST_CASE("a folder that is there already is left alone", "[app][plugin]") {
  const Folder folder;
  std::filesystem::create_directory(folder.path() / "fur");
  const Run r = make(folder, {"brdf", "fur"});
  CHECK(r.exit == 2);
  CHECK_THAT(r.err, containsText("'./fur' is there already") || containsText("'fur' is there"));
  CHECK(std::filesystem::is_empty(folder.path() / "fur"));
}

TEST_CASE("a misspelt command of plugin is named, and the nearest", "[app][plugin]") {
  const Run r = runVestige({"plugin", "lisst"});
  CHECK(r.exit == 2);
  CHECK_THAT(r.err, containsText("'vestige plugin' has no command 'lisst'") &&
                        containsText("did you mean 'list'?"));
  const Run option = runVestige({"plugin", "list", "--jsn"});
  CHECK(option.exit == 2);
  CHECK_THAT(option.err, containsText("'vestige plugin list' has no option '--jsn'") &&
                             containsText("did you mean '--json'?"));
  CHECK(runVestige({"plugin"}).exit == 2);
  CHECK_THAT(runVestige({"help", "plugin", "new"}).out, containsText("--dual"));
}
