// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <atomic>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include <vestige/brdf.h>
#include <vestige/camera.h>
#include <vestige/footprint/deltas.h>
#include <vestige/light.h>
#include <vestige/pigment.h>
#include <vestige/receiver.h>
#include <vestige/sampler.h>

/// From a ray to radiance: the contract between an integrator plugin and the engine.
///
/// Said once, true of every method:
///   * Directions in SceneView are in world space and unit; `toPrev` leaves the surface.
///   * All random numbers come from the Sampler of the PathContext: the estimate is a pure function
///   of
///     (pixel, sample index, seed), whichever thread asks.
///   * estimate() and all of SceneView are thread-safe and noexcept and allocate nothing; prepare()
///     may do what it likes, on the main thread, and use threads of its own.
///   * An integrator returns whatever it finds; the film refuses and counts what is not finite.
namespace vestige {

/// One point where a ray met the scene: geometry only, nothing looked up yet.
struct Surface : SurfacePoint {
  Real distance = 0;    ///< along the ray, scene units
  int object = -1;      ///< which placed shape: its material and its name
  int primitive = 0;    ///< triangle, or part of an analytic shape
  int light = -1;       ///< index into SceneView::lights() if it shines, else -1
  int patch = -1;       ///< index into SceneView::patches()
  Vec2 patchUv;         ///< [0,1]^2 in that patch
  Real offset = 0;      ///< how far a new ray starts off the surface, scene units
  bool closed = false;  ///< part of the boundary of a solid
  Real time = 0;        ///< of the ray that met it
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

/// The scene, as integrators see it.
class SceneView {
 public:
  virtual ~SceneView() = default;

  /// The first surface along the ray, opaque or not. False: none; then `surface` means nothing.
  /// (Filled in place: to copy what was just written costs more than a matt surface's shading.)
  virtual bool intersect(const Ray& ray, Surface& surface) const noexcept = 0;
  std::optional<Surface> intersect(const Ray& ray) const noexcept {
    std::optional<Surface> result(std::in_place);
    if (!intersect(ray, *result)) result.reset();
    return result;
  }

  /// Share of light that gets along the ray: the product of 1 - opacity over all that shadow rays
  /// meet, whatever the ray's own kind.
  virtual Rgb transmittance(const Ray& ray) const noexcept = 0;

  /// Evaluates the material's inputs over the footprint, bends and maps the normal.
  virtual void shade(const Surface& surface, Vec3 toPrev, const Footprint& footprint,
                     InputBuffer& buffer, Interaction& result) const noexcept = 0;
  Interaction shade(const Surface& surface, Vec3 toPrev, const Footprint& footprint,
                    InputBuffer& buffer) const noexcept {
    Interaction result;
    shade(surface, toPrev, footprint, buffer, result);
    return result;
  }
  /// Of all this only the opacity, [0, 1]. It is looked up at a point, here and in shade(): paths
  /// and shadow rays must see the same one.
  virtual Rgb opacity(const Surface& surface) const noexcept = 0;

  /// What the surface emits towards a receiver; black if it is no light.
  virtual Rgb emitted(const Surface& surface, const Receiver& r) const noexcept = 0;
  /// Density with which the light of this surface would have been sampled for a receiver, 1/sr,
  /// chance of choosing it included.
  virtual Real lightPdf(const Surface& surface, const Receiver& r) const noexcept = 0;

  virtual std::span<const Light* const> lights() const noexcept = 0;
  /// Chooses among them by power: for what starts at a light.
  virtual std::optional<LightChoice> chooseLight(Real u) const noexcept = 0;
  /// ... by what is likely to arrive at a point. Nullopt: nothing does from where u points. Lights
  /// that are not drawn have no chance.
  virtual std::optional<LightChoice> chooseLight(const Receiver& r, Real u) const noexcept = 0;
  /// Of that choice, [0,1].
  virtual Real lightChance(int light, const Receiver& r) const noexcept = 0;
  /// Whether shadow rays meet just what indirect rays meet. If not, only shadow rays bring the
  /// light of lights that are drawn: two strategies that see different scenes cannot be weighted.
  virtual bool shadowsMatchIndirect() const noexcept { return true; }
  /// Indices into lights() of those at infinity.
  virtual std::span<const int> infiniteLights() const noexcept = 0;

  /// Whether any material or light looks something up over a footprint. If not, paths need carry
  /// none.
  virtual bool usesFootprints() const noexcept = 0;
  /// ... and whether that of this surface does.
  virtual bool usesFootprint(const Surface& surface) const noexcept = 0;
  /// Texels that one unit of uv spans in the finest texture of a surface; <0, 0>: it has none.
  virtual Vec2 texels(const Surface& surface) const noexcept = 0;

  /// Extent of everything finite.
  virtual Bounds bounds() const noexcept = 0;

  /// Where the origin of the space that everything here, cameras and lights included, is given in
  /// stands in the scene's own coordinates: position + middle() is what the scene's author knows,
  /// for people and files. Zero where the scene stands around its origin; else near the scene, so
  /// that positions keep their digits far from the origin. Directions and lengths are the same.
  virtual Vec3 middle() const noexcept { return {}; }

  /// All surfaces as patches with true areas.
  virtual std::span<const Patch> patches() const noexcept = 0;
  /// The surface of a patch at patchUv, world.
  virtual SurfacePoint patchPoint(int patch, Vec2 uv) const noexcept = 0;
  /// Area of the part [low, high] of a patch's uv square (of its triangle: where u + v <= 1).
  virtual Real patchArea(int patch, Vec2 low, Vec2 high) const noexcept = 0;
};

/// A ray that leaves a surface, started off it on the side it goes to, so that rounding cannot hit
/// the same surface again.
inline Ray spawnRay(const Surface& s, Vec3 direction, RayKind kind = RayKind::any) noexcept {
  const Real side = dot(direction, s.geometricNormal) < 0 ? Real(-1) : Real(1);
  return {s.position + side * s.offset * s.geometricNormal, direction, 0, kInfinity, s.time, kind};
}
/// From a surface to a point of a light. Both ends move off their surfaces, and the ray runs
/// between the moved points: so neither surface hides the other, however flat the ray meets them.
inline Ray shadowRay(const Surface& s, const LightHit& light) noexcept {
  const Ray r = spawnRay(s, light.toLight);
  if (!std::isfinite(light.distance)) return r;
  const Real off = light.offset + kRayError * (light.distance + maxAbsComponent(light.position));
  // A point without a surface moves back along the ray.
  const Real cosine = dot(light.normal, light.toLight);
  const Vec3 away = cosine < 0 ? light.normal : cosine > 0 ? -light.normal : -light.toLight;
  const Vec3 way = light.position + off * away - r.origin;
  const Real distance = length(way);
  if (!(distance > 0)) return {r.origin, light.toLight, 0, 0};
  return {r.origin, way / distance, 0, distance * (1 - kRayError)};
}
/// From a surface to a distance at which there is no light, as for ambient occlusion: the ray ends
/// a little before it.
inline Ray shadowRay(const Surface& s, Vec3 direction, Real distance) noexcept {
  Ray r = spawnRay(s, direction);
  if (std::isfinite(distance)) r.tMax = distance - 2 * s.offset - distance * Real(1e-5);
  return r;
}

/// The kind of a scattered ray: `indirect` just if a light is drawn against it.
inline RayKind kindOf(const ScatterSample& s) noexcept {
  if (!s.specular) return RayKind::indirect;
  return s.toNext.z < 0 ? RayKind::refraction : RayKind::reflection;
}

inline bool isOpaque(Rgb opacity) noexcept {
  return opacity.r >= 1 && opacity.g >= 1 && opacity.b >= 1;
}

/// Which quantity a path carries away from the sensor or the light: radiance is scaled by
/// etaScale(), flux bends with the shading normal [Vea97 5.2, 5.3].
enum class Carries { radiance, flux };

/// The point of a surface as lights see it.
inline Receiver receiverAt(const Surface& s, const Interaction& x, Real time = 0,
                           int medium = -1) noexcept {
  return {s.position, x.frame.n, time, medium};
}

/// One drawn continuation of a path, in world space.
struct Scatter {
  Vec3 toNext;
  Rgb weight;  ///< f cos / pdf with all corrections
  ScatterSample local;
};

/// Correction for shading normals on particle paths, 1 on eye paths [Vea97 Eq. 5.19].
inline Real shadingCorrection(const Interaction& x, Vec3 toNext, Carries what) noexcept {
  if (what == Carries::radiance) return 1;
  const Real in = std::abs(dot(x.toPrev, x.frame.n) * dot(toNext, x.geometricNormal));
  const Real out = std::abs(dot(x.toPrev, x.geometricNormal) * dot(toNext, x.frame.n));
  return out > 0 ? std::min(in / out, Real(100)) : 0;  // grazing: bounded, not refused
}

/// Whether the geometric and the shading normal agree on which side toNext lies.
inline bool sidesAgree(const Interaction& x, Vec3 toNext, Real localZ) noexcept {
  return dot(toNext, x.geometricNormal) * localZ > 0;
}

/// Of what crosses an interface; flux is not scaled, nor what stays on its side.
inline Real etaScale(const Interaction& x, Vec3 local, Carries what) noexcept {
  return what == Carries::radiance && local.z < 0 ? x.brdf->etaScale(x.point, local) : Real(1);
}

/// f |cos| towards a world direction, with all corrections, and the density of drawScatter() there.
/// Zero where the BRDF or the geometry says no.
inline ScatterValue evaluateScatter(const Interaction& x, Vec3 toNext,
                                    Carries what = Carries::radiance) noexcept {
  if (!x.brdf) return {};
  const Vec3 local = x.frame.toLocal(toNext);
  if (!sidesAgree(x, toNext, local.z)) return {};
  ScatterValue v = x.brdf->evaluate(x.point, local);
  v.fCos = etaScale(x, local, what) * shadingCorrection(x, toNext, what) * v.fCos;
  return v;
}

/// Draws a continuation; nullopt where the path is absorbed.
inline std::optional<Scatter> drawScatter(const Interaction& x, ScatterNumbers numbers,
                                          Carries what = Carries::radiance) noexcept {
  if (!x.brdf) return std::nullopt;
  const std::optional<ScatterSample> s = x.brdf->sample(x.point, numbers);
  if (!s) return std::nullopt;
  const Vec3 toNext = normalize(x.frame.toWorld(s->toNext));
  if (!sidesAgree(x, toNext, s->toNext.z)) return std::nullopt;
  const Real eta = etaScale(x, s->toNext, what);
  return Scatter{toNext, eta * shadingCorrection(x, toNext, what) * s->weight, *s};
}

/// What a path shows of its first surface, averaged over a pixel like radiance.
struct Aovs {
  Vec3 normal;   ///< shading normal, world, facing the camera; zero where nothing was hit
  Rgb albedo;    ///< weight of the drawn scattering: its mean is the directional albedo
  Real depth{};  ///< distance along the ray, scene units; 0 where nothing was hit
  Vec3 position;
  Vec2 uv;
  /// Where the first scattering happens that is not specular: side of the square that has the
  /// footprint's area, in scene units and in texels; after it, the largest |g_j|.
  Real footprint{}, footprintTexels{}, gradient{};
  /// Element of a radiosity solution seen: how often its patch was divided (below 0: a cluster of
  /// patches), and a whole number that tells it from its neighbours.
  Real elementLevel{}, elementId{};
};

/// What one thread counted.
struct Counters {
  std::uint64_t rays = 0, shadowRays = 0, paths = 0, nonFinite = 0, clamped = 0;
  std::uint64_t clampedIndirect = 0;  ///< contributions that an integrator's own limit cut down
};

/// The differentials at one vertex of a recorded path, on arrival there.
struct VertexDifferentials {
  static constexpr int kMost = 8;
  int size = 0;  ///< how many numbers are followed; 0: the path carries none
  Vec3 dVertex[kMost], dDirection[kMost];        ///< per unit of each number
  Real gradient[kMost] = {}, delta[kMost] = {};  ///< g_j; delta_j as the scene's bound has it
  PathCount count;
  Footprint footprint;
  Real area = 0;  ///< exact, of the polygon that the vectors span; scene units squared
};

/// One vertex of a recorded path: `inspect` prints it, the window draws it.
struct PathVertex {
  Surface surface;
  Vec3 toPrev;
  Rgb throughput;  ///< on arrival
  const char* event =
      "";  ///< "scatter", "pass", "end", "absorbed"; no surface: "escape", "roulette"
  std::optional<ScatterSample> scattered;
  Vec2 texels;  ///< SceneView::texels()
  VertexDifferentials differentials;
};
/// An element of a radiosity solution that a path saw.
struct SeenElement {
  int level = 0;           ///< divisions below its patch; -1: a cluster of patches
  std::uint32_t id = 0;    ///< as Aovs::elementId
  Real area = 0;           ///< scene units squared
  Rgb flux;                ///< W that arrive in it, with its share of what wider ones above it hold
  std::uint64_t hits = 0;  ///< particles that left their flux in it and in no wider one
};
class PathRecord {
 public:
  virtual ~PathRecord() = default;
  virtual void add(const PathVertex& vertex) = 0;
  /// ... at the vertex that is added next.
  virtual void saw(const SeenElement&) {}
};

/// One call of estimate(): which sample of which pixel, and where to leave results.
struct PathContext {
  const SceneView& scene;
  Sampler sampler;
  Ray ray;               ///< into the scene
  RayJacobian jacobian;  ///< of that ray, per unit of the film's and lens's random numbers; not
                         ///< known where nobody wants a footprint and nothing is looked up over one
  int cameraVariables = 2;            ///< 2, or 4 with a lens
  std::uint64_t declaredSamples = 0;  ///< samples a pixel the scene asked for; 0: open ended
  Counters& counters;
  Aovs* aovs = nullptr;          ///< null: not wanted
  bool wantsFootprint = false;   ///< carry differentials though no texture asks
  PathRecord* record = nullptr;  ///< null: not wanted
};

/// What prepare() may use.
struct Preparation {
  const SceneView& scene;
  std::uint32_t seed;
  int threads;
  /// Share done in [0,1]; returns false when the user cancelled.
  std::function<bool(double)> progress;
  double seconds = 0;  ///< that preparing and rendering may take together; 0: no limit
  /// A sentence that the user should read.
  std::function<void(const std::string&)> warn = [](const std::string&) {};
};

class Integrator {
 public:
  virtual ~Integrator() = default;

  /// Once before the first estimate(): particles, caches. False if cancelled. Throws
  /// std::runtime_error with a sentence for the user where that cannot be.
  virtual bool prepare(const Preparation&) { return true; }

  /// Radiance along context.ray: one sample of the pixel's integral.
  virtual Rgb estimate(PathContext& context) const noexcept = 0;

  /// Whether estimate() needs PathContext::jacobian though nothing is looked up over a footprint.
  virtual bool usesJacobian() const noexcept { return false; }

  /// What the scene or the integrator says about samples a pixel; 0: nothing.
  virtual int samples() const noexcept { return 0; }
};

/// The surface at which a path's last edge ends: nothing scatters there, so nothing but whether the
/// ray passes through is looked up.
inline void lastSurface(const SceneView& scene, const Surface& s, Vec3 toPrev,
                        Interaction& x) noexcept {
  x.brdf = nullptr, x.toPrev = toPrev, x.opacity = scene.opacity(s);
}

/// Fills what every integrator has to say about the first surface.
inline void writeAovs(Aovs& aovs, const Surface& s, const Interaction& x) noexcept {
  aovs.normal = x.frame.n, aovs.depth = s.distance, aovs.position = s.position, aovs.uv = s.uv;
}

}  // namespace vestige
