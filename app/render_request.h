// SPDX-License-Identifier: Apache-2.0
// The command line of `vestige render`, understood.
#pragma once
#include <string>
#include <vector>

#include "app/output.h"
#include "app/scene_input.h"
#include "engine/render/session.h"

namespace vestige::app {

struct RenderRequest {
  SceneInput input;
  OutputOptions output;
  RenderOptions render;
  BuildOptions build;
  bool cropGiven = false;
  double crop[4] = {0, 0, 1, 1};
  std::vector<std::string> aovs;  ///< as written; see namedAovs()
  std::string statsFile;          ///< "-": stdout
  std::string progress = "auto";
  bool resultLine = false;
  std::string checkpoint;        ///< "": none is kept
  double checkpointEvery = 300;  ///< seconds
};

/// The words of --aov as names of AOVs: no word twice, "all" replaced. `own` are those of the
/// scene's integrator. An unknown name is a Failure.
std::vector<std::string> namedAovs(const std::vector<std::string>& words,
                                   std::span<const AovSlot> own);

/// Adds all options; `request` must outlive the parsing. A number or a word out of place is a
/// Failure.
void addRenderOptions(CLI::App& command, RenderRequest& request);

}  // namespace vestige::app
