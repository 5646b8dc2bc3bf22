// SPDX-License-Identifier: Apache-2.0
// Questions about objects that a text may ask while it is read: trace(), inside(), min_extent() and
// max_extent(). The language has no geometry; a program that has some answers them.
#pragma once
#include <array>
#include <memory>
#include <string>

#include <vestige/scene_desc.h>

namespace vestige::lang {

/// Called on the thread of the run. Objects are shapes and unions with their transforms; the same
/// pointer is the same object, so that what was prepared for it can be kept while the pointer is.
/// Coordinates are those of the scene. Each function returns false if the object cannot be
/// measured, as when a file of it is missing, with the reason in `why`, the end of a sentence:
/// "cannot be measured: " + why.
class Measure {
 public:
  using Point = std::array<double, 3>;
  using Object = std::shared_ptr<const Block>;
  struct Extent {
    Point low{}, high{};  ///< a box that holds the object, and may be larger; infinite for a plane
  };
  struct Hit {
    bool isHit = false;
    Point point{}, normal{};  ///< the normal has length 1 and points out of a solid
  };

  virtual ~Measure() = default;
  virtual bool extent(const Object& object, Extent& extent, std::string& why) = 0;
  /// Whether a point lies in one of the object's solids; on the surface the answer may be either.
  virtual bool inside(const Object& object, const Point& point, bool& isInside,
                      std::string& why) = 0;
  /// The first point of the object on the ray. The direction has any length but 0.
  virtual bool trace(const Object& object, const Point& origin, const Point& direction, Hit& hit,
                     std::string& why) = 0;
};

}  // namespace vestige::lang
