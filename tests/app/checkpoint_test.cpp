// SPDX-License-Identifier: Apache-2.0
// vestige render --checkpoint from outside: interrupted, killed, extended, refused.
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "app/run.h"
#include "support/catch.h"

using nlohmann::json;
namespace fs = std::filesystem;

namespace {

using Words = std::vector<std::string>;

double rmse(const std::string& a, const std::string& b) {
  const Run r = runVestige({"compare", a, b, "--json"});
  return r.exit == 0 ? json::parse(r.out).at("rmse").get<double>() : -1;
}

std::string contents(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

Words operator+(Words a, const Words& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// Half a second of two million paths.
const Words kLong = {"--width", "256", "--height", "256", "--spp", "32"};

json firstLine(const Run& r) { return json::parse(r.out.substr(0, r.out.find('\n'))); }

}  // namespace

TEST_CASE("an interrupted render goes on to the same picture", "[app][checkpoint]") {
  const Folder folder;
  const std::string scene = folder.write("a.scene", smallScene());
  const std::string kept = folder / "a.checkpoint", a = folder / "a.exr", b = folder / "b.exr";
  REQUIRE(runVestige(Words{scene, "-o", b} + kLong).exit == 0);
  for (const int signal : {2, 15, 9}) {
    const bool isKilled = signal == 9;  // then only what was written on the way is there
    const Run first = runVestige(
        Words{scene, "-o", a, "--checkpoint", kept, "--checkpoint-every", isKilled ? "1ms" : "1h",
              "--threads", "2", "--progress", "json"} +
            kLong,
        {.interruptAt = isKilled ? "\"samples\":1" : "\"rendering\"", .interruptSignal = signal});
    INFO(first.err);
    REQUIRE(first.exit == (isKilled ? -9 : 130));
    REQUIRE(fs::exists(kept));
    CHECK(fs::exists(a) != isKilled);
    const Run second = runVestige(Words{scene, "-o", a, "--checkpoint", kept, "--threads", "1",
                                        "--progress", "json", "--stats", folder / "s.json"} +
                                  kLong);
    INFO(second.err);
    CHECK(second.exit == 0);
    CHECK(rmse(a, b) == 0);
    CHECK(firstLine(second).at("share") > 0.03);  // of one sample at least
    const json stats = json::parse(contents(folder / "s.json"));
    CHECK(stats.at("samples") == 32);
    CHECK(stats.at("paths") == 32 * 256 * 256);  // of both runs
    CHECK(stats.at("render_s") > stats.at("earlier_render_s"));
    CHECK(stats.at("earlier_render_s") > 0.0);
    fs::remove(kept), fs::remove(a);
  }
}

TEST_CASE("4 samples that become 16 are the 16", "[app][checkpoint]") {
  const Folder folder;
  const std::string kept = folder / "a.checkpoint", a = folder / "a.exr", b = folder / "b.exr";
  const std::string texture =
      "box { <1, 0, -1>, <2, 1, 0>  brdf lambert { diffuse pigment checker { rgb 1, rgb 0.1 "
      "scale 0.05 } } }";
  const std::pair<std::string, std::string> cases[] = {
      {smallScene(texture), "safe"},
      {smallScene(texture + "integrator distributed { samples 4 }"), "safe"},
      {smallScene(texture + "integrator particle { particles 2000 }"), ""}};
  for (const auto& [text, footprint] : cases) {
    const std::string scene = folder.write("a.scene", text);
    const Words more = footprint.empty() ? Words{} : Words{"--footprint", footprint};
    const Words command = Words{scene, "-o", a, "--checkpoint", kept, "--aov", "all"} + more;
    const Run four = runVestige(command + Words{"--spp", "4", "--threads", "2"});
    INFO(four.err);
    REQUIRE(four.exit == 0);
    const Run r = runVestige(command + Words{"--spp", "16", "--threads", "1", "--result-line"});
    INFO(r.err);
    REQUIRE(r.exit == 0);
    CHECK_THAT(r.err, containsText("a.checkpoint: going on from 4 samples a pixel") &&
                          containsText("16 x 16, 16 samples a pixel"));
    CHECK(json::parse(r.out.substr(7)).at("spp_actual") == 16);
    REQUIRE(runVestige(Words{scene, "-o", b, "--aov", "all", "--spp", "16"} + more).exit == 0);
    CHECK(rmse(a, b) == 0);

    // Nothing is left to do: only the picture is written again.
    const auto written = fs::last_write_time(kept);
    fs::remove(a);
    CHECK(runVestige(command + Words{"--spp", "16"}).exit == 0);
    CHECK(rmse(a, b) == 0);
    CHECK(fs::last_write_time(kept) == written);
    fs::remove(kept);
  }
}

TEST_CASE("with --time every run adds some", "[app][checkpoint]") {
  const Folder folder;
  const std::string scene = folder.write("a.scene", smallScene());
  int before = 0;
  for (int i = 0; i < 2; ++i) {
    const Run r = runVestige({scene, "-o", folder / "a.exr", "--checkpoint", folder / "a.keep",
                              "--time", "300ms", "--stats", "-"});
    INFO(r.err);
    REQUIRE(r.exit == 0);
    CHECK_THAT(r.err, containsText("a.keep: the same command goes on"));
    const int samples = json::parse(r.out).at("samples");
    CHECK(samples > before);
    before = samples;
  }
}

TEST_CASE("a checkpoint of another render is refused, and stays", "[app][checkpoint]") {
  const Folder folder;
  const std::string mesh = "v -1 0 1\nv 1 0 1\nv 0 1 1\nf 1 2 3\n";
  const std::string obj = folder.write("a.obj", mesh);
  const std::string text = smallScene("mesh { \"a.obj\" }  integrator path { depth 3  samples 2 }");
  const std::string scene = folder.write("a.scene", text);
  const std::string kept = folder / "a.checkpoint", picture = folder / "a.exr";
  const Words command = {scene, "-o", picture, "--checkpoint", kept};
  REQUIRE(runVestige(command).exit == 0);
  const std::string bytes = contents(kept);
  fs::remove(picture);
  const auto refuses = [&](const Words& more, const std::string& why) {
    const Run r = runVestige(command + more);
    INFO(r.err);
    CHECK(r.exit == 2);
    CHECK_THAT(r.err, containsText(why));
    CHECK((contents(kept) == bytes));
    CHECK_FALSE(fs::exists(picture));
  };
  refuses({"--seed", "3"}, "of another render: the seed was 0 and is 3 now; delete it");
  refuses({"--width", "8"}, "the film's size was 16 x 16 and is 8 x 8 now");
  refuses({"--crop", "0,0,0.5,1"}, "the crop window was 0,0,16,16 and is 0,0,8,16 now");
  refuses({"--aov", "depth"}, "the list of AOVs was empty and is depth now");
  refuses({"--integrator", "normals"}, "the integrator was path and is normals now");
  refuses({"--footprint", "none"}, "--footprint was the scene's and is none now");
  refuses({"--spp", "1"}, "has up to 2 samples a pixel already, more than the 1 that are wanted");
  refuses({"--noise", "0.1"}, "--checkpoint does not go with --noise");
  refuses({"--adaptive"}, "--checkpoint does not go with --adaptive");
  refuses({"--stats", kept}, "cannot be the checkpoint and something else");

  folder.write("a.obj", mesh + "f 3 2 1\n");
  refuses({}, "the file 'a.obj' has changed");
  folder.write("a.obj", mesh);
  folder.write("a.scene", text + "sphere { <0, 1, 0>, 0.5 }");
  refuses({}, "the scene has changed");
  // What is no other picture is no other render.
  std::string same = "// a comment\n" + text;
  folder.write("a.scene", same.replace(same.find("samples 2"), 9, "samples 5"));
  CHECK(runVestige(command).exit == 0);
}

TEST_CASE("where footprints go by the number of samples another number is refused",
          "[app][checkpoint]") {
  const Folder folder;
  const std::string scene = folder.write("a.scene", smallScene());
  for (const char* bound : {"global", "paper", "gradient"}) {
    const Words command = {scene,         "-o", folder / "a.exr", "--checkpoint", folder / bound,
                           "--footprint", bound};
    REQUIRE(runVestige(command + Words{"--spp", "4"}).exit == 0);
    const Run r = runVestige(command + Words{"--spp", "8"});
    CHECK(r.exit == 2);
    CHECK_THAT(r.err, containsText("which the scene's footprint goes by, was 4 and is 8 now"));
    CHECK(runVestige(command + Words{"--spp", "4"}).exit == 0);
  }
}

TEST_CASE("particles that fit into a time are no render to continue", "[app][checkpoint]") {
  const Folder folder;
  const std::string scene =
      folder.write("a.scene", smallScene("integrator particle { particles 2000 }"));
  const Words command = {scene,    "-o",   folder / "a.exr", "--checkpoint", folder / "a.keep",
                         "--time", "200ms"};
  const Run r = runVestige(command);
  CHECK(r.exit == 2);
  CHECK_THAT(r.err, containsText("--checkpoint does not go with --time here"));
  REQUIRE(runVestige({scene, "-o", folder / "a.exr", "--save-solution", folder / "a.light"}).exit ==
          0);
  CHECK(runVestige(command + Words{"--load-solution", folder / "a.light"}).exit == 0);
  CHECK(runVestige(command + Words{"--load-solution", folder / "a.light"}).exit == 0);
  std::ofstream(folder / "a.light", std::ios::app) << " ";
  const Run other = runVestige(command + Words{"--load-solution", folder / "a.light"});
  CHECK(other.exit == 2);
  CHECK_THAT(other.err, containsText("the solution 'a.light' has changed"));
}

TEST_CASE("a damaged checkpoint is refused, and stays", "[app][checkpoint]") {
  const Folder folder;
  const std::string scene = folder.write("a.scene", smallScene());
  const std::string kept = folder / "a.checkpoint";
  const Words command = {scene, "-o", folder / "a.exr", "--checkpoint", kept, "--spp", "1"};
  REQUIRE(runVestige(command).exit == 0);
  fs::resize_file(kept, fs::file_size(kept) - 100);
  const std::string bytes = contents(kept);
  const Run r = runVestige(command);
  CHECK(r.exit == 2);
  CHECK_THAT(r.err, containsText("checkpoint '" + kept + "' is damaged"));
  CHECK((contents(kept) == bytes));
  const Run none = runVestige({scene, "-o", folder / "b.exr", "--checkpoint", scene});
  CHECK(none.exit == 2);
  CHECK_THAT(none.err, containsText("is no checkpoint"));
}

TEST_CASE("a place where no checkpoint can be is found before rendering", "[app][checkpoint]") {
  const Folder folder;
  const std::string scene = folder.write("a.scene", smallScene());
  for (const std::string& file : {folder / "no/such/a.checkpoint",
                                  std::string("/proc/a.checkpoint"), folder.path().string()}) {
    const Run r =
        runVestige({scene, "-o", folder / "a.exr", "--checkpoint", file, "--spp", "1000000000"},
                   {.patience = 20});
    CHECK(r.exit == 3);
    CHECK_THAT(r.err, containsText("cannot write '" + file + "'"));
  }
  CHECK(folder.names().size() == 1);
}

TEST_CASE("a full disk costs the checkpoint, not the picture nor the one before",
          "[app][checkpoint]") {
  const Folder folder;
  const std::string scene = folder.write("a.scene", smallScene());
  const std::string kept = folder / "a.checkpoint", picture = folder / "a.jpg";
  const Words command = {scene, "-o",       picture, "--checkpoint",       kept,  "--width",
                         "64",  "--height", "64",    "--checkpoint-every", "50ms"};
  REQUIRE(runVestige(command + Words{"--spp", "4"}).exit == 0);
  const std::string bytes = contents(kept);
  fs::remove(picture);
  const Run r = runVestige(command + Words{"--spp", "600"}, {.fileSizeLimit = 65536});
  INFO(r.err);
  CHECK(r.exit == 3);
  const std::string warning =
      "warning: checkpoint '" + kept + "' could not be written: File too large";
  CHECK_THAT(r.err, containsText(warning) && containsText("wrote " + picture));
  CHECK(r.err.find(warning) == r.err.rfind(warning));  // once
  CHECK(fs::file_size(picture) > 500);
  CHECK((contents(kept) == bytes));
  CHECK(folder.names().size() == 3);
}
