// SPDX-License-Identifier: Apache-2.0
#include "engine/render/session.h"

#include <bit>
#include <chrono>
#include <thread>

#include "engine/render/pass.h"

namespace vestige {
namespace {

constexpr int kDefaultSamples = 16;
constexpr int kLeastShared = 8;      ///< fewest samples a pixel that can be shared out by noise
constexpr double kLeastTick = 0.05;  ///< seconds between two reports of progress

double now() {
  using namespace std::chrono;
  return duration<double>(steady_clock::now().time_since_epoch()).count();
}

/// The goal of an adaptive render; nullopt: all pixels get the same number of samples. The time
/// limit may end the render earlier.
std::optional<Adaptive::Goal> goalOf(const Integrator& integrator, const RenderOptions& options) {
  if (options.noise > 0) return Adaptive::Goal{.noise = options.noise};
  const int mean = wantedSamples(integrator, options);
  if (!options.adaptive || mean < kLeastShared) return std::nullopt;
  return Adaptive::Goal{.samples = double(mean)};
}

/// One call of render().
class Rendering {
 public:
  Rendering(Scene& scene, Film& film, const RenderOptions& options);
  RenderResult run();

 private:
  bool isCancelled() const { return options_.cancel && options_.cancel->load(); }
  bool isTimeUp() const { return options_.seconds > 0 && elapsed() >= options_.seconds; }
  bool isPauseDue() const;
  double elapsed() const { return now() - start_; }
  bool prepare();
  Job job() const;
  double shareOf(double samples);
  double remaining(double share, double time) const;
  void report(double share, int samples, const char* phase);
  void sumUp();
  void pauseIfDue();
  void renderPasses();
  /// False if it was stopped before its end.
  bool runPass(const Job& job, const Table<int>& tiles, int first, int count);
  /// After `done` samples a pixel. A limit that is reached with the last wanted sample does not
  /// count.
  void checkLimits(bool isWhole, int done);

  Scene& scene_;
  Film& film_;
  const RenderOptions& options_;
  const double start_ = now();
  const int threads_;
  const std::optional<Adaptive::Goal> goal_;
  const bool isShared_;  ///< samples are a mean over the picture
  const int wanted_;     ///< samples a pixel; 0: until time is up
  std::optional<Adaptive> adaptive_;
  RenderResult result_;
  double begun_ = 0;         ///< share that the film came with
  double farthest_ = 0;      ///< share reported so far; the bar must not go back
  double reported_ = 0;      ///< seconds; small pictures finish many passes a tick
  double resumed_ = start_;  ///< when the last pause ended
};

Rendering::Rendering(Scene& scene, Film& film, const RenderOptions& options)
    : scene_(scene),
      film_(film),
      options_(options),
      threads_(options.threads > 0 ? options.threads
                                   : std::max(1, int(std::thread::hardware_concurrency()))),
      goal_(goalOf(scene.integrator(), options)),
      isShared_(goal_ && goal_->samples > 0),
      wanted_(isShared_ ? kMostSamples : wantedSamples(scene.integrator(), options)) {
  result_.threads = threads_;
  if (goal_) adaptive_.emplace(film, *goal_);
}

RenderResult Rendering::run() {
  if (!options_.isPrepared && !prepare()) result_.end = RenderEnd::cancelled;
  resumed_ = now();
  if (!adaptive_ && wanted_ > 0) begun_ = std::min(1.0, film_.meanSamples() / wanted_);
  farthest_ = begun_;
  renderPasses();
  sumUp();
  return result_;
}

bool Rendering::isPauseDue() const {
  return options_.paused && options_.pauseEvery > 0 && now() - resumed_ >= options_.pauseEvery;
}

/// False if the user cancelled.
bool Rendering::prepare() {
  const auto progress = [this](double share) {
    report(share, 0, "preparing");
    return !isCancelled();
  };
  Preparation preparation{scene_.view(), options_.seed, threads_, progress};
  preparation.seconds = options_.seconds;
  if (options_.warn) preparation.warn = options_.warn;
  return scene_.integrator().prepare(preparation);
}

Job Rendering::job() const {
  const SceneView& view = scene_.view();
  const Integrator& integrator = scene_.integrator();
  const bool wantsFootprint = film_.wantsFootprint();
  return {.source = {.scene = view,
                     .camera = scene_.camera(),
                     .filter = PixelFilterSampler(scene_.film().filter),
                     .width = film_.width(),
                     .height = film_.height(),
                     .seed = options_.seed,
                     .declaredSamples = adaptive_ ? 0 : std::uint64_t(wanted_),
                     .wantsFootprint = wantsFootprint,
                     .wantsJacobian =
                         wantsFootprint || view.usesFootprints() || integrator.usesJacobian()},
          .integrator = integrator,
          .film = film_,
          .adaptive = adaptive_ ? &*adaptive_ : nullptr};
}

/// Of the whole render, when open pixels hold `samples`. With adaptive sampling this is an
/// estimate.
double Rendering::shareOf(double samples) {
  if (!adaptive_ && wanted_ == 0) return 0;
  const double share = adaptive_ ? adaptive_->share(samples, wanted_ > 0 ? wanted_ : kMostSamples)
                                 : samples / wanted_;
  farthest_ = std::max(farthest_, share);
  return farthest_;
}

/// Seconds, estimated after `time`; negative: not known yet.
double Rendering::remaining(double share, double time) const {
  double seconds = options_.seconds > 0 ? options_.seconds - time : kInfinity;
  if ((wanted_ > 0 || adaptive_) && share > begun_)
    seconds = std::min(seconds, time * (1 - share) / (share - begun_));
  return std::isfinite(seconds) ? std::max(0.0, seconds) : -1;
}

void Rendering::report(double share, int samples, const char* phase) {
  const double time = elapsed();
  if (!options_.progress || time - reported_ < kLeastTick) return;
  reported_ = time;
  Progress p{};
  p.elapsed = time;
  p.remaining = remaining(share, time);
  const bool isTimed = options_.seconds > 0 && (adaptive_ || wanted_ == 0);
  p.share = isTimed ? std::max(share, std::min(1.0, time / options_.seconds)) : share;
  p.samples = samples;
  p.wanted = isShared_ ? 0 : adaptive_ ? options_.samples : wanted_;
  p.phase = phase;
  p.quiet = options_.noise > 0 ? adaptive_->quiet() : -1;
  options_.progress(p);
}

void Rendering::sumUp() {
  result_.samples = int(film_.minSamples());
  result_.mostSamples = int(film_.maxSamples());
  result_.meanSamples = film_.meanSamples();
  if (adaptive_) result_.quiet = adaptive_->quiet();
  result_.seconds = elapsed();
}

void Rendering::pauseIfDue() {
  if (!isPauseDue()) return;
  sumUp();
  options_.paused(result_);
  resumed_ = now();
}

bool Rendering::runPass(const Job& job, const Table<int>& tiles, int first, int count) {
  Pass pass(job, tiles, std::uint32_t(first), count, options_.cancel);
  return pass.run(threads_, result_.counters, [&](double share) {
    report(shareOf(first + share * count), first, "rendering");
    return isCancelled() || isTimeUp() || isPauseDue();
  });
}

void Rendering::checkLimits(bool isWhole, int done) {
  if (isWhole && done == wanted_) return;
  if (isTimeUp()) result_.end = RenderEnd::timeUp;
  if (isCancelled()) result_.end = RenderEnd::cancelled;
}

/// Passes of 1, 1, 2, 4, ... samples: a first picture soon, then little overhead.
void Rendering::renderPasses() {
  const Job shared = job();
  Table<int> tiles = openTiles(shared);
  int done = int(film_.minSamples());
  int size = 1;
  while (result_.end == RenderEnd::finished && (wanted_ == 0 || done < wanted_)) {
    pauseIfDue();
    const int count = wanted_ > 0 ? std::min(size, wanted_ - done) : size;
    const bool isWhole = runPass(shared, tiles, done, count);
    if (!isWhole && !isCancelled() && !isTimeUp()) continue;  // the same pass, after a pause
    done += count;
    if (isWhole && adaptive_ && (std::has_single_bit(unsigned(done)) || done == wanted_)) {
      adaptive_->judge(film_, done);
      tiles = openTiles(shared);
    }
    if (adaptive_ && adaptive_->isDone()) break;
    checkLimits(isWhole, done);
    if (isWhole && options_.passed) options_.passed();
    size = std::min(options_.mostInPass, std::max(size, done));
  }
}

}  // namespace

int wantedSamples(const Integrator& integrator, const RenderOptions& options) {
  if (options.samples > 0) return options.samples;
  if (options.seconds > 0 && !options.adaptive) return 0;  // until time is up
  if (options.noise > 0) return kMostSamples;
  return integrator.samples() > 0 ? integrator.samples() : kDefaultSamples;
}

RenderResult render(Scene& scene, Film& film, const RenderOptions& options) {
  return Rendering(scene, film, options).run();
}

Rgb inspectSample(Scene& scene, const FilmShape& film, int x, int y, std::uint32_t index,
                  const RenderOptions& options, PathRecord& record) {
  const auto goOn = [](double) { return true; };
  if (!options.isPrepared) scene.integrator().prepare({scene.view(), options.seed, 1, goOn});
  const PathSource source{
      .scene = scene.view(),
      .camera = scene.camera(),
      .filter = PixelFilterSampler(scene.film().filter),
      .width = film.width,
      .height = film.height,
      .seed = options.seed,
      .declaredSamples = std::uint64_t(wantedSamples(scene.integrator(), options)),
      .wantsJacobian = true};
  Counters counters;
  StartedPath path = startPath(source, x, y, index, {.counters = counters, .record = &record});
  if (isBlack(path.weight)) return {};
  return path.weight * scene.integrator().estimate(path.context);
}

}  // namespace vestige
