// SPDX-License-Identifier: Apache-2.0
// The command line of `vestige view`, understood.
#pragma once
#include <string>

#include "app/window/preview.h"
#include "engine/colour/display.h"

namespace vestige::app {

struct ViewRequest {
  SceneInput input;
  BuildOptions build;
  RenderOptions render;
  int windowWidth = 1280, windowHeight = 800;
  Display display;
  std::string reference;   ///< a picture to compare with
  bool tells = false;      ///< a line on stdout for whatever happens
  bool isPicture = false;  ///< input.file is a picture, not a scene
};

/// Whether a file's ending is that of a picture.
bool isPictureFile(const std::string& file);

/// Opens the window and returns when it is closed. Failure where there is no display.
int runWindow(const ViewRequest& request);

}  // namespace vestige::app
