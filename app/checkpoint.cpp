// SPDX-License-Identifier: Apache-2.0
#include "app/checkpoint.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <filesystem>

#include "app/terminal.h"
#include "engine/files/fingerprint.h"
#include "engine/trace/world.h"
#include "lang/hash.h"

namespace vestige::app {
namespace {

namespace fs = std::filesystem;

/// The one that counts.
const Block* integratorOf(const SceneDesc& text, const BuildOptions& build) {
  const Block* last = text.last("integrator");
  return last && (build.integrator.empty() || build.integrator == last->plugin) ? last : nullptr;
}

void forget(Block& block, std::initializer_list<const char*> names) {
  std::erase_if(block.settings.edit(), [&](const Setting& s) {
    return std::find(names.begin(), names.end(), s.name) != names.end();
  });
}

/// Of the meaning, but for what the film says itself, what may grow and what is read from files.
std::string meaning(SceneDesc text, const BuildOptions& build) {
  Block asked;  // by the command line
  for (const auto& [name, value] : build.settings) asked.settings.push_back({name, value, {}});
  forget(asked, {"save_solution", "load_solution"});
  text.blocks.push_back(asked);
  for (Block& b : text.blocks) {
    if (b.kind == "integrator") forget(b, {"samples"});
    if (b.kind == "film") forget(b, {"resolution", "crop"});
  }
  return fmt::format("{:016x}", lang::hashOf(text));
}

void addFile(CheckpointLabel& label, const std::string& kind, const std::string& file) {
  const std::string print = fileFingerprint(file);
  if (print.empty()) return;  // looked for in vain
  label.push_back({fmt::format("{} '{}'", kind, fs::path(file).filename().string()), print, true});
}

void addFiles(CheckpointLabel& label, const Scene& scene, const Registry& registry,
              const BuildOptions& build) {
  if (build.files)
    for (const std::string& file : *build.files) addFile(label, "the file", file);
  for (const auto& [name, value] : build.settings)
    if (name == "load_solution")
      for (const std::string& file : CLI::detail::split(value.text.str(), ','))
        addFile(label, "the solution", file);
  for (const std::string& file : registry.loadedFiles()) {
    // A window knows the other integrators as well.
    const auto plugin = promisedBy(file);
    if (plugin && plugin->kind == "integrator" && plugin->name != scene.integratorName()) continue;
    addFile(label, "the plugin", file);
  }
}

}  // namespace

bool goesByDeclaredSamples(const SceneDesc& text, const BuildOptions& build) {
  const Block* integrator = integratorOf(text, build);
  std::string bound = build.footprint;
  const Value* given = integrator ? integrator->find("footprint") : nullptr;
  if (bound.empty() && given && given->block) bound = given->block->plugin;
  // Particles have footprints of their own; those of its eye paths are safe.
  if (build.integrator == "particle" || (integrator && integrator->plugin == "particle"))
    return false;
  return !bound.empty() && bound != "safe" && bound != "none";
}

CheckpointLabel checkpointLabel(const SceneDesc& text, Scene& scene, const Registry& registry,
                                const BuildOptions& build, const RenderOptions& render) {
  const char* ocio = std::getenv("OCIO");
  CheckpointLabel label = {
      {"the program",
       fmt::format("Vestige {}, Embree {}, {}", VESTIGE_VERSION, World::embreeVersion(),
                   sizeof(Real) == sizeof(double) ? "double" : "float")},
      {"the integrator", scene.integratorName()},
      {"--footprint", build.footprint.empty() ? "the scene's" : build.footprint},
      {"the scene", meaning(text, build), true},
      {"the environment variable OCIO", ocio && *ocio ? ocio : "empty"}};
  addFiles(label, scene, registry, build);
  label.push_back({"the seed", std::to_string(render.seed)});
  if (goesByDeclaredSamples(text, build)) {
    const int samples = wantedSamples(scene.integrator(), render);
    label.push_back({"the number of samples, which the scene's footprint goes by,",
                     samples > 0 ? std::to_string(samples) : "open"});
  }
  return label;
}

void CheckpointFile::load(Film& film, int wanted) {
  std::error_code ignored;
  if (!fs::exists(file_, ignored)) return;
  try {
    earlier_ = loadCheckpoint(film, label_, file_);
  } catch (const std::runtime_error& e) {
    throw Failure(kCommandLineWrong, e.what());
  }
  if (const int most = int(film.maxSamples()); wanted > 0 && most > wanted)
    throw Failure(kCommandLineWrong,
                  fmt::format("checkpoint '{}' has up to {} a pixel already, more than the {} that "
                              "are wanted; ask for --spp {} or more, or choose another name",
                              file_, count(most, "sample"), wanted, most));
}

bool CheckpointFile::save(const Film& film, const Scene& scene, const RenderResult& soFar,
                          const std::function<void(const std::string&)>& warn) {
  const RenderResult all = whole(soFar);
  try {
    if (const TextureUse t = scene.textureUse(); t.readErrors > 0)
      throw std::runtime_error(
          fmt::format("checkpoint '{}' stays as it was: '{}' cannot be read", file_, t.unreadable));
    saveCheckpoint(film, label_, {all.seconds, all.counters}, file_);
    return true;
  } catch (const std::runtime_error& e) {
    if (!hasWarned_) warn(e.what());
    hasWarned_ = true;
    return false;
  }
}

RenderResult CheckpointFile::whole(RenderResult result) const {
  result.seconds += earlier_.seconds;
  add(result.counters, earlier_.counters);
  return result;
}

}  // namespace vestige::app
