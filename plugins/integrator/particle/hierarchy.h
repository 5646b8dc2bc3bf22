// SPDX-License-Identifier: Apache-2.0
// The hierarchy of elements over all surfaces: clusters of patches, patches (either side by
// itself), and their regular division below. Which element a particle lands in is the oracle's
// decision.
//
// [PD01]  Suykens, Willems. Path differentials and applications. EGWR 2001. Sec. 4.2
// [Tob97] Tobler, Wilkie, Feda, Purgathofer. A hierarchical subdivision algorithm for stochastic
//         radiosity methods. EGWR 1997.                                  the oracle `variance`
#pragma once
#include <functional>
#include <vector>

#include <vestige/integrator.h>

#include "cell.h"
#include "elements.h"

namespace vestige::particle {

enum class Oracle {
  footprint,  ///< the largest element just smaller than the particle's footprint [PD01 4.2]
  variance,   ///< patches are divided, between passes, where hits vary in them [Tob97]
  uniform,    ///< all patches alike
};

struct HierarchySettings {
  Oracle oracle = Oracle::footprint;
  /// Besides footprints: where hits vary in an element, what is meant for it goes to its children.
  /// No derivative sees a shadow's edge.
  bool edges = true;
  bool clusters = true;
  Real minArea = 0;   ///< no element smaller, scene units squared
  int maxLevel = 12;  ///< divisions below a patch; `uniform`: exactly so many
  std::size_t memory = std::size_t(1) << 30;  ///< bytes for elements; see pause()
};

/// A point on one side of a patch.
struct PatchPoint {
  int patch = -1;     ///< below 0: the shape offers no patches
  bool back = false;  ///< seen against the geometric normal
  Vec2 uv;            ///< patchUv
};
inline PatchPoint patchPointOf(const Surface& s, Vec3 toPrev) noexcept {
  return {s.patch, dot(toPrev, s.geometricNormal) < 0, s.patchUv};
}

class Hierarchy {
 public:
  Hierarchy(const SceneView& scene, const HierarchySettings& settings);

  /// The whole of one side of a patch; 0 where there are no elements: there is no patch, its object
  /// does not count as diffuse, or the point lies on an infinite plane far outside of everything
  /// else.
  ElementId root(const PatchPoint& p) const noexcept;

  /// Whether light is kept at a point. Particles leave flux where this holds, and eye paths take
  /// the diffuse part from the elements only where this holds: anywhere else rays find it. Where a
  /// texture makes a diffuse object black light is kept as well, or its neighbours in the element
  /// would get too little.
  bool keeps(const PatchPoint& p) const noexcept { return root(p) != 0; }

  /// Where a particle with a footprint of that area, scene units squared, leaves its flux; nothing
  /// happens where light is not kept. Divides where it must. [any thread]
  void deposit(const PatchPoint& p, Real footprintArea, const Flux& flux);

  /// Between passes: looks where hits vary; no division any more once memory is used up. True if
  /// that happened just now. [one thread]
  bool pause();
  bool isFull() const noexcept { return !canDivide_; }

  /// Divides an element, unless it is. [any thread]
  ElementId divide(ElementId e, int patch, const Cell& cell);

  const Elements& elements() const noexcept { return elements_; }
  /// Elements from 1 to patches * 2 are roots (front, back), then come clusters.
  ElementId firstCluster() const noexcept { return firstCluster_; }
  ElementId clusterEnd() const noexcept { return clusterEnd_; }
  static ElementId rootOf(int patch, bool back) noexcept {
    return ElementId(2 * patch + (back ? 1 : 0) + 1);
  }
  static int patchOf(ElementId root) noexcept { return int(root - 1) / 2; }

  /// The whole patch as a cell, in patchUv.
  Cell cellOf(int patch) const noexcept;
  /// The point in the patch's own cell; in [0,1]^2 if root() is not 0.
  Vec2 local(const PatchPoint& p) const noexcept;

 private:
  bool mayDivide(const Element& e) const noexcept {
    return canDivide_ && e.level < settings_.maxLevel && Real(e.area) >= 4 * settings_.minArea;
  }
  void areasOfParts(int patch, const Cell& cell, double (&areas)[4]) const noexcept;
  void judge(ElementId e, int patch, const Cell& cell);
  /// What an element holds goes to its children, by their share of its hits: nothing is lost, and
  /// nothing stays where it is too coarse.
  void handDown(ElementId e, int patch, const Cell& cell);

  const SceneView& scene_;
  HierarchySettings settings_;
  std::vector<Cell> planes_;  ///< of infinite patches: a square around everything else
  std::vector<int> planeOf_;  ///< by patch, index into planes_ or -1; empty: there are none
  Elements elements_;
  ElementId firstCluster_ = 0, clusterEnd_ = 0;
  bool canDivide_ = true;
};

}  // namespace vestige::particle
