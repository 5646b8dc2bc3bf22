// SPDX-License-Identifier: Apache-2.0
// Footprints of whole paths: special cases with an answer of their own, and what must not change
// them.
#include "engine/picture/image.h"
#include "support/catch.h"
#include "support/path_trace.h"
#include "support/room_of_everything.h"

using namespace vestige;
using namespace vestige::test;

namespace {

/// Mirror balls and a glass ball in a room of mirrors.
SceneDesc mirrors() {
  SceneDesc s;
  const std::vector<Block> mirror = {brdf("mirror", {})};
  const std::vector<Block> glass = {brdf("glass", {{"ior", numberValue(1.5)}})};
  const auto ball = [&](Vec3 centre, double radius, const std::vector<Block>& wears) {
    return makeBlock(
        "shape", "sphere",
        {{"centre", vec(centre.x, centre.y, centre.z)}, {"radius", numberValue(radius)}}, wears);
  };
  s.blocks = {
      makeBlock(
          "camera", "pinhole",
          {{"location", vec(0, 0, -2.9)}, {"look_at", vec(0, 0, 1)}, {"angle", numberValue(60)}}),
      makeBlock("film", "", {{"resolution", vectorValue({32, 32})}}),
      makeBlock("integrator", "path"),
      ball({-1, 0, 1}, 0.9, mirror),
      ball({1, Real(0.4), 1}, 0.8, glass),
      quad({-3, -3, 3}, {6, 0, 0}, {0, 6, 0}, mirror),
      quad({-3, -3, -3}, {0, 6, 0}, {0, 0, 6}, mirror),
      quad({3, -3, -3}, {0, 6, 0}, {0, 0, 6}, mirror),
      quad({-3, -3, -3}, {6, 0, 0}, {0, 0, 6}, mirror),
      quad({-3, 3, -3}, {6, 0, 0}, {0, 0, 6}, mirror)};
  return s;
}

/// One ray differential as [Ige99] carries it: transfer (Eq. 10), reflection (14), refraction (17).
struct Igehy {
  Vec3 dP, dD;

  void transfer(Vec3 d, Real t, Vec3 n) {
    const Vec3 moved = dP + t * dD;
    dP = moved - dot(moved, n) / dot(d, n) * d;
  }
  /// n faces the ray, dN its change.
  void reflect(Vec3 d, Vec3 n, Vec3 dN) {
    const Real dDn = dot(dD, n) + dot(d, dN);
    dD = dD - Real(2) * (dot(d, n) * dN + dDn * n);
  }
  void refract(Vec3 d, Vec3 n, Vec3 dN, Real eta) {  // eta = n_i / n_t
    const Real dn = dot(d, n), dDn = dot(dD, n) + dot(d, dN);
    const Real tn = -std::sqrt(1 - eta * eta * (1 - dn * dn));
    const Real mu = eta * dn - tn, dMu = (eta - eta * eta * dn / tn) * dDn;
    dD = eta * dD - (mu * dN + dMu * n);
  }
};

/// A smooth picture of 16 x 8 texels, none of them black; its file.
std::string writeWaves(const std::string& folder) {
  Image image{16, 8, {"R", "G", "B"}, {}, {}};
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 16; ++x)
      image.pixels.insert(image.pixels.end(), 3,
                          float(1 + 0.3 * y + 0.5 * std::sin(2 * M_PI * (x + 0.5) / 16)));
  const std::string file = folder + "/waves.exr";
  std::string error;
  REQUIRE(writeImage(file, image, {}, error));
  return file;
}

Value pigment(const std::string& name, Settings settings) {
  Value v;
  v.kind = Value::Kind::block;
  v.block = std::make_shared<const Block>(makeBlock("pigment", name, std::move(settings)));
  return v;
}

Block shining(Block shape, const Value& emission) {
  shape.settings.push_back({"emission", emission, {}});
  return shape;
}

double relative(Vec3 a, Vec3 b) {
  return double(length(a - b)) / std::max(1e-6, double(length(b)));
}

}  // namespace

TEST_CASE("paths of mirrors and smooth glass carry Igehy's ray differentials",
          "[engine][footprint]") {
  const auto scene = built(mirrors());
  const PathTracer tracer(*scene, 1);
  Random random(5);
  int compared = 0;
  for (int i = 0; i < 500; ++i) {
    const PathNumbers n = randomNumbers(random, 6);
    std::vector<PathDifferentials> carried;
    const auto path = tracer.trace(n, 6, nullptr, &carried);
    const RayJacobian start = scene->camera().sampleDerivatives({n.pairs[0], n.pairs[1], 1});
    Igehy ray[2] = {{{}, start.dDirection[0]}, {{}, start.dDirection[1]}};
    for (std::size_t k = 0; k < path.size() && !isClamped(path[k]); ++k) {
      const TracedVertex& v = path[k];
      REQUIRE(carried[k].size() == 2);
      for (int j = 0; j < 2; ++j) {
        ray[j].transfer(v.direction, v.surface.distance, v.surface.geometricNormal);
        CHECK(relative(carried[k].dVertex(j), ray[j].dP) < (sizeof(Real) == 8 ? 1e-9 : 2e-3));
        CHECK(relative(carried[k].dDirection(j), ray[j].dD) < (sizeof(Real) == 8 ? 1e-9 : 2e-3));
        CHECK(carried[k].gradient(j) == 0);
        ++compared;
        if (!v.drawn) continue;
        const ObjectInfo& o = scene->object(v.surface.object);
        const Vec3 facing = v.x.frame.n;
        const Real radius = o.brdf == "glass" ? Real(0.8) : Real(0.9);
        const Vec3 outwards = v.surface.geometricNormal;
        const Real side = dot(outwards, facing) > 0 ? Real(1) : Real(-1);
        const Vec3 dN = o.shape == "sphere" ? side / radius * ray[j].dP : Vec3{};
        if (v.drawn->toNext.z > 0)
          ray[j].reflect(v.direction, facing, dN);
        else
          ray[j].refract(v.direction, facing, dN, side > 0 ? 1 / Real(1.5) : Real(1.5));
      }
    }
  }
  CHECK(compared > 2000);
}

TEST_CASE("the lens moves nothing on the plane of focus", "[engine][footprint]") {
  SceneDesc s;
  s.blocks = {makeBlock("camera", "thin_lens",
                        {{"location", vec(0.3, 0.2, -2)},
                         {"look_at", vec(0.3, 0.2, 1)},
                         {"angle", numberValue(50)},
                         {"aperture", numberValue(0.4)},
                         {"focal_point", vec(0, 0, 1)}}),
              makeBlock("film", "", {{"resolution", vectorValue({32, 32})}}),
              makeBlock("integrator", "path"),
              quad({-5, -5, 1}, {10, 0, 0}, {0, 10, 0}, {lambert(0.5)})};
  const auto scene = built(s);
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    std::vector<PathDifferentials> carried;
    PathTracer(*scene, 1).trace(randomNumbers(random, 1), 1, nullptr, &carried);
    REQUIRE(carried.size() == 1);
    REQUIRE(carried[0].size() == 4);
    CHECK(length(carried[0].dVertex(0)) > 1);
    CHECK(length(carried[0].dVertex(2)) < (sizeof(Real) == 8 ? 1e-12 : 2e-6));
    CHECK(length(carried[0].dVertex(3)) < (sizeof(Real) == 8 ? 1e-12 : 2e-6));
    CHECK(length(carried[0].dDirection(2)) > Real(0.01));  // but it does move the direction
  }
}

TEST_CASE("connections to lights move as differences say", "[engine][footprint]") {
  struct Lamp {
    const char* name;
    LightMeasure measure;
    Block block;
  };
  const TempFolder folder;
  const auto white = colourValue(5, 5, 5);
  const auto waves = textValue(writeWaves(folder.path()));
  const Lamp lamps[] = {
      {"area, constant", LightMeasure::constant,
       makeBlock("light", "area",
                 {{"corner", vec(-0.5, 2.9, -0.5)},
                  {"edge1", vec(1, 0, 0)},
                  {"edge2", vec(0, 0, 1)},
                  {"radiance", white}})},
      {"area", LightMeasure::area,
       makeBlock("light", "area",
                 {{"corner", vec(-0.5, 2.9, -0.5)},
                  {"edge1", vec(1, 0, 0)},
                  {"edge2", vec(0, 0, 1)},
                  {"radiance", white}})},
      {"textured quad", LightMeasure::area,
       shining(quad({Real(-0.5), Real(2.9), Real(-0.5)}, {1, 0, 0}, {0, 0, 1}, {lambert(0.5)}),
               pigment("image", {{"file", waves}, {"color_space", textValue("raw")}}))},
      // Squashed, so that its points are drawn by area: for a round ball see shape_light_test.cpp.
      {"textured ellipsoid", LightMeasure::area,
       placed(shining(
                  makeBlock("shape", "sphere",
                            {{"centre", vec(0, 0, 0)}, {"radius", numberValue(1)}}, {lambert(0.5)}),
                  pigment("gradient", {{"first", colourValue(1, 1, 1)},
                                       {"second", colourValue(3, 3, 3)},
                                       {"direction", vec(0.2, 0.1, 0)}})),
              at(-2.2, 2.3, 0, 0.5, 1.3))},
      {"point", LightMeasure::direction,
       makeBlock("light", "point", {{"location", vec(0.3, 2.5, -0.5)}, {"intensity", white}})},
      {"spot", LightMeasure::direction,
       makeBlock("light", "spot",
                 {{"location", vec(0.3, 2.8, -1)},
                  {"point_at", vec(0, 0, 0.5)},
                  {"radius", numberValue(5)},
                  {"falloff", numberValue(70)},
                  {"intensity", white}})},
      {"environment", LightMeasure::direction,
       makeBlock("light", "environment", {{"map", waves}})}};
  for (const Lamp& lamp : lamps) {
    SceneDesc description = everything(folder.path());
    description.blocks.push_back(lamp.block);
    const auto scene = built(description);
    const Light& light = *scene->view().lights()[0];
    const PathTracer tracer(*scene, 1);
    Random random(17);
    Judged result;
    for (int i = 0; i < 300; ++i)
      judgeConnection(tracer, light, lamp.measure, randomNumbers(random, 3), random.pair(), result);
    INFO(lamp.name << ": asked " << result.asked << ", judged " << result.judged);
    INFO("direction " << result.direction.at(0.5) << ", 99 % " << result.direction.at(0.99));
    INFO("g of " << result.gradient.all.size() << ": " << result.gradient.at(0.5) << ", 99 % "
                 << result.gradient.at(0.99));
    CHECK(result.judged > result.asked / 2);
    CHECK(result.gradient.all.size() > 200);
    checkErrors(result.direction);
    checkErrors(result.gradient);
  }
}

TEST_CASE("footprints do not change with the sign of a number or with reduction",
          "[engine][footprint]") {
  const TempFolder folder;
  const auto scene = built(everything(folder.path()));
  Random random(23);
  FootprintSettings settings;
  settings.deltas.bound = Bound::safe;  // delta 3e-6: nothing is wider than a sphere
  constexpr std::uint64_t kIndex = 20000000;
  double worstArea = 0, worstReduced = 0;
  int reduced = 0;
  for (int i = 0; i < 300; ++i) {
    const PathNumbers path = randomNumbers(random, 7);
    const CameraNumbers film{path.pairs[0], path.pairs[1], 1};
    RayJacobian jacobian = scene->camera().sampleDerivatives(film), flipped = jacobian;
    flipped.dDirection[1] = -flipped.dDirection[1], flipped.dOrigin[1] = -flipped.dOrigin[1];
    flipped.dDirection[2] = -flipped.dDirection[2], flipped.dOrigin[2] = -flipped.dOrigin[2];
    PathFootprint<20> whole, other;
    PathFootprint<8> small;
    const auto traced = PathTracer(*scene, 1).trace(path, 7);
    if (traced.empty()) continue;
    const Vec3 start = traced[0].direction;
    whole.begin(jacobian, start, 4, kIndex, 0, settings);
    other.begin(flipped, start, 4, kIndex, 0, settings);
    small.begin(jacobian, start, 4, kIndex, 0, settings);
    std::size_t k = 0;
    for (const TracedVertex& v : traced) {
      const Vec3 n = v.surface.geometricNormal;
      for (auto* f : {&whole, &other}) f->arrive(v.surface, 1e9);
      small.arrive(v.surface, 1e9);
      if (isClamped(v) || !v.drawn) break;
      const double scale = std::max(1e-6, double(covariance(whole.footprint(), n, 0)));
      for (int entry = 0; entry < 3; ++entry) {
        const double w = double(covariance(whole.footprint(), n, entry));
        worstArea = std::max(worstArea,
                             std::abs(w - double(covariance(other.footprint(), n, entry))) / scale);
        worstReduced = std::max(
            worstReduced, std::abs(w - double(covariance(small.footprint(), n, entry))) / scale);
      }
      reduced += whole.differentials().size() > 8;
      CHECK(whole.area() == Approx(double(other.area())).epsilon(1e-4));
      const ScatterNumbers numbers{path.lobes[k], path.pairs[k + 2]};
      ++k;
      const Scatter drawn{normalize(v.x.frame.toWorld(v.drawn->toNext)), {}, *v.drawn};
      for (auto* f : {&whole, &other}) f->scatter(v.surface, v.x, drawn, numbers);
      small.scatter(v.surface, v.x, drawn, numbers);
    }
  }
  CHECK(reduced > 100);
  CHECK(worstArea < (sizeof(Real) == 8 ? 1e-9 : 1e-3));
  CHECK(worstReduced < (sizeof(Real) == 8 ? 1e-6 : 1e-2));
}
