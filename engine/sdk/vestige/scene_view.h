// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>
#include <span>

#include <vestige/brdf.h>
#include <vestige/light.h>
#include <vestige/pigment.h>

/// The scene as integrators see it.
///
/// Conventions of every method:
///   * Directions are in world space and unit; `toPrev` leaves the surface.
///   * Methods are const, thread-safe and noexcept; they allocate nothing.
namespace vestige {

/// A hit of a ray with the scene: geometry only, without its material.
struct Surface : SurfacePoint {
  Real distance = 0;         ///< along the ray, scene units
  int object = -1;           ///< index of the placed shape, which has a material and a name
  int primitive = 0;         ///< triangle, or part of an analytic shape
  int light = -1;            ///< index into SceneView::lights() if it shines, else -1
  int patch = -1;            ///< index into SceneView::patches()
  Vec2 patchUv;              ///< [0,1]^2 in that patch
  Real offset = 0;           ///< how far a new ray starts off the surface, scene units
  Real time = 0;             ///< time of the ray that hit it
  std::uint32_t solid = 0;   ///< dielectric solid whose boundary it is, see MediumStack; 0: none
  MediumStack mediaInFront;  ///< on the side of the geometric normal
  MediumStack mediaBehind;   ///< on the other side; the same where it bounds no solid
};

/// A surface with its evaluated material, where an integrator scatters. Copying is cheap; the
/// inputs point into the InputBuffer passed to shade().
struct Interaction {
  const Brdf* brdf = nullptr;  ///< null: only emits, reflects nothing
  ScatterPoint point;          ///< local view for the BRDF
  Frame frame;                 ///< shading frame: n faces toPrev, s along dP/du
  Vec3 geometricNormal;        ///< faces toPrev
  Rgb opacity{1, 1, 1};        ///< 1 - the share that passes straight through: see drawPassage()
  Vec3 toPrev;                 ///< world
  Receiver receiver;           ///< for lights: the surface on the side of toPrev
};

struct LightChoice {
  int light;      ///< index into lights()
  Real chance;    ///< (0,1]
  Real rest = 0;  ///< u rescaled to [0,1) for reuse; has few bits if the chance is small
};

/// A piece of surface with an area of its own: one a triangle, one a face of an analytic shape.
struct Patch {
  int object;
  Real area;  ///< world, scene units squared; infinite for a plane
  Bounds bounds;
  Vec3 normal;      ///< mean geometric normal, unit; zero where it has no mean (sphere)
  bool isTriangle;  ///< patchUv are barycentric: u + v <= 1
};

/// Traces rays.
class Tracer {
 public:
  virtual ~Tracer() = default;

  /// The first surface along the ray, opaque or not. False: none; then `surface` means nothing.
  /// Boundaries of dielectric solids that are not there, see MediumStack, are passed by.
  /// (Filled in place: copying it would cost more than the shading of a diffuse surface.)
  virtual bool intersect(const Ray& ray, Surface& surface) const noexcept = 0;

  /// Transmittance along the ray: the product of 1 - opacity over all surfaces that are visible to
  /// shadow rays, whatever the ray's own kind, times that of the solids on the way.
  virtual Rgb transmittance(const Ray& ray) const noexcept = 0;

  /// The dielectric solids around a point, for rays that start at no surface: from a camera, from a
  /// light.
  virtual MediumStack mediaAt(Vec3 /*position*/) const noexcept { return {}; }
  /// Transmittance over a distance of the medium that fills the place, by Beer's law.
  virtual Rgb mediumTransmittance(const Ray&, Real /*distance*/) const noexcept { return grey(1); }

  /// Bounds of all finite objects.
  virtual Bounds bounds() const noexcept = 0;
};

/// Evaluates materials.
class Materials {
 public:
  virtual ~Materials() = default;

  /// Evaluates the material's inputs over the footprint, and applies the normal map and the
  /// correction of shading normals.
  virtual void shade(const Surface& surface, Vec3 toPrev, const Footprint& footprint,
                     InputBuffer& buffer, Interaction& result) const noexcept = 0;
  /// The opacity alone, [0, 1]. It is evaluated at a point, here and in shade(), because paths and
  /// shadow rays must see the same opacity.
  virtual Rgb opacity(const Surface& surface) const noexcept = 0;

  /// Whether any material or light uses a footprint. If none does, paths need not carry one.
  virtual bool usesFootprints() const noexcept = 0;
  /// Whether this surface's material uses a footprint.
  virtual bool usesFootprint(const Surface& surface) const noexcept = 0;
  /// Texels per unit of uv in the finest texture of a surface; <0, 0>: no texture.
  virtual Vec2 texels(const Surface& surface) const noexcept = 0;
};

/// The lights, and the choice of one of them.
class LightSet {
 public:
  virtual ~LightSet() = default;

  virtual std::span<const Light* const> lights() const noexcept = 0;
  /// Indices into lights() of the lights at infinity.
  virtual std::span<const int> infiniteLights() const noexcept = 0;

  /// Chooses a light by its power, to emit a particle.
  virtual std::optional<LightChoice> chooseLight(Real u) const noexcept = 0;
  /// Chooses a light by its estimated contribution at a receiver. Nullopt: no light in the branch
  /// chosen by u reaches the receiver. Lights without next-event estimation have probability 0.
  virtual std::optional<LightChoice> chooseLight(const Receiver& r, Real u) const noexcept = 0;
  /// Probability of that choice, [0,1].
  virtual Real lightChance(int light, const Receiver& r) const noexcept = 0;
  /// Whether the same surfaces are visible to shadow rays and to indirect rays. If not, only shadow
  /// rays count for sampled lights, because multiple importance sampling cannot combine strategies
  /// that see different scenes.
  virtual bool shadowsMatchIndirect() const noexcept { return true; }

  /// Radiance that the surface emits towards a receiver; black if it is no light.
  virtual Rgb emitted(const Surface& surface, const Receiver& r) const noexcept = 0;
  /// Density with which the light of this surface would have been sampled for a receiver, 1/sr,
  /// chance of choosing it included.
  virtual Real lightPdf(const Surface& surface, const Receiver& r) const noexcept = 0;
};

/// All surfaces as patches with true areas, for integrators that store light on surfaces.
class PatchSet {
 public:
  virtual ~PatchSet() = default;

  virtual std::span<const Patch> patches() const noexcept = 0;
  /// The surface of a patch at patchUv, world.
  virtual SurfacePoint patchPoint(int patch, Vec2 uv) const noexcept = 0;
  /// Area of the part [low, high] of a patch's uv square (of its triangle: where u + v <= 1).
  virtual Real patchArea(int patch, Vec2 low, Vec2 high) const noexcept = 0;
};

/// The scene as integrators see it: four interfaces, and their methods under the same names. A test
/// or a profiler can replace one interface and keep the others.
struct SceneView {
  const Tracer& tracer;
  const Materials& materials;
  const LightSet& lightSet;
  const PatchSet& patchSet;
  /// Origin of the space in which everything here, cameras and lights included, is given, in the
  /// scene's own coordinates: position + middle is the position in the scene text. Zero unless the
  /// scene lies far from its origin; then near the scene, so that positions keep their digits.
  /// Directions and lengths are unchanged.
  Vec3 middle{};

  bool intersect(const Ray& ray, Surface& surface) const noexcept {
    return tracer.intersect(ray, surface);
  }
  std::optional<Surface> intersect(const Ray& ray) const noexcept {
    std::optional<Surface> result(std::in_place);
    if (!tracer.intersect(ray, *result)) result.reset();
    return result;
  }
  Rgb transmittance(const Ray& ray) const noexcept { return tracer.transmittance(ray); }
  MediumStack mediaAt(Vec3 position) const noexcept { return tracer.mediaAt(position); }
  /// Share of light that gets along a ray to what it met at `distance`, or to infinity: what the
  /// solid around the ray's origin does not absorb. Multiplies a path's throughput after each
  /// intersect(). Its gradient is left out of footprints: they describe regions, and along an edge
  /// absorption changes little from one side of a region to the other.
  Rgb mediumTransmittance(const Ray& ray, Real distance) const noexcept {
    return ray.media.isEmpty() ? grey(1) : tracer.mediumTransmittance(ray, distance);
  }
  Bounds bounds() const noexcept { return tracer.bounds(); }

  void shade(const Surface& surface, Vec3 toPrev, const Footprint& footprint, InputBuffer& buffer,
             Interaction& result) const noexcept {
    materials.shade(surface, toPrev, footprint, buffer, result);
  }
  Interaction shade(const Surface& surface, Vec3 toPrev, const Footprint& footprint,
                    InputBuffer& buffer) const noexcept {
    Interaction result;
    materials.shade(surface, toPrev, footprint, buffer, result);
    return result;
  }
  Rgb opacity(const Surface& s) const noexcept { return materials.opacity(s); }
  bool usesFootprints() const noexcept { return materials.usesFootprints(); }
  bool usesFootprint(const Surface& s) const noexcept { return materials.usesFootprint(s); }
  Vec2 texels(const Surface& s) const noexcept { return materials.texels(s); }

  std::span<const Light* const> lights() const noexcept { return lightSet.lights(); }
  std::span<const int> infiniteLights() const noexcept { return lightSet.infiniteLights(); }
  std::optional<LightChoice> chooseLight(Real u) const noexcept { return lightSet.chooseLight(u); }
  std::optional<LightChoice> chooseLight(const Receiver& r, Real u) const noexcept {
    return lightSet.chooseLight(r, u);
  }
  Real lightChance(int light, const Receiver& r) const noexcept {
    return lightSet.lightChance(light, r);
  }
  bool shadowsMatchIndirect() const noexcept { return lightSet.shadowsMatchIndirect(); }
  Rgb emitted(const Surface& s, const Receiver& r) const noexcept { return lightSet.emitted(s, r); }
  Real lightPdf(const Surface& s, const Receiver& r) const noexcept {
    return lightSet.lightPdf(s, r);
  }

  std::span<const Patch> patches() const noexcept { return patchSet.patches(); }
  SurfacePoint patchPoint(int patch, Vec2 uv) const noexcept {
    return patchSet.patchPoint(patch, uv);
  }
  Real patchArea(int patch, Vec2 low, Vec2 high) const noexcept {
    return patchSet.patchArea(patch, low, high);
  }
};

}  // namespace vestige
