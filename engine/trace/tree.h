// SPDX-License-Identifier: Apache-2.0
// Every placement in one Embree scene: which of them a ray meets first, or whether any.
#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "engine/trace/place.h"
#include "engine/trace/triangles.h"
#include "engine/trace/world.h"

namespace vestige {

/// A placement, ready to be traced.
struct Item {
  explicit Item(const Placement& p) : placement(p), place(p.toWorld) {}
  Placement placement;
  Place place;
  const Triangles* triangles = nullptr;  ///< null: analytic
  bool baked = false;                    ///< the triangles are in world space already
  Bounds bounds;                         ///< world
};

/// Kinds of placement that a ray may ask for.
enum Mask : unsigned { kOpaque = 1, kTranslucent = 2, kEverything = 3 };

struct TreeHit {
  int item;
  int primitive;  ///< triangle, or part of an analytic shape
  Real t;         ///< lengths of ray.direction
  Vec2 b{};       ///< barycentric, triangles only
};

class Tree {
 public:
  Tree();
  ~Tree();

  /// `items` stay where they are as long as the tree lives. Trees of instanced meshes are shared
  /// with `before`, if not null, where it has them. Throws where Embree fails.
  void build(const std::vector<Item>& items, const Tree* before = nullptr);

  /// False: the ray meets nothing.
  bool closest(const Ray& ray, unsigned mask, TreeHit& hit) const noexcept;
  bool occluded(const Ray& ray, unsigned mask) const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vestige
