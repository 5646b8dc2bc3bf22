// SPDX-License-Identifier: Apache-2.0
// Cameras moved by hand, and the way back from the world to the film.
#include "app/window/steer.h"

#include "app/window/projection.h"
#include "engine/scene/scene_impl.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/text_scene.h"

using namespace vestige;
using namespace vestige::app;

namespace {

constexpr Real kAspect = Real(1.6);

struct Read {
  Block block;
  Schema schema;
  std::shared_ptr<const Camera> camera;
};

/// A camera from the text of its block.
Read cameraOf(const std::string& text) {
  std::vector<Schema> schemas;
  for (const Schema* s : test::registry().schemas()) schemas.push_back(*s);
  lang::Result r = lang::readSceneText("test.scene", text, test::SchemaList(schemas), {});
  auto scene = buildScene(r.scene, test::registry(), {}, r.diagnostics);
  INFO(text);
  REQUIRE(scene);
  Read read;
  for (const Block& b : r.scene.blocks)
    if (b.kind == "camera") read.block = b;
  read.schema = *test::registry().schema("camera", read.block.plugin);
  read.camera = scene->impl().camera;
  return read;
}

void checkSameRays(const Camera& a, const Camera& b) {
  for (const Vec2 film : {Vec2{Real(0.1), Real(0.2)}, Vec2{Real(0.9), Real(0.5)}})
    for (const Vec2 lens : {Vec2{Real(0.5), Real(0.5)}, Vec2{Real(0.1), Real(0.8)}}) {
      const auto p = a.sample({film, lens, kAspect}), q = b.sample({film, lens, kAspect});
      REQUIRE(p);
      REQUIRE(q);
      CHECK(length(p->origin - q->origin) < Real(2e-5));
      CHECK(length(p->direction - q->direction) < Real(2e-5));
    }
}

const std::vector<std::string> kCameras = {
    "camera pinhole { location <1, 2, -5> look_at <0, 1, 0> angle 50 }",
    "camera thin_lens { location <1, 2, -5> look_at <0, 1, 0> aperture 0.2 focus_distance 3 }",
    "camera orthographic { location <1, 2, -5> look_at <0, 1, 0> }",
    "camera panorama { location <1, 2, -5> look_at <0, 1, 0> }"};

}  // namespace

TEST_CASE("a camera with a view of its own is the camera it was", "[window][steer]") {
  for (const std::string& text : kCameras) {
    for (const char* moved : {"", " rotate 30*y scale 2 translate <1, 2, 3>"}) {
      const Read r = cameraOf(text.substr(0, text.size() - 1) + moved + " }");
      INFO(text << moved);
      const auto view = viewOf(r.block, r.schema);
      REQUIRE(view);
      const std::string written = cameraText(withView(r.block, r.schema, *view));
      INFO(written);
      // An orthographic film has a width of its own, which scale changes too.
      if (r.block.plugin == "orthographic" && *moved) continue;
      checkSameRays(*r.camera, *cameraOf(written).camera);
    }
  }
}

TEST_CASE("movements keep what they should", "[window][steer]") {
  const View v = {{1, 2, -5}, {0, 1, 0}, {0, 1, 0}};
  const Real d = distance(v);
  const auto isSame = [](Real a, Real b) { return std::abs(a - b) < Real(1e-4); };
  const View o = orbit(v, Real(0.4), Real(0.2));
  CHECK(length(o.lookAt - v.lookAt) == 0);
  CHECK(isSame(distance(o), d));
  CHECK(length(o.location - v.location) > Real(0.5));
  const View t = turn(v, Real(0.4), Real(0.2));
  CHECK(length(t.location - v.location) == 0);
  CHECK(isSame(distance(t), d));
  const View p = pan(v, 2, 3);
  CHECK(isSame(length(p.location - v.location), std::sqrt(Real(13))));
  CHECK(isSame(length((p.location - v.location) - (p.lookAt - v.lookAt)), 0));
  CHECK(isSame(distance(dolly(v, Real(0.5))), d / 2));
  CHECK(isSame(dot(normalize(walk(v, 2).location - v.location), normalize(v.lookAt - v.location)),
               1));
  View near = v;
  for (int i = 0; i < 500; ++i) near = dolly(near, Real(0.9));
  CHECK(distance(near) > 0);
  CHECK(distance(dolly(near, 2)) > Real(1.5) * distance(near));
  // A full turn comes back; up and down ends short of the poles and can go back.
  View round = v;
  for (int i = 0; i < 8; ++i) round = orbit(round, kPi / 4, 0);
  CHECK(length(round.location - v.location) < Real(1e-3));
  const View top = orbit(v, 0, 10);
  CHECK(isSame(distance(top), d));
  CHECK(std::abs(dot(normalize(top.lookAt - top.location), v.sky)) < 1);
  CHECK(std::isfinite(orbit(top, 1, 10).location.x));
}

TEST_CASE("the world comes back to the film", "[window][projection]") {
  for (const std::string& text : kCameras) {
    const Read r = cameraOf(text);
    INFO(text);
    for (const Vec2 film : {Vec2{Real(0.5), Real(0.5)}, Vec2{Real(0.15), Real(0.3)},
                            Vec2{Real(0.8), Real(0.75)}, Vec2{Real(0.45), Real(0.9)}})
      for (const Real far : {Real(0.3), Real(4), Real(500)}) {
        const auto ray = r.camera->sample({film, {Real(0.5), Real(0.5)}, kAspect});
        const auto back =
            onFilm(*r.camera, ray->origin + far * ray->direction, kAspect, {Real(0.5), Real(0.5)});
        INFO(film.x << ' ' << film.y << ' ' << far);
        REQUIRE(back);
        CHECK(std::abs(back->x - film.x) < Real(1e-3));
        CHECK(std::abs(back->y - film.y) < Real(1e-3));
      }
  }
  const Read r = cameraOf(kCameras[0]);
  CHECK_FALSE(onFilm(*r.camera, {2, 3, -10}, kAspect, {Real(0.5), Real(0.5)}));
}
