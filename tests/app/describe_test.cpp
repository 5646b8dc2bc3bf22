// SPDX-License-Identifier: Apache-2.0
// vestige describe, for people and for programs.
#include <nlohmann/json.hpp>

#include "app/run.h"
#include "support/catch.h"

using nlohmann::json;

TEST_CASE("describe lists the kinds and their plugins", "[app]") {
  const Run r = vestige({"describe"});
  CHECK(r.exit == 0);
  for (const char* word :
       {"brdf", "lambert", "camera", "pinhole", "light", "shape", "sphere", "film"})
    CHECK_THAT(r.out, containsText(word));
}

TEST_CASE("describe of a plugin shows its parameters in aligned columns", "[app]") {
  const Run r = vestige({"describe", "brdf", "phong"});
  CHECK(r.exit == 0);
  CHECK_THAT(r.out, containsText("exponent") && containsText("colour or pigment"));
  CHECK(vestige({"describe", "phong"}).out == r.out);
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
    const Run r = vestige({"describe", "camera", "thin_lens"},
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
  const Run kind = vestige({"describe", "brfd"});
  CHECK(kind.exit == 2);
  CHECK_THAT(kind.err, containsText("did you mean 'brdf'?"));
  const Run name = vestige({"describe", "brdf", "fong"});
  CHECK(name.exit == 2);
  CHECK_THAT(name.err, containsText("'fong'") && containsText("phong"));
}

TEST_CASE("describe --json holds all schemas", "[app]") {
  const json all = json::parse(vestige({"describe", "--json"}).out);
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
  CHECK(json::parse(vestige({"describe", "brdf", "phong", "--json"}).out).size() == 1);
}
