// SPDX-License-Identifier: Apache-2.0
#include "app/render_request.h"

#include <fmt/format.h>

#include <algorithm>
#include <CLI/CLI.hpp>

#include "app/options.h"

namespace vestige::app {
namespace {

constexpr int kMaxSide = 65536;       // pixels
constexpr double kLeastNoise = 1e-4;  // already more than a million samples for most pixels

[[noreturn]] void refuseAov(const std::string& word, std::vector<std::string> known) {
  known.insert(known.begin(), "all");
  const std::string near = nearestWord(word, known);
  throw Failure(kCommandLineWrong,
                fmt::format("--aov knows no '{}'; {}", word,
                            near.empty() ? fmt::format("with this integrator it knows {}",
                                                       fmt::join(known, ", "))
                                         : fmt::format("did you mean '{}'?", near)));
}

void addQuality(CLI::App& command, RenderRequest& r) {
  const char* group = "Quality";
  addInteger(
      command, "--spp", 1, 1 << 30, [&](auto n) { r.render.samples = int(n); },
      "samples a pixel (what the scene says, or 16)")
      ->group(group);
  const auto time = [&](const std::string& text) {
    const auto seconds = parseDuration(text);
    if (!seconds)
      throw Failure(kCommandLineWrong,
                    fmt::format("--time wants a time as 30s, 2m or 1h30m, found '{}'", text));
    r.render.seconds = *seconds;
  };
  command.add_option_function<std::string>("--time", time, "stop after this time: 30s, 2m, 1h30m")
      ->take_last()
      ->type_name("TIME")
      ->group(group);
  addNumber(
      command, "--noise", kLeastNoise, 1, [&](double x) { r.render.noise = x; },
      "stop where the noise is below this share of the brightness: 0.1 a sketch, 0.02 good; half "
      "the number takes four times as long. Pixels then take as many samples as they need, at most "
      "65536 whatever the scene says; with --spp at most that many, with --time as many as fit")
      ->group(group);
  command
      .add_flag(
          "--adaptive", r.render.adaptive,
          "samples lie where they take away most noise: --spp, or what the scene says, is their "
          "mean over the picture")
      ->group(group);
  addInteger(
      command, "--seed", 0, 0xffffffff, [&](auto n) { r.render.seed = std::uint32_t(n); },
      "another noise, the same picture (0)")
      ->group(group);
  addInteger(
      command, "--threads", 0, 4096, [&](auto n) { r.render.threads = int(n); },
      "threads; the picture is the same for any number (0: all)")
      ->group(group);
  addBuildOptions(command, r.build, group);
  // A solution of integrator particle. Several files become one list.
  const auto save = [&](const std::string& file) {
    r.build.settings.emplace_back("save_solution", textValue(file));
  };
  command
      .add_option_function<std::string>("--save-solution", save,
                                        "keep the light on the surfaces (integrator particle)")
      ->take_last()
      ->type_name("FILE")
      ->group(group);
  const auto load = [&](const std::vector<std::string>& files) {
    for (const std::string& file : files)
      if (file.empty() || file.find(',') != std::string::npos)
        throw Failure(kCommandLineWrong, "--load-solution wants a file whose name has no comma");
    r.build.settings.emplace_back("load_solution",
                                  textValue(fmt::format("{}", fmt::join(files, ","))));
  };
  command
      .add_option_function<std::vector<std::string>>(
          "--load-solution", load,
          "see a solution again, from any camera, without particles; parts add up")
      ->allow_extra_args(false)
      ->type_name("FILE")
      ->group(group);
}

void addPicture(CLI::App& command, RenderRequest& r) {
  const char* group = "Picture";
  addList(command, "-o,--output", r.output.files,
          "where the picture goes: .exr .hdr .tif .png .jpg; may be given several times "
          "(the scene's name with .png)")
      ->type_name("FILE")
      ->group(group);
  addInteger(
      command, "--width", 1, kMaxSide, [&](auto n) { r.input.width = int(n); }, "pixels")
      ->group(group);
  addInteger(
      command, "--height", 1, kMaxSide, [&](auto n) { r.input.height = int(n); }, "pixels")
      ->group(group);
  const auto crop = [&](const std::string& text) {
    if (!parseCrop(text, r.crop))
      throw Failure(kCommandLineWrong,
                    fmt::format("--crop wants x0,y0,x1,y1 as shares from 0 to 1 with x0 < x1 and "
                                "y0 < y1, as in 0.25,0,0.75,0.5; found '{}'",
                                text));
    r.cropGiven = true;
  };
  command.add_option_function<std::string>("--crop", crop, "only this part, as shares of the film")
      ->take_last()
      ->type_name("X0,Y0,X1,Y1")
      ->group(group);
  const auto aov = [&](const std::string& text) { r.aovs = CLI::detail::split(text, ','); };
  command
      .add_option_function<std::string>(
          "--aov", aov,
          fmt::format("further channels: {}, those of the integrator, or all",
                      fmt::join(aovNames(), ",")))
      ->take_last()
      ->type_name("LIST")
      ->group(group);
  addNumber(
      command, "--exposure", -100, 100, [&](double x) { r.output.write.display.exposure = x; },
      "stops, for PNG and JPEG (0)")
      ->group(group);
  const auto view = [&](const std::string& v) {
    r.output.write.display.view = v, r.output.viewGiven = true;
  };
  command.add_option_function<std::string>("--view", view, "view of the OpenColorIO configuration")
      ->take_last()
      ->type_name("NAME")
      ->group(group);
  command.add_flag("--half", r.output.write.halfFloat, "16 bits a channel in EXR")->group(group);
}

void addCheckpoint(CLI::App& command, RenderRequest& r) {
  const char* group = "Interruptions";
  command
      .add_option(
          "--checkpoint", r.checkpoint,
          "keep the render in this file every five minutes, at the end and after Ctrl-C. If "
          "the file is there, go on from it: the same command continues, with a larger "
          "--spp it adds samples, and the picture is that of a render in one go")
      ->take_last()
      ->type_name("FILE")
      ->group(group);
  const auto every = [&](const std::string& text) {
    const auto seconds = parseDuration(text);
    if (!seconds)
      throw Failure(
          kCommandLineWrong,
          fmt::format("--checkpoint-every wants a time as 30s, 2m or 1h30m, found '{}'", text));
    r.checkpointEvery = *seconds;
  };
  command
      .add_option_function<std::string>("--checkpoint-every", every,
                                        "how often it is written: 30s, 2m, 1h (5m)")
      ->take_last()
      ->type_name("TIME")
      ->group(group);
}

void addReports(CLI::App& command, RenderRequest& r) {
  const char* group = "Reports";
  command.add_option("--progress", r.progress, "auto, bar, plain, json (on stdout) or none (auto)")
      ->take_last()
      ->check(CLI::IsMember({"auto", "bar", "plain", "json", "none"}))
      ->type_name("STYLE")
      ->group(group);
  command.add_option("--stats", r.statsFile, "statistics as JSON; - is stdout")
      ->take_last()
      ->type_name("FILE")
      ->group(group);
  command.add_flag("--result-line", r.resultLine, "a line RESULT {...} with the times on stdout")
      ->group(group);
}

}  // namespace

std::vector<std::string> namedAovs(const std::vector<std::string>& words,
                                   std::span<const AovSlot> own) {
  const std::vector<std::string> names = aovNames(own);
  std::vector<std::string> wanted;
  const auto add = [&](const std::string& name) {
    if (std::find(wanted.begin(), wanted.end(), name) == wanted.end()) wanted.push_back(name);
  };
  for (const std::string& word : words) {
    if (word == "all") {
      for (const std::string& name : names) add(name);
      continue;
    }
    if (std::find(names.begin(), names.end(), word) == names.end()) refuseAov(word, names);
    add(word);
  }
  return wanted;
}

void addRenderOptions(CLI::App& command, RenderRequest& request) {
  addSceneOptions(command, request.input);
  addPicture(command, request);
  addQuality(command, request);
  addCheckpoint(command, request);
  addReports(command, request);
  addLimits(command, request.input.limits);
}

}  // namespace vestige::app
