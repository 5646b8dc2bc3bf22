// SPDX-License-Identifier: Apache-2.0
// One pass over the film: tiles, shared out among threads.
#pragma once
#include <vestige/table.h>

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>

#include "engine/film/film.h"
#include "engine/render/adaptive.h"
#include "engine/render/start_path.h"

namespace vestige {

/// What the threads of one render share; constant but for the film.
struct Job {
  PathSource source;
  const Integrator& integrator;
  Film& film;
  const Adaptive* adaptive;  ///< null: all pixels get the same number of samples

  bool wants(int x, int y) const noexcept { return !adaptive || adaptive->wants(x, y); }
};

/// Numbers of the tiles with pixels that want samples.
Table<int> openTiles(const Job& job);

/// `count` samples for each pixel of some tiles, by several threads, watched by the calling thread.
class Pass {
 public:
  /// The samples are `first` to `first + count - 1`. `cancel` may be null.
  Pass(const Job& job, const Table<int>& tiles, std::uint32_t first, int count,
       const std::atomic<bool>* cancel)
      : job_(job), tiles_(tiles), first_(first), count_(count), cancel_(cancel) {}

  /// `tick(share)` is called several times a second on the calling thread; true stops the pass once
  /// samples under way are finished. False if the pass was stopped before its end.
  bool run(int threads, Counters& total, const std::function<bool(double)>& tick);

 private:
  void work();

  const Job& job_;
  const Table<int>& tiles_;
  const std::uint32_t first_;
  const int count_;
  const std::atomic<bool>* cancel_;
  std::atomic<int> next_{0}, done_{0};
  std::atomic<bool> stop_{false};
  std::mutex mutex_;
  std::condition_variable finished_, ready_;
  int running_ = 0;
  bool started_ = false;
  Counters counters_;
};

void add(Counters& sum, const Counters& counters);

}  // namespace vestige
