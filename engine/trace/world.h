// SPDX-License-Identifier: Apache-2.0
// All surfaces of a scene behind one acceleration structure. Embree stays behind this header.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include <vestige/integrator.h>

namespace vestige {

/// What one object of the world is: a shape (or one part of a mesh) at a place.
struct Placement {
  std::shared_ptr<const Shape> shape;  ///< kept alive
  /// The part of the shape that this is, or a mesh without a shape, which is copied; null:
  /// analytic.
  const TriangleMesh* mesh = nullptr;
  Affine toWorld;   ///< not singular
  int object = -1;  ///< handed back in Surface::object
  int light = -1;   ///< handed back in Surface::light
  bool closed = false;
  /// Whether the surface may let light through: then transmittance() asks `opacity`.
  bool translucent = false;
  RayKind visibleTo = RayKind::any;  ///< kinds of rays that meet it
  /// Whether it refracts: a solid then, if it is closed or its mesh is watertight.
  bool isDielectric = false;
  int priority = 0;  ///< of a solid, against others at the same place
};

class World {
 public:
  World();
  ~World();
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;

  /// Before commit(). The same mesh pointer placed several times becomes instances of one tree.
  void add(const Placement& placement);
  /// What rays meet, without the lights that they find there. Nobody changes it any more, so worlds
  /// on different threads may share one.
  struct Body;
  /// Builds the tree. Vertices that are not finite and degenerate triangles were dropped: how many
  /// is told by dropped(). Where all placements but their lights are those of the world `before`,
  /// its body serves as it is; else trees of meshes that stayed are taken from it. Answers are the
  /// same to the bit as without.
  void commit(const std::shared_ptr<const Body>& before = nullptr);
  std::shared_ptr<const Body> body() const noexcept;
  std::size_t dropped() const noexcept;

  /// First surface along the ray; false: none.
  bool intersect(const Ray& ray, Surface& surface) const noexcept;
  std::optional<Surface> intersect(const Ray& ray) const noexcept {
    std::optional<Surface> result(std::in_place);
    if (!intersect(ray, *result)) result.reset();
    return result;
  }

  /// Product of 1 - opacity(surface) over the surfaces in (tMin, tMax) that shadow rays meet; black
  /// behind an opaque one. `opacity` is called in the order of t, also for the boundaries of solids
  /// that meet others. The same to the bit in whatever order the placements were added.
  using Opacity = Rgb (*)(const void* context, const Surface& surface);
  Rgb transmittance(const Ray& ray, Opacity opacity, const void* context) const noexcept;

  /// How many dielectric solids there are, numbered from 1 on as MediumStack wants it: by priority,
  /// then smaller ones above larger ones, then later ones above earlier ones.
  int solids() const noexcept;
  struct Solid {
    int object = -1;
    Bounds bounds;
    RayKind visibleTo = RayKind::any;
    bool meetsOthers = false;  ///< its bounds share a point with those of another solid
  };
  /// An estimate of the most solids around one point.
  int solidsAtOnce() const noexcept;
  const Solid& solid(std::uint32_t number) const noexcept;
  /// The boundaries of solids that meet others along a ray; fills `found` and returns how many.
  int boundaries(const Ray& ray, std::span<Surface> found) const noexcept;

  /// Of everything finite; empty if there is nothing.
  Bounds bounds() const noexcept;

  std::span<const Patch> patches() const noexcept;
  SurfacePoint patchPoint(int patch, Vec2 uv) const noexcept;
  Real patchArea(int patch, Vec2 low, Vec2 high) const noexcept;

  std::vector<Placement> placements() const;  ///< after commit(), without their lights
  std::size_t triangles() const noexcept;     ///< without instances
  static std::string embreeVersion();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vestige
