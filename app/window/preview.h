// SPDX-License-Identifier: Apache-2.0
// Renders in the background what the window wants to see. Wishes never wait: the newest counts, and
// what was under way for an older one is dropped. Knows nothing of windows.
#pragma once
#include <array>
#include <atomic>
#include <condition_variable>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <thread>

#include "app/path_text.h"
#include "app/scene_input.h"
#include "engine/film/checkpoint.h"
#include "engine/render/session.h"
#include "engine/scene/build_cache.h"
#include "lang/text_store.h"

namespace vestige::app {

/// What to show. A counter goes up when its part changed: only what stands below it is done anew.
struct Wish {
  int reload = 0;  ///< some file did: text, scene, picture
  int way = 0;     ///< how light is found: the integrator, then the picture
  BuildOptions build;
  int view = 0;                                 ///< the camera, then the picture
  std::optional<Block> camera;                  ///< in place of the text's
  int picture = 0;                              ///< how it is sampled
  int width = 0, height = 0;                    ///< 0: the scene's
  std::optional<std::array<double, 4>> region;  ///< of the film, in place of the scene's crop
  std::vector<std::string> aovs;                ///< those that the integrator lacks are left out
  int samples = 0;  ///< a pixel; 0: what the scene says. More of them go on with the same picture
  bool isPaused = false;  ///< keeps the picture, and goes on with it later

  bool isSamePicture(const Wish& other) const {
    return reload == other.reload && way == other.way && view == other.view &&
           picture == other.picture;
  }
};

/// A scene as it was read, kept alive by everything that was made from it.
struct OpenScene {
  explicit OpenScene(Registry r) : registry(std::move(r)) {}
  Registry registry;
  LoadedScene loaded;
  // For the window, which may not ask the registry: that is the working thread's.
  Block camera;
  Schema cameraSchema;
  std::vector<std::string> integrators;
  std::set<std::string> looked;  ///< files that the builder looked for
  Scene& scene() const { return *loaded.scene; }
};

/// The picture so far. Nobody changes it any more.
struct Snapshot {
  std::shared_ptr<const OpenScene> open;
  std::shared_ptr<const Camera> camera;
  Film::Means means;
  Crop crop;
  int filmWidth = 0, filmHeight = 0;  ///< of the whole film in its final size
  int scale = 1;                      ///< a pixel of `means` is so many pixels wide
  /// What part of the film `means` holds: left, top, right, bottom as shares of it.
  std::array<float, 4> part = {0, 0, 1, 1};
  int samples = 0;
  double seconds = 0;  ///< since the wish
  Wish wish;
  std::string integrator;
  std::vector<std::string> aovs;  ///< that the integrator has
};

/// What the text, or a plugin, has to say to the user.
struct Complaint {
  Severity severity;
  std::string text;   ///< with line and caret
  lang::Place place;  ///< line 0: nowhere
};

struct Status {
  std::string phase = "reading";     ///< "reading", "preparing", "rendering", "finished", "paused"
  double share = 0, remaining = -1;  ///< as in Progress
  int samples = 0, wanted = 0;
  double raysPerSecond = 0;
  double firstPicture = 0;  ///< seconds from the last wish to its first picture
  bool isWrong = false;     ///< what is wanted cannot be shown: it is an older picture
  std::vector<Complaint> complaints;
};

/// One path, for the inspector.
struct Inspection {
  std::shared_ptr<const OpenScene> open;
  std::shared_ptr<const Camera> camera;
  int x = 0, y = 0, filmWidth = 0, filmHeight = 0;
  std::uint32_t sample = 0;
  RecordedPath path;
  Rgb radiance;
};

class Preview {
 public:
  /// `wake` is called, on another thread, when there is something new to see.
  Preview(SceneInput input, RenderOptions render, const Wish& first, std::function<void()> wake);
  ~Preview();
  Preview(const Preview&) = delete;
  Preview& operator=(const Preview&) = delete;

  void want(const Wish& wish);
  /// Traces that sample of that pixel of the film and keeps its path; soon, whatever else is under
  /// way.
  void inspect(int x, int y, std::uint32_t sample);
  void forgetInspection();
  /// The same beside it, for what is under the cursor: the first sample.
  void hover(int x, int y);
  /// Keeps the picture so far in a file from which `vestige render --checkpoint` goes on; soon.
  /// What came of it is a sentence that news() tells once.
  void keep(const std::string& file);
  std::string news();

  std::shared_ptr<const Snapshot> snapshot() const;
  std::shared_ptr<const Inspection> inspection() const;
  std::shared_ptr<const Inspection> hovered() const;
  std::shared_ptr<const OpenScene> open() const;
  Status status() const;
  /// Every file that the scene came from or looked for, plugin libraries too.
  std::set<std::string> files() const;
  /// When their reading began.
  std::filesystem::file_time_type readAt() const;

 private:
  struct Request {
    int x, y;
    std::uint32_t sample;
  };

  void work();
  void doWish(const Wish& wish, bool isFresh);
  /// False where the picture cannot be made.
  bool makeReady(const Wish& wish);
  bool load(const Wish& wish);
  void complainAbout(const LoadedScene& loaded);
  bool renew(const Wish& wish);
  void renderPicture(const Wish& wish);
  /// One size and one set of particles; false if something newer is wanted or it cannot be.
  bool renderStage(const Wish& wish, Film& film, int scale, int samples);
  bool canGoOn(const Wish& wish) const;
  bool renderCoarse(const Wish& wish);
  FilmShape shapeFor(const Wish& wish) const;
  Film filmFor(const Wish& wish, int scale) const;
  void publish(const Wish& wish, const Film& film, int scale, double seconds);
  void keepIfAsked(const Wish& wish);
  std::string keepFilm(const std::string& file);
  std::string howToGoOn(const std::string& file) const;
  void answerRequests(const Wish& wish);
  std::shared_ptr<const Inspection> answer(const Wish& wish, const Request& request) const;
  void fail(const std::string& sentence);
  void setPhase(const std::string& phase);

  const SceneInput input_;
  const RenderOptions render_;
  const std::function<void()> wake_;

  mutable std::mutex mutex_;  ///< over everything down to the next line
  std::condition_variable changed_;
  Wish wish_;
  bool isFresh_ = true;
  std::atomic<bool> quits_ = false;
  std::optional<Request> clickedAt_, hoveredAt_;  ///< a newer question takes an older one's place
  std::string keepAs_;                            ///< a file; "": nobody asked
  std::string news_;
  std::shared_ptr<const Snapshot> snapshot_;
  std::shared_ptr<const Inspection> inspection_, hovered_;
  std::shared_ptr<const OpenScene> shown_;
  Status status_;
  std::set<std::string> files_;
  std::filesystem::file_time_type readAt_;

  std::atomic<bool> cancel_{false};
  /// Of the coarse picture: it may be finished though something newer is wanted, or a camera that
  /// is moved all the time would never be seen.
  std::atomic<bool> cancelCoarse_{false};
  // Of the working thread alone:
  const std::shared_ptr<BuildCache> cache_ = std::make_shared<BuildCache>();
  lang::TextStore texts_;
  std::shared_ptr<OpenScene> open_;
  Wish done_;  ///< what open_ was made for
  bool isTextWrong_ = false;
  std::vector<Complaint> textComplaints_;  ///< of the last reading
  bool isPrepared_ = false;                ///< the integrator
  bool isLastRound_ = false;               ///< with all the particles that it is to have
  double published_ = 0;                   ///< when the last picture was
  double wished_ = 0;
  bool hasFirst_ = false;
  int coarse_ = 8;            ///< how coarse the first picture is: as much as it takes to come soon
  std::optional<Film> film_;  ///< of the last stage, as far as it got
  Wish filmWish_;             ///< what it was made for
  Effort effort_;             ///< that it took
  std::thread thread_;
};

}  // namespace vestige::app
