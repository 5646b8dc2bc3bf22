// SPDX-License-Identifier: Apache-2.0
// A scene file, as a render would read it; ends the program where there is none.
#pragma once
#include <cstdio>
#include <cstdlib>

#include "engine/scene/scene.h"
#include "lang/lang.h"
#include "support/schema_list.h"

namespace vestige::bench {

inline std::unique_ptr<Scene> read(
    const char* file, const std::vector<std::pair<std::string, std::string>>& definitions = {},
    const std::string& integrator = "") {
  std::vector<std::string> refused;
  const Registry registry = Registry::load(pluginFolders({}), refused);
  lang::Options options;
  options.includePaths = {installedIncludeFolder()};
  options.definitions = definitions;
  std::vector<Schema> schemas;
  for (const Schema* s : registry.schemas()) schemas.push_back(*s);
  lang::Result text = lang::readScene(file, test::SchemaList(schemas), options);
  BuildOptions build;
  build.integrator = integrator;
  auto scene = buildScene(text.scene, registry, build, text.diagnostics);
  for (const Diagnostic& d : text.diagnostics.list())
    std::fprintf(stderr, "%s: %s\n", file, d.message.c_str());
  if (!scene) std::exit(3);
  return scene;
}

}  // namespace vestige::bench
