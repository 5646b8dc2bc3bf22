// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <atomic>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include <vestige/camera.h>
#include <vestige/footprint/deltas.h>
#include <vestige/sampler.h>
#include <vestige/scattering.h>

/// From a ray to radiance: the contract between an integrator plugin and the engine.
///
/// Said once, true of every method:
///   * All random numbers come from the Sampler of the PathContext: the estimate is a pure function
///     of (pixel, sample index, seed), whichever thread asks.
///   * estimate() is thread-safe and noexcept and allocates nothing; prepare() runs once, on the
///   main
///     thread, and may use threads of its own.
///   * An integrator returns whatever it finds; the film refuses and counts what is not finite.
namespace vestige {

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
