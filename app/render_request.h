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
  int width = 0, height = 0;
  bool cropGiven = false;
  double crop[4] = {0, 0, 1, 1};
  std::vector<Aov> aovs;
  std::string statsFile;  ///< "-": stdout
  std::string progress = "auto";
  bool resultLine = false;
  std::string checkpoint;        ///< "": none is kept
  double checkpointEvery = 300;  ///< seconds
};

/// Adds all options; `request` must outlive the parsing. Numbers and words out of place are
/// Failures.
void addRenderOptions(CLI::App& command, RenderRequest& request);

}  // namespace vestige::app
