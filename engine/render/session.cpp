// SPDX-License-Identifier: Apache-2.0
#include "engine/render/session.h"

#include <xmmintrin.h>

#include <bit>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

#include "engine/render/adaptive.h"
#include "engine/render/pixel_filter.h"

namespace vestige {
namespace {

constexpr int kTile = 16;  ///< pixels
constexpr int kDefaultSamples = 16;
constexpr int kLeastShared = 8;  ///< samples a pixel that tell where more of them belong
constexpr auto kTick = std::chrono::milliseconds(100);
constexpr double kLeastTick = 0.05;  ///< seconds between two tellings of progress

double now() {
  using namespace std::chrono;
  return duration<double>(steady_clock::now().time_since_epoch()).count();
}

/// Tiny numbers as zero: denormals cost a hundred cycles each and show in no picture. Embree asks
/// for it too. Restores the thread's mode when it goes.
class FlushDenormals {
 public:
  FlushDenormals() : before_(_mm_getcsr()) { _mm_setcsr(before_ | 0x8040); }
  ~FlushDenormals() { _mm_setcsr(before_); }

 private:
  unsigned before_;
};

/// Everything that the threads of one render share and none changes.
struct Job {
  const SceneView& scene;
  const Camera& camera;
  const Integrator& integrator;
  Film& film;
  PixelFilterSampler filter;
  std::uint32_t seed;
  std::uint64_t declaredSamples;
  bool wantsFootprint, wantsJacobian;
  int tilesX, tilesY;
  const Adaptive* adaptive;  ///< null: all pixels alike

  bool wants(int x, int y) const noexcept { return !adaptive || adaptive->wants(x, y); }
};

/// Where a sample's ray starts, and how that moves with its numbers.
struct CameraRay {
  CameraSample ray;
  RayJacobian jacobian;
};
std::optional<CameraRay> cameraRay(const Camera& camera, const PixelFilterSampler& filter,
                                   const Sampler& sampler, int x, int y, int width, int height,
                                   bool wantsJacobian) noexcept {
  const Vec2 u = sampler.pair(dimension::kFilm);
  const FilterOffset dx = filter.sample(u.x), dy = filter.sample(u.y);
  const Real w = Real(width), h = Real(height);
  const CameraNumbers numbers{
      {(Real(x) + Real(0.5) + dx.offset) / w, (Real(y) + Real(0.5) + dy.offset) / h},
      camera.variables() > 2 ? sampler.pair(dimension::kLens) : Vec2{},
      w / h};
  const std::optional<CameraSample> ray = camera.sample(numbers);
  if (!ray) return std::nullopt;
  if (!wantsJacobian) return CameraRay{*ray, {}};
  CameraRay result{*ray, camera.sampleDerivatives(numbers)};
  for (auto* d : {&result.jacobian.dOrigin, &result.jacobian.dDirection}) {
    (*d)[0] *= dx.slope / w;
    (*d)[1] *= dy.slope / h;
  }
  return result;
}

/// One sample of one pixel. [any thread, one a pixel]
void samplePixel(const Job& job, int x, int y, std::uint32_t index, Counters& counters) noexcept {
  const Sampler sampler(std::uint32_t(x), std::uint32_t(y), index, job.seed);
  Aovs aovs;
  ++counters.paths;
  const auto start = cameraRay(job.camera, job.filter, sampler, x, y, job.film.width(),
                               job.film.height(), job.wantsJacobian);
  if (!start) return job.film.add(x, y, {}, aovs, counters);
  PathContext context{.scene = job.scene,
                      .sampler = sampler,
                      .ray = {start->ray.origin, start->ray.direction, 0, kInfinity, 0,
                              RayKind::camera, job.scene.mediaAt(start->ray.origin)},
                      .jacobian = start->jacobian,
                      .cameraVariables = job.camera.variables(),
                      .declaredSamples = job.declaredSamples,
                      .counters = counters,
                      .aovs = &aovs,
                      .wantsFootprint = job.wantsFootprint};
  const Rgb radiance = start->ray.weight * job.integrator.estimate(context);
  if (aovs.depth > 0) aovs.position += job.scene.middle;
  job.film.add(x, y, radiance, aovs, counters);
}

/// Calls `visit(x, y)` for each pixel of a tile that wants samples, until it says false.
template <class Visit>
bool forPixels(const Job& job, int tile, const Visit& visit) {
  const Crop crop = job.film.crop();
  const int x0 = crop.x0 + tile % job.tilesX * kTile, y0 = crop.y0 + tile / job.tilesX * kTile;
  for (int y = y0; y < std::min(y0 + kTile, crop.y1); ++y)
    for (int x = x0; x < std::min(x0 + kTile, crop.x1); ++x)
      if (job.wants(x, y) && !visit(x, y)) return false;
  return true;
}

/// Tiles with pixels that want samples.
std::vector<int> openTiles(const Job& job) {
  std::vector<int> tiles;
  for (int tile = 0; tile < job.tilesX * job.tilesY; ++tile) {
    const bool isClosed = forPixels(job, tile, [](int, int) { return false; });
    if (!isClosed) tiles.push_back(tile);
  }
  return tiles;
}

/// False if it was stopped, which is asked before each sample: one may be a large tree of rays.
template <class IsStopped>
bool renderTile(const Job& job, int tile, std::uint32_t first, int count, Counters& counters,
                const IsStopped& isStopped) {
  return forPixels(job, tile, [&](int x, int y) {
    // A pass that was cut short left some pixels ahead of the others.
    for (std::uint32_t s = std::max(first, job.film.samples(x, y));
         s < first + std::uint32_t(count); ++s) {
      if (isStopped()) return false;
      samplePixel(job, x, y, s, counters);
    }
    return true;
  });
}

/// One pass over some tiles by several threads, watched by the calling thread. False if `stop` said
/// so before the end; samples under way are finished.
class Pass {
 public:
  Pass(const Job& job, const std::vector<int>& tiles, std::uint32_t first, int count,
       const std::atomic<bool>* cancel)
      : job_(job), tiles_(tiles), first_(first), count_(count), cancel_(cancel) {}

  /// `tick(share)` is called now and then; it returns true to stop.
  template <class Tick>
  bool run(int threads, Counters& total, const Tick& tick) {
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
    return std::size_t(done_) == tiles_.size();
  }

 private:
  void work() {
    const FlushDenormals flush;
    Counters counters;
    {
      std::unique_lock lock(mutex_);
      ready_.wait(lock, [this] { return started_; });
    }
    const auto isStopped = [this] { return stop_ || (cancel_ && *cancel_); };
    for (std::size_t i; (i = std::size_t(next_++)) < tiles_.size(); ++done_)
      if (!renderTile(job_, tiles_[i], first_, count_, counters, isStopped)) break;
    const std::lock_guard lock(mutex_);
    add(counters_, counters);
    if (--running_ == 0) finished_.notify_all();
  }

  const Job& job_;
  const std::vector<int>& tiles_;
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

}  // namespace

void add(Counters& sum, const Counters& c) {
  sum.rays += c.rays, sum.shadowRays += c.shadowRays, sum.paths += c.paths;
  sum.nonFinite += c.nonFinite, sum.clamped += c.clamped;
  sum.clampedIndirect += c.clampedIndirect;
}

int wantedSamples(const Integrator& integrator, const RenderOptions& options) {
  if (options.samples > 0) return options.samples;
  if (options.seconds > 0 && !options.adaptive) return 0;  // until time is up
  if (options.noise > 0) return kMostSamples;
  return integrator.samples() > 0 ? integrator.samples() : kDefaultSamples;
}

namespace {

/// What an adaptive render is to reach; nullopt: all pixels get the same. A time that is up ends it
/// earlier.
std::optional<Adaptive::Goal> goalOf(const Integrator& integrator, const RenderOptions& options) {
  if (options.noise > 0) return Adaptive::Goal{.noise = options.noise};
  const int mean = wantedSamples(integrator, options);
  if (!options.adaptive || mean < kLeastShared) return std::nullopt;
  return Adaptive::Goal{.samples = double(mean)};
}

}  // namespace

FilmShape filmShape(const Scene& scene, int width, int height, const double crop[4]) {
  const FilmSettings& f = scene.film();
  // One side given: the other keeps the shape of the picture.
  int w = width > 0 ? width : f.width, h = height > 0 ? height : f.height;
  if (width > 0 && height <= 0) h = std::max(1, int(std::lround(double(f.height) * w / f.width)));
  if (height > 0 && width <= 0) w = std::max(1, int(std::lround(double(f.width) * h / f.height)));
  const double* c = crop ? crop : f.crop;
  Crop window{int(std::floor(c[0] * w)), int(std::floor(c[1] * h)), int(std::ceil(c[2] * w)),
              int(std::ceil(c[3] * h))};
  window.x0 = std::clamp(window.x0, 0, w - 1), window.y0 = std::clamp(window.y0, 0, h - 1);
  window.x1 = std::clamp(window.x1, window.x0 + 1, w);
  window.y1 = std::clamp(window.y1, window.y0 + 1, h);
  return {w, h, window};
}

double sceneSize(const Scene& scene) {
  const FilmSettings& film = scene.film();
  const Real aspect = Real(film.width) / Real(film.height);
  Bounds extent = scene.view().bounds();
  for (const Vec2 at : {Vec2{0, 0}, Vec2{1, 0}, Vec2{0, 1}, Vec2{1, 1}, Vec2{0.5, 0.5}})
    if (const auto s = scene.camera().sample({at, {0.5, 0.5}, aspect})) extent.add(s->origin);
  const auto farthest = [](Real a, Real b) { return double(std::max(std::abs(a), std::abs(b))); };
  const double size =
      std::hypot(farthest(extent.low.x, extent.high.x), farthest(extent.low.y, extent.high.y),
                 farthest(extent.low.z, extent.high.z));
  return size > 0 && std::isfinite(size) ? size : 1;
}

Film makeFilm(const Scene& scene, int width, int height, const double crop[4],
              std::vector<Aov> aovs) {
  const FilmShape s = filmShape(scene, width, height, crop);
  return Film(s.width, s.height, s.crop, std::move(aovs), sceneSize(scene));
}

RenderResult render(Scene& scene, Film& film, const RenderOptions& options) {
  const double start = now();
  const int threads =
      options.threads > 0 ? options.threads : std::max(1, int(std::thread::hardware_concurrency()));
  const auto goal = goalOf(scene.integrator(), options);
  const bool isShared = goal && goal->samples > 0;
  const int wanted = isShared ? kMostSamples : wantedSamples(scene.integrator(), options);
  const auto cancelled = [&] { return options.cancel && options.cancel->load(); };
  const auto timeUp = [&] { return options.seconds > 0 && now() - start >= options.seconds; };
  RenderResult result{.end = RenderEnd::finished, .threads = threads};
  std::optional<Adaptive> adaptive;
  if (goal) adaptive.emplace(film, *goal);

  double told = 0;    // when progress was last told: small pictures finish many passes a tick
  double before = 0;  // share that the film came with
  const auto report = [&](double share, int samples, const char* phase) {
    const double elapsed = now() - start;
    if (!options.progress || elapsed - told < kLeastTick) return;
    told = elapsed;
    const double left = options.seconds > 0 ? options.seconds - elapsed : kInfinity;
    const bool isKnown = (wanted > 0 || adaptive) && share > before;
    const double remaining =
        std::min(left, isKnown ? elapsed * (1 - share) / (share - before) : kInfinity);
    if (options.seconds > 0 && (adaptive || wanted == 0))
      share = std::max(share, std::min(1.0, elapsed / options.seconds));
    options.progress({share, elapsed, std::isfinite(remaining) ? std::max(0.0, remaining) : -1,
                      samples, adaptive ? (isShared ? 0 : options.samples) : wanted, phase,
                      options.noise > 0 ? adaptive->quiet() : -1});
  };

  const auto preparing = [&](double share) {
    report(share, 0, "preparing");
    return !cancelled();
  };
  Preparation preparation{scene.view(), options.seed, threads, preparing};
  preparation.seconds = options.seconds;
  if (options.warn) preparation.warn = options.warn;
  if (!options.isPrepared && !scene.integrator().prepare(preparation))
    result.end = RenderEnd::cancelled;

  const Crop crop = film.crop();
  const Job job{
      scene.view(),
      scene.camera(),
      scene.integrator(),
      film,
      PixelFilterSampler(scene.film().filter),
      options.seed,
      adaptive ? 0 : std::uint64_t(wanted),
      film.wantsFootprint(),
      film.wantsFootprint() || scene.view().usesFootprints() || scene.integrator().usesJacobian(),
      (crop.x1 - crop.x0 + kTile - 1) / kTile,
      (crop.y1 - crop.y0 + kTile - 1) / kTile,
      adaptive ? &*adaptive : nullptr};
  before = !adaptive && wanted > 0 ? std::min(1.0, film.meanSamples() / wanted) : 0;
  double farthest = before;  // the bar shall not go back, though what the noise asks is a guess
  const auto shareOf = [&](double samples) {
    if (!adaptive && wanted == 0) return 0.0;
    const double share =
        adaptive ? adaptive->share(samples, wanted > 0 ? wanted : kMostSamples) : samples / wanted;
    return farthest = std::max(farthest, share);
  };
  const auto sumUp = [&] {
    result.samples = int(film.minSamples()), result.mostSamples = int(film.maxSamples());
    result.meanSamples = film.meanSamples();
    if (adaptive) result.quiet = adaptive->quiet();
    result.seconds = now() - start;
  };
  double resumed = now();
  const auto isPauseDue = [&] {
    return options.paused && options.pauseEvery > 0 && now() - resumed >= options.pauseEvery;
  };
  std::vector<int> tiles = openTiles(job);
  // Passes of 1, 1, 2, 4, ... samples: a picture soon, then little overhead.
  for (int done = int(film.minSamples()), pass = 1; result.end == RenderEnd::finished;) {
    if (wanted > 0 && done >= wanted) break;
    if (isPauseDue()) {
      sumUp();
      options.paused(result);
      resumed = now();
    }
    const int count = wanted > 0 ? std::min(pass, wanted - done) : pass;
    const bool whole = Pass(job, tiles, std::uint32_t(done), count, options.cancel)
                           .run(threads, result.counters, [&](double share) {
                             report(shareOf(done + share * count), done, "rendering");
                             return cancelled() || timeUp() || isPauseDue();
                           });
    if (!whole && !cancelled() && !timeUp()) continue;  // the same pass, after a pause
    if (!whole) result.end = cancelled() ? RenderEnd::cancelled : RenderEnd::timeUp;
    done += count;
    if (whole && adaptive && (std::has_single_bit(unsigned(done)) || done == wanted)) {
      adaptive->judge(film, done);
      tiles = openTiles(job);
    }
    if (adaptive && adaptive->isDone()) break;
    if (whole && timeUp() && done != wanted) result.end = RenderEnd::timeUp;
    if (whole && cancelled() && done != wanted) result.end = RenderEnd::cancelled;
    if (whole && options.passed) options.passed();
    pass = std::min(options.mostInPass, std::max(pass, done));
  }
  sumUp();
  return result;
}

Rgb inspectSample(Scene& scene, const FilmShape& film, int x, int y, std::uint32_t index,
                  const RenderOptions& options, PathRecord& record) {
  Counters counters;
  const auto goOn = [](double) { return true; };
  if (!options.isPrepared) scene.integrator().prepare({scene.view(), options.seed, 1, goOn});
  const Sampler sampler(std::uint32_t(x), std::uint32_t(y), index, options.seed);
  const auto start = cameraRay(scene.camera(), PixelFilterSampler(scene.film().filter), sampler, x,
                               y, film.width, film.height, true);
  if (!start) return {};
  PathContext context{.scene = scene.view(),
                      .sampler = sampler,
                      .ray = {start->ray.origin, start->ray.direction, 0, kInfinity, 0,
                              RayKind::camera, scene.view().mediaAt(start->ray.origin)},
                      .jacobian = start->jacobian,
                      .cameraVariables = scene.camera().variables(),
                      .declaredSamples = std::uint64_t(wantedSamples(scene.integrator(), options)),
                      .counters = counters,
                      .record = &record};
  return start->ray.weight * scene.integrator().estimate(context);
}

}  // namespace vestige
