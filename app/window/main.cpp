// SPDX-License-Identifier: Apache-2.0
// vestige view: a program of its own, so that the others need no display and no OpenGL.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <csignal>

#include "app/crash.h"
#include "app/options.h"
#include "app/terminal.h"
#include "app/window/request.h"

namespace vestige::app {
namespace {

int run(int argc, char** argv) {
  CLI::App program(
      "Shows a scene while it is written: the picture gets better as you look and follows every "
      "save of the text. Or shows a picture file. H in the window lists keys.",
      "vestige view");
  ViewRequest r;
  addSceneOptions(program, r.input);
  const auto size = [&](const char* name, int& into, const char* help) {
    addInteger(
        program, name, 1, 16384, [&into](auto n) { into = int(n); }, help);
  };
  size("--width", r.input.width, "pixels of the picture (the scene's)");
  size("--height", r.input.height, "likewise");
  size("--window-width", r.windowWidth, "of the window (1280)");
  size("--window-height", r.windowHeight, "likewise (800)");
  addInteger(
      program, "--spp", 1, kMostSamples, [&](auto n) { r.render.samples = int(n); },
      "samples a pixel (the scene's)");
  addInteger(
      program, "--threads", 1, 1024, [&](auto n) { r.render.threads = int(n); },
      "(as many as there are)");
  addInteger(
      program, "--seed", 0, 1 << 30, [&](auto n) { r.render.seed = std::uint32_t(n); },
      "of all random numbers (0)");
  addNumber(
      program, "--exposure", -100, 100, [&](double x) { r.display.exposure = x; }, "stops (0)");
  program.add_option("--view", r.display.view, "of the colour config (its default)");
  program.add_option("--compare", r.reference, "a picture to compare with")->type_name("FILE");
  program.add_flag("--events", r.tells, "a line on stdout for whatever happens, for scripts");
  addBuildOptions(program, r.build, "Options");
  addLimits(program, r.input.limits);
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return program.exit(help);
  } catch (const CLI::ParseError& error) {
    throw Failure(kCommandLineWrong,
                  fmt::format("vestige view: {}; see vestige view --help", error.what()));
  }
  r.isPicture = isPictureFile(r.input.file);
  if (!r.isPicture) {
    checkSceneFile(r.input.file);
    checkBuildOptions(r.build, loadRegistry(r.input.pluginPaths));
  }
  std::signal(SIGCHLD, SIG_IGN);  // nobody waits for the editor
  return runWindow(r);
}

}  // namespace
}  // namespace vestige::app

int main(int argc, char** argv) {
  using namespace vestige::app;
  tellOfCrashes();
  try {
    return run(argc, argv);
  } catch (const Failure& failure) {
    complain(failure.what());
    return failure.code();
  } catch (const std::exception& failure) {
    complain(failure.what());
  }
  return kMachineFailed;
}
