// SPDX-License-Identifier: Apache-2.0
// vestige render: from a scene's text to picture files.
#include <fmt/format.h>

#include <algorithm>
#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>
#include <set>

#include "app/checkpoint.h"
#include "app/command.h"
#include "app/interrupt.h"
#include "app/progress.h"
#include "app/render_request.h"
#include "app/statistics.h"
#include "app/terminal.h"

namespace vestige::app {
namespace {

/// What can be known to fail before any work is done.
void checkRequest(const RenderRequest& r, const Registry& registry) {
  checkBuildOptions(r.build, registry);
  checkOutputs(r.output, !r.aovs.empty());
  if (!r.statsFile.empty() && r.statsFile != "-") checkWritable(r.statsFile);
  if (r.render.adaptive && r.render.noise > 0)
    throw Failure(kCommandLineWrong,
                  "--adaptive does not go with --noise, which gives pixels what they need anyway");
  if (r.checkpoint.empty()) return;
  if (r.render.adaptive || r.render.noise > 0)
    throw Failure(
        kCommandLineWrong,
        fmt::format("--checkpoint does not go with {}: which pixels are quiet is not kept",
                    r.render.adaptive ? "--adaptive" : "--noise"));
  std::vector<std::string> written = r.output.files;
  written.push_back(r.statsFile);
  for (const auto& [name, value] : r.build.settings)
    if (name == "save_solution") written.push_back(value.text);
  std::error_code ignored;
  const auto whole = [&](const std::string& f) {
    return std::filesystem::weakly_canonical(f, ignored);
  };
  for (const std::string& file : written)
    if (!file.empty() && whole(file) == whole(r.checkpoint))
      throw Failure(kCommandLineWrong,
                    fmt::format("'{}' cannot be the checkpoint and something else", file));
  checkWritable(r.checkpoint);
}

/// What can only be known once the scene is.
void checkIntegrator(const RenderRequest& r, const Scene& scene) {
  const auto isLoaded = [](const auto& setting) { return setting.first == "load_solution"; };
  if (r.render.seconds <= 0 || scene.integratorName() != "particle" ||
      std::any_of(r.build.settings.begin(), r.build.settings.end(), isLoaded))
    return;
  throw Failure(kCommandLineWrong,
                "--checkpoint does not go with --time here: integrator particle sends as many "
                "particles as fit into the time, in each run others. Keep their light with "
                "--save-solution first, and continue with --load-solution");
}

RenderResult renderFilm(const RenderRequest& r, Scene& scene, Film& film,
                        std::optional<CheckpointFile>& checkpoint) {
  ProgressReport report(progressStyle(r.progress));
  RenderOptions options = r.render;
  options.cancel = &catchInterrupts();
  options.progress = [&](const Progress& p) { report.show(p); };
  options.warn = [&](const std::string& sentence) { report.clear(), warn(sentence); };
  if (checkpoint) options.pauseEvery = r.checkpointEvery;
  options.paused = [&](const RenderResult& soFar) {
    checkpoint->save(film, scene, soFar, options.warn);
  };
  try {
    return render(scene, film, options);
  } catch (const std::runtime_error& e) {  // the integrator cannot prepare
    report.clear();
    throw Failure(kMachineFailed, e.what());
  }
}

void warnAboutCounters(const Counters& c) {
  if (c.nonFinite > 0)
    warn(fmt::format("{} had no finite value and {} left out as black; please report the scene",
                     count((long long)c.nonFinite, "sample"), c.nonFinite == 1 ? "was" : "were"));
  if (c.clamped > 0)
    warn(fmt::format("{} brighter than {:.3g} and {} cut down to it",
                     count((long long)c.clamped, "sample") + (c.clamped == 1 ? " was" : " were"),
                     kRadianceLimit, c.clamped == 1 ? "was" : "were"));
  if (c.clampedIndirect > 0)
    warn(
        fmt::format("the scene's clamp cut {} of indirect light down: the picture is a little too "
                    "dark",
                    count((long long)c.clampedIndirect, "contribution")));
}

void warnAboutAovs(const Film& film) {
  for (int i = 0; i < film.layers().size(); ++i)
    if (const std::uint64_t cut = film.cuts()[i]; cut > 0)
      warn(fmt::format("{} of AOV '{}' {} not finite or beyond {:.3g} and {} cut",
                       count((long long)cut, "sample"), film.layers()[i].name,
                       cut == 1 ? "was" : "were", film.layers()[i].limit(),
                       cut == 1 ? "was" : "were"));
}

void warnAboutTextures(const TextureUse& t) {
  if (t.readErrors > 0)
    warn(
        fmt::format("{} of '{}' could not be read while rendering, and the picture shows mean "
                    "colours there; the file is made anew the next time",
                    count((long long)t.readErrors, "piece"), t.unreadable));
}

/// "64 samples a pixel", "16 to 512 samples a pixel, 80 on average, 97 % of the pixels quiet".
std::string samplesText(const Statistics& s) {
  const RenderResult& r = s.render;
  if (!s.isAdaptive) return count(r.samples, "sample") + " a pixel";
  const std::string text = fmt::format("{} to {} a pixel, {:.0f} on average", r.samples,
                                       count(r.mostSamples, "sample"), r.meanSamples);
  if (s.noise <= 0) return text;
  return text + fmt::format(", {:.0f} % of the pixels quiet", std::floor(100 * r.quiet));
}

void reportWritten(const RenderRequest& r, const Statistics& s,
                   const std::vector<std::string>& files, bool isKept) {
  const ProgressStyle style = progressStyle(r.progress);
  if (style == ProgressStyle::json) std::cout << doneLine(s, files) << std::endl;
  if (style != ProgressStyle::bar && style != ProgressStyle::plain) return;
  const std::string why =
      s.render.end == RenderEnd::finished ? "" : fmt::format(", {}", endText(s.render.end));
  for (const std::string& file : files)
    say(fmt::format("wrote {} ({} x {}, {}, {}{})", file, s.width, s.height, samplesText(s),
                    durationText(s.render.seconds), why));
  if (!r.checkpoint.empty() && s.render.end != RenderEnd::finished && isKept)
    say(fmt::format("kept in {}: the same command goes on", r.checkpoint));
}

/// False if the file could not be written.
bool writeStatistics(const RenderRequest& r, const Statistics& s) {
  if (r.resultLine) std::cout << resultLine(s) << std::endl;
  if (r.statsFile.empty()) return true;
  if (r.statsFile == "-") {
    std::cout << statisticsJson(s) << std::endl;
    return true;
  }
  std::ofstream file(r.statsFile);
  file << statisticsJson(s) << std::endl;
  if (file) return true;
  complain(fmt::format("the statistics could not be written to '{}'", r.statsFile));
  return false;
}

Statistics statisticsOf(const RenderRequest& r, const LoadedScene& loaded, const Film& film,
                        const RenderResult& result, double importSeconds) {
  const Crop crop = film.crop();
  Statistics s;
  s.importSeconds = importSeconds;
  s.loadSeconds = loaded.loadSeconds, s.buildSeconds = loaded.buildSeconds;
  s.render = result, s.seed = r.render.seed, s.noise = r.render.noise;
  s.isAdaptive = r.render.adaptive || s.noise > 0;
  for (const std::uint64_t cut : film.cuts()) s.cutAovs += cut;
  s.textures = loaded.scene->textureUse(), s.triangles = loaded.scene->triangles();
  s.width = crop.x1 - crop.x0, s.height = crop.y1 - crop.y0;
  return s;
}

/// "room.checkpoint: going on from 16 samples a pixel".
void sayHowFar(const RenderRequest& r, const Film& film) {
  const ProgressStyle style = progressStyle(r.progress);
  if (film.maxSamples() == 0 || (style != ProgressStyle::bar && style != ProgressStyle::plain))
    return;
  say(fmt::format("{}: going on from {} a pixel", r.checkpoint,
                  count(film.minSamples(), "sample")));
}

/// What there is of the picture, to its files; the program's exit code.
int writeResults(const RenderRequest& r, const Statistics& stats, const Film& film,
                 std::uint64_t sceneHash, bool isKept) {
  const RenderResult& result = stats.render;
  warnAboutCounters(result.counters);
  warnAboutAovs(film);
  warnAboutTextures(stats.textures);
  if (result.mostSamples == 0) {
    complain("stopped before the first sample, so there is no picture to write");
    return result.end == RenderEnd::cancelled ? kInterrupted : kFine;
  }
  if (result.samples == 0) warn("not every pixel got a sample: those without are black");
  bool failed = false;
  const PictureFacts facts{sceneHash, r.render.seed, result.samples, result.seconds};
  const auto files = writeOutputs(r.output, pictureOf(film, facts), failed);
  reportWritten(r, stats, files, isKept);
  if (!writeStatistics(r, stats) || failed || !isKept) return kMachineFailed;
  return result.end == RenderEnd::cancelled ? kInterrupted : kFine;
}

int runRender(const RenderRequest& r) {
  const double start = secondsNow();
  const Registry registry = loadRegistry(r.input.pluginPaths);
  const double importSeconds = secondsNow() - start;
  checkRequest(r, registry);

  std::set<std::string> files;
  BuildOptions build = r.build;
  build.files = &files;
  SceneInput input = r.input;
  input.writes = true;
  const LoadedScene loaded = loadScene(input, registry, Stage::built, build);
  printDiagnostics(loaded.text);
  if (!loaded.scene) return kSceneWrong;
  if (!isAccepted(loaded.text, r.input.werror)) {
    complain("not rendered: with --werror a warning counts as an error");
    return kSceneWrong;
  }

  Film film = makeFilm(*loaded.scene, r.input.width, r.input.height, r.cropGiven ? r.crop : nullptr,
                       namedAovs(r.aovs, loaded.scene->integrator().aovs()));
  std::optional<CheckpointFile> checkpoint;
  if (!r.checkpoint.empty()) {
    checkIntegrator(r, *loaded.scene);
    checkpoint.emplace(
        r.checkpoint, checkpointLabel(loaded.text.scene, *loaded.scene, registry, build, r.render));
    checkpoint->load(film, wantedSamples(loaded.scene->integrator(), r.render));
    sayHowFar(r, film);
  }
  RenderResult result = renderFilm(r, *loaded.scene, film, checkpoint);
  const bool isNew = result.counters.paths > 0;
  const bool isKept = !checkpoint || !isNew || checkpoint->save(film, *loaded.scene, result, warn);
  if (checkpoint) result = checkpoint->whole(result);
  Statistics stats = statisticsOf(r, loaded, film, result, importSeconds);
  if (checkpoint) stats.earlierSeconds = checkpoint->earlier().seconds;
  return writeResults(r, stats, film, loaded.scene->hash(), isKept);
}

}  // namespace

void addRender(CLI::App& program, Action& chosen) {
  CLI::App* command = program.add_subcommand("render", "Render a scene to picture files");
  const auto request = std::make_shared<RenderRequest>();
  addRenderOptions(*command, *request);
  command->callback([request, &chosen] {
    if (request->output.files.empty())
      request->output.files = {std::filesystem::path(request->input.file).stem().string() + ".png"};
    chosen = [request] { return runRender(*request); };
  });
}

}  // namespace vestige::app
