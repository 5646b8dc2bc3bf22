// SPDX-License-Identifier: Apache-2.0
// What the program says about itself, and about a command line that it does not understand.
#include "app/run.h"
#include "support/catch.h"

TEST_CASE("help teaches: examples, commands, exit codes", "[app]") {
  for (const char* word : {"--help", "-h", "help"}) {
    const Run r = runVestige({word});
    CHECK(r.exit == 0);
    CHECK(r.err == "");
    for (const char* text : {"hello.scene", "render", "check", "describe", "compare", "130"})
      CHECK_THAT(r.out, containsText(text));
  }
}

TEST_CASE("each command has its help", "[app]") {
  for (const char* command : {"render", "check", "describe", "compare"}) {
    const Run r = runVestige({command, "--help"});
    CHECK(r.exit == 0);
    CHECK_THAT(r.out, containsText(command));
    CHECK(runVestige({"help", command}).out == r.out);
  }
  CHECK_THAT(runVestige({"render", "--help"}).out, containsText("--spp") && containsText("--crop"));
}

TEST_CASE("no argument at all shows the help and fails", "[app]") {
  const Run r = runVestige({});
  CHECK(r.exit == 2);
  CHECK(r.out == "");
  CHECK_THAT(r.err, containsText("vestige COMMAND --help"));
}

TEST_CASE("the version names every library", "[app]") {
  const Run r = runVestige({"--version"});
  CHECK(r.exit == 0);
  for (const char* text : {"vestige 0.", "Embree ", "OpenImageIO", "OpenColorIO", "fmt ", "CLI11 ",
                           "Real", "SDK 7.", "lib/vestige/plugins"})
    CHECK_THAT(r.out, containsText(text));
}

TEST_CASE("a misspelt command is named, and the nearest", "[app]") {
  const Run r = runVestige({"rendr", "x.scene"});
  CHECK(r.exit == 2);
  CHECK_THAT(r.err, containsText("'rendr'") && containsText("did you mean 'render'?"));
}

TEST_CASE("a misspelt option is named, and the nearest", "[app]") {
  for (const auto& words : {std::vector<std::string>{"render", "x.scene", "--sppp", "4"},
                            std::vector<std::string>{"render", "--sppp=4", "x.scene"}}) {
    const Run r = runVestige(words);
    CHECK(r.exit == 2);
    CHECK_THAT(r.err, containsText("'--sppp'") && containsText("did you mean '--spp'?"));
  }
}

TEST_CASE("option values out of place are refused before anything is read", "[app]") {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"--spp", "many"}, "--spp wants a whole number from 1"},
      {{"--spp", "0"}, "found '0'"},
      {{"--spp", "99999999999999999999"}, "--spp wants"},
      {{"--threads", "-1"}, "--threads wants"},
      {{"--seed", "4294967296"}, "--seed wants"},
      {{"--time", "soon"}, "--time wants a time as 30s"},
      {{"--time", "0s"}, "--time wants"},
      {{"--time", "5x"}, "found '5x'"},
      {{"--noise", "0"}, "--noise wants a number from 0.0001 to 1, found '0'"},
      {{"--noise", "-0.02"}, "found '-0.02'"},
      {{"--noise", "nan"}, "found 'nan'"},
      {{"--noise", "2%"}, "found '2%'"},
      {{"--noise", "low"}, "--noise wants"},
      {{"--crop", "0,0,1"}, "--crop wants x0,y0,x1,y1"},
      {{"--crop", "0.5,0,0.5,1"}, "--crop wants"},
      {{"--crop", "0,0,1,2"}, "--crop wants"},
      {{"--exposure", "nan"}, "--exposure wants"},
      {{"--aov", "normals"}, "did you mean 'normal'?"},
      {{"--progress", "loud"}, "--progress"},
      {{"--width", "0"}, "--width wants"},
      {{"-D", "1=2"}, "-D wants NAME=VALUE"},
      {{"-D", "a="}, "-D wants NAME=VALUE"},
      {{"--integrator", "pat"}, "did you mean 'path'?"},
      {{"--plugin-path", "no/such/folder"}, "there is no folder 'no/such/folder'"},
  };
  const Folder folder;
  const std::string scene = folder.write("a.scene", smallScene());
  for (const auto& [words, message] : cases) {
    std::vector<std::string> line = {"render", scene, "-o", folder / "a.png"};
    line.insert(line.end(), words.begin(), words.end());
    const Run r = runVestige(line);
    INFO(words[0] << ' ' << words[1] << '\n' << r.err);
    CHECK(r.exit == 2);
    CHECK_THAT(r.err, containsText(message));
  }
  CHECK(folder.names().size() == 1);
}

TEST_CASE("a scene file that is not there is named, and the nearest", "[app]") {
  const Folder folder;
  folder.write("cornell.scene", smallScene());
  const Run r = runVestige({"render", "cornel.scene"}, {.folder = folder.path()});
  CHECK(r.exit == 2);
  CHECK_THAT(r.err, containsText("there is no scene file 'cornel.scene'") &&
                        containsText("did you mean 'cornell.scene'?"));
  CHECK(runVestige({"render"}).exit == 2);
  CHECK(runVestige({"render", folder.path().string()}).exit == 2);
}

TEST_CASE("without plugins it says where it looked", "[app]") {
  const Folder folder;
  std::filesystem::create_directory(folder.path() / "bin");
  std::filesystem::copy_file(VESTIGE_BINARY, folder.path() / "bin/vestige");
  const std::string scene = folder.write("a.scene", smallScene());
  const Run r = runVestige({"check", scene}, {.program = folder / "bin/vestige"});
  CHECK(r.exit == 3);
  CHECK_THAT(r.err,
             containsText("found no plugin") && containsText(folder / "lib/vestige/plugins"));
}

TEST_CASE("a broken library that the scene does not name goes unmentioned", "[app]") {
  const Folder folder;
  folder.write("brdf_stranger.so", "not a library");
  const std::string scene = folder.write("a.scene", smallScene());
  const Run r = runVestige({"check", scene, "--plugin-path", folder.path().string()});
  CHECK(r.exit == 0);
  CHECK(r.err.empty());
  const Run all = runVestige({"describe", "--plugin-path", folder.path().string()});
  CHECK(all.exit == 0);
  CHECK_THAT(all.err, containsText("warning") && containsText("brdf_stranger.so"));
}

TEST_CASE("a library whose name promises nothing is refused with a reason and the render goes on",
          "[app]") {
  const Folder folder;
  folder.write("stranger.so", "not a library");
  const std::string scene = folder.write("a.scene", smallScene());
  const Run r = runVestige({"check", scene, "--plugin-path", folder.path().string()});
  CHECK(r.exit == 0);
  CHECK_THAT(r.err, containsText("warning") && containsText("stranger.so"));
}

TEST_CASE("a scene that names a broken library is told why", "[app]") {
  const Folder folder;
  for (const char* name : {"brdf_moth.so", "shape_hole.so", "integrator_stranger.so"})
    folder.write(name, "not a library");
  const auto inspect = [&](const std::string& more, const std::vector<std::string>& options = {}) {
    std::vector<std::string> words = {"inspect", folder.write("a.scene", smallScene(more))};
    words.insert(words.end(), {"0", "0", "--plugin-path", folder.path().string()});
    words.insert(words.end(), options.begin(), options.end());
    return runVestige(words);
  };
  /// Once, and of no other library.
  const auto isTold = [&](const std::string& text, const std::string& file) {
    const std::size_t first = text.find("was not loaded");
    return text.find((folder / file) + "' was not loaded") != text.npos &&
           text.find("was not loaded", first + 1) == text.npos;
  };
  const Run brdf = inspect("sphere { <0, 1, 0>, 1 brdf moth { } }");
  INFO(brdf.err);
  CHECK(brdf.exit == 1);
  CHECK_THAT(brdf.err, containsText("no brdf is called 'moth'"));
  CHECK(isTold(brdf.err, "brdf_moth.so"));
  const Run shape = inspect("hole { <0, 1, 0>, 1 }");
  INFO(shape.err);
  CHECK(shape.exit == 1);
  CHECK(isTold(shape.err, "shape_hole.so"));
  const Run integrator = inspect("", {"--integrator", "stranger"});
  INFO(integrator.err);
  CHECK(integrator.exit == 2);
  CHECK(isTold(integrator.err, "integrator_stranger.so"));
}

TEST_CASE("a broken library does not displace a sound one, and is told", "[app]") {
  const Folder folder;
  folder.write("brdf_lambert.so", "not a library");
  const std::string scene = folder.write("a.scene", smallScene());
  const Run r = runVestige({"check", scene, "--plugin-path", folder.path().string()});
  CHECK(r.exit == 0);
  CHECK_THAT(r.err, containsText("warning") && containsText(folder / "brdf_lambert.so"));
}
