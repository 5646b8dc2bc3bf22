// SPDX-License-Identifier: Apache-2.0
// From the command line to a scene in memory, complaints printed: what `render` and `check` share.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "app/command.h"
#include "engine/scene/scene.h"
#include "lang/lang.h"

namespace vestige::app {

/// What the user said about where the scene is and how it is read.
struct SceneInput {
  std::string file;
  std::vector<std::string> definitions;   ///< -D name=value, as typed
  std::vector<std::string> includePaths;  ///< -I
  std::vector<std::string> pluginPaths;   ///< --plugin-path
  bool sandbox = false;
  std::string writeFolder;  ///< --write-folder
  bool writes = false;      ///< whether the scene may change files there
  bool werror = false;
  int width = 0, height = 0;  ///< --width, --height: image_width and image_height; 0: the film's
  lang::Limits limits;
};

/// The positional SCENE and the options above but the limits. `input` must outlive the parsing.
void addSceneOptions(CLI::App& command, SceneInput& input);
/// --max-...: what a hostile text may cost. Best added last: they are the last that people look
/// for.
void addLimits(CLI::App& command, lang::Limits& limits);
/// Only --plugin-path.
void addPluginPath(CLI::App& command, std::vector<std::string>& paths);

/// All plugins of this installation and of the paths. Libraries that had to be opened to know what
/// they hold and were refused are told as warnings. Failure if there is no library at all.
Registry loadRegistry(const std::vector<std::string>& extraPaths);
/// Warnings for libraries that were refused when they were asked for, but those that `said` has.
void warnOfRefused(const Registry& registry, const Diagnostics& said);

/// A text with its meaning, and the scene that was built from it if that was asked for and worked.
struct LoadedScene {
  lang::Result text;  ///< the builder's diagnostics included
  std::unique_ptr<Scene> scene;
  double loadSeconds = 0, buildSeconds = 0;  ///< language; files, textures, acceleration structure
};
enum class Stage { text, built };
/// `texts`: keeps the tokens of the text for the next time; may be null.
LoadedScene loadScene(const SceneInput& input, const Registry& registry, Stage stage,
                      const BuildOptions& build = {}, lang::TextStore* texts = nullptr);
/// --integrator and --footprint, in place of the scene's own, and --texture-memory. `build` must
/// outlive the parsing.
void addBuildOptions(CLI::App& command, BuildOptions& build, const std::string& group);
/// Failure if one of them names nothing known.
void checkBuildOptions(const BuildOptions& build, const Registry& registry);

/// Failure if the file is not there, or is none that can be read.
void checkSceneFile(const std::string& file);

/// Diagnostics to stderr, and "2 errors, 1 warning" after them if there were any.
void printDiagnostics(const lang::Result& text);
/// Whether nothing speaks against rendering: no error, and no warning where those count as errors.
bool isAccepted(const lang::Result& text, bool werror);

/// Seconds since some fixed moment.
double secondsNow();

}  // namespace vestige::app
