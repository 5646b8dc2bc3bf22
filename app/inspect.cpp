// SPDX-License-Identifier: Apache-2.0
// vestige inspect: one path of one pixel, vertex by vertex.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <fstream>
#include <iostream>

#include "app/options.h"
#include "app/path_drawing.h"
#include "app/path_text.h"
#include "engine/render/session.h"

namespace vestige::app {
namespace {

struct InspectRequest {
  SceneInput input;
  BuildOptions build;
  RenderOptions render;
  int x = 0, y = 0;
  std::uint32_t sample = 0;
  bool json = false;
  std::string svg;  ///< file for a drawing; "": none
};

constexpr const char* kLegend = R"(
V vertex, D direction that arrives there. |dV|, |dD|: how far they move per unit of a random number
of the path; g: relative change of its contribution; delta: the share of that number's interval that
this one path stands for. Footprint: ellipse of all delta dV together, dA and dB its full axes.
)";

void writeDrawing(const std::string& file, const RecordedPath& path, const LoadedScene& loaded) {
  std::ofstream out(file, std::ios::binary);
  out << pathSvg(path, loaded);
  if (!out.flush()) throw Failure(kMachineFailed, fmt::format("cannot write '{}'", file));
}

int runInspect(const InspectRequest& r) {
  const Registry registry = loadRegistry(r.input.pluginPaths);
  checkBuildOptions(r.build, registry);
  const LoadedScene loaded = loadScene(r.input, registry, Stage::built, r.build);
  printDiagnostics(loaded.text);
  if (!loaded.scene) return kSceneWrong;
  const FilmShape film = filmShape(*loaded.scene, r.input.width, r.input.height, nullptr);
  if (r.x >= film.width || r.y >= film.height)
    throw Failure(kCommandLineWrong,
                  fmt::format("pixel {} {} lies outside of the picture, which is {} x {}", r.x, r.y,
                              film.width, film.height));
  RecordedPath path;
  const Rgb radiance = inspectSample(*loaded.scene, film, r.x, r.y, r.sample, r.render, path);
  if (!r.svg.empty()) writeDrawing(r.svg, path, loaded);
  if (r.json) {
    std::cout << pathJson(path, loaded, radiance) << std::endl;
    return kFine;
  }
  std::cout << fmt::format("pixel {} {} of {} x {}, sample {}: radiance <{:.4g}, {:.4g}, {:.4g}>\n",
                           r.x, r.y, film.width, film.height, r.sample, radiance.r, radiance.g,
                           radiance.b);
  if (path.vertices.empty())
    std::cout << fmt::format("integrator {} tells nothing about its paths\n",
                             loaded.scene->integratorName());
  std::cout << pathText(path, loaded) << kLegend << std::flush;
  return kFine;
}

}  // namespace

void addInspect(CLI::App& program, Action& chosen) {
  CLI::App* command = program.add_subcommand(
      "inspect", "Trace one path and tell, vertex by vertex, how large its footprint is and why");
  const auto r = std::make_shared<InspectRequest>();
  addSceneOptions(*command, r->input);
  const auto pixel = [&](const char* name, int& into, const char* help) {
    addInteger(
        *command, name, 0, 65535, [&into](auto n) { into = int(n); }, help)
        ->required();
  };
  pixel("x", r->x, "column of the pixel, from the left");
  pixel("y", r->y, "row of the pixel, from the top");
  const auto number = [&](const char* name, std::int64_t low, auto& into, const char* help) {
    addInteger(
        *command, name, low, 1 << 30, [&into](auto n) { into = std::decay_t<decltype(into)>(n); },
        help);
  };
  number("--sample", 0, r->sample, "which sample of the pixel (0)");
  number("--spp", 1, r->render.samples, "samples a pixel, for the bounds that go by them");
  number("--seed", 0, r->render.seed, "as in render (0)");
  number("--width", 1, r->input.width, "pixels");
  number("--height", 1, r->input.height, "pixels");
  command->add_flag("--json", r->json, "for programs");
  command->add_option("--svg", r->svg, "draw the path and its footprints into FILE")
      ->type_name("FILE");
  addBuildOptions(*command, r->build, "Options");
  addLimits(*command, r->input.limits);
  command->callback([r, &chosen] { chosen = [r] { return runInspect(*r); }; });
}

}  // namespace vestige::app
