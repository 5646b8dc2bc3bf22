// SPDX-License-Identifier: Apache-2.0
// A scene from its text, with the plugins of this build or others.
#pragma once
#include "lang/lang.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/schema_list.h"

namespace vestige::test {

inline std::unique_ptr<Scene> sceneOf(const std::string& text, const Registry& plugins = registry(),
                                      const BuildOptions& options = {}) {
  std::vector<Schema> schemas;
  for (const Schema* s : plugins.schemas()) schemas.push_back(*s);
  lang::Result read = lang::readSceneText("test.scene", text, SchemaList(schemas), {});
  auto scene = buildScene(read.scene, plugins, options, read.diagnostics);
  std::string said;
  for (const Diagnostic& d : read.diagnostics.list()) said += d.message + '\n';
  INFO(said);
  REQUIRE(scene);
  return scene;
}

}  // namespace vestige::test
