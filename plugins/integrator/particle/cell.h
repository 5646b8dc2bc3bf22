// SPDX-License-Identifier: Apache-2.0
// Regular division of a patch into four: squares into squares, triangles into triangles.
#pragma once
#include <vestige/math.h>

namespace vestige::particle {

/// A piece of a patch: the points origin + s a + t b, s and t in [0, 1] (s + t <= 1 in a triangle).
/// Exact: all its numbers are multiples of powers of 1/2.
struct Cell {
  Vec2 origin, a{1, 0}, b{0, 1};
  bool isTriangle = false;

  Vec2 at(Vec2 local) const noexcept { return origin + local.x * a + local.y * b; }

  /// Child k of four. The last of a triangle is the middle one, upside down.
  Cell child(int k) const noexcept {
    const Vec2 ha = Real(0.5) * a, hb = Real(0.5) * b;
    if (isTriangle && k == 3) return {origin + ha + hb, Real(-1) * ha, Real(-1) * hb, true};
    return {origin + Real(k & 1) * ha + Real(k >> 1) * hb, ha, hb, isTriangle};
  }
  int corners() const noexcept { return isTriangle ? 3 : 4; }
  /// Local place of a corner, counter-clockwise.
  Vec2 corner(int i) const noexcept {
    constexpr Vec2 square[4] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    constexpr Vec2 triangle[3] = {{0, 0}, {1, 0}, {0, 1}};
    return isTriangle ? triangle[i] : square[i];
  }
};

/// Which child a local place lies in; it becomes the place in that child.
inline int descend(Vec2& local, bool isTriangle) noexcept {
  const Vec2 twice = Real(2) * local;
  if (isTriangle && local.x < Real(0.5) && local.y < Real(0.5) && twice.x + twice.y > 1) {
    local = {1 - twice.x, 1 - twice.y};
    return 3;
  }
  const int i = local.x >= Real(0.5), j = local.y >= Real(0.5);
  // A triangle's corner child of the other side begins where this one would be.
  const int k = isTriangle && i && j ? 1 : i + 2 * j;
  local = {twice.x - Real(k & 1), twice.y - Real(k >> 1)};
  return k;
}

}  // namespace vestige::particle
