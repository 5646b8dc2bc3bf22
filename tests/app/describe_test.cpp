// SPDX-License-Identifier: Apache-2.0
// vestige describe, for people and for programs.
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/run.h"
#include "support/catch.h"

using nlohmann::json;

namespace {

std::string contents(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Columns of a row of a table: bars that nothing escapes, less one.
int columnsOf(const std::string& row) {
  int bars = 0;
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (row[i] == '\\')
      ++i;
    else
      bars += row[i] == '|';
  }
  return bars - 1;
}

}  // namespace

TEST_CASE("describe lists the kinds and their plugins", "[app]") {
  const Run r = runVestige({"describe"});
  CHECK(r.exit == 0);
  for (const char* word :
       {"brdf", "lambert", "camera", "pinhole", "light", "shape", "sphere", "film"})
    CHECK_THAT(r.out, containsText(word));
}

TEST_CASE("describe of a plugin shows its parameters in aligned columns", "[app]") {
  const Run r = runVestige({"describe", "brdf", "phong"});
  CHECK(r.exit == 0);
  CHECK_THAT(r.out, containsText("exponent") && containsText("colour or pigment"));
  CHECK(runVestige({"describe", "phong"}).out == r.out);
  std::size_t type = 0;
  std::istringstream lines(r.out);
  for (std::string line; std::getline(lines, line);) {
    if (line.find("parameter  ") != std::string::npos) type = line.find("type");
    if (line.rfind("  specular", 0) == 0) CHECK(line.find("colour") == type);
    if (line.rfind("  exponent", 0) == 0) CHECK(line.find("number") == type);
  }
  CHECK(type > 0);
}

TEST_CASE("describe keeps to the width of the terminal", "[app]") {
  for (const int width : {50, 80, 120}) {
    const Run r = runVestige({"describe", "camera", "thin_lens"},
                             {.variables = {{"COLUMNS", std::to_string(width)}}});
    std::istringstream lines(r.out);
    int longest = 0;
    for (std::string line; std::getline(lines, line);)
      longest = std::max(longest, int(line.size()));
    INFO(r.out);
    if (width >= 80) CHECK(longest <= width);
  }
}

TEST_CASE("describe of a misspelt word names the nearest", "[app]") {
  const Run kind = runVestige({"describe", "brfd"});
  CHECK(kind.exit == 2);
  CHECK_THAT(kind.err, containsText("did you mean 'brdf'?"));
  const Run name = runVestige({"describe", "brdf", "fong"});
  CHECK(name.exit == 2);
  CHECK_THAT(name.err, containsText("'fong'") && containsText("phong"));
}

TEST_CASE("describe --json holds all schemas", "[app]") {
  const json all = json::parse(runVestige({"describe", "--json"}).out);
  bool found = false;
  for (const json& schema : all) {
    CHECK(schema.at("kind").is_string());
    if (schema.at("kind") != "brdf" || schema.at("name") != "phong") continue;
    found = true;
    bool exponent = false;
    for (const json& p : schema.at("parameters"))
      if (p.at("name") == "exponent")
        exponent = p.at("type") == "real" && p.at("texturable") == true;
    CHECK(exponent);
  }
  CHECK(found);
  CHECK(json::parse(runVestige({"describe", "brdf", "phong", "--json"}).out).size() == 1);
}

TEST_CASE("docs/reference is what describe --markdown writes today", "[app]") {
  const Folder folder;
  // As docs/reference/make does: nobody's own plugins.
  const Run r = runVestige({"describe", "--markdown", folder / "pages"},
                           {.variables = {{"HOME", folder / "home"}, {"VESTIGE_PLUGIN_PATH", ""}}});
  INFO(r.err);
  REQUIRE(r.exit == 0);
  const std::filesystem::path kept = std::filesystem::path(VESTIGE_SOURCE_DIR) / "docs/reference";
  INFO("The schemas and docs/reference/ differ. Run: docs/reference/make " << VESTIGE_BINARY);
  for (const auto& page : std::filesystem::directory_iterator(folder / "pages")) {
    const std::string name = page.path().filename().string();
    INFO("docs/reference/" << name << " is out of date");
    CHECK(contents(page.path()) == contents(kept / name));
  }
  for (const auto& page : std::filesystem::directory_iterator(kept)) {
    const std::string name = page.path().filename().string();
    INFO("docs/reference/" << name << " belongs to no kind any more");
    CHECK((page.path().extension() != ".md" ||
           std::filesystem::exists(std::filesystem::path(folder / "pages") / name)));
  }
}

TEST_CASE("describe --markdown: a stranger's words do not break the page", "[app]") {
  const Folder folder;
  const Run r = runVestige(
      {"describe", "brdf", "--markdown", folder / "pages", "--plugin-path", VESTIGE_AWKWARD});
  INFO(r.err);
  REQUIRE(r.exit == 0);
  const std::string page = contents(folder / "pages/brdf.md");
  INFO(page);
  CHECK_THAT(page, containsText("## brdf phong\n"));
  CHECK_THAT(page, containsText("\n1\\. a \\| b, \\*c\\*, \\_d\\_, \\<b\\>e\\</b\\>, \\`f\\`, "
                                "\\[g\\](h), \\\\i, \\&amp; \\$j\\$ and \\# k\n"));
  CHECK_THAT(page, containsText("| `a_b` | number | W/(m^2 sr) \\| \\* |"));
  CHECK_THAT(page, containsText("`` \"d\\|e\" \\| \"f`g\" ``"));
  CHECK_THAT(page, containsText("must be given") && containsText("| \\- not a list |"));
  std::istringstream lines(page);
  for (std::string row; std::getline(lines, row);)
    if (row.rfind("| ", 0) == 0) CHECK(columnsOf(row) == 7);
  CHECK_THAT(contents(folder / "pages/README.md"), containsText("[awkward](brdf.md#brdf-awkward)"));
}

TEST_CASE("describe --markdown says what it could not write", "[app]") {
  const Folder folder;
  const std::string file = folder.write("pages", "a file");
  const Run r = runVestige({"describe", "--markdown", file});
  CHECK(r.exit == 3);
  CHECK_THAT(r.err, containsText(file));
}
