// SPDX-License-Identifier: Apache-2.0
// Every file errors/*.scene begins with the diagnostics that reading it must print, exactly, each
// line behind "//| ".
#include "support/catch.h"

#include <filesystem>
#include <fstream>

#include "tests/lang/schemas.h"

namespace vestige::lang::test {
namespace {

namespace fs = std::filesystem;

std::string withoutFolder(std::string text, const std::string& folder) {
  for (auto at = text.find(folder); at != std::string::npos; at = text.find(folder, at))
    text.erase(at, folder.size());
  return text;
}

std::string expectedOf(const fs::path& file) {
  std::ifstream in(file);
  std::string expected;
  for (std::string line; std::getline(in, line) && line.compare(0, 3, "//|") == 0;)
    expected += (line.size() > 4 ? line.substr(4) : "") + '\n';
  return expected;
}

}  // namespace

TEST_CASE("diagnostics are as their scenes say", "[lang]") {
  const fs::path folder = fs::path(VESTIGE_SOURCE_DIR) / "tests/lang/errors";
  int files = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".scene") continue;
    ++files;
    const Result result = readScene(entry.path().string(), schemas(), {});
    INFO(entry.path().string());
    CHECK(withoutFolder(printed(result), folder.string() + "/") == expectedOf(entry.path()));
  }
  CHECK(files >= 30);
}

TEST_CASE("a scene that cannot be read is an error without a place", "[lang]") {
  const Result result = readScene("no/such/file.scene", schemas(), {});
  CHECK(printed(result) == "error: the scene 'no/such/file.scene' does not exist\n");
  CHECK(result.scene.blocks.empty());
}

}  // namespace vestige::lang::test
