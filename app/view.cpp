// SPDX-License-Identifier: Apache-2.0
// vestige view: hands over to the program with the window, which is installed beside this one.
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "app/command.h"
#include "engine/scene/registry.h"

namespace vestige::app {

int runView(const std::vector<std::string>& words) {
  const std::string program = installationFolder() + "/bin/vestige-view";
  if (access(program.c_str(), X_OK) != 0)
    throw Failure(kMachineFailed,
                  fmt::format("this installation has no window: '{}' is missing. It is built where "
                              "GLFW and Dear ImGui are installed (libglfw3-dev, libimgui-dev)",
                              program));
  std::vector<char*> arguments = {const_cast<char*>(program.c_str())};
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  execv(program.c_str(), arguments.data());
  throw Failure(kMachineFailed, fmt::format("cannot start '{}': {}", program, strerror(errno)));
}

}  // namespace vestige::app
