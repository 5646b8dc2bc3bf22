// SPDX-License-Identifier: Apache-2.0
// Scenes that write files: only `render` makes them, and only below --write-folder.
#include <filesystem>
#include <fstream>

#include "app/run.h"
#include "support/catch.h"

namespace {

namespace fs = std::filesystem;

const char* const kWriting = R"(
#fopen F "data.txt" write
#write (F, image_width, ",", image_height)
#fclose F
#fopen F "data.txt" read
#read (F, W, H)
sphere { <0, H / W, 0>, 0.5  brdf lambert { } }
)";

std::string firstLine(const std::string& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return line;
}

Run run(const Folder& folder, std::vector<std::string> arguments) {
  return runVestige(arguments, {.folder = folder.path(), .patience = 60});
}

}  // namespace

TEST_CASE("render writes the scene's files below --write-folder", "[app]") {
  const Folder folder;
  const std::string scene = folder.write("a.scene", smallScene(kWriting));
  fs::create_directory(folder / "out");
  const Run render = run(folder, {"render", scene, "-o", "a.png", "--spp", "1", "--width", "8",
                                  "--write-folder", "out"});
  INFO(render.err);
  CHECK(render.exit == 0);
  CHECK(firstLine(folder / "out/data.txt") == "8,8");
}

TEST_CASE("check and inspect write nothing", "[app]") {
  const Folder folder;
  const std::string scene = folder.write("a.scene", smallScene(kWriting));
  fs::create_directory(folder / "out");
  CHECK(run(folder, {"check", scene, "--write-folder", "out"}).exit == 0);
  CHECK(run(folder, {"inspect", scene, "3", "3", "--write-folder", "out"}).exit == 0);
  CHECK(fs::is_empty(folder / "out"));
}

TEST_CASE("a scene that writes needs --write-folder", "[app]") {
  const Folder folder;
  const std::string scene = folder.write("a.scene", smallScene(kWriting));
  for (const char* command : {"check", "render"}) {
    const Run refused = run(folder, {command, scene});
    CHECK(refused.exit == 1);
    CHECK(refused.err.find("--write-folder DIR allows it") != std::string::npos);
  }
  const Run missing = run(folder, {"render", scene, "--write-folder", "none"});
  CHECK(missing.exit == 1);
  CHECK(missing.err.find("No such file") != std::string::npos);
  CHECK(folder.names().size() == 1);
}
