// SPDX-License-Identifier: Apache-2.0
// From a scene to a filled film: passes, tiles, threads, progress, cancelling.
#pragma once
#include <atomic>
#include <functional>

#include "engine/film/film.h"
#include "engine/scene/scene.h"

namespace vestige {

struct Progress {
  double share;       ///< of the whole, [0,1]
  double elapsed;     ///< seconds
  double remaining;   ///< seconds, estimate; negative: not known yet
  int samples;        ///< a pixel, finished
  int wanted;         ///< a pixel; 0: of each pixel as many as it needs
  const char* phase;  ///< "preparing", "rendering"
  double quiet;       ///< share of the pixels at the noise wanted, [0,1]; negative: none is wanted
};

/// Samples a pixel at most where only the noise decides.
inline constexpr int kMostSamples = 65536;

struct RenderResult;

/// Of samples, seconds and noise the one reached first ends the render.
struct RenderOptions {
  int samples = 0;     ///< a pixel; 0: what the scene says, or 16; see also noise
  double seconds = 0;  ///< stop when this much time has passed; 0: no limit
  /// Stop where the standard error of luminance over luminance is below this; 0: everywhere the
  /// same number of samples. Needs an empty film. Without samples and seconds the most samples are
  /// kMostSamples, whatever the scene says; paths do not know how many will follow.
  double noise = 0;
  /// The samples are a mean over the picture, and lie where they take away most noise. Needs an
  /// empty film, and noise 0.
  bool adaptive = false;
  std::uint32_t seed = 0;
  int threads = 0;                            ///< 0: as many as the machine has
  const std::atomic<bool>* cancel = nullptr;  ///< set by a signal handler or a window
  std::function<void(const Progress&)> progress =
      nullptr;  ///< on the calling thread, a few times a second
  /// Of what the integrator has to say to the user, on the calling thread; null: nobody listens.
  std::function<void(const std::string&)> warn = nullptr;
  /// After each pass over the film, which stands still meanwhile, on the calling thread.
  std::function<void()> passed = nullptr;
  /// Whenever so many seconds have passed, in the middle of a pass if need be; 0: never. The film
  /// stands still meanwhile. With what this call has done so far, on the calling thread.
  double pauseEvery = 0;
  std::function<void(const RenderResult&)> paused = nullptr;
  int mostInPass = 16;      ///< samples a pixel: how coarse progress may be
  bool isPrepared = false;  ///< the integrator was, by an earlier call for the same scene and seed
};

enum class RenderEnd { finished, timeUp, cancelled };

struct RenderResult {
  RenderEnd end = RenderEnd::finished;
  int samples = 0;         ///< a pixel: the fewest that any pixel has
  int mostSamples = 0;     ///< that any pixel has
  double meanSamples = 0;  ///< over the pixels
  double quiet = 1;        ///< share of the pixels that reached the noise wanted, [0,1]
  double seconds = 0;
  int threads = 0;
  Counters counters = {};
};
void add(Counters& sum, const Counters& counters);

/// Resolution of a scene's film after the command line's wishes (0: the scene's), and its crop
/// window. Cheap: no storage.
struct FilmShape {
  int width, height;
  Crop crop;
};
FilmShape filmShape(const Scene& scene, int width, int height, const double crop[4]);
/// The largest distance from the origin of the finite part of the scene and of the camera, scene
/// units; 1 where nothing says so. A function of the scene alone.
double sceneSize(const Scene& scene);
/// An empty film of that shape, whose units follow the scene's size.
Film makeFilm(const Scene& scene, int width, int height, const double crop[4],
              std::vector<Aov> aovs);

/// Samples a pixel that end the render; 0: time does.
int wantedSamples(const Integrator& integrator, const RenderOptions& options);

/// Adds samples to the film until done, out of time or cancelled. Whatever was finished stays.
/// Throws std::runtime_error with a sentence for the user where the integrator cannot prepare.
RenderResult render(Scene& scene, Film& film, const RenderOptions& options);

/// Traces one sample of one pixel of a film of that size, as render() would, and tells its path to
/// `record`. What it adds to the pixel.
Rgb inspectSample(Scene& scene, const FilmShape& film, int x, int y, std::uint32_t index,
                  const RenderOptions& options, PathRecord& record);

}  // namespace vestige
