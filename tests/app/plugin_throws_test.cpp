// SPDX-License-Identifier: Apache-2.0
// A constructor may throw whatever it likes: the user reads a sentence at the scene's line.
#include "app/run.h"
#include "support/catch.h"

TEST_CASE("what a plugin's constructor throws is told, and nothing crashes", "[app][plugin]") {
  const Folder folder;
  const std::pair<const char*, const char*> cases[] = {
      {"0", "unknown failure"}, {"1", "no such fibre"}, {"2", "how is 2: expected less"}};
  for (const auto& [how, message] : cases) {
    const std::string scene = folder.write(
        "a.scene",
        smallScene("sphere { <0, 1, 0>, 1 brdf throws { how " + std::string(how) + " } }"));
    const Run r =
        runVestige({"render", scene, "-o", folder / "a.png", "--plugin-path", VESTIGE_THROWS});
    INFO(r.err);
    CHECK(r.exit == 1);
    CHECK_THAT(r.err, containsText(message) && containsText("a.scene:5"));
  }
}

TEST_CASE("a crash inside a plugin names its library", "[app][plugin]") {
  const Folder folder;
  const std::string scene =
      folder.write("a.scene", smallScene("sphere { <0, 1, 0>, 1 brdf throws { how 3 } }"));
  const Run r =
      runVestige({"render", scene, "-o", folder / "a.png", "--plugin-path", VESTIGE_THROWS});
  CHECK(r.exit != 0);
  // A sanitizer tells it in its own way.
  CHECK_THAT(r.err, containsText("brdf_throws.so"));
}
