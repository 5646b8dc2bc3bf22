// SPDX-License-Identifier: Apache-2.0
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "app/run.h"
#include "support/catch.h"

namespace {

/// A camera straight above a plane, 64 pixels wide: one pixel is 4 units / 64 across.
const char* const kPlane = R"(
camera pinhole { location <0, 2, 0> look_at <0, 0, 0> angle 90 sky z }
film { resolution <64, 64> }
integrator path { samples 4 depth 3 }
light distant { direction <0, -1, 0> irradiance rgb 1 }
plane { y, 0 brdf lambert { diffuse pigment checker { rgb 0.2, rgb 0.8 } } }
)";

}  // namespace

TEST_CASE("inspect shows an integrator's notes", "[app][inspect]") {
  const Folder folder;
  const std::string scene =
      folder.write("a.scene",
                   "camera orthographic { location <0, 3, -1> look_at <0, 3, 0> width 1e-6 }\n"
                   "film { resolution <1, 1> }\nintegrator own_aovs {}\n");
  const std::vector<std::string> words = {"inspect", scene,           "0",
                                          "0",       "--plugin-path", VESTIGE_OWN_AOVS};
  const Run text = runVestige(words);
  INFO(text.err);
  CHECK(text.exit == 0);
  CHECK_THAT(text.out, containsText("    notes       test.start <"));
  CHECK_THAT(text.out, containsText("> scene units, number 16777215\n"));
  std::vector<std::string> json = words;
  json.push_back("--json");
  const auto notes = nlohmann::json::parse(runVestige(json).out).at("vertices").at(0).at("notes");
  CHECK(notes.at("number").get<double>() == 16777215);
  REQUIRE(notes.at("test.start").size() == 3);
  CHECK(notes.at("test.start").at(2).get<double>() == Approx(-1).margin(1e-5));
}

TEST_CASE("inspect tells what a path hit and how large it is there", "[app]") {
  const Folder folder;
  const std::string scene = folder.write("a.scene", kPlane);
  const Run text = runVestige({"inspect", scene, "31", "40"});
  INFO(text.err);
  CHECK(text.exit == 0);
  CHECK_THAT(text.out, containsText("plane with brdf lambert") && containsText("a.scene:6") &&
                           containsText("film x") && containsText("N_eff") &&
                           containsText("exact area"));

  const Run json = runVestige({"inspect", scene, "31", "40", "--json"});
  REQUIRE(json.exit == 0);
  const auto j = nlohmann::json::parse(json.out);
  const auto& first = j["vertices"][0];
  CHECK(first["shape"] == "plane");
  CHECK(first["variables"] == 2);
  REQUIRE(first["differentials"].size() == 2);
  // Seen head-on from 2 units with 90 degrees a pixel is a square of 4 / 64.
  CHECK(first["footprint"]["size"].get<double>() == Approx(4.0 / 64).epsilon(1e-3));
  CHECK(first["footprint"]["exact_area"].get<double>() == Approx(16.0 / 4096).epsilon(1e-3));
}

TEST_CASE("inspect: later samples stand for less, bounds can be chosen", "[app]") {
  const Folder folder;
  const std::string scene = folder.write("a.scene", kPlane);
  const auto size = [&](std::vector<std::string> more) {
    std::vector<std::string> words = {"inspect", scene, "10", "10", "--json"};
    words.insert(words.end(), more.begin(), more.end());
    const Run r = runVestige(words);
    INFO(r.err);
    REQUIRE(r.exit == 0);
    return nlohmann::json::parse(r.out)["vertices"][0]["footprint"]["size"].get<double>();
  };
  CHECK(size({"--sample", "15"}) == Approx(4.0 / 64 * 1.6 * std::pow(16., -2. / 3)).epsilon(1e-3));
  CHECK(size({"--footprint", "local", "--spp", "16"}) == Approx(4.0 / 64 / 4).epsilon(1e-3));
  CHECK(size({"--footprint", "global", "--spp", "16"}) == Approx(4.0 / 64 / 4).epsilon(1e-3));
  CHECK(size({"--footprint", "pixel", "--spp", "1"}) == Approx(4.0 / 64).epsilon(1e-3));
}

TEST_CASE("inspect refuses what it cannot answer", "[app]") {
  const Folder folder;
  const std::string scene = folder.write("a.scene", kPlane);
  const Run outside = runVestige({"inspect", scene, "64", "0"});
  CHECK(outside.exit == 2);
  CHECK_THAT(outside.err, containsText("64 x 64"));
  const Run bound = runVestige({"inspect", scene, "1", "1", "--footprint", "locl"});
  CHECK(bound.exit == 2);
  CHECK_THAT(bound.err, containsText("did you mean 'local'?"));
  const Run none = runVestige({"inspect", scene, "1", "1", "--footprint", "none"});
  CHECK(none.exit == 0);
  CHECK_THAT(none.out, containsText("carries no differentials"));
}

TEST_CASE("a footprint block is checked like any other", "[app]") {
  const Folder folder;
  const auto check = [&](const std::string& block) {
    std::string text = kPlane;
    text.replace(text.find("depth 3"), 7, "depth 3 " + block);
    return runVestige({"check", folder.write("b.scene", text)});
  };
  CHECK(check("footprint safe").exit == 0);
  CHECK(check("footprint gradient { limit 0.5 scale 2 }").exit == 0);
  const Run unknown = check("footprint safest");
  CHECK(unknown.exit == 1);
  CHECK_THAT(unknown.err, containsText("safe"));
  const Run wrong = check("footprint local { limit -1 }");
  CHECK(wrong.exit == 1);
  CHECK_THAT(wrong.err, containsText("limit") && containsText("b.scene:4"));
}

TEST_CASE("inspect tells where roulette ended a path", "[app]") {
  int escaped = 0, ended = 0;
  for (int sample = 0; sample < 20; ++sample) {
    const Run r = runVestige({"inspect", VESTIGE_SOURCE_DIR "/examples/cornell.scene", "200", "200",
                              "--sample", std::to_string(sample), "--json"});
    REQUIRE(r.exit == 0);
    const auto j = nlohmann::json::parse(r.out)["vertices"];
    const auto last = j.back();
    escaped += last["event"] == "escape", ended += last["event"] == "roulette";
    if (last["event"] == "roulette") CHECK(j.size() > 3);
  }
  CHECK(escaped > 0);  // the box is open towards the camera
  CHECK(ended > 3);
}

TEST_CASE("a footprint asked of an integrator that has none is a warning", "[app]") {
  const Folder folder;
  const std::string scene = folder.write("a.scene", kPlane);
  const Run r = runVestige({"render", scene, "--integrator", "normals", "--footprint", "safe",
                            "--spp", "1", "-o", (folder.path() / "a.exr").string()});
  CHECK(r.exit == 0);
  CHECK_THAT(r.err, containsText("integrator normals has no footprints"));
}

namespace {

/// kPlane under a ceiling, so that paths have a second vertex.
std::string room(const std::string& footprint) {
  std::string text = kPlane;
  text.replace(text.find("depth 3"), 7, "depth 3 footprint " + footprint);
  return text + "plane { -y, -3 brdf lambert { diffuse pigment checker { rgb 0.2, rgb 0.8 } } }";
}

}  // namespace

TEST_CASE("the cones of other renderers open by their own rules", "[app]") {
  const Folder folder;
  for (const std::string bound : {"cone_roughness", "cone_density"}) {
    const Run r = runVestige(
        {"inspect", folder.write("a.scene", room(bound)), "31", "31", "--spp", "16", "--json"});
    REQUIRE(r.exit == 0);
    const auto v = nlohmann::json::parse(r.out)["vertices"];
    REQUIRE(v.size() >= 2);
    const double start = 4.0 / 64 / 4;  // a pixel's share among 16, on the plane
    CHECK(v[0]["footprint"]["size"].get<double>() == Approx(start).epsilon(1e-2));
    // A diffuse surface is as rough as can be: 1 rad.
    const double pdf = v[0]["scatter"]["pdf"], distance = v[1]["distance"];
    const double spread = bound == "cone_roughness" ? 1 : 1 / (8 * std::sqrt(pdf));
    const double cosine = 3 / distance;
    CHECK(v[1]["footprint"]["size"].get<double>() ==
          Approx((start + spread * distance) / std::sqrt(cosine)).epsilon(1e-2));
  }
}

TEST_CASE("a limit of the score leaves diffuse surfaces alone", "[app]") {
  const Folder folder;
  const auto deltas = [&](const std::string& of) {
    const std::string scene =
        folder.write("a.scene", room("safe { limit 0.001 of \"" + of + "\" }"));
    const Run r = runVestige({"inspect", scene, "31", "31", "--sample", "15", "--json"});
    INFO(r.err);
    REQUIRE(r.exit == 0);
    const auto d = nlohmann::json::parse(r.out)["vertices"][1]["differentials"];
    REQUIRE(d.size() == 4);
    return std::pair(d[2]["delta"].get<double>(), d[3]["delta"].get<double>());
  };
  const double bound = std::pow(16, -2. / 3);
  CHECK(deltas("score").first == Approx(bound).epsilon(1e-3));
  CHECK(deltas("score").second == Approx(bound).epsilon(1e-3));
  CHECK(std::min(deltas("contribution").first, deltas("contribution").second) < bound / 2);
}

TEST_CASE("inspect --svg draws the path and a panel a vertex", "[app]") {
  const Folder folder;
  const std::string scene = folder.write("a.scene", kPlane);
  const Run r = runVestige({"inspect", scene, "31", "40", "--svg", folder / "a.svg"});
  INFO(r.err);
  REQUIRE(r.exit == 0);
  std::ifstream in(folder / "a.svg");
  const std::string svg{std::istreambuf_iterator<char>(in), {}};
  CHECK_THAT(svg, containsText("camera") && containsText("plane lambert"));
  // A pixel of 4 / 64 = 0.0625 units, and delta 1.
  CHECK_THAT(svg, containsText("film x: 1 x 0.0625") && containsText("film y: 1 x 0.0625"));
  CHECK_THAT(svg, !containsText("nan") && !containsText("inf"));

  const std::string up = folder.write("up.scene", R"(
camera pinhole { location <0, 2, 0> look_at <0, 4, 0> sky z }
film { resolution <8, 8> }
integrator path { samples 1 }
light environment { radiance rgb 1 }
plane { y, 0 brdf lambert { } }
)");
  REQUIRE(runVestige({"inspect", up, "4", "4", "--svg", folder / "up.svg"}).exit == 0);
  std::ifstream nothing(folder / "up.svg");
  const std::string empty{std::istreambuf_iterator<char>(nothing), {}};
  CHECK_THAT(empty, containsText("meets no surface"));

  const Run nowhere = runVestige({"inspect", scene, "31", "40", "--svg", folder / "no/a.svg"});
  CHECK(nowhere.exit == 3);
  CHECK_THAT(nowhere.err, containsText("no/a.svg"));
}
