// SPDX-License-Identifier: Apache-2.0
#include "engine/render/pass.h"

#include <xmmintrin.h>

#include <array>
#include <thread>
#include <vector>

namespace vestige {
namespace {

constexpr int kTile = 16;  ///< pixels
constexpr auto kTick = std::chrono::milliseconds(100);

/// Treats denormal numbers as zero on this thread, and restores its mode in the end: a denormal
/// costs a hundred cycles and shows in no picture. Embree asks for this too.
class FlushDenormals {
 public:
  FlushDenormals() : before_(_mm_getcsr()) { _mm_setcsr(before_ | 0x8040); }
  ~FlushDenormals() { _mm_setcsr(before_); }

 private:
  unsigned before_;
};

/// One sample of one pixel. [any thread, one a pixel]
void samplePixel(const Job& job, int x, int y, std::uint32_t index, int ownAovs,
                 Counters& counters) noexcept {
  std::array<Real, kMostOwnAovs> own{};
  Aovs aovs;
  aovs.own = {own.data(), std::size_t(ownAovs)};
  ++counters.paths;
  StartedPath path = startPath(job.source, x, y, index, {.counters = counters, .aovs = &aovs});
  if (isBlack(path.weight)) return job.film.add(x, y, {}, aovs, counters);
  const Rgb radiance = path.weight * job.integrator.estimate(path.context);
  if (aovs.depth > 0) aovs.position += job.source.scene.middle;
  job.film.add(x, y, radiance, aovs, counters);
}

int tilesAcross(Crop crop) noexcept { return (crop.x1 - crop.x0 + kTile - 1) / kTile; }
int tilesDown(Crop crop) noexcept { return (crop.y1 - crop.y0 + kTile - 1) / kTile; }

/// Calls `visit(x, y)` for each pixel of a tile that wants samples, until it says false.
template <class Visit>
bool forPixels(const Job& job, int tile, const Visit& visit) {
  const Crop crop = job.film.crop();
  const int x0 = crop.x0 + tile % tilesAcross(crop) * kTile;
  const int y0 = crop.y0 + tile / tilesAcross(crop) * kTile;
  for (int y = y0; y < std::min(y0 + kTile, crop.y1); ++y)
    for (int x = x0; x < std::min(x0 + kTile, crop.x1); ++x)
      if (job.wants(x, y) && !visit(x, y)) return false;
  return true;
}

/// False if it was stopped. Checks before each sample, since one may be a large tree of rays.
template <class IsStopped>
bool renderTile(const Job& job, int tile, std::uint32_t first, int count, Counters& counters,
                const IsStopped& isStopped) {
  const int ownAovs = int(job.integrator.aovs().size());
  return forPixels(job, tile, [&](int x, int y) {
    // A pass that was cut short left some pixels ahead of the others.
    for (std::uint32_t s = std::max(first, job.film.samples(x, y));
         s < first + std::uint32_t(count); ++s) {
      if (isStopped()) return false;
      samplePixel(job, x, y, s, ownAovs, counters);
    }
    return true;
  });
}

}  // namespace

Table<int> openTiles(const Job& job) {
  Table<int> tiles;
  const Crop crop = job.film.crop();
  for (int tile = 0; tile < tilesAcross(crop) * tilesDown(crop); ++tile) {
    const bool isClosed = forPixels(job, tile, [](int, int) { return false; });
    if (!isClosed) tiles.push_back(tile);
  }
  return tiles;
}

bool Pass::run(int threads, Counters& total, const std::function<bool(double)>& tick) {
  std::vector<std::thread> workers;
  for (int i = 0; i < threads; ++i) workers.emplace_back([this] { work(); });
  std::unique_lock lock(mutex_);
  running_ += threads;
  started_ = true;
  ready_.notify_all();
  while (running_ > 0) {
    finished_.wait_for(lock, kTick);
    if (tick(double(done_) / double(tiles_.size()))) stop_ = true;
  }
  lock.unlock();
  for (std::thread& w : workers) w.join();
  add(total, counters_);
  return done_ == tiles_.size();
}

void Pass::work() {
  const FlushDenormals flush;
  Counters counters;
  {
    std::unique_lock lock(mutex_);
    ready_.wait(lock, [this] { return started_; });
  }
  const auto isStopped = [this] { return stop_ || (cancel_ && *cancel_); };
  for (int i; (i = next_++) < tiles_.size(); ++done_)
    if (!renderTile(job_, tiles_[i], first_, count_, counters, isStopped)) break;
  const std::lock_guard lock(mutex_);
  add(counters_, counters);
  if (--running_ == 0) finished_.notify_all();
}

void add(Counters& sum, const Counters& c) {
  sum.rays += c.rays;
  sum.shadowRays += c.shadowRays;
  sum.paths += c.paths;
  sum.nonFinite += c.nonFinite;
  sum.clamped += c.clamped;
  sum.clampedIndirect += c.clampedIndirect;
}

}  // namespace vestige
