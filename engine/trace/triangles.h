// SPDX-License-Identifier: Apache-2.0
// A mesh made fit for tracing: without what is broken, carried into the space it is traced in.
#pragma once
#include <vestige/shape.h>

namespace vestige {

class Triangles {
 public:
  /// `mesh` must outlive this.
  Triangles(const TriangleMesh& mesh, const Affine& toSpace);

  const Affine& toSpace() const noexcept { return toSpace_; }
  std::size_t size() const noexcept { return triangles_.size(); }
  std::size_t dropped() const noexcept { return dropped_; }
  const std::vector<Vec3>& positions() const noexcept { return positions_; }
  const std::vector<std::array<std::uint32_t, 3>>& indices() const noexcept { return triangles_; }
  Bounds bounds() const noexcept;

  struct Edges {
    Vec3 a, ab, ac;
    Vec3 normal;  ///< unit, on the side of cross(ab, ac) in the mesh's own space
  };
  Edges edges(std::uint32_t triangle) const noexcept;

  Real area(std::uint32_t triangle) const noexcept;

  /// Whether they bound a solid: every edge, by the positions of its ends, belongs to exactly two
  /// triangles that run along it in opposite directions, and the normals point outwards.
  bool isWatertight() const;

  /// Fills in the point with barycentric coordinates b of the second and third corner. Returns the
  /// largest component of the edges.
  Real at(std::uint32_t triangle, Vec2 b, SurfacePoint& s) const noexcept;

  /// Where a ray in this space meets the triangle's plane, in full precision.
  struct Meeting {
    Real t;
    Vec2 b;
  };
  Meeting meet(std::uint32_t triangle, const Ray& ray) const noexcept;

 private:
  bool isSound(const std::array<std::uint32_t, 3>& corners) const noexcept;
  /// Of a flat point with barycentric uv: the shading normal, from the corners'; then uv and what
  /// goes by them, from the corners' uv.
  void bend(SurfacePoint& s, const std::array<std::uint32_t, 3>& corners) const noexcept;
  void followUvs(SurfacePoint& s, const std::array<std::uint32_t, 3>& corners) const noexcept;

  const TriangleMesh* source_;
  Affine toSpace_;
  std::vector<Vec3> positions_;
  std::vector<Vec3> normals_;  ///< carried along but not unit, so that blending them commutes
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::vector<Vec3> faces_;  ///< Edges::normal
  Real side_ = 1;            ///< -1 where toSpace mirrors
  bool hasUvs_ = false;
  std::size_t dropped_ = 0;
};

}  // namespace vestige
