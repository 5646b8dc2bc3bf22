// SPDX-License-Identifier: Apache-2.0
// A lamp in a room, and a bright sky outside of its window: how noisy is the direct light?
#include <vestige/tools/direct_light.h>

#include <cstdio>

#include "support/catch.h"
#include "support/scenes.h"

namespace vestige::test {
namespace {

/// room() on a wide ground under a sky, its back wall a frame around a window of 0.8 x 0.8.
SceneDesc roomWithWindow() {
  SceneDesc s = room(0.5, "path");
  const std::vector<Block> wall = {lambert(0.5)};
  s.blocks[7] = quad({-1, -1, 1}, {2, 0, 0}, {0, Real(0.6), 0}, wall);
  s.blocks.push_back(quad({-1, Real(0.4), 1}, {2, 0, 0}, {0, Real(0.6), 0}, wall));
  for (const Real x : {Real(-1), Real(0.4)})
    s.blocks.push_back(quad({x, Real(-0.4), 1}, {Real(0.6), 0, 0}, {0, Real(0.8), 0}, wall));
  s.blocks.push_back(quad({-15, Real(-1.01), -15}, {30, 0, 0}, {0, 0, 30}, wall));
  s.blocks.push_back(makeBlock(
      "light", "environment",
      {{"map", textValue(VESTIGE_SOURCE_DIR "/examples/assets/spiaggia_di_mondello.hdr")}}));
  return s;
}

struct Sums {
  double sum = 0, squares = 0;
  int n = 0;
  void add(double x) {
    sum += x;
    squares += x * x;
    ++n;
  }
  double mean() const { return sum / n; }
  double variance() const { return squares / n - sqr(mean()); }
};

}  // namespace

TEST_CASE("a sky that walls hide does not take the lamp's rays", "[lights]") {
  Diagnostics diagnostics;
  const auto scene = buildScene(roomWithWindow(), registry(), {}, diagnostics);
  REQUIRE(scene);
  const SceneView& view = scene->view();
  constexpr int kPlaces = 200, kDraws = 1000;
  double byPower = 0, byPlace = 0, difference = 0, error = 0;
  for (int place = 0; place < kPlaces; ++place) {
    const Sampler where(std::uint32_t(place), 1, 0, 1);
    const Real z = 1 - 2 * where.number(0), angle = 2 * kPi * where.number(1);
    const Real r = safeSqrt(1 - z * z);
    Surface s;
    const Vec3 direction{r * std::cos(angle), r * std::sin(angle), z};
    if (!view.intersect({{}, direction, 0, kInfinity}, s) || s.light >= 0) continue;
    InputBuffer inputs;
    const Interaction x = view.shade(s, -direction, {}, inputs);
    Counters counters;
    Sums tree, table;
    for (int i = 0; i < kDraws; ++i) {
      PathContext c{.scene = view,
                    .sampler = Sampler(std::uint32_t(place), 0, std::uint32_t(i), 1),
                    .ray = {},
                    .jacobian = {},
                    .counters = counters};
      // Without rays that scattering draws: `scattered` is 0.
      const TowardsLight drawn = drawLight(c, x.receiver, 0, std::uint32_t(i));
      tree.add(double(luminance(reflectedLight(c, s, x, drawn, 1, 0))));
      // The same lights by power alone, wherever the point is.
      const LightChoice choice = *view.chooseLight(c.sampler.number(1000));
      const Light* light = view.lights()[std::size_t(choice.light)];
      const Vec2 u = c.sampler.pair(1002);
      const TowardsLight other{light, u, choice.chance, light->sample(x.receiver, u)};
      table.add(double(luminance(reflectedLight(c, s, x, other, 1, 0))));
    }
    byPlace += tree.variance();
    byPower += table.variance();
    difference += tree.mean() - table.mean();
    error += (tree.variance() + table.variance()) / kDraws;
  }
  std::printf("sky outside;variance by power over variance by halves;%.3f\n", byPower / byPlace);
  CHECK(std::abs(difference) < 5 * std::sqrt(error));
  CHECK(byPower > 2 * byPlace);
}

}  // namespace vestige::test
