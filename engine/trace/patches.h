// SPDX-License-Identifier: Apache-2.0
// The surfaces as parametric patches with true areas, made when first asked for.
#pragma once
#include <mutex>
#include <span>

#include "engine/trace/tree.h"

namespace vestige {

class Patches {
 public:
  /// Numbers the patches of each item; their areas come later.
  void number(const std::vector<Item>& items);
  /// Of a hit; -1 where the surface has no patches.
  int index(int item, int primitive) const noexcept;

  std::span<const Patch> all() const noexcept;
  /// The surface at patchUv, world.
  SurfacePoint point(int patch, Vec2 uv) const noexcept;
  /// World area of [low, high] of a patch's uv square: exact for triangles, by quadrature else.
  Real area(int patch, Vec2 low, Vec2 high) const noexcept;

 private:
  void make() const;
  int owner(int patch) const noexcept;

  const std::vector<Item>* items_ = nullptr;
  std::vector<int> first_;  ///< patch of each item, and one past the last
  mutable std::once_flag once_;
  mutable std::vector<Patch> patches_;
};

}  // namespace vestige
