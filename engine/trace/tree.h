// SPDX-License-Identifier: Apache-2.0
// Every placement in one Embree scene: which of them a ray meets first, or whether any.
#pragma once
#include <array>
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
  Real inside = 0;                       ///< of a finite shape: rounding error by its size alone
  std::uint32_t solid = 0;               ///< its number, if it is a dielectric solid
  /// Shadow rays do not end there but look at it: translucent, or a solid that meets others, whose
  /// boundary may not be there.
  bool isLayer = false;
};

/// Which placements a ray may meet: eight bits of kinds for opaque ones, eight for translucent
/// ones.
inline constexpr unsigned opaque(RayKind k) noexcept { return bits(k); }
inline constexpr unsigned translucent(RayKind k) noexcept { return bits(k) << 8; }
inline constexpr unsigned everything(RayKind k) noexcept { return opaque(k) | translucent(k); }

struct TreeHit {
  int item;
  int primitive;  ///< triangle, or part of an analytic shape
  Real t;         ///< lengths of ray.direction
  Vec2 b{};       ///< barycentric; of an analytic shape ShapeHit::uv
};

/// Along a ray; ties are broken by what was met.
inline bool operator<(const TreeHit& a, const TreeHit& b) noexcept {
  if (a.t != b.t) return a.t < b.t;
  return a.item != b.item ? a.item < b.item : a.primitive < b.primitive;
}

/// The nearest translucent surfaces along a ray, in whatever order Embree finds them. Where there
/// are more than fit, the ray is traced again for those beyond.
class Layers {
 public:
  static constexpr int kMost = 64;

  void add(const TreeHit& hit) noexcept;
  /// Sorts them and keeps one of an item at one t. Surfaces at the same t stay together: the last
  /// ones are left to the next round where some of them may not have fitted.
  void settle() noexcept;
  std::span<const TreeHit> hits() const noexcept { return {hits_.data(), std::size_t(count_)}; }
  bool isCut() const noexcept { return isCut_; }
  /// Empties it; what lies up to the last hit is ignored from now on. Returns its t.
  Real goOn() noexcept;

 private:
  std::array<TreeHit, kMost> hits_;  ///< a heap once it is full: the farthest first
  int count_ = 0;
  bool isCut_ = false, hasBegun_ = false;
  TreeHit last_{};  ///< of the round before, if hasBegun_
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
  /// Adds the translucent surfaces along the ray. False: it meets an opaque one, and `layers` means
  /// nothing. `from`: where the search may begin, see Layers::goOn().
  bool gather(const Ray& ray, unsigned mask, Real from, Layers& layers) const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vestige
