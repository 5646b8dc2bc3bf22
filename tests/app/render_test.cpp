// SPDX-License-Identifier: Apache-2.0
// vestige render from outside: files, progress, statistics, time, interruption.
#include <fstream>
#include <nlohmann/json.hpp>

#include "app/run.h"
#include "support/catch.h"

using nlohmann::json;

namespace {

/// RMSE between two pictures, by `vestige compare`; negative if it failed.
double rmse(const std::string& a, const std::string& b) {
  const Run r = runVestige({"compare", a, b, "--json"});
  return r.exit == 0 ? json::parse(r.out).at("rmse").get<double>() : -1;
}

/// Every line of stdout as an object.
std::vector<json> objects(const std::string& text) {
  std::vector<json> found;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) found.push_back(json::parse(line));
  return found;
}

/// Of all lines but the last, which says what was written.
void checkShareRises(const std::vector<json>& lines) {
  double share = 0;
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    CHECK(lines[i].at("share").get<double>() >= share);
    share = lines[i].at("share");
  }
}

}  // namespace

TEST_CASE("render writes each picture asked for", "[app]") {
  const Folder folder;
  const std::string scene = folder.write("a.scene", smallScene());
  const std::string png = folder / "a.png", exr = folder / "a.exr";
  const Run r = runVestige({"render", scene, "-o", png, "-o", exr, "--spp", "1"});
  INFO(r.err);
  CHECK(r.exit == 0);
  CHECK(r.out == "");
  CHECK_THAT(r.err, containsText("wrote " + png) && containsText("16 x 16, 1 sample a pixel"));
  CHECK(looksLikePicture(png));
  CHECK(looksLikePicture(exr));
  CHECK(folder.names().size() == 3);
}

TEST_CASE("a bare scene renders to its name with .png, here", "[app]") {
  const Folder scenes, here;
  const std::string scene = scenes.write("hello.scene", smallScene());
  CHECK(runVestige({scene, "--spp", "1"}, {.folder = here.path()}).exit == 0);
  CHECK(looksLikePicture(here / "hello.png"));
  CHECK(runVestige({"--spp", "1", scene, "--progress", "none"}, {.folder = here.path()}).err == "");
}

TEST_CASE("the same render twice, and by one thread or two, is the same picture", "[app]") {
  const Folder folder;
  const std::string scene = folder.write("a.scene", smallScene());
  const std::string a = folder / "a.exr", b = folder / "b.exr", c = folder / "c.exr";
  REQUIRE(runVestige({scene, "-o", a, "--spp", "4", "--threads", "1"}).exit == 0);
  REQUIRE(runVestige({scene, "-o", b, "--spp", "4", "--threads", "2"}).exit == 0);
  REQUIRE(runVestige({scene, "-o", c, "--spp", "4", "--seed", "7"}).exit == 0);
  CHECK(rmse(a, b) == 0);
  CHECK(rmse(a, c) > 0);
}

TEST_CASE("-D reaches the scene, which keeps its own value otherwise", "[app]") {
  const Folder folder;
  const std::string text = smallScene(
      "#ifndef (Size) #declare Size = 1; #end\nsphere { <0, 1, 0>, Size brdf lambert { } }");
  const std::string scene = folder.write("a.scene", text);
  const std::string a = folder / "a.exr", b = folder / "b.exr", c = folder / "c.exr";
  REQUIRE(runVestige({scene, "-o", a, "--spp", "2"}).exit == 0);
  REQUIRE(runVestige({scene, "-o", b, "--spp", "2", "-D", "Size=1"}).exit == 0);
  REQUIRE(runVestige({scene, "-o", c, "--spp", "2", "-DSize=0.5"}).exit == 0);
  CHECK(rmse(a, b) == 0);
  CHECK(rmse(a, c) > 0.01);
}

TEST_CASE("size and crop", "[app]") {
  const Folder folder;
  const std::string scene = folder.write("a.scene", smallScene());
  const Run r = runVestige({scene, "-o", folder / "a.exr", "--spp", "1", "--width", "40",
                            "--height", "20", "--crop", "0.25,0,0.75,0.5", "--stats", "-"});
  REQUIRE(r.exit == 0);
  const json stats = json::parse(r.out);
  CHECK(stats.at("width") == 20);
  CHECK(stats.at("height") == 10);
}

TEST_CASE("the crop shows what the whole picture shows there", "[app]") {
  const Folder folder;
  const std::string scene = folder.write("a.scene", smallScene());
  const std::string full = folder / "f.exr", part = folder / "p.exr";
  REQUIRE(runVestige({scene, "-o", full, "--spp", "1"}).exit == 0);
  REQUIRE(runVestige({scene, "-o", part, "--spp", "1", "--crop", "0,0,1,1"}).exit == 0);
  CHECK(rmse(full, part) == 0);
  const Run r = runVestige({"compare", full, full, "-o", folder / "d.png"});
  CHECK(r.exit == 0);
  REQUIRE(runVestige({scene, "-o", part, "--spp", "1", "--crop", "0,0,0.5,1"}).exit == 0);
  const Run sizes = runVestige({"compare", part, full});
  CHECK(sizes.exit == 2);
  CHECK_THAT(sizes.err, containsText("8 x 16") && containsText("16 x 16"));
}

TEST_CASE("AOVs go into EXR, and a PNG alone is warned about", "[app]") {
  const Folder folder;
  const std::string scene = folder.write("a.scene", smallScene());
  const std::string exr = folder / "a.exr";
  const Run r = runVestige({scene, "-o", exr, "--spp", "1", "--aov", "all"});
  CHECK(r.exit == 0);
  std::ifstream file(exr, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  for (const char* word : {"normal.X", "albedo.R", "depth.Z", "position.X", "uv.U", "samples",
                           "vestige:scene_hash", "vestige:version", "vestige:samples"})
    CHECK(bytes.find(word) != std::string::npos);
  const Run png = runVestige({scene, "-o", folder / "a.png", "--spp", "1", "--aov", "normal"});
  CHECK(png.exit == 0);
  CHECK_THAT(png.err, containsText("warning: PNG and JPEG keep colour only"));
}

TEST_CASE("AOVs of the integrator's own are known by name", "[app]") {
  const Folder folder;
  const std::string scene =
      folder.write("a.scene",
                   "camera orthographic { location <0, 0, -1> look_at 0 width 4 }\n"
                   "film { resolution <4, 1> }\nintegrator own_aovs { value 7 }\n");
  const std::string exr = folder / "a.exr";
  const auto run = [&](const std::string& aovs, const std::vector<std::string>& more = {}) {
    std::vector<std::string> words = {
        scene, "-o", exr, "--plugin-path", VESTIGE_OWN_AOVS, "--aov", aovs, "--spp", "4"};
    words.insert(words.end(), more.begin(), more.end());
    return runVestige(words);
  };
  for (const char* aovs : {"all", "test.value", "depth,test.value,depth"}) {
    INFO(aovs);
    CHECK(run(aovs).exit == 0);
    std::ifstream file(exr, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    CHECK(bytes.find("test.value") != std::string::npos);
    CHECK((bytes.find("aim.x") != std::string::npos) == (std::string(aovs) == "all"));
  }
  const Run unknown = run("depth,zzz");
  CHECK(unknown.exit == 2);
  CHECK_THAT(unknown.err, containsText("--aov knows no 'zzz'; with this integrator it knows all, "
                                       "normal, albedo,") &&
                              containsText("gradient, test.value, aim.x"));
  CHECK_THAT(run("test.valve").err, containsText("did you mean 'test.value'?"));
  // Another integrator has other AOVs.
  const Run other = run("test.value", {"--integrator", "path"});
  CHECK(other.exit == 2);
  CHECK_THAT(other.err, containsText("--aov knows no 'test.value'"));
}

TEST_CASE("statistics count what was done", "[app]") {
  const Folder folder;
  const std::string scene = folder.write("a.scene", smallScene());
  const std::string file = folder / "s.json";
  const Run r = runVestige({scene, "-o", folder / "a.png", "--spp", "3", "--threads", "2",
                            "--stats", file, "--result-line"});
  REQUIRE(r.exit == 0);
  std::ifstream in(file);
  const json s = json::parse(in);
  CHECK(s.at("samples") == 3);
  CHECK(s.at("paths") == 3 * 16 * 16);
  CHECK(s.at("rays").get<double>() >= 3 * 16 * 16);
  CHECK(s.at("shadow_rays").get<double>() > 0);
  CHECK(s.at("threads") == 2);
  CHECK(s.at("nonfinite") == 0);
  CHECK(s.at("peak_memory_bytes").get<double>() > 1e6);
  for (const char* key : {"load_s", "build_s", "render_s", "clamped", "texture_bytes", "triangles"})
    CHECK(s.at(key).is_number());
  REQUIRE(r.out.rfind("RESULT {", 0) == 0);
  CHECK(json::parse(r.out.substr(7)).at("spp_actual") == 3);
}

TEST_CASE("clamp cuts indirect light down, and says so", "[app]") {
  const Folder folder;
  // A mirror throws a small bright lamp onto the floor.
  const auto rendered = [&](const std::string& more, const std::string& name) {
    const std::string scene =
        folder.write(name + ".scene",
                     "camera pinhole { location <0, 2, -5>  look_at <0, 0.3, 0>  angle 40 }\n"
                     "film { resolution <24, 16> }\n"
                     "integrator path { samples 64  depth " +
                         more +
                         " }\n"
                         "sphere { <0, 2.5, 0>, 0.5  emission rgb 50 }\n"
                         "sphere { <0.8, 0.6, 0>, 0.6  brdf mirror { } }\n"
                         "plane { <0, 1, 0>, 0  brdf lambert { diffuse rgb 0.5 } }\n");
    const Run r = runVestige({scene, "-o", folder / (name + ".exr"), "--stats", folder / "s.json"});
    INFO(r.err);
    REQUIRE(r.exit == 0);
    std::ifstream in(folder / "s.json");
    const auto count = json::parse(in).at("clamped_indirect").get<long>();
    CHECK((r.err.find("clamp cut") != std::string::npos) == (count > 0));
    return count;
  };
  CHECK(rendered("6", "free") == 0);
  CHECK(rendered("6  clamp 1", "cut") > 0);
  CHECK(rendered("2", "direct") == 0);
  CHECK(rendered("2  clamp 0.001", "direct_cut") == 0);
  const auto mean = [&](const std::string& a, const std::string& b) {
    const Run r = runVestige({"compare", "--json", folder / (a + ".exr"), folder / (b + ".exr")});
    INFO(r.err);
    return json::parse(r.out);
  };
  CHECK(mean("cut", "free").at("mean_ratio")[0].get<double>() < 0.999);
  CHECK(mean("direct", "direct_cut").at("rmse") == 0);  // direct light is left alone
}

TEST_CASE("AOVs that are cut are reported", "[app]") {
  const Folder folder;
  // A plane has no extent, so that nothing but the camera says how large the scene is.
  const auto cut = [&](const std::string& distance, const std::string& words) {
    const std::string scene =
        folder.write("far.scene",
                     "camera pinhole { location <0, 0, 0>  look_at <0, 0, 1>  angle 10 }\n"
                     "film { resolution <8, 8> }\nintegrator path { samples 2 }\n"
                     "light environment { radiance rgb 1 }\n"
                     "plane { <0, 0, -1>, -" +
                         distance + "  brdf lambert { diffuse rgb 0.5 } }\n");
    const Run r = runVestige(
        {scene, "-o", folder / "a.exr", "--aov", "depth,normal", "--stats", folder / "s.json"});
    INFO(r.err);
    REQUIRE(r.exit == 0);
    CHECK((r.err.find(words) != std::string::npos));
    CHECK((r.err.find("AOV") != std::string::npos) == !words.empty());
    std::ifstream in(folder / "s.json");
    return json::parse(in).at("cut_aovs").get<long>();
  };
  CHECK(cut("1000", "") == 0);
  CHECK(cut("1e7", "128 samples of AOV 'depth' were not finite or beyond 1.05e+06") == 128);
}

TEST_CASE("progress as JSON is one object a line and ends with what was written", "[app]") {
  const Folder folder;
  const std::string scene = folder.write("a.scene", smallScene());
  const std::string png = folder / "a.png";
  const Run r = runVestige({scene, "-o", png, "--time", "1s", "--progress", "json"});
  REQUIRE(r.exit == 0);
  const std::vector<json> lines = objects(r.out);
  REQUIRE(lines.size() >= 3);
  checkShareRises(lines);
  CHECK(lines.back().at("phase") == "done");
  CHECK(lines.back().at("end") == "time is up");
  CHECK(lines.back().at("files") == json::array({png}));
}

TEST_CASE("--noise says what it came to", "[app]") {
  const Folder folder;
  const std::string scene = folder.write("a.scene", smallScene());
  const std::string file = folder / "s.json";
  const Run r = runVestige({scene, "-o", folder / "a.png", "--noise", "0.1", "--width", "64",
                            "--stats", file, "--result-line"});
  INFO(r.err);
  REQUIRE(r.exit == 0);
  CHECK_THAT(r.err, containsText("16 to ") && containsText("100 % of the pixels quiet"));
  std::ifstream in(file);
  const json s = json::parse(in);
  CHECK(s.at("end") == "finished");
  CHECK(s.at("noise") == 0.1);
  CHECK(s.at("samples") == 16);
  CHECK(s.at("samples_most") > 16);
  CHECK(s.at("samples_mean").get<double>() * 4096 == s.at("paths"));
  CHECK(s.at("quiet_pixels") == 4096);
  const json line = json::parse(r.out.substr(7));
  CHECK(line.at("spp_mean") == s.at("samples_mean"));
  CHECK(line.at("spp_most") == s.at("samples_most"));
  CHECK(line.at("quiet_pixels") == 4096);
}

TEST_CASE("--adaptive shares a mean number of samples out", "[app]") {
  const Folder folder;
  const std::string scene = folder.write("a.scene", smallScene());
  const Run r = runVestige({scene, "-o", folder / "a.png", "--adaptive", "--spp", "32", "--width",
                            "64", "--stats", "-", "--progress", "plain"});
  INFO(r.err);
  REQUIRE(r.exit == 0);
  CHECK_THAT(r.err, containsText("8 to ") && containsText(" on average") && !containsText("quiet"));
  const json s = json::parse(r.out);
  CHECK(s.at("samples") == 8);
  CHECK(s.at("samples_most") > 32);
  CHECK(s.at("samples_mean") <= 32);
  CHECK(s.at("samples_mean") > 24);
  CHECK(s.at("samples_mean").get<double>() * 4096 == s.at("paths"));
  CHECK_FALSE(s.contains("quiet_pixels"));
  const Run both = runVestige({scene, "-o", folder / "a.png", "--adaptive", "--noise", "0.1"});
  CHECK(both.exit == 2);
  CHECK_THAT(both.err, containsText("--adaptive does not go with --noise"));
}

TEST_CASE("--noise: --spp and --time end it too, and progress tells how much is quiet", "[app]") {
  const Folder folder;
  const std::string scene = folder.write("a.scene", smallScene());
  const std::string png = folder / "a.png";
  const Run few =
      runVestige({scene, "-o", png, "--noise", "0.0001", "--spp", "20", "--stats", "-"});
  CHECK(json::parse(few.out).at("samples_most") == 20);
  CHECK(json::parse(few.out).at("quiet_pixels") < 256);
  const Run r =
      runVestige({scene, "-o", png, "--noise", "0.0001", "--time", "1s", "--progress", "json"});
  REQUIRE(r.exit == 0);
  const std::vector<json> lines = objects(r.out);
  REQUIRE(lines.size() >= 3);
  checkShareRises(lines);
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) CHECK(lines[i].at("quiet") <= 1);
  CHECK(lines.back().at("end") == "time is up");
}

TEST_CASE("--time stops in time", "[app]") {
  const Folder folder;
  const std::string scene = folder.write("a.scene", smallScene());
  const Run r = runVestige({scene, "-o", folder / "a.png", "--time", "1s", "--spp", "100000000"});
  CHECK(r.exit == 0);
  CHECK(r.seconds > 0.9);
  CHECK(r.seconds < 5);
  CHECK(looksLikePicture(folder / "a.png"));
}

TEST_CASE("an interrupted render keeps what is done", "[app]") {
  const Folder folder;
  const std::string scene = folder.write("a.scene", smallScene());
  const std::string exr = folder / "a.exr";
  const std::vector<std::string> spp = {"--spp", "100000000"}, noise = {"--noise", "0.0001"};
  for (const auto& [signal, until] : {std::pair{2, spp}, {15, spp}, {2, noise}}) {
    const Run r =
        runVestige({scene, "-o", exr, until[0], until[1], "--progress", "json"},
                   {.folder = {}, .interruptAt = "\"rendering\"", .interruptSignal = signal});
    INFO(r.err);
    CHECK(r.exit == 130);
    CHECK(looksLikePicture(exr));
    CHECK(rmse(exr, exr) == 0);  // it can be read
    CHECK(objects(r.out).back().at("end") == "interrupted");
    std::filesystem::remove(exr);
  }
}

TEST_CASE("an unwritable output is found before rendering", "[app]") {
  const Folder folder;
  const std::string scene = folder.write("a.scene", smallScene());
  const std::vector<std::pair<std::string, int>> cases = {
      {folder / "no/such/folder/a.png", 3},
      {folder.path().string(), 3},
      {"/proc/a.png", 3},
      {folder / "a.txt", 2},
      {folder / "a", 2},
  };
  for (const auto& [file, code] : cases) {
    const Run r = runVestige({scene, "-o", file, "--spp", "1000000000"}, {.patience = 20});
    INFO(file << ": " << r.err);
    CHECK(r.exit == code);
    CHECK(r.seconds < 5);
    CHECK_THAT(r.err, containsText(file));
  }
  const Run stats = runVestige({scene, "-o", folder / "a.png", "--stats", folder / "no/s.json"});
  CHECK(stats.exit == 3);
  CHECK(folder.names().size() == 1);
}

TEST_CASE("an unknown view is found before rendering", "[app]") {
  const Folder folder;
  const std::string scene = folder.write("a.scene", smallScene());
  const Run r =
      runVestige({scene, "-o", folder / "a.png", "--view", "Fish eye", "--spp", "1000000000"},
                 {.patience = 20});
  INFO(r.err);
  CHECK(r.exit == 2);
  CHECK_THAT(r.err, containsText("Fish eye"));
  CHECK(folder.names().size() == 1);
}

TEST_CASE("a full disk is told, and leaves nothing half-written", "[app]") {
  const Folder folder;
  const std::string scene = folder.write("a.scene", smallScene());
  const std::string exr = folder / "a.exr";
  const Run r = runVestige(
      {scene, "-o", exr, "--spp", "1", "--width", "200", "--height", "200"},
      {.variables = {{"TMPDIR", folder.path().string()}, {"HOME", folder.path().string()}},
       .fileSizeLimit = 8192});
  INFO(r.err);
  CHECK(r.exit == 3);
  CHECK_THAT(r.err, containsText("error") && containsText(exr));
  CHECK(folder.names().size() == 1);
}

TEST_CASE("one output that fails does not take the other with it", "[app]") {
  const Folder folder;
  const std::string scene = folder.write("a.scene", smallScene());
  const Run r = runVestige({scene, "-o", folder / "a.exr", "-o", folder / "a.jpg", "--spp", "1",
                            "--width", "128", "--height", "128"},
                           {.fileSizeLimit = 16384});
  INFO(r.err);
  CHECK(r.exit == 3);
  CHECK_THAT(r.err, containsText("a.exr") && containsText("wrote " + folder / "a.jpg"));
  CHECK(folder.names().size() == 2);
}

// Sanitizers reserve terabytes of addresses for themselves, which no limit allows.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST_CASE("a picture that does not fit into memory is the machine's fault", "[app]") {
  const Folder folder;
  const std::string scene = folder.write("a.scene", smallScene());
  const Run r = runVestige({scene, "-o", folder / "a.exr", "--width", "60000", "--height", "60000"},
                           {.memoryLimit = 4L << 30});
  INFO(r.err);
  CHECK(r.exit == 3);
  CHECK_THAT(r.err, containsText("more than this machine's 4.3 GB"));
}
#endif
