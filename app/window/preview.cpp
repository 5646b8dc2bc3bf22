// SPDX-License-Identifier: Apache-2.0
#include "app/window/preview.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <new>
#include <sstream>
#include <string_view>
#include <utility>

#include "app/checkpoint.h"
#include "app/crash.h"
#include "app/terminal.h"
#include "engine/scene/scene_impl.h"
#include "lang/source.h"

namespace vestige::app {
namespace {

constexpr int kFinest = 2, kCoarsest = 64;   ///< the first picture's pixels, in pixels
constexpr double kSoon = 0.02, kLate = 0.1;  ///< seconds that the first picture should take
constexpr double kStarving = 0.5;            ///< seconds without any picture
constexpr int kFewPixels = 96 * 96;          ///< no coarser picture is needed of so few
constexpr int kMostInPass = 4;               ///< samples a pixel between two pictures
constexpr int kFirstParticles = 20000, kMoreParticles = 4;  ///< then so many times as many

/// As it is to be typed.
std::string shellWord(const std::string& text) {
  const bool isPlain = std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return std::isalnum(c) || std::strchr("-_./=:,+@", c);
  });
  if (isPlain && !text.empty()) return text;
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

std::string firstError(const Diagnostics& diagnostics) {
  for (const Diagnostic& d : diagnostics.list())
    if (d.severity == Severity::error) return d.message;
  return "";
}

/// Numbers of particles, growing, for an integrator that shoots some; {0} for the others.
std::vector<std::int64_t> particleRounds(const OpenScene& open, const BuildOptions& build) {
  const Schema* schema = open.registry.schema("integrator", open.scene().integratorName());
  const Parameter* row = schema ? schema->find("particles") : nullptr;
  if (!row) return {0};
  auto wanted = std::int64_t(row->initial.v[0]);
  const Block* b = open.loaded.text.scene.last("integrator");
  if (b && b->plugin == open.scene().integratorName())
    if (const Value* given = b->find("particles")) wanted = std::int64_t(given->v[0]);
  for (const auto& [name, value] : build.settings)
    if (name == "particles") wanted = std::int64_t(value.v[0]);
  std::vector<std::int64_t> rounds;
  for (std::int64_t n = kFirstParticles; n < wanted; n *= kMoreParticles) rounds.push_back(n);
  rounds.push_back(wanted);
  return rounds;
}

}  // namespace

Preview::Preview(SceneInput input, RenderOptions render, const Wish& first,
                 std::function<void()> wake)
    : input_(std::move(input)), render_(std::move(render)), wake_(std::move(wake)), wish_(first) {
  thread_ = std::thread([this] { work(); });
}

Preview::~Preview() {
  {
    const std::lock_guard lock(mutex_);
    quits_ = cancel_ = cancelCoarse_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

// ---------------------------------------------------------------- from the window
void Preview::want(const Wish& wish) {
  const std::lock_guard lock(mutex_);
  if (!wish.isSamePicture(wish_) || wish.isPaused != wish_.isPaused ||
      wish.samples != wish_.samples)
    isFresh_ = cancel_ = true;
  wish_ = wish;
  changed_.notify_all();
}

void Preview::inspect(int x, int y, std::uint32_t sample) {
  const std::lock_guard lock(mutex_);
  clickedAt_ = {x, y, sample};
  changed_.notify_all();
}

void Preview::hover(int x, int y) {
  const std::lock_guard lock(mutex_);
  hoveredAt_ = {x, y, 0};
  changed_.notify_all();
}

void Preview::forgetInspection() {
  const std::lock_guard lock(mutex_);
  inspection_.reset();
  clickedAt_.reset();
}

void Preview::keep(const std::string& file) {
  const std::lock_guard lock(mutex_);
  keepAs_ = file;
  isFresh_ = cancel_ = true;  // the film stands still, and goes on
  changed_.notify_all();
}

std::string Preview::news() {
  const std::lock_guard lock(mutex_);
  return std::exchange(news_, "");
}

std::shared_ptr<const Snapshot> Preview::snapshot() const {
  const std::lock_guard lock(mutex_);
  return snapshot_;
}
std::shared_ptr<const Inspection> Preview::inspection() const {
  const std::lock_guard lock(mutex_);
  return inspection_;
}
std::shared_ptr<const Inspection> Preview::hovered() const {
  const std::lock_guard lock(mutex_);
  return hovered_;
}
std::shared_ptr<const OpenScene> Preview::open() const {
  const std::lock_guard lock(mutex_);
  return shown_;
}
Status Preview::status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}
std::set<std::string> Preview::files() const {
  const std::lock_guard lock(mutex_);
  return files_;
}

std::filesystem::file_time_type Preview::readAt() const {
  const std::lock_guard lock(mutex_);
  return readAt_;
}

// ---------------------------------------------------------------- the working thread
void Preview::work() {
  useCrashStack();
  for (;;) {
    Wish wish;
    bool isFresh;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] { return quits_ || isFresh_ || clickedAt_ || hoveredAt_; });
      wish = wish_, isFresh = isFresh_;
      if (quits_ && keepAs_.empty()) return;
      isFresh_ = cancel_ = false;
    }
    try {
      doWish(wish, isFresh);
    } catch (const std::bad_alloc&) {
      film_.reset();
      fail("out of memory");
    } catch (const std::exception& e) {
      film_.reset();
      fail(e.what());
    }
  }
}

void Preview::doWish(const Wish& wish, bool isFresh) {
  keepIfAsked(wish);
  if (quits_) return;
  if (isFresh && wish.isPaused) setPhase("paused");
  if (isFresh && !wish.isPaused) {
    wished_ = secondsNow(), hasFirst_ = false;
    if (makeReady(wish)) renderPicture(wish);
  }
  if (isPrepared_) answerRequests(wish);
  const std::lock_guard lock(mutex_);
  if (!isPrepared_) clickedAt_.reset(), hoveredAt_.reset();  // nothing can be traced
}

bool Preview::makeReady(const Wish& wish) {
  if (!open_ || wish.reload != done_.reload) {
    isTextWrong_ = !load(wish);
    if (isTextWrong_) setPhase("waiting for a save");
    done_ = wish;
    done_.way = done_.view = -1;
  }
  {
    // What an earlier wish could not have is forgotten; what is wrong with the text is not.
    const std::lock_guard lock(mutex_);
    status_.isWrong = isTextWrong_, status_.complaints = textComplaints_;
  }
  return !isTextWrong_ && renew(wish);
}

bool Preview::load(const Wish& wish) {
  setPhase("reading");
  {
    const std::lock_guard lock(mutex_);
    readAt_ = std::filesystem::file_time_type::clock::now();
  }
  auto fresh = std::make_shared<OpenScene>(loadRegistry(input_.pluginPaths));
  BuildOptions build = wish.build;
  build.files = &fresh->looked;
  build.cache = cache_;
  build.integrator.clear(), build.footprint.clear(), build.settings.clear();  // see renew()
  fresh->loaded = loadScene(input_, fresh->registry, Stage::built, build, &texts_);
  std::set<std::string> files = fresh->looked;
  files.insert(input_.file);
  for (int i = 0; i < fresh->loaded.text.sources->size(); ++i)
    files.insert(fresh->loaded.text.sources->text(i).name);
  for (const std::string& file : fresh->registry.loadedFiles()) files.insert(file);
  for (const Refusal& r : fresh->registry.refused()) files.insert(r.file);
  {
    const std::lock_guard lock(mutex_);
    files_.swap(files);
  }
  complainAbout(fresh->loaded);
  const bool isFine = fresh->loaded.scene && isAccepted(fresh->loaded.text, input_.werror);
  if (const Block* b = fresh->loaded.text.scene.last("camera")) fresh->camera = *b;
  if (const Schema* s = fresh->registry.schema("camera", fresh->camera.plugin))
    fresh->cameraSchema = *s;
  if (isFine) fresh->integrators = fresh->registry.names("integrator");
  if (!isFine) return false;
  std::shared_ptr<const OpenScene> before = fresh;  // dies without the lock
  {
    const std::lock_guard lock(mutex_);
    shown_.swap(before);
    inspection_.reset(), hovered_.reset();
  }
  open_ = fresh;
  isPrepared_ = isLastRound_ = false;
  film_.reset();
  return true;
}

void Preview::complainAbout(const LoadedScene& loaded) {
  textComplaints_.clear();
  for (const Diagnostic& d : loaded.text.diagnostics.list()) {
    std::ostringstream text;
    lang::print(text, d, *loaded.text.sources, false);
    textComplaints_.push_back({d.severity, text.str(), lang::locate(d.span, *loaded.text.sources)});
  }
}

/// Camera and integrator, where they are not yet as wished.
bool Preview::renew(const Wish& wish) {
  Diagnostics diagnostics;
  SceneDesc text = open_->loaded.text.scene;
  if (wish.view != done_.view) {
    if (wish.camera) text.blocks.push_back(*wish.camera);
    renewCamera(open_->scene(), text, open_->registry, diagnostics);
  }
  if (wish.way != done_.way) {
    renewIntegrator(open_->scene(), text, open_->registry, wish.build, diagnostics);
    isPrepared_ = isLastRound_ = false;
  }
  done_ = wish;
  if (!diagnostics.hasErrors()) return true;
  done_.view = done_.way = -1;  // what is there is not what was wished
  fail(firstError(diagnostics));
  return false;
}

FilmShape Preview::shapeFor(const Wish& wish) const {
  return filmShape(open_->scene(), wish.width, wish.height,
                   wish.region ? wish.region->data() : nullptr);
}

Film Preview::filmFor(const Wish& wish, int scale) const {
  const FilmShape whole = shapeFor(wish);
  const std::vector<std::string> known = aovNames(open_->scene().integrator().aovs());
  std::vector<std::string> aovs = wish.aovs;
  std::erase_if(aovs, [&](const std::string& name) {
    return std::find(known.begin(), known.end(), name) == known.end();
  });
  return makeFilm(open_->scene(), std::max(1, whole.width / scale),
                  std::max(1, whole.height / scale), wish.region ? wish.region->data() : nullptr,
                  aovs);
}

/// Whether the film may get more samples. Where footprints go by the number of samples that was
/// declared, a picture of more of them is another one from the first.
bool Preview::canGoOn(const Wish& wish) const {
  if (!film_ || !wish.isSamePicture(filmWish_)) return false;
  if (wish.samples == filmWish_.samples) return true;
  return !goesByDeclaredSamples(open_->loaded.text.scene, wish.build);
}

void Preview::renderPicture(const Wish& wish) {
  if (canGoOn(wish)) {
    filmWish_ = wish;
    if (renderStage(wish, *film_, 1, wish.samples)) setPhase("finished");
    return;
  }
  film_.reset();
  const FilmShape shape = shapeFor(wish);
  // Particles know nothing of the camera: once they have flown, they need not again.
  const std::vector<std::int64_t> rounds = isLastRound_ && isPrepared_
                                               ? std::vector<std::int64_t>{0}
                                               : particleRounds(*open_, wish.build);
  for (std::size_t i = 0; i < rounds.size(); ++i) {
    if (rounds[i] > 0) {
      BuildOptions build = wish.build;
      build.settings.push_back({"particles", numberValue(double(rounds[i]))});
      Diagnostics diagnostics;
      isPrepared_ = false;
      if (!renewIntegrator(open_->scene(), open_->loaded.text.scene, open_->registry, build,
                           diagnostics))
        return fail(firstError(diagnostics));
    }
    isLastRound_ = i + 1 == rounds.size();
    if (i == 0 && std::int64_t(shape.width) * shape.height > kFewPixels && !renderCoarse(wish))
      return;
    if (!isLastRound_) {
      Film film = filmFor(wish, 1);
      if (!renderStage(wish, film, 1, 1)) return;
      continue;
    }
    film_ = filmFor(wish, 1), filmWish_ = wish, effort_ = {};
    if (!renderStage(wish, *film_, 1, wish.samples)) return;
  }
  setPhase("finished");
}

/// Large pixels first. How large is learnt from the time that the last ones took.
bool Preview::renderCoarse(const Wish& wish) {
  Film film = filmFor(wish, coarse_);
  cancelCoarse_ = false;
  const double start = secondsNow();
  const bool isWhole = renderStage(wish, film, coarse_, 1);
  const double seconds = secondsNow() - start;
  if (seconds > kLate) coarse_ = std::min(kCoarsest, coarse_ * 2);
  if (seconds < kSoon) coarse_ = std::max(kFinest, coarse_ / 2);
  return isWhole && !cancel_;
}

bool Preview::renderStage(const Wish& wish, Film& film, int scale, int samples) {
  Scene& scene = open_->scene();
  RenderOptions options = render_;
  options.samples = samples;
  options.cancel = scale > 1 ? &cancelCoarse_ : &cancel_;
  options.isPrepared = isPrepared_;
  options.mostInPass = kMostInPass;
  const double start = secondsNow();
  options.passed = [&] {
    isPrepared_ = true;
    publish(wish, film, scale, secondsNow() - start);
    answerRequests(wish);
  };
  options.progress = [&](const Progress& p) {
    {
      const std::lock_guard lock(mutex_);
      status_.phase = p.phase, status_.share = p.share, status_.remaining = p.remaining;
      status_.samples = p.samples, status_.wanted = p.wanted;
    }
    isPrepared_ = isPrepared_ || std::string_view(p.phase) == "rendering";
    if (isPrepared_) answerRequests(wish);
    // Now and then a coarse picture is finished however late it is.
    if (cancel_ && p.elapsed > kLate && secondsNow() - published_ < kStarving) cancelCoarse_ = true;
    wake_();
  };
  setPhase("rendering");
  const RenderResult result = render(scene, film, options);
  isPrepared_ = isPrepared_ || result.counters.paths > 0;
  if (film_ && &film == &*film_)
    effort_.seconds += result.seconds, add(effort_.counters, result.counters);
  {
    const std::lock_guard lock(mutex_);
    if (result.seconds > 0)
      status_.raysPerSecond =
          double(result.counters.rays + result.counters.shadowRays) / result.seconds;
    status_.samples = result.samples;
  }
  return result.end == RenderEnd::finished;
}

void Preview::publish(const Wish& wish, const Film& film, int scale, double seconds) {
  auto fresh = std::make_shared<Snapshot>();
  const FilmShape whole = shapeFor(wish);
  fresh->open = open_, fresh->camera = open_->scene().impl().camera;
  fresh->means = film.means(), fresh->crop = film.crop();
  fresh->filmWidth = whole.width, fresh->filmHeight = whole.height;
  const Crop& c = fresh->crop;
  const auto w = float(film.width()), h = float(film.height());
  fresh->part = {float(c.x0) / w, float(c.y0) / h, float(c.x1) / w, float(c.y1) / h};
  published_ = secondsNow();
  fresh->scale = scale, fresh->samples = int(film.minSamples()), fresh->seconds = seconds;
  fresh->wish = wish, fresh->integrator = open_->scene().integratorName();
  fresh->aovs = aovNames(open_->scene().integrator().aovs());
  std::shared_ptr<const Snapshot> published = std::move(fresh);
  {
    const std::lock_guard lock(mutex_);
    if (!hasFirst_) status_.firstPicture = secondsNow() - wished_;
    hasFirst_ = true;
    status_.samples = published->samples;
    snapshot_.swap(published);
  }  // the one before dies without the lock
  wake_();
}

void Preview::keepIfAsked(const Wish& wish) {
  std::string file;
  {
    const std::lock_guard lock(mutex_);
    file.swap(keepAs_);
  }
  if (file.empty()) return;
  std::string said = "there is no whole picture to keep yet";
  if (film_ && film_->minSamples() > 0 && wish.isSamePicture(filmWish_)) try {
      said = keepFilm(file);
    } catch (const std::bad_alloc&) {
      said = "out of memory: nothing was kept";
    } catch (const std::exception& e) {
      said = e.what();
    }
  {
    const std::lock_guard lock(mutex_);
    news_ = said;
  }
  wake_();
}

/// What came of it.
std::string Preview::keepFilm(const std::string& file) {
  // The camera in hand is that of the text into which it was pasted.
  SceneDesc text = open_->loaded.text.scene;
  const auto last = std::find_if(text.blocks.rbegin(), text.blocks.rend(),
                                 [](const Block& b) { return b.kind == "camera"; });
  if (filmWish_.camera && last != text.blocks.rend()) *last = *filmWish_.camera;
  BuildOptions build = filmWish_.build;
  build.files = &open_->looked;
  RenderOptions render = render_;
  render.samples = filmWish_.samples;
  CheckpointFile checkpoint(file,
                            checkpointLabel(text, open_->scene(), open_->registry, build, render));
  const Film bare = withoutAovs(*film_);
  // One of another render, or of more samples, is not lost.
  Film older = bare;
  CheckpointFile(checkpoint).load(older, int(bare.minSamples()));
  RenderResult soFar;
  soFar.seconds = effort_.seconds, soFar.counters = effort_.counters;
  std::string said = howToGoOn(file);
  checkpoint.save(bare, open_->scene(), soFar, [&](const std::string& why) { said = why; });
  return said;
}

/// With the options that the film was made with.
std::string Preview::howToGoOn(const std::string& file) const {
  const Wish& wish = filmWish_;
  const FilmShape scenes = filmShape(open_->scene(), 0, 0, nullptr);
  std::string options;
  const auto add = [&](const char* option, const std::vector<std::string>& values) {
    for (const std::string& v : values) options += fmt::format(" {} {}", option, shellWord(v));
  };
  add("-D", input_.definitions);
  add("-I", input_.includePaths);
  add("--plugin-path", input_.pluginPaths);
  if (render_.seed != 0) options += fmt::format(" --seed {}", render_.seed);
  if (film_->width() != scenes.width || film_->height() != scenes.height)
    options += fmt::format(" --width {} --height {}", film_->width(), film_->height());
  if (wish.region) {
    const auto& r = *wish.region;
    options += fmt::format(" --crop {},{},{},{}", r[0], r[1], r[2], r[3]);
  }
  if (!wish.build.integrator.empty()) options += " --integrator " + wish.build.integrator;
  if (!wish.build.footprint.empty()) options += " --footprint " + wish.build.footprint;
  const bool isFixed = goesByDeclaredSamples(open_->loaded.text.scene, wish.build);
  const std::string samples =
      isFixed
          ? std::to_string(wantedSamples(open_->scene().integrator(), {.samples = wish.samples}))
          : "...";
  return fmt::format("kept {}: vestige render {}{} --checkpoint {} --spp {} goes on{}",
                     count(film_->minSamples(), "sample"), shellWord(input_.file), options,
                     shellWord(file), samples,
                     wish.camera ? ", with this camera in the text (C)" : "");
}

void Preview::answerRequests(const Wish& wish) {
  std::optional<Request> clicked, hovered;
  {
    const std::lock_guard lock(mutex_);
    clicked.swap(clickedAt_), hovered.swap(hoveredAt_);
  }
  if (!clicked && !hovered) return;
  const auto path = clicked ? answer(wish, *clicked) : nullptr;
  const auto beneath = hovered ? answer(wish, *hovered) : nullptr;
  {
    const std::lock_guard lock(mutex_);
    if (path) inspection_ = path;
    if (beneath) hovered_ = beneath;
  }
  wake_();
}

/// Null beside the film.
std::shared_ptr<const Inspection> Preview::answer(const Wish& wish, const Request& request) const {
  const FilmShape film = shapeFor(wish);
  if (request.x < 0 || request.y < 0 || request.x >= film.width || request.y >= film.height)
    return nullptr;
  auto fresh = std::make_shared<Inspection>();
  fresh->open = open_, fresh->camera = open_->scene().impl().camera;
  fresh->x = request.x, fresh->y = request.y, fresh->sample = request.sample;
  fresh->filmWidth = film.width, fresh->filmHeight = film.height;
  RenderOptions options = render_;
  options.samples = wish.samples, options.isPrepared = true;
  fresh->radiance = inspectSample(open_->scene(), film, request.x, request.y, request.sample,
                                  options, fresh->path);
  return fresh;
}

void Preview::fail(const std::string& sentence) {
  {
    const std::lock_guard lock(mutex_);
    status_.isWrong = true;
    status_.phase = "stopped";
    status_.complaints = {{Severity::error, sentence, {}}};
  }
  wake_();
}

void Preview::setPhase(const std::string& phase) {
  {
    const std::lock_guard lock(mutex_);
    status_.phase = phase;
  }
  wake_();
}

}  // namespace vestige::app
