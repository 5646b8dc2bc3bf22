// SPDX-License-Identifier: Apache-2.0
// How much noise a footprint takes away behind a glossy surface, held against an independent
// program's experiment: four stratified rays leave a Phong lobe for a textured wall
// (docs/footprints.md has the table). Theirs is numpy, its own sampler, derivatives and filter;
// ours the plugin, the footprint module and, for squares, the pigment's filter.
#include <vestige/footprint.h>
#include <vestige/pigment.h>

#include "support/catch.h"
#include "support/judge.h"
#include "support/plugins.h"

using namespace vestige;
using namespace vestige::test;

namespace {

constexpr Real kPixel = Real(0.02);  ///< side of the pixel's share of the glossy plane z = 0
constexpr int kPlaces = 500, kRuns = 24, kSplit = 4;

/// What the wall x = 2 shows at a point (y, z), or over a footprint there.
using Texture2d = std::function<double(Vec2 at, const Vec2 d[2])>;

double waves(Vec2 p) {
  double v = 0;
  for (const double f : {0.5, 1., 2., 4., 8.}) {
    const double a = double(p.x) * .8 + double(p.y) * .6, b = double(p.y) * .8 - double(p.x) * .6;
    v += std::sin(2 * M_PI * f * a + f) * std::sin(2 * M_PI * f * b + 2 * f) / std::sqrt(f);
  }
  return .5 + .25 * v;
}

double squaresAt(Vec2 p, double side) {
  const auto cell = [&](Real x) { return std::floor(double(x) / side); };
  return std::fmod(std::abs(cell(p.x) + cell(p.y)), 2);
}

/// The other program's filter: the mean over the parallelogram, by 8 x 8 points.
Texture2d byPoints(std::function<double(Vec2)> at) {
  return [at = std::move(at)](Vec2 p, const Vec2 d[2]) {
    if (dot(d[0], d[0]) + dot(d[1], d[1]) == 0) return at(p);
    double sum = 0;
    for (int i = 0; i < 64; ++i) {
      const Real a = (Real(i % 8) + Real(0.5)) / 8 - Real(0.5);
      const Real b = (Real(i / 8) + Real(0.5)) / 8 - Real(0.5);
      sum += at(p + a * d[0] + b * d[1]);
    }
    return sum / 64;
  };
}

/// The pigment's own filter, without such points' noise.
Texture2d squares(double side) {
  const std::shared_ptr<Pigment> checker =
      make<Pigment>(pluginNamed("pigment", "checker"), {{"first", colourValue(0, 0, 0)},
                                                        {"second", colourValue(1, 1, 1)},
                                                        {"mapping", textValue("uv")}});
  return [checker, side](Vec2 p, const Vec2 d[2]) {
    const Real k = Real(1 / side);
    return double(checker->eval({{}, k * p, {{}, {k * d[0], k * d[1]}}}).colour.r);
  };
}

class Experiment {
 public:
  Experiment(double exponent, Texture2d texture) : texture_(std::move(texture)) {
    const LoadedPlugin phong = pluginNamed("brdf", "phong");
    brdf_ = make<Brdf>(phong, {});
    inputs_ = inputsFor(*phong.schema, {{"exponent", numberValue(exponent)},
                                        {"specular", colourValue(1, 1, 1)},
                                        {"transmission", colourValue(0, 0, 0)}});
    x_.brdf = brdf_.get(), x_.toPrev = -arriving_;
    x_.frame = Frame::around({0, 0, 1}), x_.geometricNormal = {0, 0, 1};
    x_.point = {.toPrev = x_.frame.toLocal(x_.toPrev), .inputs = Inputs(inputs_.data())};
  }

  /// Mean over the rays of one pixel; rays that miss the wall count as black.
  double pixel(Vec2 offset, const FootprintSettings* settings, int strata, Random& r) const {
    const Vec2 film = r.pair();
    double sum = 0;
    for (int i = 0; i < strata * strata; ++i) {
      const Vec2 u = r.pair();
      const auto within = [&](Real v, int cell) { return (Real(cell) + v) / Real(strata); };
      sum += ray(film, {within(u.x, i % strata), within(u.y, i / strata)}, offset, settings);
    }
    return sum / (strata * strata);
  }

 private:
  double ray(Vec2 film, Vec2 u, Vec2 offset, const FootprintSettings* settings) const {
    Surface plane;
    plane.geometricNormal = plane.normal = {0, 0, 1};
    plane.dPdu = {1, 0, 0}, plane.dPdv = {0, 1, 0};
    plane.position = {(film.x - Real(0.5)) * kPixel, (film.y - Real(0.5)) * kPixel, 0};
    const ScatterNumbers numbers{0, u};
    const auto drawn = drawScatter(x_, numbers);
    if (!drawn || !(drawn->toNext.z > Real(1e-3)) || !(drawn->toNext.x > Real(0.05))) return 0;
    Surface wall;
    wall.geometricNormal = wall.normal = {-1, 0, 0};
    wall.dPdu = {0, 1, 0}, wall.dPdv = {0, 0, 1};
    wall.distance = (2 - plane.position.x) / drawn->toNext.x;
    wall.position = plane.position + wall.distance * drawn->toNext;
    Footprint region{};
    if (settings) {
      RayJacobian film;  // a camera far away: the pixel is a square of the plane
      film.dOrigin[0] = {kPixel, 0, 0}, film.dOrigin[1] = {0, kPixel, 0};
      PathFootprint<> f;
      f.begin(film, arriving_, 2, 0, 1, *settings, false);
      f.arrive(plane, 1000);
      f.scatter(plane, x_, *drawn, numbers, {2, 2});
      f.arrive(wall, 1000);
      region = f.footprint();
    }
    return texture_(Vec2{wall.position.y, wall.position.z} + offset, region.dUv);
  }

  Texture2d texture_;
  std::shared_ptr<Brdf> brdf_;
  InputBuffer inputs_{};
  Interaction x_;
  Vec3 arriving_ = normalize(Vec3{1, 0, -1});
};

struct Error {
  double variance = 0, square = 0;
};

/// Over many places of the texture: kRuns pixels each against a reference of many rays.
std::array<Error, 3> errors(const Experiment& e) {
  FootprintSettings local, igehy;
  local.deltas.bound = Bound::local, igehy.deltas.bound = Bound::pixel;
  const FootprintSettings* const modes[3] = {nullptr, &local, &igehy};
  std::array<Error, 3> result;
  Random r(5);
  for (int place = 0; place < kPlaces; ++place) {
    const Vec2 offset = Real(50) * r.pair();
    double reference = 0;
    constexpr int kReference = 20, kStrata = 32;
    for (int i = 0; i < kReference; ++i)
      reference += e.pixel(offset, nullptr, kStrata, r) / kReference;
    for (int m = 0; m < 3; ++m) {
      double sum = 0, squares = 0, errorSquares = 0;
      for (int i = 0; i < kRuns; ++i) {
        const double v = e.pixel(offset, modes[m], 2, r);
        sum += v, squares += v * v, errorSquares += (v - reference) * (v - reference);
      }
      result[std::size_t(m)].variance += (squares - sum * sum / kRuns) / (kRuns - 1) / kPlaces;
      result[std::size_t(m)].square += errorSquares / kRuns / kPlaces;
    }
  }
  return result;
}

/// What the other program found: the variance and the mean square error of no filter over those of
/// `local` with covariance.
struct Theirs {
  double side;  ///< of squares; 0: waves
  double exponent, variance, square;
};
constexpr Theirs kTheirs[] = {
    {0.25, 10, 67.7, 67.3}, {0.25, 40, 163.2, 159.2}, {0.25, 200, 86.2, 82.6},
    {1, 10, 47.1, 44.7},    {1, 40, 11.8, 10.6},      {1, 200, 3.8, 3.5},
    {0, 10, 14.3, 13.0},    {0, 40, 10.9, 8.5},       {0, 200, 4.1, 3.7}};

struct Won {
  double variance, square, igehy;
};
Won won(double exponent, const Texture2d& texture) {
  const auto [none, local, igehy] = errors(Experiment(exponent, texture));
  return {none.variance / local.variance, none.square / local.square, none.square / igehy.square};
}

}  // namespace

TEST_CASE("behind a glossy surface footprints win what another program says", "[slow][footprint]") {
  std::printf("glossy wall;exponent;variance ratio (theirs, pigment's);mse ratio;igehy\n");
  for (const Theirs& t : kTheirs) {
    const auto at = [&](Vec2 p) { return t.side > 0 ? squaresAt(p, t.side) : waves(p); };
    const Won points = won(t.exponent, byPoints(at));
    INFO("side " << t.side << ", exponent " << t.exponent);
    CHECK(points.variance == Approx(t.variance).epsilon(0.1));
    CHECK(points.square == Approx(t.square).epsilon(0.1));
    CHECK(points.igehy < 1.25);  // the film's numbers alone win next to nothing
    Won own = points;
    if (t.side > 0) own = won(t.exponent, squares(t.side));
    std::printf("side %g;%g;%.1f (%.1f, %.1f);%.1f (%.1f, %.1f);%.2f\n", t.side, t.exponent,
                points.variance, t.variance, own.variance, points.square, t.square, own.square,
                points.igehy);
    CHECK(own.square > 0.95 * points.square);
  }
}
