// SPDX-License-Identifier: Apache-2.0
// From the flux in the elements to an irradiance everywhere: push, then a balanced subdivision with
// a value at each vertex, shared by all elements and patches that meet there, so that nothing jumps
// and nothing cracks.
//
// E(x) = sum over the elements a that hold x, from the largest cluster down, of flux_a / area_a.
#pragma once
#include <vector>

#include "hierarchy.h"

namespace vestige::particle {

/// What the picture shows of an element.
struct ElementInfo {
  int level = 0;         ///< divisions below its patch; -1: it lies in a cluster
  std::uint32_t id = 0;  ///< 24 bits; neighbours differ
};

/// The same and more, for an inspected pixel.
struct SeenElement {
  int level = 0;
  std::uint32_t id = 0;
  Real area = 0;           ///< scene units squared
  Rgb flux;                ///< W that arrive in it, with its share of the wider elements above it
  std::uint64_t hits = 0;  ///< particles that left their flux in it and in no wider one
};

class Irradiance {
 public:
  Irradiance() = default;
  /// `scale`: W/m^2 of one unit of flux on one unit of area.
  Irradiance(const SceneView& scene, const Hierarchy& hierarchy, double scale);

  /// Whether light is kept at a point; if not, rays have to find it. An empty one covers nothing.
  bool covers(const PatchPoint& p) const noexcept;
  /// W/m^2, blended between vertices; constant on each element if not `smooth`. [any thread]
  Rgb at(const PatchPoint& p, bool smooth) const noexcept;
  /// All zero where no light is kept.
  ElementInfo element(const PatchPoint& p) const noexcept;
  SeenElement seen(const PatchPoint& p) const noexcept;

  std::size_t leaves() const noexcept { return leaves_; }

 private:
  struct Node {
    std::uint32_t children = 0;  ///< the first of four; 0: a leaf
    std::uint32_t vertices[4] = {};
    Rgb e;
    std::int8_t level = 0;
    bool isAdded = false;  ///< by balancing
  };
  struct Leaf {
    std::uint32_t node, root;
    Cell cell;
    int depth;
  };
  struct Vertex {
    Vec3 position, normal;
    Rgb sum;
    int count = 0;
    std::uint32_t next = 0;  ///< in the same cell of the grid
  };
  /// A vertex in the middle of the longest edge that it lies on; length 0: of none.
  struct Between {
    std::uint32_t a = 0, b = 0;
    Real length = 0;
    bool isSettled = false;
  };
  class Build;

  struct Found {
    const Node* node;
    Vec2 local;
    std::uint32_t path;
  };
  Found find(const PatchPoint& p) const noexcept;

  const Hierarchy* hierarchy_ = nullptr;
  std::vector<std::uint32_t> roots_;  ///< by element id of the root; 0: dark
  std::vector<Node> nodes_;
  std::vector<Rgb> values_;  ///< by vertex
  std::size_t leaves_ = 0;
};

}  // namespace vestige::particle
