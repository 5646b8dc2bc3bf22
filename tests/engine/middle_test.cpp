// SPDX-License-Identifier: Apache-2.0
// Where the space that a scene is traced in stands, and which coordinates people see.
#include "engine/scene/middle.h"

#include <fmt/format.h>

#include "engine/render/session.h"
#include "engine/scene/scene_impl.h"
#include "support/text_scene.h"

using namespace vestige;
using namespace vestige::test;

namespace {

Bounds boxAt(Vec3 low, Vec3 size) { return {low, low + size}; }

/// A patterned box of one unit with a lamp, `at` from the origin, under an orthographic camera that
/// sees its lid.
std::string boxText(double at, const std::string& more = "") {
  return fmt::format(
      "camera orthographic {{ location <0.5, 3, 0.5> look_at <0.5, 0, 0.5> sky z width 0.5 "
      "translate {0} }}\n film {{ resolution <8, 8> filter \"box\" }}\n"
      "integrator path {{ depth 2 }}\n"
      "light point {{ <0.5, 2, 0.5> intensity rgb 1 translate {0} }}\n"
      "union {{ box {{ <0, 0, 0>, <1, 1, 1> brdf lambert {{ diffuse pigment gradient {{ x }} }} "
      "}} {1} translate {0} }}\n",
      at, more);
}

}  // namespace

TEST_CASE("the middle of a scene is a point of a coarse grid, or zero", "[scene]") {
  CHECK(middleOf({}) == Vec3{});
  CHECK(middleOf({{0, 0, 0}, {kInfinity, 1, 1}}) == Vec3{});
  CHECK(middleOf(boxAt({7, 7, 7}, {0, 0, 0})) == Vec3{});
  CHECK(middleOf(boxAt({-1, 20, 3}, {1, 1, 1})) == Vec3{});
  CHECK(middleOf(boxAt({1000, -1000, 3}, {1, 3, 2})) == Vec3{1000, -1000, 4});
  // One wall moved by a little: the same.
  CHECK(middleOf(boxAt({1000, -1000, 3}, {1, Real(3.2), Real(1.9)})) == Vec3{1000, -1000, 4});
  const Vec3 far{Real(123456.7), Real(-0.3), Real(777.7)}, size{Real(2.5), Real(1.1), Real(0.4)};
  const Vec3 middle = middleOf(boxAt(far, size));
  const Vec3 off = middle - (far + Real(0.5) * size);
  CHECK(maxAbsComponent(off) <= 2);  // half of the grid's step, 4
  for (const Real scale : {Real(1) / 1024, Real(1024)})
    CHECK(middleOf(boxAt(scale * far, scale * size)) == scale * middle);
}

TEST_CASE("scenes are traced around their middle", "[scene]") {
  CHECK(sceneOf(boxText(0))->view().middle == Vec3{});
  CHECK(sceneOf(boxText(20))->view().middle == Vec3{});
  const auto far = sceneOf(boxText(5000));
  const Vec3 middle = far->view().middle;
  CHECK(maxAbsComponent(middle - Vec3{5000, 5000, 5000}) <= 1);
  CHECK(maxAbsComponent(far->view().bounds().low) <= 1);
  // Nothing bounded: lamps and the camera say where the scene stands.
  const auto endless = sceneOf(
      "camera pinhole { location <9000, 1, 0> look_at <9000, 0, 1> }\n"
      "light point { <9002, 1, 0> }\nplane { y, 0 }\n");
  CHECK(std::abs(endless->view().middle.x - 9001) <= 2);
}

TEST_CASE("positions that people see are those of the scene's author", "[scene]") {
  const auto means = [](double at) {
    const auto scene = sceneOf(boxText(at));
    Film film = makeFilm(*scene, 0, 0, nullptr, {"position"});
    render(*scene, film, {.samples = 16, .threads = 1});
    return film.means();
  };
  const Film::Means near = means(0), far = means(4096);
  REQUIRE(near.channels.size() == 6);
  for (std::size_t i = 0; i < near.pixels.size(); i += 6) {
    // The pattern too: x alone says how bright the lid is.
    CHECK(far.pixels[i] == Approx(near.pixels[i]).epsilon(2e-3));
    for (std::size_t c = 3; c < 6; ++c)
      CHECK(far.pixels[i + c] == Approx(near.pixels[i + c] + 4096).epsilon(1e-6));
    CHECK(near.pixels[i + 4] == Approx(1));
  }
}

TEST_CASE("patterns keep the coordinates of the scene's author", "[scene]") {
  // Checks of one unit, which do not move with the box: an even number of them from the origin it
  // looks the same, an odd number swaps them.
  const auto means = [](double at) {
    const auto scene = sceneOf(fmt::format(
        "camera orthographic {{ location <{0}, 3, 0> look_at <{0}, 0, 0> sky z width 4 }}\n"
        "film {{ resolution <8, 8> filter \"box\" }}\nintegrator path {{ depth 2 }}\n"
        "light distant {{ direction <0, -1, 0> irradiance rgb pi }}\n"
        "box {{ <{1}, 0, -2>, <{2}, 0.5, 2> brdf lambert {{ diffuse pigment checker {{ rgb 0.9, "
        "rgb 0.2 }} }} }}\n",
        at, at - 2, at + 2));
    Film film = makeFilm(*scene, 0, 0, nullptr, {});
    render(*scene, film, {.samples = 4, .threads = 1});
    return film.means().pixels;
  };
  const std::vector<float> near = means(0), even = means(2000), odd = means(2001);
  float most = 0, least = 1;
  for (std::size_t i = 0; i < near.size(); ++i) {
    CHECK(even[i] == Approx(near[i]).margin(0.01));
    CHECK(odd[i] == Approx(0.9 + 0.2 - double(near[i])).margin(0.01));
    most = std::max(most, near[i]);
    least = std::min(least, near[i]);
  }
  CHECK(most - least > 0.2f);
}
