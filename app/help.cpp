// SPDX-License-Identifier: Apache-2.0
// The first page that a user sees.
#include "app/command.h"

namespace vestige::app {

std::string helpText() {
  return R"(vestige: renders scenes written as text, physically based, on the CPU.

A .scene file reads like POV-Ray's language: camera, lights, shapes, materials, with variables,
loops and macros. Every camera, light, shape and material is a plugin.

  vestige hello.scene                              picture in hello.png
  vestige render hello.scene -o a.exr -o a.png     two files of one render
  vestige render hello.scene --time 2m --width 1920
  vestige render hello.scene --noise 0.02          until its noise is 2 % of its brightness
  vestige render hello.scene --checkpoint hello.checkpoint
                                                   goes on after an interruption
  vestige view hello.scene                         a window: the picture follows each save
  vestige check hello.scene                        what is wrong with it, without rendering
  vestige describe brdf phong                      what a material may say

Commands ('vestige COMMAND --help' for their options)
  render SCENE      render to EXR, HDR, TIFF, PNG or JPEG; Ctrl-C keeps what is done
  view SCENE        show the scene while it is written; or a picture: view picture.exr
  inspect SCENE X Y one path, vertex by vertex: what it hit and how large its footprint is there
  check SCENE       errors and warnings only; --json for editors
  describe [KIND [NAME]]
                    plugins and their parameters, with types, ranges and defaults
  compare A B       how far picture A is from the reference B
  plugin new KIND NAME
                    a folder with a plugin of your own, ready to build; plugin list: all that are
                    found, with their files and versions
  plugin test FILE.so
                    whether its densities, derivatives and energy are right, and which of its
                    methods is wrong

Options
  -h, --help        this page
  --version         versions of the program, its libraries and its plugins

Environment
  VESTIGE_PLUGIN_PATH, VESTIGE_INCLUDE_PATH   more folders, separated by ':'
                    (~/.local/lib/vestige is looked through for plugins in any case)
  VISUAL, EDITOR    opened by `vestige view` at the place of an error (code)
  VESTIGE_CACHE     folder for files that can be made again (~/.cache/vestige)
  OCIO              OpenColorIO configuration in place of the built-in one
  NO_COLOR          no colours on the terminal

Exit codes: 0 fine, 1 the scene is wrong, 2 the command line is wrong, 3 the machine failed (disk
full, place not writable, out of memory, library missing), 130 interrupted.
)";
}

}  // namespace vestige::app
