// SPDX-License-Identifier: Apache-2.0
// What the pages and examples show is what the program takes.
#include <sstream>

#include "images/picture.h"

using namespace vestige;
using namespace vestige::test;

namespace {

std::string contents(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// The texts between ```scene and ``` of a page.
std::vector<std::string> snippets(const std::string& page) {
  static const std::string kOpen = "```scene\n", kClose = "```\n";
  std::vector<std::string> found;
  for (std::size_t at = page.find(kOpen); at != std::string::npos; at = page.find(kOpen, at)) {
    at += kOpen.size();
    const std::size_t end = page.find(kClose, at);
    REQUIRE(end != std::string::npos);
    found.push_back(page.substr(at, end - at));
    at = end;
  }
  return found;
}

int check(const std::filesystem::path& scene) {
  return runVestige("check --werror " + quoted(scene));
}

}  // namespace

TEST_CASE("every example is a scene without complaints", "[images]") {
  int scenes = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(source("examples"))) {
    if (entry.path().extension() != ".scene") continue;
    // Those need their plugins: tests/install/install_test.sh.
    if (entry.path().string().find("/examples/plugins/") != std::string::npos) continue;
    INFO(entry.path().string());
    CHECK(check(entry.path()) == 0);
    ++scenes;
  }
  CHECK(scenes >= 3);
}

TEST_CASE("every scene in the manual can be rendered", "[images]") {
  const std::vector<std::string> scenes = snippets(contents(source("docs/language.md")));
  CHECK(scenes.size() >= 3);
  for (const std::string& text : scenes) {
    const std::filesystem::path file = scratch() / "snippet.scene";
    std::ofstream(file) << text;
    INFO(text);
    CHECK(check(file) == 0);
    const Image picture = renderText(text, "--width 24 --height 18 --spp 1");
    CHECK(mean(picture, 0) > 0);
  }
}

TEST_CASE("the README shows the scene of its picture", "[images]") {
  std::string scene = contents(source("examples/hello.scene"));
  scene.erase(0, scene.find('\n') + 1);  // the licence line
  CHECK(contents(source("README.md")).find(scene) != std::string::npos);
}
