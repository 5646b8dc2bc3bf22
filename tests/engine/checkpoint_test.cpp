// SPDX-License-Identifier: Apache-2.0
// A film kept in a file: what went in comes out, what goes on from it is what never stopped, and
// nothing else than a whole file of the same render is taken.
#include "engine/film/checkpoint.h"

#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <fstream>

#include "engine/render/session.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/temp_folder.h"

using namespace vestige;
using test::TempFolder;

namespace {

constexpr Crop kCrop{1, 0, 4, 2};
const CheckpointLabel kLabel = {{"the scene", "1f", true}, {"the seed", "7"}};
const Effort kEffort{1.5, {.rays = 9, .paths = 5, .clampedIndirect = 3}};

/// Six pixels with different numbers of samples.
Film someFilm(std::vector<std::string> aovs = {"normal", "depth"}) {
  Film film(5, 3, kCrop, std::move(aovs));
  Counters counters;
  Aovs seen;
  seen.normal = {0, 1, 0}, seen.depth = 3;
  for (int y = kCrop.y0; y < kCrop.y1; ++y)
    for (int x = kCrop.x0; x < kCrop.x1; ++x)
      for (int i = 0; i <= x + y; ++i)
        film.add(x, y, {Real(0.1) * Real(i), -2, 1e12}, seen, counters);
  seen.depth = kInfinity;  // is cut
  film.add(kCrop.x0, kCrop.y0, {}, seen, counters);
  return film;
}
Film emptyFilm(std::vector<std::string> aovs = {"normal", "depth"}) {
  return Film(5, 3, kCrop, std::move(aovs));
}

std::string contents(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Why the file is not taken; "" if it is.
std::string whyNot(Film film, const CheckpointLabel& label, const std::string& file) {
  const Film before = film;
  try {
    loadCheckpoint(film, label, file);
    return "";
  } catch (const std::runtime_error& e) {
    CHECK(film == before);
    return e.what();
  }
}

SceneDesc largeRoom() {
  SceneDesc s = test::room(0.7, "path", {{"depth", numberValue(4)}});
  for (Block& b : s.blocks)
    if (b.kind == "film")
      b = test::makeBlock("film", "", {{"resolution", vectorValue({160, 160})}});
  return s;
}

struct Rendering {
  std::unique_ptr<Scene> scene;
  Film film;
};
Rendering begin(const SceneDesc& text) {
  Diagnostics diagnostics;
  auto scene = buildScene(text, test::registry(), {}, diagnostics);
  REQUIRE(scene);
  Film film = makeFilm(*scene, 0, 0, nullptr, {"albedo"});
  return {std::move(scene), std::move(film)};
}

}  // namespace

TEST_CASE("a film comes back from its checkpoint", "[checkpoint]") {
  const TempFolder folder;
  const std::string file = folder / "a.checkpoint";
  const Film film = someFilm();
  saveCheckpoint(film, kLabel, kEffort, file);
  saveCheckpoint(film, kLabel, kEffort, file);  // in place of the first
  Film back = emptyFilm();
  const Effort effort = loadCheckpoint(back, kLabel, file);
  CHECK(back == film);
  CHECK(back.means().pixels == film.means().pixels);
  CHECK(effort.seconds == 1.5);
  CHECK(effort.counters.rays == 9);
  CHECK(effort.counters.paths == 5);
  CHECK(effort.counters.clampedIndirect == 3);
  CHECK(folder.files() == 1);
}

TEST_CASE("a checkpoint of another render is refused by its first difference", "[checkpoint]") {
  const TempFolder folder;
  const std::string file = folder / "a.checkpoint";
  saveCheckpoint(someFilm(), kLabel, kEffort, file);
  const auto because = [&](const std::string& text) {
    return containsText("'" + file + "' is of another render: " + text + "; delete it");
  };
  CheckpointLabel other = {{"the scene", "2f", true}, kLabel[1]};
  CHECK_THAT(whyNot(emptyFilm(), other, file), because("the scene has changed"));
  other = {kLabel[0], {"the seed", "8"}};
  CHECK_THAT(whyNot(emptyFilm(), other, file), because("the seed was 7 and is 8 now"));
  other = {kLabel[0], {"the file 'a\nb'", "3", true}, kLabel[1]};
  CHECK_THAT(whyNot(emptyFilm(), other, file), because("the file 'a?b' is new"));
  CHECK_THAT(whyNot(Film(5, 4, kCrop, {"normal", "depth"}), kLabel, file),
             because("the film's size was 5 x 3 and is 5 x 4 now"));
  CHECK_THAT(whyNot(Film(5, 3, {0, 0, 3, 2}, {"normal", "depth"}), kLabel, file),
             because("the crop window was 1,0,4,2 and is 0,0,3,2 now"));
  CHECK_THAT(whyNot(emptyFilm({}), kLabel, file),
             because("the list of AOVs was normal,depth and is empty now"));
  CHECK_THAT(whyNot(emptyFilm(), kLabel, folder / "none"), containsText("cannot be read"));
  CHECK_THAT(whyNot(emptyFilm(), kLabel, folder.path()), containsText("cannot be read"));
}

TEST_CASE("a checkpoint of another layout is refused with its own sentence", "[checkpoint]") {
  const TempFolder folder;
  const std::string file = folder / "a.checkpoint";
  saveCheckpoint(someFilm(), kLabel, kEffort, file);
  std::string bytes = contents(file);
  REQUIRE(bytes.rfind("vestige checkpoint 2\n", 0) == 0);
  for (const char layout : {'1', '3'}) {
    bytes[19] = layout;
    std::ofstream(file, std::ios::binary) << bytes;
    CHECK(whyNot(emptyFilm(), kLabel, file) ==
          "checkpoint '" + file + "' has layout " + layout +
              ", and this version of the program reads layout 2 only; delete it to begin anew, or "
              "choose another name");
  }
}

TEST_CASE("a checkpoint whose AOVs have other units is refused", "[checkpoint]") {
  const TempFolder folder;
  const std::string file = folder / "a.checkpoint";
  saveCheckpoint(someFilm(), kLabel, kEffort, file);
  CHECK_THAT(whyNot(Film(5, 3, kCrop, {"normal", "depth"}, 8), kLabel, file),
             containsText("the list of the AOVs' units was -40,-32 and is -40,-29 now"));
}

TEST_CASE("a checkpoint that was cut short or has a wrong bit is refused", "[checkpoint]") {
  const TempFolder folder;
  const std::string file = folder / "a.checkpoint";
  saveCheckpoint(someFilm(), kLabel, kEffort, file);
  const std::string whole = contents(file);
  const auto refuses = [&](const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
    return whyNot(emptyFilm(), kLabel, file) != "";
  };
  CHECK_FALSE(refuses(whole));
  CHECK(refuses(whole + '\0'));
  int taken = 0;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    taken += !refuses(whole.substr(0, i));
    std::string wrong = whole;
    wrong[i] = char(wrong[i] ^ (1 << i % 8));
    taken += !refuses(wrong);
  }
  CHECK(taken == 0);
  CHECK_THAT((refuses("PNG"), whyNot(emptyFilm(), kLabel, file)), containsText("is no checkpoint"));
  CHECK_THAT((refuses(whole.substr(0, 200)), whyNot(emptyFilm(), kLabel, file)),
             containsText("is damaged"));
}

TEST_CASE("where a checkpoint cannot be written the one before stays", "[checkpoint]") {
  const TempFolder folder;
  const std::string file = folder / "a.checkpoint";
  saveCheckpoint(emptyFilm(), kLabel, {}, file);
  const std::string before = contents(file);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit;
  getrlimit(RLIMIT_FSIZE, &limit);
  rlimit tight = limit;
  tight.rlim_cur = 300;  // as if the disk were full
  setrlimit(RLIMIT_FSIZE, &tight);
  std::string why;
  try {
    saveCheckpoint(someFilm(), kLabel, kEffort, file);
  } catch (const std::runtime_error& e) {
    why = e.what();
  }
  setrlimit(RLIMIT_FSIZE, &limit);
  std::signal(SIGXFSZ, handler);
  CHECK_THAT(why, containsText("'" + file + "' could not be written: File too large"));
  CHECK(contents(file) == before);
  CHECK(folder.files() == 1);
  CHECK_THROWS_AS(saveCheckpoint(someFilm(), kLabel, kEffort, folder / "no/a.checkpoint"),
                  std::runtime_error);
}

TEST_CASE("a render that goes on from a checkpoint is the one that never stopped", "[checkpoint]") {
  const TempFolder folder;
  Rendering whole = begin(largeRoom());
  int uneven = 0;
  const auto file = [&](int i) { return folder / (std::to_string(i) + ".checkpoint"); };
  const auto keep = [&](const RenderResult& soFar) {
    CHECK(soFar.counters.paths == std::uint64_t(std::llround(soFar.meanSamples * 160 * 160)));
    if (soFar.samples == soFar.mostSamples) return;  // between passes: too easy
    ++uneven;
    saveCheckpoint(whole.film, kLabel, {}, file(uneven == 1 ? 0 : 1));  // first and last
  };
  render(*whole.scene, whole.film,
         {.samples = 24, .threads = 1, .pauseEvery = 1e-3, .paused = keep});
  CHECK(whole.film.minSamples() == 24);
  CHECK(whole.film.maxSamples() == 24);
  REQUIRE(uneven > 0);  // else the machine is too fast for this test

  Rendering plain = begin(largeRoom());
  render(*plain.scene, plain.film, {.samples = 24, .threads = 2});
  CHECK(whole.film == plain.film);
  for (int i = 0; i < std::min(uneven, 2); ++i) {
    Rendering next = begin(largeRoom());
    loadCheckpoint(next.film, kLabel, file(i));
    const double there = next.film.meanSamples() / 24;
    double first = -1;
    const auto progress = [&](const Progress& p) {
      if (first < 0) first = p.share;
      // Only what this call has done tells how fast it is.
      if (p.share > there)
        CHECK(p.remaining == Approx(p.elapsed * (1 - p.share) / (p.share - there)));
    };
    const RenderResult r =
        render(*next.scene, next.film, {.samples = 24, .threads = 2, .progress = progress});
    CHECK(next.film == plain.film);
    CHECK((first < 0 || first >= there));  // so soon done that nothing was told
    CHECK(r.counters.paths == std::uint64_t(std::llround((1 - there) * 24 * 160 * 160)));
  }
}
