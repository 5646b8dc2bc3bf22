// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>
#include <span>

#include <vestige/brdf.h>
#include <vestige/light.h>
#include <vestige/pigment.h>

/// The scene as integrators see it.
///
/// Said once, true of every method:
///   * Directions are in world space and unit; `toPrev` leaves the surface.
///   * Methods are const, thread-safe and noexcept; they allocate nothing.
namespace vestige {

/// One point where a ray met the scene: geometry only, nothing looked up yet.
struct Surface : SurfacePoint {
  Real distance = 0;         ///< along the ray, scene units
  int object = -1;           ///< which placed shape: its material and its name
  int primitive = 0;         ///< triangle, or part of an analytic shape
  int light = -1;            ///< index into SceneView::lights() if it shines, else -1
  int patch = -1;            ///< index into SceneView::patches()
  Vec2 patchUv;              ///< [0,1]^2 in that patch
  Real offset = 0;           ///< how far a new ray starts off the surface, scene units
  Real time = 0;             ///< of the ray that met it
  std::uint32_t solid = 0;   ///< dielectric solid whose boundary it is, see MediumStack; 0: none
  MediumStack mediaInFront;  ///< on the side of the geometric normal
  MediumStack mediaBehind;   ///< on the other side; the same where it bounds no solid
};

/// A surface with its material looked up: what an integrator scatters at. Copying is cheap; the
/// inputs point into the InputBuffer that shade() was given.
struct Interaction {
  const Brdf* brdf = nullptr;  ///< null: only emits, reflects nothing
  ScatterPoint point;          ///< local view for the BRDF
  Frame frame;                 ///< shading frame: n faces toPrev, s along dP/du
  Vec3 geometricNormal;        ///< faces toPrev
  Rgb opacity{1, 1, 1};        ///< share that does not pass straight through: see drawPassage()
  Vec3 toPrev;                 ///< world
};

struct LightChoice {
  int light;      ///< index into lights()
  Real chance;    ///< (0,1]
  Real rest = 0;  ///< u stretched over the choice, [0,1); of few bits where the chance is small
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

  /// Share of light that gets along the ray: the product of 1 - opacity over all that shadow rays
  /// meet, whatever the ray's own kind, times what the solids on the way let through.
  virtual Rgb transmittance(const Ray& ray) const noexcept = 0;

  /// The dielectric solids around a point, for rays that start at no surface: from a camera, from a
  /// light.
  virtual MediumStack mediaAt(Vec3 /*position*/) const noexcept { return {}; }
  /// Share of light that gets that far through what fills the place, by Beer's law.
  virtual Rgb mediumTransmittance(const MediumStack&, Real /*distance*/) const noexcept {
    return grey(1);
  }

  /// Extent of everything finite.
  virtual Bounds bounds() const noexcept = 0;
};

/// Looks materials up.
class Materials {
 public:
  virtual ~Materials() = default;

  /// Evaluates the material's inputs over the footprint, bends and maps the normal.
  virtual void shade(const Surface& surface, Vec3 toPrev, const Footprint& footprint,
                     InputBuffer& buffer, Interaction& result) const noexcept = 0;
  /// Of all this only the opacity, [0, 1]. It is looked up at a point, here and in shade(): paths
  /// and shadow rays must see the same one.
  virtual Rgb opacity(const Surface& surface) const noexcept = 0;

  /// Whether any material or light looks something up over a footprint. If not, paths need carry
  /// none.
  virtual bool usesFootprints() const noexcept = 0;
  /// Whether that of this surface does.
  virtual bool usesFootprint(const Surface& surface) const noexcept = 0;
  /// Texels that one unit of uv spans in the finest texture of a surface; <0, 0>: it has none.
  virtual Vec2 texels(const Surface& surface) const noexcept = 0;
};

/// The lights, and how one of them is chosen.
class LightSet {
 public:
  virtual ~LightSet() = default;

  virtual std::span<const Light* const> lights() const noexcept = 0;
  /// Indices into lights() of those at infinity.
  virtual std::span<const int> infiniteLights() const noexcept = 0;

  /// Chooses a light by its power: for particles, which start there.
  virtual std::optional<LightChoice> chooseLight(Real u) const noexcept = 0;
  /// Chooses a light by what is likely to arrive at a receiver. Nullopt: nothing does from where u
  /// points. Lights that are not drawn have no chance.
  virtual std::optional<LightChoice> chooseLight(const Receiver& r, Real u) const noexcept = 0;
  /// Probability of that choice, [0,1].
  virtual Real lightChance(int light, const Receiver& r) const noexcept = 0;
  /// Whether shadow rays meet just what indirect rays meet. If not, only shadow rays bring the
  /// light of lights that are drawn: two strategies that see different scenes cannot be weighted.
  virtual bool shadowsMatchIndirect() const noexcept { return true; }

  /// What the surface emits towards a receiver; black if it is no light.
  virtual Rgb emitted(const Surface& surface, const Receiver& r) const noexcept = 0;
  /// Density with which the light of this surface would have been sampled for a receiver, 1/sr,
  /// chance of choosing it included.
  virtual Real lightPdf(const Surface& surface, const Receiver& r) const noexcept = 0;
};

/// All surfaces as patches with true areas: for integrators that keep light on surfaces.
class PatchSet {
 public:
  virtual ~PatchSet() = default;

  virtual std::span<const Patch> patches() const noexcept = 0;
  /// The surface of a patch at patchUv, world.
  virtual SurfacePoint patchPoint(int patch, Vec2 uv) const noexcept = 0;
  /// Area of the part [low, high] of a patch's uv square (of its triangle: where u + v <= 1).
  virtual Real patchArea(int patch, Vec2 low, Vec2 high) const noexcept = 0;
};

/// The scene, as integrators see it: its four trades, and their methods by the same names. To stand
/// in for one trade, as a test or a profiler does, write that interface and keep the others.
struct SceneView {
  const Tracer& tracer;
  const Materials& materials;
  const LightSet& lightSet;
  const PatchSet& patchSet;
  /// Where the origin of the space that everything here, cameras and lights included, is given in
  /// stands in the scene's own coordinates: position + middle is what the scene's author knows, for
  /// people and files. Zero where the scene stands around its origin; else near the scene, so that
  /// positions keep their digits far from the origin. Directions and lengths are the same.
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
    return ray.media.isEmpty() ? grey(1) : tracer.mediumTransmittance(ray.media, distance);
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
