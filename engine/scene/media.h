// SPDX-License-Identifier: Apache-2.0
// Dielectric solids that touch, overlap or lie in one another: which boundaries are there, and what
// fills the place. docs/adr/0012 has the decisions.
//
// [SB02] Schmidt, Budge. Simple nested dielectrics in ray traced images. JGT 7(2), 2002.
#pragma once
#include <vector>

#include "engine/scene/material.h"
#include "engine/trace/world.h"

namespace vestige {

class Media {
 public:
  /// After the world was committed. `materials`: by object.
  void build(const World& world, const std::vector<const Material*>& materials);
  bool isNone() const noexcept { return indices_.size() == 1; }

  /// Refractive indices by solid; of number 0, air's.
  const Real* indices() const noexcept { return indices_.data(); }
  /// Those of the solids that rays of a kind meet.
  MediumStack seenBy(const MediumStack& solids, RayKind kind) const noexcept;
  /// Whether some solid is not visible to all rays.
  bool isRestricted() const noexcept { return isRestricted_; }
  /// Beer's law in what fills the place.
  Rgb transmittance(const MediumStack& media, Real distance) const noexcept;
  /// The solids around a point, found by a ray from there. `world`: here and below that of build().
  MediumStack at(const World& world, Vec3 position) const noexcept;

  /// Goes on from the surface that a ray met until there is one: false where none is left. Of a
  /// solid's boundary sets the media on both sides.
  bool follow(const World& world, const Ray& ray, Surface& surface) const noexcept;

  /// Along a shadow ray: takes surfaces in the order of their distances.
  struct Shadow {
    const Media& media;
    const World& world;
    Vec3 direction;
    MediumStack stack;
    Real from = 0;  ///< distance of the last boundary
    Rgb opticalDepth{};

    /// Passes a boundary. False: it is not there.
    bool pass(Surface surface) noexcept;
    /// What is absorbed on all the way, to a distance.
    Rgb transmittance(Real distance) noexcept;
  };

 private:
  /// Sets the media on both sides of a boundary, met by a ray within `media`. Corrects them where
  /// they contradict the side that was met: the ray started inside, or missed a boundary.
  void cross(const World& world, Vec3 direction, const MediumStack& media,
             Surface& s) const noexcept;
  /// Calls visit(solid, enters) for the boundaries that coincide with a surface within rounding,
  /// its own left out.
  template <class Visit>
  void visitTouching(const World& world, Vec3 direction, const Surface& s,
                     const Visit& visit) const noexcept;
  static void addDepth(Rgb& depth, Rgb absorption, Real distance) noexcept;

  std::vector<Real> indices_{1};
  std::vector<Rgb> absorption_{Rgb{}};  ///< 1 per scene unit
  std::vector<RayKind> visibleTo_{RayKind::any};
  bool isRestricted_ = false;
  Bounds bounds_;  ///< of all solids
};

}  // namespace vestige
