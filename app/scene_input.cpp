// SPDX-License-Identifier: Apache-2.0
#include "app/scene_input.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cctype>
#include <chrono>
#include <CLI/CLI.hpp>
#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "app/options.h"
#include "app/terminal.h"
#include "engine/picture/image.h"

namespace vestige::app {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kMuch = std::int64_t(1) << 40;  // more than any limit is worth

bool isName(const std::string& word) {
  if (word.empty() || std::isdigit(static_cast<unsigned char>(word[0]))) return false;
  for (const unsigned char c : word)
    if (!std::isalnum(c) && c != '_') return false;
  return true;
}

/// "Columns=5" taken apart; "Columns" alone means 1.
std::pair<std::string, std::string> definition(const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string name = text.substr(0, equals);
  const std::string value = equals == std::string::npos ? "1" : text.substr(equals + 1);
  if (!isName(name) || value.empty())
    throw Failure(kCommandLineWrong,
                  fmt::format("-D wants NAME=VALUE, as in -D Columns=5; found '{}'", text));
  return {name, value};
}

/// -I, then VESTIGE_INCLUDE_PATH, then what is installed.
std::vector<std::string> includeFolders(const std::vector<std::string>& given) {
  std::vector<std::string> folders = given;
  if (const char* path = std::getenv("VESTIGE_INCLUDE_PATH"))
    for (const std::string& folder : CLI::detail::split(path, ':'))
      if (!folder.empty()) folders.push_back(folder);
  folders.push_back(installedIncludeFolder());
  return folders;
}

/// The registry as the language asks it.
class RegistrySchemas final : public lang::SchemaSource {
 public:
  explicit RegistrySchemas(const Registry& registry) : registry_(registry) {}
  const Schema* find(const std::string& kind, const std::string& name) const override {
    return registry_.schema(kind, name);
  }
  bool has(const std::string& kind, const std::string& name) const override {
    return registry_.has(kind, name);
  }
  std::vector<std::string> kinds() const override { return registry_.kinds(); }
  std::vector<std::string> names(const std::string& kind) const override {
    return registry_.names(kind);
  }
  std::string whyMissing(const std::string& kind, const std::string& name) const override {
    return registry_.whyMissing(kind, name);
  }

 private:
  const Registry& registry_;
};

/// A folder that is there but may not be listed would look like one without plugins.
void warnOfFolders(const std::vector<std::string>& folders) {
  std::error_code fault;
  for (const std::string& folder : folders) {
    const fs::file_type type = fs::status(folder, fault).type();
    if (type == fs::file_type::not_found) continue;
    if (type != fs::file_type::none && type != fs::file_type::directory)
      warn(fmt::format("no plugin is looked for in '{}': it is no folder", folder));
    else if (fault || (fs::directory_iterator(folder, fault), fault))
      warn(fmt::format("no plugin is looked for in '{}': {}", folder, fault.message()));
  }
}

/// Whether a note of some diagnostic says this.
bool isSaid(const std::string& sentence, const Diagnostics& diagnostics) {
  for (const Diagnostic& d : diagnostics.list())
    for (const Note& n : d.notes)
      if (n.message == sentence) return true;
  return false;
}

}  // namespace

void checkSceneFile(const std::string& file) {
  std::error_code ignored;
  if (fs::is_directory(file, ignored))
    throw Failure(kCommandLineWrong, fmt::format("'{}' is a folder, not a scene file", file));
  if (!fs::exists(file, ignored)) {
    const fs::path folder = fs::path(file).parent_path();
    std::vector<std::string> beside;
    for (const auto& entry : fs::directory_iterator(folder.empty() ? "." : folder, ignored))
      beside.push_back((folder / entry.path().filename()).string());
    const std::string near = nearestWord(file, beside);
    throw Failure(kCommandLineWrong,
                  fmt::format("there is no scene file '{}'{}", file,
                              near.empty() ? "" : fmt::format("; did you mean '{}'?", near)));
  }
  if (access(file.c_str(), R_OK) != 0)
    throw Failure(kCommandLineWrong, fmt::format("'{}' may not be read by this user", file));
}

void addPluginPath(CLI::App& command, std::vector<std::string>& paths) {
  addList(command, "--plugin-path", paths, "look for plugin libraries in this folder too")
      ->type_name("DIR");
}

void addLimits(CLI::App& command, lang::Limits& limits) {
  const auto limit = [&](const char* name, auto& target, std::int64_t high, const char* help) {
    const auto set = [&target](std::int64_t n) { target = std::decay_t<decltype(target)>(n); };
    addInteger(command, name, 1, high, set, fmt::format("{} ({})", help, target))
        ->group("Limits on hostile scenes");
  };
  limit("--max-include-depth", limits.includeDepth, 10'000, "includes inside includes");
  limit("--max-macro-depth", limits.macroDepth, 100'000, "macro calls inside macro calls");
  limit("--max-loop-iterations", limits.loopIterations, kMuch, "turns of all loops together");
  limit("--max-tokens", limits.expandedTokens, kMuch,
        "steps of reading: words, each turn of a loop counted, and other work");
  const auto setPicture = [](std::int64_t n) { limitPictures(n * 1'000'000); };
  addInteger(command, "--max-picture", 1, 1'000'000, setPicture,
             fmt::format("million pixels of a picture file ({})", kMaxPicturePixels / 1'000'000))
      ->group("Limits on hostile scenes");
  const auto setMemory = [&limits](std::int64_t n) { limits.memory = n << 20; };
  addInteger(command, "--max-memory", 1, kMuch, setMemory,
             fmt::format("MB that reading the text may take ({})", limits.memory >> 20))
      ->group("Limits on hostile scenes");
  limit("--max-string-length", limits.stringLength, kMuch, "bytes of one string");
  limit("--max-blocks", limits.blocks, kMuch, "blocks of the scene, copies counted");
  limit("--max-array-elements", limits.arrayElements, kMuch, "elements of all arrays together");
  limit("--max-errors", limits.errors, 100'000, "errors after which reading stops");
  limit("--max-nesting", limits.nesting, 1000, "blocks and brackets inside each other");
}

void addSceneOptions(CLI::App& command, SceneInput& input) {
  command.add_option("scene", input.file, "the scene text")->required()->type_name("FILE");
  addList(command, "-D,--define", input.definitions, "declare a name before the scene is read")
      ->type_name("NAME=VALUE");
  addList(command, "-I,--include", input.includePaths, "look for #include files here too")
      ->type_name("DIR");
  addPluginPath(command, input.pluginPaths);
  command.add_flag("--sandbox", input.sandbox,
                   "refuse includes from outside the scene's folder and the include folders");
  command
      .add_option("--write-folder", input.writeFolder,
                  "let #write make files below this folder; only `render` makes them")
      ->take_last()
      ->type_name("DIR");
  command.add_flag("--werror", input.werror, "treat warnings as errors");
}

Registry loadRegistry(const std::vector<std::string>& extraPaths) {
  std::error_code ignored;
  for (const std::string& folder : extraPaths)
    if (!fs::is_directory(folder, ignored))
      throw Failure(kCommandLineWrong,
                    fmt::format("--plugin-path: there is no folder '{}'", folder));
  const std::vector<std::string> folders = pluginFolders(extraPaths);
  warnOfFolders(folders);
  std::vector<std::string> refused;
  Registry registry = Registry::load(folders, refused);
  for (const std::string& sentence : refused) warn(sentence);
  if (!registry.isEmpty()) return registry;
  std::string places;
  for (const std::string& folder : folders) places += "\n  " + folder;
  throw Failure(kMachineFailed,
                "found no plugin library, so there is nothing to render with; looked in" + places);
}

void warnOfRefused(const Registry& registry, const Diagnostics& said) {
  for (const Refusal& r : registry.refused())
    if (!isSaid(r.sentence, said)) warn(r.sentence);
}

LoadedScene loadScene(const SceneInput& input, const Registry& registry, Stage stage,
                      const BuildOptions& build, lang::TextStore* texts) {
  lang::Options options;
  options.store = texts;
  options.includePaths = includeFolders(input.includePaths);
  for (const std::string& text : input.definitions) options.definitions.push_back(definition(text));
  options.sandbox = input.sandbox;
  options.writeFolder = input.writeFolder, options.writes = input.writes;
  options.limits = input.limits;
  options.imageWidth = input.width, options.imageHeight = input.height;
  checkSceneFile(input.file);

  LoadedScene loaded;
  const double start = secondsNow();
  loaded.text = lang::readScene(input.file, RegistrySchemas(registry), options);
  const double read = secondsNow();
  loaded.loadSeconds = read - start;
  if (stage == Stage::built && !loaded.text.diagnostics.hasErrors())
    loaded.scene = buildScene(loaded.text.scene, registry, build, loaded.text.diagnostics);
  loaded.buildSeconds = secondsNow() - read;
  warnOfRefused(registry, loaded.text.diagnostics);
  return loaded;
}

void addBuildOptions(CLI::App& command, BuildOptions& build, const std::string& group) {
  command.add_option("--integrator", build.integrator, "in place of the scene's")
      ->take_last()
      ->type_name("NAME")
      ->group(group);
  command
      .add_option("--footprint", build.footprint,
                  "in place of the scene's: none, pixel, local, global, safe, gradient or paper")
      ->take_last()
      ->type_name("BOUND")
      ->group(group);
  const auto memory = [&](const std::string& text) {
    const auto bytes = parseBytes(text);
    if (!bytes)
      throw Failure(kCommandLineWrong,
                    fmt::format("--texture-memory wants a size as 512M, 2G or 1.5G or a whole "
                                "number of bytes, found '{}'",
                                text));
    build.textureMemory = *bytes;
  };
  command
      .add_option_function<std::string>(
          "--texture-memory", memory,
          "for all textures; what does not fit is read piece by piece (4G)")
      ->take_last()
      ->type_name("SIZE")
      ->group(group);
}

namespace {

void checkWord(const std::string& kind, const std::string& wanted, const Registry& registry) {
  if (wanted.empty() || registry.schema(kind, wanted)) return;
  if (const std::string why = registry.whyMissing(kind, wanted); !why.empty())
    throw Failure(kCommandLineWrong, fmt::format("there is no {} '{}': {}", kind, wanted, why));
  const std::vector<std::string> known = registry.names(kind);
  const std::string near = nearestWord(wanted, known);
  throw Failure(kCommandLineWrong,
                fmt::format("there is no {} '{}'; {}", kind, wanted,
                            near.empty() ? fmt::format("there are {}", fmt::join(known, ", "))
                                         : fmt::format("did you mean '{}'?", near)));
}

}  // namespace

void checkBuildOptions(const BuildOptions& build, const Registry& registry) {
  checkWord("integrator", build.integrator, registry);
  checkWord("footprint", build.footprint, registry);
}

void printDiagnostics(const lang::Result& text) {
  const bool colour = wantsColour(STDERR_FILENO);
  int warnings = 0;
  for (const Diagnostic& d : text.diagnostics.list()) {
    lang::print(std::cerr, d, *text.sources, colour);
    warnings += d.severity == Severity::warning;
  }
  const int errors = text.diagnostics.errors();
  if (errors > 0 && warnings > 0)
    say(count(errors, "error") + ", " + count(warnings, "warning"));
  else if (errors > 0 || warnings > 0)
    say(errors > 0 ? count(errors, "error") : count(warnings, "warning"));
}

bool isAccepted(const lang::Result& text, bool werror) {
  return !text.diagnostics.hasErrors() && !(werror && text.diagnostics.warnings() > 0);
}

double secondsNow() {
  using namespace std::chrono;
  return duration<double>(steady_clock::now().time_since_epoch()).count();
}

}  // namespace vestige::app
