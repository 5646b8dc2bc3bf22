// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <vestige/inputs.h>

/// Surfaces: analytic shapes, which intersect rays themselves, and meshes, which return triangles.
///
/// Conventions of every method:
///   * Methods work in the shape's own space; the engine transforms rays, points, normals and their
///     derivatives, areas and densities.
///   * The normal of a closed shape points outwards.
///   * uv and its directions are those of the scene language (docs/language.md); where uv has a
///     pole, dP/du and dP/dv are finite and span the tangent plane.
///   * Methods are const, thread-safe and noexcept; they allocate nothing.
namespace vestige {

/// Triangles with the vertex data of a file.
struct TriangleMesh {
  std::vector<Vec3> positions;
  std::vector<Vec3> normals;  ///< unit, one a position; empty: flat
  std::vector<Vec2> uvs;      ///< one a position; empty: barycentric
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// A mesh with one material: files with several materials give several parts.
struct MeshPart {
  TriangleMesh mesh;
  std::string name;  ///< of the material, for messages
  /// The material as a block of the scene language; null: the shape's own brdf. A `brdf` in the
  /// scene text overrides it.
  std::shared_ptr<const Block> brdf;
  Value emission;  ///< kind none: does not shine
};

/// A hit of a ray with an analytic shape.
struct ShapeHit {
  Real t = 0;    ///< in lengths of ray.direction
  int part = 0;  ///< which face: lid, side, ...
  Vec2 uv{};     ///< passed back to surface(); for shapes whose intersection finds it anyway
};

/// One of several hits of a ray.
struct Crossing {
  ShapeHit hit;
  bool enters = false;  ///< the ray runs against the normal: into the solid, if the shape is closed
};

/// The surface at a point: position, normals, uv, and the derivatives of position and normal by uv.
struct SurfacePoint {
  Vec3 position;         ///< on the surface, within rounding
  Vec3 geometricNormal;  ///< unit
  Vec3 normal;           ///< unit, for shading; equals geometricNormal but on smooth meshes
  Vec2 uv;
  Vec3 dPdu, dPdv;  ///< scene units per unit of uv
  Vec3 dNdu, dNdv;  ///< of `normal`; zero where flat
  /// Second derivatives of position, scene units per unit of uv squared. Zero on triangles and
  /// wherever uv is a straight grid.
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

/// A direction towards the shape, drawn by solid angle.
struct ConeSample {
  Vec3 toShape;   ///< unit
  Real distance;  ///< to the first point met
  Real pdf;       ///< 1/sr
};
/// First derivatives of ConeSample::toShape.
struct ConeJacobian {
  Mat3x2 du;   ///< per unit of random number
  Mat3 dFrom;  ///< per scene unit of the receiver's position
};

class Shape {
 public:
  virtual ~Shape() = default;

  /// Infinite in some direction for a plane.
  virtual Bounds bounds() const noexcept = 0;

  /// The first hit with t in (ray.tMin, ray.tMax), from either side. If the origin lies on the
  /// surface, the engine has set tMin accordingly.
  virtual std::optional<ShapeHit> intersect(const Ray& ray) const noexcept = 0;

  /// The surface at a point that intersect() or crossings() found (`near` lies on it within
  /// rounding). hit.t is undefined here: the ray may have been in another space.
  virtual SurfacePoint surface(Vec3 near, const ShapeHit& hit) const noexcept = 0;

  /// All hits with t in (ray.tMin, ray.tMax) in ascending order; the first one is that of
  /// intersect(). Returns their number, at most found.size(): then only the nearest hits are given.
  /// The hits of a closed shape enter and leave in turn; a ray that touches it gives two hits or
  /// none. By default: repeated calls of intersect(), each a few rounding steps further.
  virtual int crossings(const Ray& ray, std::span<Crossing> found) const noexcept;

  /// Whether the surface bounds a solid: rays inside it hit its back.
  virtual bool isClosed() const noexcept = 0;

  /// Total area; 0 if it is infinite: such a shape cannot emit light.
  virtual Real area() const noexcept = 0;

  /// Draws a point uniformly by area; called only if area() > 0.
  virtual AreaSample samplePoint(Vec2 u) const noexcept = 0;

  /// Draws a direction by solid angle; nullopt if the shape has no such sampler or `from` lies
  /// inside: use samplePoint() then.
  virtual std::optional<ConeSample> sampleToward(Vec3 /*from*/, Vec2 /*u*/) const noexcept {
    return std::nullopt;
  }
  /// Density of sampleToward() for any direction that meets the shape, 1/sr; 0: no such sampler.
  virtual Real towardPdf(Vec3 /*from*/) const noexcept { return 0; }
  virtual ConeJacobian towardDerivatives(Vec3 /*from*/, Vec2 /*u*/) const noexcept { return {}; }

  /// Number of faces, each covered once by uv in [0,1]^2: the patches of SceneView. 0: no patches.
  virtual int faces() const noexcept { return 0; }
  /// The point of a face at uv; equals surface() at that point.
  virtual SurfacePoint at(Vec2 /*uv*/, int /*face*/) const noexcept { return {}; }

  /// Triangles that replace all methods above, which the engine then never calls; null: analytic.
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
