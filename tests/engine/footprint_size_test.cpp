// SPDX-License-Identifier: Apache-2.0
// What a footprint means: it is as large as the way to the neighbouring sample. Measured on planes
// behind a glossy lobe and behind two diffuse bounces, for several numbers of samples.
#include <cstdio>
#include <functional>

#include "support/room_of_everything.h"

using namespace vestige;
using namespace vestige::test;

namespace {

/// Three walls far enough across to catch what leaves another.
SceneDesc corner(const Block& floor) {
  SceneDesc s;
  s.blocks = {
      makeBlock(
          "camera", "pinhole",
          {{"location", vec(0, 2, -4)}, {"look_at", vec(0, 0, 0)}, {"angle", numberValue(40)}}),
      makeBlock("film", "", {{"resolution", vectorValue({32, 32})}}),
      makeBlock("integrator", "path"),
      quad({-500, 0, -500}, {1000, 0, 0}, {0, 0, 1000}, {floor}),
      quad({-500, -1, 3}, {1000, 0, 0}, {0, 1000, 0}, {lambert(0.5)}),
      quad({-500, 6, -500}, {1000, 0, 0}, {0, 0, 1000}, {lambert(0.5)})};
  return s;
}

/// Where one sample ended, what drew it, and what its footprint says.
struct Landed {
  std::vector<Vec2> pairs;
  Vec3 position;
  double size;  ///< root mean square of the footprint's two axes
};

/// Samples that follow the middle of the film to `vertices` surfaces, the ones named.
std::vector<Landed> land(const Scene& scene, int samples, int vertices,
                         const std::vector<int>& objects, const FootprintSettings& settings,
                         Real strata) {
  std::vector<Landed> all;
  for (int i = 0; i < samples; ++i) {
    const Sampler sampler(3, 5, std::uint32_t(i), 7);
    PathNumbers n;
    n.pairs = {{Real(0.5), Real(0.5)}, {}};
    Landed landed;
    for (int k = 0; k < vertices; ++k) {
      n.pairs.push_back(sampler.pair(dimension::vertex(std::uint32_t(k))));
      if (k + 1 < vertices) landed.pairs.push_back(n.pairs.back());
      n.lobes.push_back(Real(0.5));
    }
    const auto path = PathTracer(scene, 1).trace(n, vertices);
    if (int(path.size()) < vertices) continue;
    bool isWanted = true;
    for (int k = 0; k < vertices; ++k)
      isWanted &= path[std::size_t(k)].surface.object == objects[std::size_t(k)];
    if (!isWanted) continue;
    PathFootprint<8> f;
    f.begin({}, path[0].direction, 0, std::uint64_t(i), std::uint64_t(samples), settings);
    for (int k = 0; k < vertices; ++k) {
      const TracedVertex& v = path[std::size_t(k)];
      f.arrive(v.surface, Real(1e9));
      if (k + 1 == vertices) break;
      const ScatterNumbers numbers{n.lobes[std::size_t(k)], n.pairs[std::size_t(k + 2)]};
      f.scatter(v.surface, v.x, {normalize(v.x.frame.toWorld(v.drawn->toNext)), {}, *v.drawn},
                numbers, {strata, strata});
    }
    const TracedVertex& last = path.back();
    landed.position = last.surface.position;
    landed.size = std::sqrt(double(covariance(f.footprint(), last.surface.geometricNormal, 0)) / 2);
    all.push_back(landed);
  }
  return all;
}

/// Farthest of all numbers, max norm.
double apart(const Landed& a, const Landed& b) {
  double most = 0;
  for (std::size_t k = 0; k < a.pairs.size(); ++k)
    most = std::max({most, std::abs(double(a.pairs[k].x - b.pairs[k].x)),
                     std::abs(double(a.pairs[k].y - b.pairs[k].y))});
  return most;
}

/// Median of (way to the neighbour's point) / (size of the footprint). The neighbour is the sample
/// with the nearest numbers.
double medianRatio(const std::vector<Landed>& all) {
  std::vector<double> ratios;
  for (const Landed& a : all) {
    const Landed* nearest = nullptr;
    for (const Landed& b : all)
      if (&a != &b && (!nearest || apart(a, b) < apart(a, *nearest))) nearest = &b;
    if (nearest) ratios.push_back(double(length(a.position - nearest->position)) / a.size);
  }
  REQUIRE(ratios.size() > 3);
  std::nth_element(ratios.begin(), ratios.begin() + std::ptrdiff_t(ratios.size() / 2),
                   ratios.end());
  return ratios[ratios.size() / 2];
}

struct Series {
  const char* name;
  std::vector<double> ratios;
};

/// One series a case, one ratio for each number of samples.
std::vector<Series> measure(const std::vector<int>& counts) {
  FootprintSettings local, global;
  local.deltas.bound = Bound::local, global.deltas.bound = Bound::global;
  const auto glossy = built(corner(
      brdf("phong", {{"specular", colourValue(0.9, 0.9, 0.9)}, {"exponent", numberValue(40)}})));
  const auto matt = built(corner(lambert(0.5)));
  std::vector<Series> all = {{"behind a Phong lobe, local deltas", {}},
                             {"behind two diffuse bounces, global deltas", {}}};
  for (const int n : counts) {
    const Real strata = std::sqrt(Real(n));
    all[0].ratios.push_back(medianRatio(land(*glossy, n, 2, {0, 1}, local, strata)));
    all[1].ratios.push_back(medianRatio(land(*matt, 4 * n, 3, {0, 1, 2}, global, 1)));
  }
  return all;
}

}  // namespace

TEST_CASE("a footprint is as large as the way to the neighbouring sample", "[engine][footprint]") {
  const std::vector<int> counts = {16, 64, 256, 1024};
  for (const Series& s : measure(counts)) {
    double least = 1e9, most = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
      INFO(s.name << ", " << counts[i] << " samples: " << s.ratios[i]);
      // Nearest of the points of a net: about half of the spacing [MATH 3.2].
      CHECK(s.ratios[i] > 0.25);
      CHECK(s.ratios[i] < 1);
      least = std::min(least, s.ratios[i]), most = std::max(most, s.ratios[i]);
    }
    CHECK(most < 1.8 * least);
  }
}

// The numbers of docs/images/neighbours.svg: test_engine "[.neighbours]" |
// docs/figures/neighbours.py
TEST_CASE("table of footprints and neighbours", "[.neighbours]") {
  const std::vector<int> counts = {16, 64, 256, 1024, 4096};
  const auto all = measure(counts);
  for (const Series& s : all)
    for (std::size_t i = 0; i < counts.size(); ++i)
      std::printf("neighbours;%s;%d;%.4f\n", s.name, counts[i], s.ratios[i]);
}
