// SPDX-License-Identifier: Apache-2.0
// Choice of one light at a vertex, by its estimated contribution.
//
// [CK18] Conty Estevez, Kulla. Importance sampling of many lights with adaptive tree splitting.
//        HPG 2018.
#pragma once
#include <vestige/integrator.h>

#include <cstdint>
#include <vector>

namespace vestige {

/// Chances by power, the same everywhere; each light has a least chance, so that a bright sun does
/// not starve the others.
class LightTable {
 public:
  /// A power that is not a number above 0 counts as 0.
  void build(const std::vector<double>& powers);
  /// Uses the given probabilities, whose sum is 1.
  void set(const std::vector<double>& chances);
  bool isEmpty() const noexcept { return chances_.empty(); }
  /// Draws an entry by u in [0,1).
  LightChoice choose(Real u) const noexcept;
  Real chance(int entry) const noexcept { return chances_[std::size_t(entry)]; }
  /// The chance of all entries before this one together.
  Real chanceBefore(int entry) const noexcept {
    return entry > 0 ? upTo_[std::size_t(entry) - 1] : Real(0);
  }

 private:
  std::vector<Real> chances_, upTo_;
};

/// Bounds of a set of lights.
struct LightCluster {
  Bounds box;
  Vec3 axis{0, 0, 1};    ///< unit, amid the directions in which they shine
  Real angle = 0;        ///< rad, from the axis to the farthest of their own axes
  Real reach = kPi / 2;  ///< rad, from a light's own axis to where nothing of it arrives
  Real power = 0;        ///< W, luminance

  explicit LightCluster(const LightExtent& light, Real power) noexcept;
  LightCluster(const LightCluster& a, const LightCluster& b) noexcept;

  /// Roughly proportional to what arrives at a point; 0 only where nothing can.
  Real importance(Vec3 at) const noexcept;
};

/// A binary tree over all lights with a known extent. The others (at infinity, or of unknown
/// extent) are chosen by power beside the tree. Where there are lights at infinity and finite ones,
/// each of the two groups gets half of the choices: the power of a sky grows with the scene and
/// is a poor estimate of its contribution indoors. Lights that are not drawn have probability 0.
class LightTree {
 public:
  void build(std::span<const Light* const> lights);

  /// Nullopt: there is no light, or none of those in the branch that u leads to reaches the
  /// receiver.
  std::optional<LightChoice> choose(const Receiver& r, Real u) const noexcept {
    if (only_ >= 0) return LightChoice{only_, 1, u};  // most scenes have one
    return chooseAmongMany(r, u);
  }
  /// The probability that choose() returns this light, [0,1].
  Real chance(int light, const Receiver& r) const noexcept;

 private:
  std::optional<LightChoice> chooseAmongMany(const Receiver& r, Real u) const noexcept;

  struct Node {
    LightCluster cluster;
    std::int32_t child;  ///< the first of two neighbours; below 0: ~light
  };
  struct Place {
    std::int32_t entry;  ///< of the table; below 0: never chosen
    std::int32_t node;   ///< its leaf; below 0: none
  };

  /// Makes the tree; returns its power, W.
  double growAll(std::span<std::int32_t> lights, std::vector<LightCluster>& clusters);
  void grow(std::int32_t node, std::span<std::int32_t> lights,
            const std::vector<LightCluster>& clusters);
  /// Whether no light of the tree reaches a point; its share then goes to the lights beside it.
  bool skipsTree(Vec3 at) const noexcept;
  /// Probability of the first of two children against the second; nullopt: neither reaches the
  /// receiver.
  std::optional<Real> firstChance(std::int32_t first, Vec3 at) const noexcept;

  LightTable table_;                   ///< lights as in outside_, then the tree
  std::vector<std::int32_t> outside_;  ///< lights beside the tree, those at infinity first
  std::vector<Node> nodes_;            ///< [0] is the root; pairs of children side by side
  std::vector<std::int32_t> parents_;  ///< of nodes
  std::vector<Place> places_;          ///< by light
  std::int32_t only_ = -1;             ///< the one light that is drawn, if there is but one
};

}  // namespace vestige
