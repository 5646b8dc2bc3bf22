// SPDX-License-Identifier: Apache-2.0
// Which dielectric solids surround a point. Every ray carries those around its origin.
//
// [SB02] Schmidt, Budge. Simple nested dielectrics in ray traced images. JGT 7(2), 2002.
#pragma once
#include <array>
#include <cstdint>

namespace vestige {

/// A set of dielectric solids. A solid is a number from 1 on, which the engine gives it. Where
/// solids overlap, the one with the largest number fills the place, and the boundaries of the
/// others are not there [SB02].
class MediumStack {
 public:
  /// Of more solids around one point, those with the smallest numbers are left out.
  static constexpr int kMost = 12;

  /// The solid that fills the place; 0: none, so air.
  std::uint32_t top() const noexcept { return solids_[0]; }
  bool isEmpty() const noexcept { return solids_[0] == 0; }
  bool contains(std::uint32_t solid) const noexcept {
    for (const std::uint32_t s : solids_)
      if (s == solid) return true;
    return false;
  }

  /// All of them, descending, then zeros.
  const std::array<std::uint32_t, kMost>& solids() const noexcept { return solids_; }

  /// The stack beyond a boundary of the solid: inside of it, or outside.
  MediumStack with(std::uint32_t solid) const noexcept {
    if (contains(solid)) return *this;
    MediumStack more = *this;
    for (std::uint32_t& s : more.solids_) {
      if (s >= solid) continue;
      const std::uint32_t next = s;
      s = solid;
      solid = next;
    }
    return more;
  }
  MediumStack without(std::uint32_t solid) const noexcept {
    MediumStack fewer;
    std::size_t n = 0;
    for (const std::uint32_t s : solids_)
      if (s != solid) fewer.solids_[n++] = s;
    return fewer;
  }

  friend bool operator==(const MediumStack&, const MediumStack&) = default;

 private:
  std::array<std::uint32_t, kMost> solids_{};  ///< descending, then zeros
};

}  // namespace vestige
