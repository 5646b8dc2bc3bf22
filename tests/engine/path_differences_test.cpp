// SPDX-License-Identifier: Apache-2.0
// Whole paths through the real engine: every differential at every vertex against differences of
// the path itself.
#include <fstream>

#include "support/catch.h"
#include "support/differences.h"
#include "support/path_trace.h"
#include "support/scenes.h"
#include "support/temp_folder.h"

using namespace vestige;
using namespace vestige::test;

namespace {

constexpr bool kDouble = sizeof(Real) == 8;
constexpr double kPathStep = kDouble ? 2e-4 : 4e-3;
/// Differences that disagree with those of half the step by more say nothing.
constexpr double kTrust = kDouble ? 1e-5 : 1e-2;

Value vec(double x, double y, double z) { return vectorValue({x, y, z}); }

/// A smooth ball as an OBJ file, its uv as on a globe, a little squashed.
void writeBall(const std::string& file, int columns, int rows) {
  std::ofstream out(file);
  for (int y = 0; y <= rows; ++y)
    for (int x = 0; x <= columns; ++x) {
      const double lon = 2 * M_PI * x / columns, lat = M_PI * (0.02 + 0.96 * y / rows);
      const double n[3] = {std::sin(lat) * std::cos(lon), std::cos(lat),
                           std::sin(lat) * std::sin(lon)};
      out << "v " << n[0] << ' ' << 0.8 * n[1] << ' ' << n[2] << "\nvn " << n[0] << ' '
          << n[1] / 0.8 << ' ' << n[2] << "\nvt " << double(x) / columns << ' ' << double(y) / rows
          << '\n';
    }
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      const int a = 1 + y * (columns + 1) + x, c = a + columns + 1;
      const auto corner = [&](int i) { out << ' ' << i << '/' << i << '/' << i; };
      out << "f", corner(a), corner(a + 1), corner(c + 1), out << "\nf", corner(a), corner(c + 1),
          corner(c), out << '\n';
    }
}

Block brdf(const std::string& name, Settings settings) {
  return makeBlock("brdf", name, std::move(settings));
}

Block placed(Block shape, const Affine& t) {
  shape.own = shape.world = t;
  for (Block& child : shape.children) child.world = t;
  return shape;
}

Affine at(double x, double y, double z, double size, double squash = 1, double turn = 0) {
  Affine a;
  const double c = std::cos(turn), s = std::sin(turn);
  a.m[0][0] = size * c, a.m[0][1] = -size * squash * s;
  a.m[1][0] = size * s, a.m[1][1] = size * squash * c, a.m[2][2] = size;
  a.m[0][3] = x, a.m[1][3] = y, a.m[2][3] = z;
  return a;
}

/// A closed room with a bit of everything: curved mirrors, glass, glossy and anisotropic metal,
/// meshes with smooth normals, stretched instances, a tilted normal map.
SceneDesc everything(const std::string& folder) {
  writeBall(folder + "/ball.obj", 24, 16);
  SceneDesc s = room(0.7, "path");
  std::erase_if(s.blocks,
                [](const Block& b) { return b.kind != "film" && b.kind != "integrator"; });
  s.blocks.push_back(makeBlock("camera", "thin_lens",
                               {{"location", vec(0.2, 0.1, -2.9)},
                                {"look_at", vec(0, 0, 0)},
                                {"angle", numberValue(70)},
                                {"aperture", numberValue(0.1)},
                                {"focal_point", vec(0, 0, 0.5)}}));
  const std::vector<Block> matt = {lambert(0.7)};
  const std::vector<Block> glossy = {
      brdf("phong", {{"specular", colourValue(0.8, 0.8, 0.8)}, {"exponent", numberValue(40)}})};
  s.blocks.push_back(quad({-3, -3, -3}, {6, 0, 0}, {0, 0, 6}, matt));
  s.blocks.push_back(quad({-3, 3, -3}, {6, 0, 0}, {0, 0, 6}, matt));
  s.blocks.push_back(quad({-3, -3, -3}, {6, 0, 0}, {0, 6, 0}, matt));
  s.blocks.push_back(quad({-3, -3, 3}, {6, 0, 0}, {0, 6, 0}, glossy));
  s.blocks.push_back(quad({-3, -3, -3}, {0, 6, 0}, {0, 0, 6}, matt));
  s.blocks.push_back(quad({3, -3, -3}, {0, 6, 0}, {0, 0, 6}, matt));
  // A tilted normal everywhere, as a map would say: both colours of the checker are the same.
  Value tilted;
  const Value map = colourValue(0.7, 0.4, 0.9);
  tilted.kind = Value::Kind::block;
  tilted.block = std::make_shared<const Block>(
      makeBlock("pigment", "checker", {{"first", map}, {"second", map}}));
  const auto unit = numberValue(1);
  s.blocks.push_back(
      placed(makeBlock("shape", "sphere", {{"center", vec(0, 0, 0)}, {"radius", unit}},
                       {brdf("rough_conductor", {{"alpha", numberValue(0.3)},
                                                 {"anisotropy", numberValue(0.4)},
                                                 {"normal_map", tilted}})}),
             at(2.0, 2.1, 1.0, 0.7, 1.3, 0.2)));
  s.blocks.push_back(
      placed(makeBlock("shape", "sphere", {{"center", vec(0, 0, 0)}, {"radius", unit}}, glossy),
             at(-1.3, 0.6, 0.5, 0.9)));
  s.blocks.push_back(placed(makeBlock("shape", "mesh", {{"file", textValue(folder + "/ball.obj")}},
                                      {brdf("rough_dielectric", {{"alpha", numberValue(0.15)},
                                                                 {"ior", numberValue(1.5)}})}),
                            at(1.1, 0.7, 0.3, 0.8)));
  s.blocks.push_back(placed(
      makeBlock("shape", "torus", {{"major_radius", unit}, {"minor_radius", numberValue(0.4)}},
                {brdf("rough_conductor",
                      {{"alpha", numberValue(0.3)}, {"anisotropy", numberValue(0.6)}})}),
      at(-1.2, -1.2, 0.6, 0.8, 0.9, 0.5)));
  s.blocks.push_back(
      placed(makeBlock("shape", "cone",
                       {{"base", vec(0, -1, 0)},
                        {"base_radius", unit},
                        {"cap", vec(0, 1, 0)},
                        {"cap_radius", numberValue(0.3)}},
                       {brdf("rough_conductor",
                             {{"alpha", numberValue(0.2)}, {"anisotropy", numberValue(0.5)}})}),
             at(1.2, -1.3, 0.7, 0.7, 1.2, -0.4)));
  s.blocks.push_back(
      placed(makeBlock("shape", "sphere", {{"center", vec(0, 0, 0)}, {"radius", unit}},
                       {brdf("glass", {{"ior", numberValue(1.5)}})}),
             at(0, 1.7, 1.2, 0.7, 0.6, 0.3)));
  s.blocks.push_back(placed(
      makeBlock(
          "shape", "cylinder", {{"base", vec(0, -1, 0)}, {"cap", vec(0, 1, 0)}, {"radius", unit}},
          {brdf("principled", {{"roughness", numberValue(0.4)}, {"metallic", numberValue(0.5)}})}),
      at(0, -0.2, 2.0, 0.5)));
  s.blocks.push_back(placed(
      makeBlock("shape", "mesh", {{"file", textValue(folder + "/ball.obj")}}, {brdf("mirror", {})}),
      at(-0.1, -2.2, 0.2, 0.6, 1.3, 0.8)));
  return s;
}

/// Errors of one kind, judged together.
struct Errors {
  std::vector<double> all;
  void add(double e) { all.push_back(std::isfinite(e) ? e : 1e30); }
  double at(double share) {
    REQUIRE(!all.empty());
    std::sort(all.begin(), all.end());
    return all[std::min(all.size() - 1, std::size_t(share * double(all.size())))];
  }
};

/// One number of the path moved by h.
PathNumbers moved(PathNumbers n, int j, double h) {
  Vec2& pair = n.pairs[std::size_t(j / 2)];
  (j % 2 == 0 ? pair.x : pair.y) += Real(h);
  return n;
}

/// Where a clamp of the module takes over, after which its answers are no derivatives.
bool isClamped(const TracedVertex& v) {
  return std::abs(dot(v.direction, v.surface.geometricNormal)) < 2 * kGrazing ||
         dot(v.x.frame.n, v.x.toPrev) < Real(0.01) ||
         (v.drawn && std::abs(v.drawn->toNext.z) < Real(0.01));
}

struct Judged {
  Errors position, direction, gradient;
  long asked = 0, judged = 0;
};

/// Compares at every vertex of one random path.
void judge(const PathTracer& tracer, const PathNumbers& n, int vertices, Judged& result) {
  std::vector<PathDifferentials> carried;
  const auto base = tracer.trace(n, vertices, nullptr, &carried);
  int last = 0;
  while (last < int(base.size()) && !(last > 0 && isClamped(base[std::size_t(last - 1)]))) ++last;
  if (last > 0 && isClamped(base[std::size_t(last - 1)])) --last;
  // Number j of the path is pair numbers[j / 2]: specular vertices use none.
  std::vector<int> numbers = {0, 1, 2, 3};
  for (int k = 0; k < last; ++k) {
    const PathDifferentials& d = carried[std::size_t(k)];
    REQUIRE(d.size() == int(numbers.size()));
    double largest = 0;
    for (int j = 0; j < d.size(); ++j) largest = std::max(largest, double(length(d.dVertex(j))));
    for (int j = 0; j < d.size(); ++j) {
      const int number = numbers[std::size_t(j)];
      if (!differsSmoothly(n.pairs[std::size_t(number / 2)], Real(3 * kPathStep))) continue;
      const double size = double(length(d.dVertex(j))) + double(length(d.dDirection(j)));
      const double h = kPathStep / std::max(1.0, size);
      const auto value = [&](auto pick) {
        return [&, pick](double x) -> std::optional<decltype(pick(base[0]))> {
          const auto p = tracer.trace(moved(n, number, x), k + 1, &base);
          if (int(p.size()) <= k) return std::nullopt;
          return pick(p[std::size_t(k)]);
        };
      };
      ++result.asked;
      const double scale = std::max(double(length(d.dVertex(j))), 0.01 * largest);
      const auto v = trustedDifference(
          value([](const TracedVertex& t) { return t.surface.position; }), h, kTrust * scale, 3);
      if (!v) continue;
      ++result.judged;
      result.position.add(double(length(d.dVertex(j) - *v)) /
                          std::max(double(length(*v)), 0.01 * largest));
      const auto dir =
          trustedDifference(value([](const TracedVertex& t) { return t.direction; }), h,
                            kTrust * std::max(1.0, double(length(d.dDirection(j)))));
      if (dir)
        result.direction.add(double(length(d.dDirection(j) - *dir)) /
                             std::max(1.0, double(length(*dir))));
      const auto g = trustedDifference(value([](const TracedVertex& t) { return t.logF; }), h,
                                       kTrust * std::max(1.0, double(std::abs(d.gradient(j)))), 5);
      if (g)
        result.gradient.add(std::abs(double(d.gradient(j) - *g)) /
                            std::max(1.0, std::abs(double(*g))));
    }
    if (base[std::size_t(k)].drawn && !base[std::size_t(k)].drawn->specular)
      numbers.push_back(2 * (k + 2)), numbers.push_back(2 * (k + 2) + 1);
    if (numbers.size() > 12) break;
  }
}

PathNumbers randomNumbers(Random& r, int vertices) {
  PathNumbers n;
  for (int i = 0; i < vertices + 2; ++i) n.pairs.push_back(r.pair());
  for (int i = 0; i < vertices; ++i) n.lobes.push_back(r.number());
  return n;
}

std::unique_ptr<Scene> built(const SceneDesc& description) {
  Diagnostics diagnostics;
  auto scene = buildScene(description, registry(), {}, diagnostics);
  for (const Diagnostic& d : diagnostics.list()) UNSCOPED_INFO(d.message);
  REQUIRE(scene);
  return scene;
}

}  // namespace

TEST_CASE("differentials of whole paths are the paths' derivatives", "[engine][footprint]") {
  const TempFolder folder;
  const auto scene = built(everything(folder.path()));
  const PathTracer tracer(*scene, 1);
  Random random(11);
  Judged result;
  for (int i = 0; i < 400; ++i) judge(tracer, randomNumbers(random, 6), 6, result);
  INFO("asked " << result.asked << ", judged " << result.judged);
  INFO("dV median " << result.position.at(0.5) << ", 99 % " << result.position.at(0.99));
  INFO("dD median " << result.direction.at(0.5) << ", 99 % " << result.direction.at(0.99));
  INFO("g median " << result.gradient.at(0.5) << ", 99 % " << result.gradient.at(0.99));
  CHECK(result.judged > result.asked / 2);
  for (Errors* e : {&result.position, &result.direction, &result.gradient}) {
    CHECK(e->at(0.5) < (kDouble ? 1e-6 : 2e-3));
    CHECK(e->at(0.99) < (kDouble ? 1e-4 : 2e-2));
  }
}
