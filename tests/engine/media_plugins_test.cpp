// SPDX-License-Identifier: Apache-2.0
// Plugins of the kinds `medium` and `phase`, each held by another plugin.
#include "support/text_scene.h"

using namespace vestige;
using namespace vestige::test;

namespace {

const Registry& plugins() {
  static std::vector<std::string> refused;
  static const Registry all = Registry::load({VESTIGE_PLUGINS, VESTIGE_MEDIA_STUBS}, refused);
  return all;
}

std::string wall(const std::string& brdf) {
  return "camera pinhole { location <0,0,-2> look_at <0,0,0> }\n"
         "shape quad { corner <-1,-1,0> edge1 <2,0,0> edge2 <0,2,0> " +
         brdf + " }";
}

/// The errors of a scene that is refused.
std::string refusal(const std::string& text) {
  std::vector<Schema> schemas;
  for (const Schema* s : plugins().schemas()) schemas.push_back(*s);
  lang::Result read = lang::readSceneText("test.scene", text, SchemaList(schemas), {});
  CHECK_FALSE(buildScene(read.scene, plugins(), {}, read.diagnostics));
  std::string said;
  for (const Diagnostic& d : read.diagnostics.list()) said += d.message + '\n';
  return said;
}

}  // namespace

TEST_CASE("a BRDF holds a medium, which holds a phase function", "[scene][plugin]") {
  const auto scene =
      sceneOf(wall("brdf foggy { inside fog { density 0.7 phase lean { a 0.4 } } }"), plugins());
  const SceneView& view = scene->view();
  Surface s;
  REQUIRE(view.intersect({{0, 0, -2}, {0, 0, 1}}, s));
  InputBuffer inputs;
  Interaction x;
  view.shade(s, {0, 0, -1}, {}, inputs, x);
  REQUIRE(x.brdf);
  const Vec3 toNext = normalize(Vec3{Real(0.6), 0, Real(0.8)});
  const ScatterValue v = x.brdf->evaluate(x.point, toNext);
  CHECK(v.fCos.r == Approx(std::exp(-0.7)));
  CHECK(v.pdf == Approx((1 - 0.4 * 0.8) / (4 * M_PI)));
}

TEST_CASE("media and phase functions that are missing or refused", "[scene][plugin]") {
  CHECK_THAT(refusal(wall("brdf foggy { inside fog { } }")),
             containsText("fog needs a phase function"));
  CHECK_THAT(refusal(wall("brdf foggy { inside fog { phase lean { a 2 } } }")),
             containsText("'a' must be between -1 and 1, found 2"));
  CHECK_THAT(refusal(wall("brdf foggy { inside lean { } }")),
             containsText("no medium is called 'lean': expected fog"));
}
