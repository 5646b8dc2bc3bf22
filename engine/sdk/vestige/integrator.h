// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <atomic>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <vestige/camera.h>
#include <vestige/footprint/deltas.h>
#include <vestige/sampler.h>
#include <vestige/scattering.h>

/// From a ray to radiance: the contract between an integrator plugin and the engine.
///
/// Said once, true of every method:
///   * All random numbers come from the Sampler of the PathContext: the estimate is a pure function
///     of (pixel, sample index, seed), whichever thread asks.
///   * estimate() is thread-safe and noexcept and allocates nothing. prepare() runs once, on the
///     main thread; it may use threads of its own.
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
  /// One value for each slot that Integrator::aovs() declares, in that order; zero at first.
  std::span<Real> own;
};

/// How an AOV goes with the size of the scene.
enum class AovMeasure {
  number,  ///< it does not
  length   ///< scene units: in a scene twice as large, values and steps are twice as large
};

/// An AOV that an integrator declares: one number a sample, averaged over the pixel.
struct AovSlot {
  const char* name;  ///< of the layer and its channel: letters, digits and . _ -, "element.level"
  const char* help;  ///< what the number says, in one line
  AovMeasure measure = AovMeasure::number;
  /// Resolution of the film's sums; for a length, in a scene of size 1. Rounded down to a power of
  /// two. Values beyond 2^52 steps are cut.
  double step = 0x1p-16;
};
/// AOVs that one integrator may declare.
inline constexpr int kMostOwnAovs = 8;
/// The AOVs that every integrator has. No slot may take one of these names.
inline constexpr std::string_view kCommonAovs[] = {
    "normal",    "albedo",           "depth",   "position", "uv", "samples",
    "footprint", "footprint.texels", "gradient"};

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

/// One to three numbers that an integrator has to tell about a vertex, for `inspect` and the
/// window.
struct PathNote {
  const char* name;  ///< "element.flux"
  const char* unit;  ///< "W"; "" for a plain number
  double values[3];
  int count = 1;  ///< of values; three are a colour or a vector
};

class PathRecord {
 public:
  virtual ~PathRecord() = default;
  virtual void add(const PathVertex& vertex) = 0;
  /// Belongs to the vertex that is added next. Name and unit are string literals of the plugin.
  virtual void note(const PathNote&) {}
};

/// One call of estimate(). The members that are const say which sample of which pixel is wanted;
/// results and counts go to the others.
struct PathContext {
  const SceneView& scene;
  const Sampler sampler;
  const Ray ray;  ///< into the scene
  /// Of that ray, per unit of the film's and the lens's random numbers; zero unless a texture, an
  /// AOV or the integrator needs it.
  const RayJacobian jacobian;
  const int cameraVariables = 2;            ///< 2, or 4 with a lens
  const std::uint64_t declaredSamples = 0;  ///< samples a pixel the scene asked for; 0: open ended
  Counters& counters;
  Aovs* const aovs = nullptr;          ///< null: not wanted
  const bool wantsFootprint = false;   ///< carry differentials though no texture asks
  PathRecord* const record = nullptr;  ///< null: not wanted
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

  /// AOVs beside those that every integrator has, at most kMostOwnAovs. The same as long as the
  /// integrator lives.
  virtual std::span<const AovSlot> aovs() const noexcept { return {}; }

  /// What the scene or the integrator says about samples a pixel; 0: nothing.
  virtual int samples() const noexcept { return 0; }
};

/// The surface at which a path's last edge ends: nothing scatters there, so nothing but whether the
/// ray passes through is looked up.
inline void lastSurface(const SceneView& scene, const Surface& s, Vec3 toPrev,
                        Interaction& x) noexcept {
  x.brdf = nullptr;
  x.toPrev = toPrev;
  x.opacity = scene.opacity(s);
}

/// Fills what every integrator has to say about the first surface.
inline void writeAovs(Aovs& aovs, const Surface& s, const Interaction& x) noexcept {
  aovs.normal = x.frame.n;
  aovs.depth = s.distance;
  aovs.position = s.position;
  aovs.uv = s.uv;
}

}  // namespace vestige
