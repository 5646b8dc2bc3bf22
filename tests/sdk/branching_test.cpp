// SPDX-License-Identifier: Apache-2.0
// Which random numbers the branches of a path draw, and the layers between its vertices.
#include <vestige/tools/branching.h>
#include <vestige/tools/layers.h>

#include <set>
#include <utility>
#include <vector>

#include "support/catch.h"

using namespace vestige;

namespace {

/// All that decides which numbers a stream gives at the end of an edge.
std::pair<std::uint32_t, std::uint32_t> key(const RandomStream& s, int edge) {
  return {s.index, s.vertex(edge)};
}

/// How many cells of a grid of columns x rows the pairs of a split's children fall into.
std::size_t cellsMet(const RandomStream& parent, int count, int columns, int rows) {
  const Sampler sampler(5, 7, 0, 1);
  const SplitStrata split(count);
  std::set<int> cells;
  for (int i = 0; i < count; ++i) {
    const RandomStream s = parent.child(count, i);
    const std::uint32_t dim = dimension::vertex(s.vertex(2)) + dimension::kDirection;
    const Vec2 u = split.pair(sampler, dim, s.index, i);
    cells.insert(int(u.x * Real(columns)) * rows + int(u.y * Real(rows)));
  }
  return cells.size();
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  double ab = 0, aa = 0, bb = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ab += (a[i] - 0.5) * (b[i] - 0.5);
    aa += (a[i] - 0.5) * (a[i] - 0.5);
    bb += (b[i] - 0.5) * (b[i] - 0.5);
  }
  return ab / std::sqrt(aa * bb);
}

}  // namespace

TEST_CASE("nodes deep in a tree of rays share no random numbers", "[sdk][branching]") {
  for (const int split : {256, 100, 4}) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> met;
    constexpr int kDepth = 40;
    std::size_t nodes = 0;
    // One leaf a sample, at the same place in the tree: only the first index tells them apart.
    for (std::uint32_t sample = 0; sample < 500; ++sample) {
      RandomStream s{sample};
      for (int edge = 1; edge < kDepth; ++edge) {
        s = s.child(split, edge % split);
        met.insert(key(s, edge + 1));
        ++nodes;
      }
    }
    INFO("split " << split);
    CHECK(met.size() == nodes);
  }
}

TEST_CASE("siblings are stratified at any depth of a tree", "[sdk][branching]") {
  for (const std::uint32_t index : {0u, 3u, 0x00ffffffu, 0x0fffffffu, 0x10000000u, 0xfffffffeu}) {
    INFO("parent " << index);
    CHECK(cellsMet({index}, 16, 4, 4) == 16);
    CHECK(cellsMet({index}, 16, 16, 1) == 16);
    CHECK(cellsMet({index}, 6, 3, 2) == 6);
    CHECK(cellsMet({index, 77}, 256, 16, 16) == 256);
  }
}

TEST_CASE("the branches of a fork draw independent numbers", "[sdk][branching]") {
  constexpr std::uint32_t kSamples = 4096;
  for (const int edge : {2, 3, 9}) {
    std::vector<double> first, second;
    for (std::uint32_t i = 0; i < kSamples; ++i) {
      const Sampler sampler(11, 13, i, 1);
      const RandomStream one{i}, two = one.forked();
      const auto number = [&](const RandomStream& s) {
        const std::uint32_t dim = dimension::vertex(s.vertex(edge)) + dimension::kLobe;
        return double(sampler.number(dim, s.index));
      };
      first.push_back(number(one));
      second.push_back(number(two));
    }
    CHECK(std::abs(correlation(first, second)) < 5 / std::sqrt(double(kSamples)));
  }
}

TEST_CASE("layers have dimensions of their own", "[sdk][branching]") {
  std::set<std::uint32_t> met;
  constexpr std::uint32_t kVertices = 16, kLayers = 20000;
  for (std::uint32_t vertex = 0; vertex < kVertices; ++vertex) {
    for (std::uint32_t offset = 0; offset + 1 < dimension::kPerVertex; ++offset)
      met.insert(dimension::vertex(vertex) + offset);
    for (std::uint32_t layer = 0; layer < kLayers; ++layer)
      met.insert(layerDimension(vertex, layer));
  }
  CHECK(met.size() == kVertices * (dimension::kPerVertex - 1 + kLayers));
  // Far more layers than of any scene, before one vertex.
  met.clear();
  for (std::uint32_t layer = 0; layer < 200000; ++layer) met.insert(layerDimension(0, layer));
  CHECK(met.size() == 200000);
}
