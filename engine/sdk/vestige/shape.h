// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <vestige/inputs.h>

/// Surfaces: analytic ones, which intersect rays themselves, and meshes, which hand over triangles.
///
/// Said once, true of every method:
///   * A shape is asked in its own space; the engine transforms rays, points, normals and their
///     derivatives, areas and densities, however the shape is scaled and rotated.
///   * The normal of a closed shape points outwards.
///   * uv and its directions are those of the scene language (docs/language.md); where uv has a
///     pole, dP/du and dP/dv are finite and span the tangent plane.
///   * Methods are const, thread-safe and noexcept; they allocate nothing.
namespace vestige {

/// Triangles with what a file had to say about their corners.
struct TriangleMesh {
  std::vector<Vec3> positions;
  std::vector<Vec3> normals;  ///< unit, one a position; empty: flat
  std::vector<Vec2> uvs;      ///< one a position; empty: barycentric
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// A mesh and what it is made of: files with several materials give several parts.
struct MeshPart {
  TriangleMesh mesh;
  std::string name;  ///< of the material, for messages
  /// The material as the language would have written it; null: the shape's own brdf. A `brdf` in
  /// the scene text overrides it.
  std::shared_ptr<const Block> brdf;
  Value emission;  ///< kind none: does not shine
};

/// Where a ray meets an analytic shape.
struct ShapeHit {
  Real t = 0;    ///< in lengths of ray.direction
  int part = 0;  ///< which face: lid, side, ...
  Vec2 uv{};     ///< handed back to surface(); for shapes whose search finds it anyway
};

/// One of several meetings of a ray.
struct Crossing {
  ShapeHit hit;
  bool enters = false;  ///< runs against the normal: into the solid, if the shape is closed
};

/// The surface at a point: position, normals, uv, and how position and normal move with uv.
struct SurfacePoint {
  Vec3 position;         ///< on the surface, within rounding
  Vec3 geometricNormal;  ///< unit
  Vec3 normal;           ///< unit, for shading; equals geometricNormal but on smooth meshes
  Vec2 uv;
  Vec3 dPdu, dPdv;  ///< scene units per unit of uv
  Vec3 dNdu, dNdv;  ///< of `normal`; zero where flat
  /// Second derivatives of position, scene units per unit of uv squared: how the tangents turn in
  /// the surface as one walks on it. Zero on triangles and wherever uv is a straight grid.
  Vec3 dPduu, dPduv, dPdvv;

  /// A point of a flat surface with straight uv: all other derivatives are zero.
  static SurfacePoint flat(Vec3 position, Vec3 normal, Vec2 uv, Vec3 dPdu, Vec3 dPdv) noexcept {
    SurfacePoint s;
    s.position = position;
    s.geometricNormal = s.normal = normal;
    s.uv = uv;
    s.dPdu = dPdu;
    s.dPdv = dPdv;
    return s;
  }
};

/// A point drawn from the surface.
struct AreaSample {
  SurfacePoint point;
  Mat3x2 du;    ///< dP/du, per unit of random number; |du.c0 x du.c1| pdf = 1
  Mat3x2 dNdu;  ///< of the normal
  Real pdf;     ///< per unit of area, > 0
};

/// A direction towards the shape, drawn by the angle that it fills.
struct ConeSample {
  Vec3 toShape;   ///< unit
  Real distance;  ///< to the first point met
  Real pdf;       ///< 1/sr
};
/// First derivatives of ConeSample::toShape.
struct ConeJacobian {
  Mat3x2 du;   ///< per unit of random number
  Mat3 dFrom;  ///< per scene unit of the point that looks
};

class Shape {
 public:
  virtual ~Shape() = default;

  /// Infinite in some direction for a plane.
  virtual Bounds bounds() const noexcept = 0;

  /// First meeting with t in (ray.tMin, ray.tMax), either side. The origin may lie on the surface
  /// within rounding; the engine then has set tMin.
  virtual std::optional<ShapeHit> intersect(const Ray& ray) const noexcept = 0;

  /// The surface at a point that intersect() or crossings() found (`near` lies on it within
  /// rounding). hit.t means nothing here: the ray may have been in another space.
  virtual SurfacePoint surface(Vec3 near, const ShapeHit& hit) const noexcept = 0;

  /// Meetings with t in (ray.tMin, ray.tMax) in ascending order, the first being intersect()'s;
  /// returns how many. More than `found` holds: its size, and the nearest ones. Along a line those
  /// of a closed shape enter and leave in turn; a ray that touches it gives two or none. By
  /// default: intersect() again and again, each time a few rounding steps further.
  virtual int crossings(const Ray& ray, std::span<Crossing> found) const noexcept;

  /// Whether it bounds a solid: rays inside it see its back.
  virtual bool isClosed() const noexcept = 0;

  /// Total area; 0: it has none that could shine (infinite).
  virtual Real area() const noexcept = 0;

  /// Uniform by area; only where area() > 0.
  virtual AreaSample samplePoint(Vec2 u) const noexcept = 0;

  /// By solid angle; nullopt: the shape has no such sampler or `from` lies inside, use
  /// samplePoint().
  virtual std::optional<ConeSample> sampleToward(Vec3 /*from*/, Vec2 /*u*/) const noexcept {
    return std::nullopt;
  }
  /// Density of sampleToward() for any direction that meets the shape, 1/sr; 0: no such sampler.
  virtual Real towardPdf(Vec3 /*from*/) const noexcept { return 0; }
  virtual ConeJacobian towardDerivatives(Vec3 /*from*/, Vec2 /*u*/) const noexcept { return {}; }

  /// Faces that uv in [0,1]^2 covers once each, as patches for integrators; 0: the shape offers
  /// none.
  virtual int faces() const noexcept { return 0; }
  /// The point of a face at uv: what surface() says of the point that has this uv.
  virtual SurfacePoint at(Vec2 /*uv*/, int /*face*/) const noexcept { return {}; }

  /// Triangles in place of all of the above, which the engine then never calls; null: analytic.
  virtual const std::vector<MeshPart>* parts() const noexcept { return nullptr; }
};

inline int Shape::crossings(const Ray& ray, std::span<Crossing> found) const noexcept {
  Ray rest = ray;
  for (std::size_t n = 0; n < found.size(); ++n) {
    const std::optional<ShapeHit> hit = intersect(rest);
    if (!hit) return int(n);
    const SurfacePoint s = surface(rest.at(hit->t), *hit);
    found[n] = {*hit, dot(rest.direction, s.geometricNormal) < 0};
    rest.tMin = hit->t + 4 * std::numeric_limits<Real>::epsilon() * std::abs(hit->t);
    rest.tMin = std::max(rest.tMin, std::nextafter(hit->t, kInfinity));
  }
  return int(found.size());
}

/// Base of a shape that is made of triangles.
class MeshShape : public Shape {
 public:
  const std::vector<MeshPart>* parts() const noexcept final { return &parts_; }
  bool isClosed() const noexcept override { return false; }

  Bounds bounds() const noexcept final { return {}; }
  std::optional<ShapeHit> intersect(const Ray&) const noexcept final { return std::nullopt; }
  SurfacePoint surface(Vec3, const ShapeHit&) const noexcept final { return {}; }
  Real area() const noexcept final { return 0; }
  AreaSample samplePoint(Vec2) const noexcept final { return {}; }

 protected:
  std::vector<MeshPart> parts_;
};

}  // namespace vestige
