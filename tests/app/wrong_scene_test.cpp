// SPDX-License-Identifier: Apache-2.0
// Wrong input: a message at its place, exit code 1, never a crash.
#include <nlohmann/json.hpp>

#include "app/run.h"
#include "support/catch.h"

namespace {

/// A scene with a mistake, and what the message must hold.
struct Mistake {
  const char* text;  ///< added to the small scene
  std::vector<std::string> message;
};

Run check(const Folder& folder, const std::string& text) {
  return runVestige({"check", folder.write("a.scene", text)},
                    {.folder = folder.path(), .patience = 20});
}

/// A header without end, a face whose vertex does not exist, a file cut short, ...
void writeBrokenFiles(const Folder& folder) {
  folder.write("garbage.png", "this is no picture\n");
  folder.write("truncated.png", std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16));
  folder.write("garbage.obj", "v 0 0\nf 1 2 900\n");
  folder.write("garbage.gltf", "{ \"asset\": ");
  folder.write("garbage.glb", "glTF\2\0\0\0zzzz");
  folder.write("garbage.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty");
  folder.write("beyond.ply",
               "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
               "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
               "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 900000\n");
  folder.write("garbage.stl", "solid x\nfacet");
}

}  // namespace

TEST_CASE("a mistake in a scene is told at its place", "[app]") {
  const Folder folder;
  writeBrokenFiles(folder);
  const std::vector<Mistake> mistakes = {
      {"sphere { 0, 1 brdf phong { exponant 3 } }", {"exponant", "did you mean 'exponent'?"}},
      {"sphere { 0, 1 brdf phong { exponent \"three\" } }", {"exponent", "number"}},
      {"sphere { 0, 1 brdf fong { } }", {"fong", "phong"}},
      {"sphere { 0, -1 }", {"radius", "-1"}},
      {"sphere { 0, 0 }", {"radius"}},
      {"sphere { 0, 1 matrix <1,0,0, 0,0,0, 0,0,1, 0,0,0> }", {"flatten"}},
      {"#include \"nowhere.inc\"", {"nowhere.inc"}},
      {"sphere { 0, 1 brdf lambert { diffuse pigment image { \"nowhere.png\" } } }",
       {"nowhere.png"}},
      {"sphere { 0, 1 brdf lambert { diffuse pigment image { \"garbage.png\" } } }",
       {"garbage.png"}},
      {"sphere { 0, 1 brdf lambert { diffuse pigment image { \"truncated.png\" } } }",
       {"truncated.png"}},
      {"mesh { \"nowhere.obj\" }", {"nowhere.obj"}},
      {"mesh { \"garbage.obj\" }", {"garbage.obj"}},
      {"mesh { \"garbage.gltf\" }", {"garbage.gltf"}},
      {"mesh { \"garbage.glb\" }", {"garbage.glb"}},
      {"mesh { \"garbage.ply\" }", {"garbage.ply"}},
      {"mesh { \"beyond.ply\" }", {"beyond.ply"}},
      {"mesh { \"garbage.stl\" }", {"garbage.stl"}},
      {"plane { y, 0 emission rgb 1 }", {"plane"}},
      {"sphere { 0, 1", {"'}'"}},
  };
  for (const Mistake& m : mistakes) {
    const Run r = check(folder, smallScene(m.text));
    INFO(m.text << '\n' << r.err);
    CHECK(r.exit == 1);
    CHECK_THAT(r.err, containsText("a.scene:5:") && containsText("error: "));
    CHECK_THAT(r.err, containsText("^") && containsText("1 error"));
    for (const std::string& text : m.message) CHECK_THAT(r.err, containsText(text));
  }
}

TEST_CASE("the caret stands under the wrong word", "[app]") {
  const Folder folder;
  const Run r = check(folder, smallScene("sphere { 0, 1 brdf phong { exponant 3 } }"));
  const std::size_t word = r.err.find("exponant 3");
  REQUIRE(word != std::string::npos);
  const std::size_t line = r.err.rfind('\n', word) + 1;
  const std::size_t next = r.err.find('\n', word) + 1;
  CHECK(r.err.find('^', next) - next == word - line);
}

TEST_CASE("a scale of 0 is taken as 1 with a warning, as POV-Ray does", "[app]") {
  const Folder folder;
  const Run r = check(folder, smallScene("sphere { 0, 1 scale <1, 0, 1> }"));
  CHECK(r.exit == 0);
  CHECK_THAT(r.err, containsText("a.scene:5:") && containsText("warning: "));
  CHECK(runVestige({"check", folder / "a.scene", "--werror"}).exit == 1);
}

TEST_CASE("a camera that looks at itself is refused", "[app]") {
  const Folder folder;
  const Run r = check(folder, "camera pinhole { location <1, 2, 3> look_at <1, 2, 3> }\n");
  INFO(r.err);
  CHECK(r.exit == 1);
  CHECK_THAT(r.err, containsText("a.scene:1:") && containsText("look_at"));
}

TEST_CASE("an empty scene is black with a warning, one without camera an error", "[app]") {
  const Folder folder;
  const std::string empty = folder.write(
      "a.scene", "camera pinhole { location <0, 0, -1> look_at 0 }\nfilm { resolution <4, 4> }");
  const Run r = runVestige({empty, "-o", folder / "a.png", "--spp", "1"});
  INFO(r.err);
  CHECK(r.exit == 0);
  CHECK_THAT(r.err, containsText("warning") && containsText("black") && containsText("1 warning"));
  CHECK(looksLikePicture(folder / "a.png"));
  CHECK(runVestige({empty, "-o", folder / "b.png", "--spp", "1", "--werror"}).exit == 1);
  CHECK_FALSE(std::filesystem::exists(folder / "b.png"));
  const Run blind = check(folder, "");
  CHECK(blind.exit == 1);
  CHECK_THAT(blind.err, containsText("no camera"));
}

TEST_CASE("several mistakes come in one run and render refuses them too", "[app]") {
  const Folder folder;
  const std::string scene = folder.write(
      "a.scene", smallScene("sphere { 0, 1 brdf phong { exponant 3 } }\nsphere { 0, \"x\" }"));
  const Run r = runVestige({"render", scene, "-o", folder / "a.png"});
  CHECK(r.exit == 1);
  CHECK_THAT(r.err, containsText("a.scene:5:") && containsText("a.scene:6:"));
  CHECK_THAT(r.err, containsText("2 errors"));
  CHECK_FALSE(std::filesystem::exists(folder / "a.png"));
}

TEST_CASE("check --json gives places to editors", "[app]") {
  const Folder folder;
  const std::string scene =
      folder.write("a.scene", smallScene("sphere { 0, 1 brdf phong { exponant 3 } }"));
  const Run r = runVestige({"check", scene, "--json"});
  CHECK(r.exit == 1);
  const auto report = nlohmann::json::parse(r.out);
  CHECK(report.at("errors") == 1);
  const auto& d = report.at("diagnostics").at(0);
  CHECK(d.at("severity") == "error");
  CHECK(d.at("line") == 5);
  CHECK(d.at("column") == 28);
  CHECK(d.at("end_column") == 36);
  REQUIRE(d.at("edits").size() == 1);
  CHECK(d.at("edits").at(0).at("text") == "exponent");
  CHECK(d.at("edits").at(0).at("utf16_column") == 28);
  CHECK(d.at("edits").at(0).at("end_utf16_column") == 36);
  CHECK_THAT(d.at("file").get<std::string>(), containsText("a.scene"));
}

TEST_CASE("check --json counts columns in characters and in UTF-16 code units", "[app]") {
  const Folder folder;
  // U+1F600: one character, two code units, four bytes.
  const std::string scene = folder.write("a.scene", "/* \xF0\x9F\x98\x80 */ spere { 0, 1 }\n");
  const Run r = runVestige({"check", "--syntax", scene, "--json"});
  const auto d = nlohmann::json::parse(r.out).at("diagnostics").at(0);
  CHECK(d.at("column") == 9);
  CHECK(d.at("utf16_column") == 10);
  CHECK(d.at("end_column") == 14);
  CHECK(d.at("end_utf16_column") == 15);
}

TEST_CASE("a scene without mistakes passes; --syntax opens no file", "[app]") {
  const Folder folder;
  const Run fine = check(folder, smallScene());
  INFO(fine.err);
  CHECK(fine.exit == 0);
  CHECK(fine.err == "");
  const std::string scene = folder.write("b.scene", smallScene("mesh { \"nowhere.obj\" }"));
  CHECK(runVestige({"check", scene}).exit == 1);
  CHECK(runVestige({"check", scene, "--syntax"}).exit == 0);
}

TEST_CASE("limits end hostile scenes, and name their flag", "[app]") {
  const Folder folder;
  const std::string scene = folder.write(
      "a.scene", smallScene("#declare I = 0; #while (I < 200000) #declare I = I + 1; #end"));
  const Run r = runVestige({"check", scene, "--max-loop-iterations", "1000"});
  INFO(r.err);
  CHECK(r.exit == 1);
  CHECK_THAT(r.err, containsText("--max-loop-iterations"));
  CHECK(runVestige({"check", scene}).exit == 0);
}
