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
  int wanted;         ///< a pixel; 0: until time is up
  const char* phase;  ///< "preparing", "rendering"
};

struct RenderOptions {
  int samples = 0;     ///< a pixel; 0: what the scene says, or 16
  double seconds = 0;  ///< stop when this much time has passed; 0: no limit
  std::uint32_t seed = 0;
  int threads = 0;                            ///< 0: as many as the machine has
  const std::atomic<bool>* cancel = nullptr;  ///< set by a signal handler or a window
  std::function<void(const Progress&)> progress =
      nullptr;  ///< on the calling thread, a few times a second
};

enum class RenderEnd { finished, timeUp, cancelled };

struct RenderResult {
  RenderEnd end;
  int samples;  ///< a pixel: the fewest that any pixel has
  double seconds;
  int threads;
  Counters counters;
};

/// Film resolution of a scene after the command line's wishes (0: the scene's), and its crop
/// window.
Film makeFilm(const Scene& scene, int width, int height, const double crop[4],
              std::vector<Aov> aovs);

/// Adds samples to the film until done, out of time or cancelled. Whatever was finished stays.
RenderResult render(Scene& scene, Film& film, const RenderOptions& options);

/// Traces one sample of one pixel of a film of that size, as render() would, and tells its path to
/// `record`. What it adds to the pixel.
Rgb inspectSample(Scene& scene, const Film& film, int x, int y, std::uint32_t index,
                  const RenderOptions& options, PathRecord& record);

}  // namespace vestige
