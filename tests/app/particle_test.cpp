// SPDX-License-Identifier: Apache-2.0
// Integrator particle from outside: solutions on disk, parts, limits, interruption.
#include <fstream>
#include <nlohmann/json.hpp>

#include "app/run.h"
#include "support/catch.h"

namespace {

std::string room(const std::string& settings = "particles 20000") {
  return smallScene("integrator particle { " + settings +
                    " }\nbox { <-1, 0, -1>, <1, 1.5, 1> brdf lambert { } }");
}

bool areSame(const std::string& a, const std::string& b) {
  const Run r = runVestige({"compare", a, b, "--json"});
  return r.exit == 0 && nlohmann::json::parse(r.out).at("rmse").get<double>() == 0;
}

}  // namespace

TEST_CASE("a solution is kept, and seen again without particles", "[app][particle]") {
  const Folder folder;
  const std::string scene = folder.write("a.scene", room());
  const std::string light = folder / "a.light", a = folder / "a.exr", b = folder / "b.exr";
  REQUIRE(runVestige({scene, "-o", a, "--spp", "2", "--save-solution", light}).exit == 0);
  CHECK(folder.names().size() == 3);  // nothing half done is left
  const Run again = runVestige({scene, "-o", b, "--spp", "2", "--load-solution", light});
  INFO(again.err);
  CHECK(again.exit == 0);
  CHECK(areSame(a, b));
  // Another camera, size and number of samples.
  std::string moved = room();
  moved.replace(moved.find("<0, 1.5, -5>"), 12, "<3, 2.5, -4>");
  const std::string other = folder.write("b.scene", moved);
  CHECK(runVestige({other, "-o", b, "--width", "40", "--load-solution", light}).exit == 0);
}

TEST_CASE("parts of the particles add up to all of them", "[app][particle]") {
  const Folder folder;
  const std::string whole = folder.write("w.scene", room("particles 20000 edges off"));
  const std::string part =
      folder.write("p.scene", room("particles 20000 edges off part Part parts 3"));
  std::vector<std::string> sum = {whole, "-o", folder / "b.exr", "--spp", "1"};
  for (const char* n : {"1", "2", "3"}) {
    const std::string file = folder / (std::string("part") + n);
    REQUIRE(runVestige({part, "-D", std::string("Part=") + n, "-o", folder / "x.exr", "--spp", "1",
                        "--save-solution", file})
                .exit == 0);
    sum.insert(sum.end(), {"--load-solution", file});
  }
  REQUIRE(runVestige({whole, "-o", folder / "a.exr", "--spp", "1"}).exit == 0);
  REQUIRE(runVestige(sum).exit == 0);
  CHECK(areSame(folder / "a.exr", folder / "b.exr"));
}

TEST_CASE("parts that do not add up to the bit are warned about", "[app][particle]") {
  const Folder folder;
  const auto said = [&](const std::string& settings) {
    const std::string scene = folder.write("a.scene", room("particles 2000 " + settings));
    const Run r = runVestige({scene, "-o", folder / "a.png", "--spp", "1"});
    CHECK(r.exit == 0);
    return r.err;
  };
  for (const char* how : {"parts 2", "part 2 parts 2 oracle \"variance\" edges off"}) {
    const std::string err = said(how);
    CHECK_THAT(err, containsText("not the same to the bit"));
    CHECK_THAT(err, containsText("edges off"));
  }
  for (const char* how : {"", "parts 2 edges off", "parts 2 oracle \"uniform\""})
    CHECK_THAT(said(how), !containsText("to the bit"));
}

TEST_CASE("solutions that cannot be read or written are told before any work", "[app][particle]") {
  const Folder folder;
  const std::string scene = folder.write("a.scene", room("particles 1000000000"));
  const std::string png = folder / "a.png";
  const auto complaint = [&](const std::string& option, const std::string& file, int code) {
    const Run r = runVestige({scene, "-o", png, option, file});
    CHECK(r.exit == code);
    return r.err;
  };
  CHECK_THAT(complaint("--load-solution", folder / "nope", 3), containsText("cannot be read"));
  CHECK_THAT(complaint("--load-solution", scene, 3), containsText("is no radiosity solution"));
  CHECK_THAT(complaint("--save-solution", folder / "no/a", 3), containsText("cannot be written"));
  CHECK_THAT(complaint("--load-solution", "", 2), containsText("wants a file"));

  const std::string other = folder.write("b.scene", smallScene());
  CHECK(runVestige({scene, "-o", png, "--time", "1s", "--save-solution", folder / "l"}).exit == 0);
  const Run foreign =
      runVestige({other, "-o", png, "--integrator", "particle", "--load-solution", folder / "l"});
  CHECK(foreign.exit == 3);
  CHECK_THAT(foreign.err, containsText("was made for other surfaces"));
  const Run path = runVestige({other, "-o", png, "--save-solution", folder / "p"});
  CHECK(path.exit == 1);
  CHECK_THAT(path.err, containsText("integrator path has no 'save_solution'"));
}

TEST_CASE("a scene cannot write files by itself", "[app][particle]") {
  const Folder folder;
  const std::string scene =
      folder.write("a.scene", room("save_solution \"" + (folder / "stolen") + "\""));
  const Run r = runVestige({scene, "-o", folder / "a.png"});
  CHECK(r.exit == 1);
  CHECK_THAT(r.err, containsText("a.scene:") && containsText("command line"));
  CHECK(folder.names().size() == 1);
}

TEST_CASE("time is shared between particles and picture, and an interruption keeps the particles",
          "[app][particle]") {
  const Folder folder;
  const std::string scene = folder.write("a.scene", room("particles 1000000000"));
  const Run timed = runVestige({scene, "-o", folder / "a.png", "--time", "2s"});
  CHECK(timed.exit == 0);
  CHECK_THAT(timed.err, containsText("of 1000000000 particles"));
  CHECK(looksLikePicture(folder / "a.png"));

  const Run stopped = runVestige(
      {scene, "-o", folder / "b.png", "--save-solution", folder / "l", "--progress", "json"},
      {.folder = {}, .interruptAt = "\"preparing\""});
  CHECK(stopped.exit == 130);
  CHECK_THAT(stopped.err, containsText("saved the solution of the particles sent so far"));
  CHECK(runVestige({scene, "-o", folder / "b.png", "--spp", "1", "--load-solution", folder / "l"})
            .exit == 0);
}

TEST_CASE("memory for elements that is used up is told, and the picture made", "[app][particle]") {
  const Folder folder;
  const std::string scene =
      folder.write("a.scene", room("particles 300000 memory 1 oracle \"uniform\" level 9"));
  const Run r = runVestige({scene, "-o", folder / "a.png", "--spp", "1"});
  CHECK(r.exit == 0);
  CHECK_THAT(r.err, containsText("the elements fill their memory"));
  CHECK(looksLikePicture(folder / "a.png"));
}
