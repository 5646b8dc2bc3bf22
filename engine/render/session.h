// SPDX-License-Identifier: Apache-2.0
// From a scene to a filled film: passes, progress, limits, cancelling.
#pragma once
#include <atomic>
#include <functional>

#include "engine/render/film_shape.h"

namespace vestige {

struct Progress {
  double share;       ///< of the whole render, [0,1]
  double elapsed;     ///< seconds
  double remaining;   ///< seconds, estimate; negative: not known yet
  int samples;        ///< a pixel, finished
  int wanted;         ///< a pixel; 0: each pixel gets as many as it needs
  const char* phase;  ///< "preparing", "rendering"
  double quiet;  ///< share of the pixels at or below the wanted noise, [0,1]; negative: none is set
};

/// Most samples a pixel where only the noise decides.
inline constexpr int kMostSamples = 65536;

struct RenderResult;

/// The render ends when the first of `samples`, `seconds` and `noise` is reached.
struct RenderOptions {
  int samples = 0;     ///< a pixel; 0: the scene's, or 16; see also noise
  double seconds = 0;  ///< time limit; 0: none
  /// A pixel is done when the standard error of luminance over luminance is below this; 0: all
  /// pixels get the same number of samples. Needs an empty film. Without samples and seconds a
  /// pixel takes at most kMostSamples, whatever the scene says. PathContext::declaredSamples is 0.
  double noise = 0;
  /// `samples` is the mean over the picture; pixels with more noise get more of them. Needs an
  /// empty film and noise 0.
  bool adaptive = false;
  std::uint32_t seed = 0;
  int threads = 0;                            ///< 0: one for each core
  const std::atomic<bool>* cancel = nullptr;  ///< set by a signal handler or a window
  std::function<void(const Progress&)> progress =
      nullptr;  ///< on the calling thread, a few times a second
  /// Receives messages for the user, on the calling thread. May be null.
  std::function<void(const std::string&)> warn = nullptr;
  /// Called after each pass, on the calling thread. The film does not change meanwhile.
  std::function<void()> passed = nullptr;
  /// Seconds between two calls of `paused`, even within a pass; 0: never. It gets the result so
  /// far, on the calling thread. The film does not change meanwhile.
  double pauseEvery = 0;
  std::function<void(const RenderResult&)> paused = nullptr;
  int mostInPass = 16;      ///< samples a pixel
  bool isPrepared = false;  ///< an earlier call prepared the integrator for this scene and seed
};

enum class RenderEnd { finished, timeUp, cancelled };

struct RenderResult {
  RenderEnd end = RenderEnd::finished;
  int samples = 0;         ///< of the pixel with the fewest
  int mostSamples = 0;     ///< of the pixel with the most
  double meanSamples = 0;  ///< over the pixels
  double quiet = 1;        ///< share of the pixels that reached the wanted noise, [0,1]
  double seconds = 0;
  int threads = 0;
  Counters counters = {};
};
void add(Counters& sum, const Counters& counters);

/// Samples a pixel that end the render; 0: the time limit ends it.
int wantedSamples(const Integrator& integrator, const RenderOptions& options);

/// Adds samples to the film until done, out of time or cancelled. Finished samples stay. Throws
/// std::runtime_error with a sentence for the user if the integrator cannot prepare.
RenderResult render(Scene& scene, Film& film, const RenderOptions& options);

/// Traces one sample of one pixel of a film of that size, as render() would, and reports its path
/// to `record`. Returns what the sample adds to the pixel.
Rgb inspectSample(Scene& scene, const FilmShape& film, int x, int y, std::uint32_t index,
                  const RenderOptions& options, PathRecord& record);

}  // namespace vestige
