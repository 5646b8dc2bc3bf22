// SPDX-License-Identifier: Apache-2.0
// The renderer behind the window, without a window.
#include "app/window/preview.h"

#include <chrono>
#include <fstream>
#include <map>
#include <random>

#include "app/run.h"
#include "app/window/footprint_region.h"
#include "app/window/steer.h"
#include "support/catch.h"

using namespace vestige;
using namespace vestige::app;

namespace {

constexpr double kPatience = 60;  // seconds; what is waited for takes a fraction of one

/// A scene file, its preview, and how often that called.
struct Bench {
  explicit Bench(const std::string& text, const Wish& first = {})
      : file(folder.write("a.scene", text)) {
    SceneInput input;
    input.file = file;
    RenderOptions options;
    options.threads = 2;
    preview = std::make_unique<Preview>(input, options, first, [this] { ++calls; });
    wish = first;
  }
  template <class Condition>
  bool comes(const Condition& condition) const {
    const double start = secondsNow();
    while (!condition()) {
      if (secondsNow() - start > kPatience) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return true;
  }
  bool isFinished(int samples) const {
    const auto s = preview->snapshot();
    return preview->status().phase == "finished" && s && s->samples == samples && s->scale == 1 &&
           s->wish.isSamePicture(wish);
  }
  void want() { preview->want(wish); }
  void rewrite(const std::string& text) {
    std::ofstream(file) << text;
    ++wish.reload;
    want();
  }

  Folder folder;
  std::string file;
  std::atomic<int> calls{0};
  Wish wish;
  std::unique_ptr<Preview> preview;
};

std::string scene(const std::string& colour, int samples = 4, const std::string& more = "") {
  return "camera pinhole { location <0, 1, -4> look_at <0, 0.7, 0> }\n"
         "film { resolution <160, 120> }\n"
         "integrator path { samples " +
         std::to_string(samples) +
         " }\n"
         "light environment { radiance rgb 1 }\n"
         "plane { y, 0 brdf lambert { diffuse pigment checker { rgb 0.2, rgb 0.8 } } }\n"
         "sphere { <0, 0.7, 0>, 0.7 brdf lambert { diffuse rgb " +
         colour + " } }\n" + more;
}

/// What `vestige render` would make of it.
Film::Means rendered(const Bench& b, int samples) {
  SceneInput input;
  input.file = b.file;
  const Registry registry = loadRegistry({});
  const LoadedScene loaded = loadScene(input, registry, Stage::built);
  REQUIRE(loaded.scene);
  Film film = makeFilm(*loaded.scene, 0, 0, nullptr, {});
  RenderOptions options;
  options.samples = samples;
  render(*loaded.scene, film, options);
  return film.means();
}

}  // namespace

TEST_CASE("the preview ends at the picture of a render, bit for bit", "[window][preview]") {
  Bench b(scene("<0.8, 0.1, 0.1>"));
  REQUIRE(b.comes([&] { return b.isFinished(4); }));
  CHECK(b.preview->snapshot()->means.pixels == rendered(b, 4).pixels);
  CHECK(b.calls > 2);
  SECTION("also when it was stopped on the way, and more samples were asked for") {
    b.wish.samples = 64;
    b.want();
    REQUIRE(b.comes([&] { return b.preview->snapshot()->samples > 4; }));
    b.wish.isPaused = true;
    b.want();
    REQUIRE(b.comes([&] { return b.preview->status().phase == "paused"; }));
    const int then = b.preview->snapshot()->samples;
    CHECK(then < 64);
    b.wish.isPaused = false;
    b.want();
    REQUIRE(b.comes([&] { return b.isFinished(64); }));
    CHECK(b.preview->snapshot()->means.pixels == rendered(b, 64).pixels);
  }
  SECTION("and after a change of the text") {
    b.rewrite(scene("<0.1, 0.1, 0.8>", 2));
    REQUIRE(b.comes([&] { return b.isFinished(2); }));
    CHECK(b.preview->snapshot()->means.pixels == rendered(b, 2).pixels);
  }
}

TEST_CASE("a broken text keeps the picture and says where", "[window][preview]") {
  Bench b(scene("<0.8, 0.1, 0.1>"));
  REQUIRE(b.comes([&] { return b.isFinished(4); }));
  const auto before = b.preview->snapshot();
  b.rewrite(scene("<0.8, 0.1, 0.1>", 4, "spher { }\n"));
  REQUIRE(b.comes([&] { return b.preview->status().isWrong; }));
  const Status s = b.preview->status();
  REQUIRE_FALSE(s.complaints.empty());
  CHECK(s.complaints[0].place.line == 7);
  CHECK_THAT(s.complaints[0].text, containsText("a.scene:7") && containsText("^"));
  CHECK(b.preview->snapshot() == before);
  SECTION("the hand may still move the camera: nothing comes of it, nothing breaks") {
    ++b.wish.view;
    b.want();
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    CHECK(b.preview->snapshot() == before);
  }
  b.rewrite(scene("<0.1, 0.8, 0.1>", 3));
  REQUIRE(b.comes([&] { return b.isFinished(3); }));
  CHECK_FALSE(b.preview->status().isWrong);
  CHECK(b.preview->status().complaints.empty());
}

TEST_CASE("a text that is broken from the beginning can be mended", "[window][preview]") {
  Bench b("sphere {");
  REQUIRE(b.comes([&] { return b.preview->status().isWrong; }));
  CHECK_FALSE(b.preview->snapshot());
  b.preview->inspect(1, 1, 0);
  b.rewrite(scene("<0.1, 0.8, 0.1>", 1));
  REQUIRE(b.comes([&] { return b.isFinished(1); }));
}

TEST_CASE("a missing file is among those to watch", "[window][preview]") {
  Bench b(scene("<0.8, 0.1, 0.1>", 1, "mesh { \"later.obj\" }\n#include \"parts.inc\"\n"));
  REQUIRE(b.comes([&] { return b.preview->status().isWrong; }));
  b.folder.write("parts.inc", "\n");
  ++b.wish.reload;
  b.want();
  REQUIRE(b.comes([&] { return b.preview->files().count(b.folder / "later.obj") > 0; }));
  CHECK(b.preview->files().count(b.folder / "parts.inc") > 0);
  CHECK(b.preview->files().count(b.file) > 0);
}

TEST_CASE("paths are told while a long picture is under way", "[window][preview]") {
  Bench b(scene("<0.8, 0.1, 0.1>", 60000));
  REQUIRE(b.comes([&] { return b.preview->snapshot() && b.preview->snapshot()->scale == 1; }));
  b.preview->inspect(80, 60, 3);
  REQUIRE(b.comes([&] { return b.preview->inspection() != nullptr; }));
  const auto i = b.preview->inspection();
  CHECK(b.preview->status().phase == "rendering");
  CHECK(i->sample == 3);
  REQUIRE_FALSE(i->path.vertices.empty());
  const PathVertex& v = i->path.vertices[0];
  // What is drawn is what was traced.
  const Region3 r = regionOf(v, {});
  REQUIRE(int(r.deltas.size()) == v.differentials.size);
  CHECK(length(cross(r.a, r.b)) ==
        Approx(length(cross(v.differentials.footprint.dP[0], v.differentials.footprint.dP[1])))
            .epsilon(1e-3));
  CHECK(r.area == Approx(v.differentials.area).epsilon(1e-3));
  // More samples: a smaller region.
  Reckoning few, many;
  few.bound = many.bound = Bound::safe;
  few.samples = 4, many.samples = 400;
  CHECK(regionOf(v, many).area < regionOf(v, few).area);
  b.preview->inspect(-1, 5000, 0);  // beside the picture
  b.preview.reset();                // in the middle of it
}

TEST_CASE("the particle integrator refines in rounds", "[window][preview]") {
  Bench b(
      "camera pinhole { location <0, 1, -4> look_at <0, 0.7, 0> }\n"
      "film { resolution <40, 30> }\n"
      "light area { <-1, 3, -1>, <2, 0, 0>, <0, 0, 2> radiance rgb 5 }\n"
      "quad { <-3, 0, -3>, <6, 0, 0>, <0, 0, 6> }\n"
      "integrator particle { particles 100000 samples 1 }\n");
  std::set<std::shared_ptr<const Snapshot>> seen;
  REQUIRE(b.comes([&] {
    if (const auto s = b.preview->snapshot()) seen.insert(s);
    return b.isFinished(1);
  }));
  CHECK(seen.size() >= 2);
  CHECK(b.preview->snapshot()->means.pixels == rendered(b, 1).pixels);
}

TEST_CASE("the element under the cursor is told, as bright as its flux makes it",
          "[window][preview]") {
  Bench b(
      "camera pinhole { location <0, 1, -4> look_at <0, 0.7, 0> }\n"
      "film { resolution <40, 30> }\n"
      "light area { <-1, 3, -1>, <2, 0, 0>, <0, 0, 2> radiance rgb 5 }\n"
      "quad { <-3, 0, -3>, <6, 0, 0>, <0, 0, 6> brdf lambert { diffuse rgb 0.4 } }\n"
      "integrator particle { particles 50000 samples 1 show \"elements\" }\n");
  REQUIRE(b.comes([&] { return b.isFinished(1); }));
  b.preview->hover(20, 22);
  REQUIRE(b.comes([&] { return b.preview->hovered() != nullptr; }));
  const auto i = b.preview->hovered();
  CHECK_FALSE(b.preview->inspection());  // that is another question
  std::map<std::string, PathNote> notes;
  for (const RecordedPath::Note& n : i->path.notes) {
    CHECK(n.vertex == 0);
    notes[n.note.name] = n.note;
  }
  REQUIRE(notes.size() == 5);
  const double level = notes["element.level"].values[0], area = notes["element.area"].values[0];
  const double flux = notes["element.flux"].values[0];
  CHECK(level > 0);
  CHECK(area == Approx(36 / std::pow(4, level)).epsilon(1e-4));
  CHECK(notes["element.flux"].count == 3);
  CHECK(notes["element.particles"].values[0] > 0);
  // The radiance of a diffuse surface: rho / pi E.
  CHECK(flux > 0);
  CHECK(double(i->radiance.r) == Approx(0.4 / double(kPi) * flux / area).epsilon(1e-4));
  CHECK(b.preview->snapshot()->means.pixels[(22 * 40 + 20) * 3] ==
        Approx(i->radiance.r).epsilon(1e-4));
  b.rewrite(scene("<0.8, 0.1, 0.1>", 1));
  REQUIRE(b.comes([&] { return b.isFinished(1); }));
  CHECK_FALSE(b.preview->hovered());
  b.preview->hover(80, 60);
  REQUIRE(b.comes([&] { return b.preview->hovered() != nullptr; }));
  CHECK(b.preview->hovered()->path.notes.empty());  // integrator path has none
}

TEST_CASE("hasty wishes neither crash nor starve", "[window][preview]") {
  Bench b(scene("<0.8, 0.1, 0.1>", 8));
  std::mt19937 random(7);
  const std::vector<std::string> integrators = {"", "path", "distributed", "normals", "uv"};
  std::vector<std::string> aovs = aovNames();
  aovs.push_back("element.id");  // none of these integrators has it
  for (int i = 0; i < 300; ++i) {
    switch (random() % 8) {
      case 0:
        b.rewrite(random() % 4 ? scene("<0.2, 0.3, 0." + std::to_string(i) + ">", 8) : "sphere {");
        break;
      case 1:
        b.wish.build.integrator = integrators[random() % integrators.size()], ++b.wish.way;
        break;
      case 2:
        b.wish.isPaused = random() % 3 == 0;
        break;
      case 3:
        b.wish.region = std::array<double, 4>{0.1, 0.2, 0.1 + 0.1 * double(random() % 9), 0.9};
        if (random() % 2) b.wish.region.reset();
        ++b.wish.picture;
        break;
      case 4:
        b.wish.aovs.clear();
        if (random() % 2) b.wish.aovs = {aovs[random() % aovs.size()]};
        ++b.wish.picture;
        break;
      case 5:
        b.wish.width = int(random() % 300), ++b.wish.picture;
        break;
      case 6:
        b.preview->inspect(int(random() % 200), int(random() % 200), random() % 9);
        b.preview->hover(int(random() % 200), int(random() % 200));
        break;
      default:
        ++b.wish.view;
    }
    b.want();
    if (random() % 4 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(random() % 20));
  }
  b.wish.isPaused = false, b.wish.build.integrator.clear(), ++b.wish.way;
  b.wish.region.reset(), b.wish.aovs.clear(), b.wish.width = 0, ++b.wish.picture;
  b.rewrite(scene("<0.2, 0.3, 0.4>", 2));
  REQUIRE(b.comes([&] { return b.isFinished(2); }));
  CHECK(b.preview->snapshot()->means.pixels == rendered(b, 2).pixels);
}

TEST_CASE("the first wish is heard", "[window][preview]") {
  Wish first;
  first.width = 80, first.build.integrator = "normals";
  const Bench b(scene("<0.8, 0.1, 0.1>"), first);
  REQUIRE(b.comes([&] { return b.preview->status().phase == "finished"; }));
  CHECK(b.preview->snapshot()->filmWidth == 80);
  CHECK(b.preview->snapshot()->integrator == "normals");
}

TEST_CASE("a camera that is refused is told, and the next one is taken", "[window][preview]") {
  Bench b(scene("<0.8, 0.1, 0.1>"));
  REQUIRE(b.comes([&] { return b.isFinished(4); }));
  Block refused = b.preview->open()->camera;
  refused.settings.push_back({"angle", numberValue(200), {}});
  b.wish.camera = refused, ++b.wish.view;
  b.want();
  REQUIRE(b.comes([&] { return b.preview->status().isWrong; }));
  CHECK_THAT(b.preview->status().complaints[0].text, containsText("angle"));
  b.wish.camera.reset(), ++b.wish.view;
  b.want();
  REQUIRE(b.comes([&] { return b.isFinished(4); }));
  CHECK_FALSE(b.preview->status().isWrong);
}

TEST_CASE("more samples start again where footprints go by their number", "[window][preview]") {
  const std::string local = scene("<0.8, 0.1, 0.1>", 4);
  const std::size_t at = local.find("samples 4") + 9;
  Bench b(local.substr(0, at) + " footprint local { }" + local.substr(at));
  REQUIRE(b.comes([&] { return b.isFinished(4); }));
  b.wish.samples = 16;
  b.want();
  REQUIRE(b.comes([&] { return b.isFinished(16); }));
  CHECK(b.preview->snapshot()->means.pixels == rendered(b, 16).pixels);
}

TEST_CASE("`vestige render` goes on from a kept picture, with the camera in hand",
          "[window][preview]") {
  Bench b(scene("<0.2, 0.5, 0.9>", 1 << 20));
  REQUIRE(b.comes([&] { return b.preview->open() != nullptr; }));
  const auto open = b.preview->open();
  const auto view = viewOf(open->camera, open->cameraSchema);
  REQUIRE(view);
  const Block moved =
      withView(open->camera, open->cameraSchema, orbit(*view, Real(0.1), Real(0.2)));
  b.wish.camera = moved, ++b.wish.view;
  b.wish.aovs = {"depth"}, ++b.wish.picture;
  b.want();
  REQUIRE(b.comes([&] {
    const auto s = b.preview->snapshot();
    return s && s->samples >= 4 && s->wish.view == b.wish.view;
  }));
  const std::string kept = b.folder / "a.checkpoint";
  b.preview->keep(kept);
  std::string news;
  REQUIRE(b.comes([&] { return !(news = b.preview->news()).empty(); }));
  INFO(news);
  CHECK(news.find("--checkpoint " + kept) != news.npos);
  REQUIRE(std::filesystem::exists(kept));
  int samples = 0;
  REQUIRE(std::sscanf(news.c_str(), "kept %d samples", &samples) == 1);
  b.preview.reset();

  std::string text = scene("<0.2, 0.5, 0.9>", 16);
  text.replace(0, text.find('\n') + 1, cameraText(moved));
  b.folder.write("a.scene", text);
  const std::string more = std::to_string(samples + 8);
  const auto render = [&](const std::string& picture) {
    const Run run = runVestige({"render", b.file, "-o", b.folder / picture, "--spp", more,
                                "--progress", "none", "--checkpoint", kept});
    INFO(run.err);
    REQUIRE(run.exit == 0);
  };
  render("on.exr");
  std::filesystem::remove(kept);
  render("once.exr");
  std::string error;
  CHECK(readImage(b.folder / "on.exr", error).pixels ==
        readImage(b.folder / "once.exr", error).pixels);
}

TEST_CASE("a picture is kept though the window closes, and not in place of something else",
          "[window][preview]") {
  Bench b(scene("0.5", 1 << 20));
  REQUIRE(b.comes([&] {
    const auto s = b.preview->snapshot();
    return s && s->samples >= 4;
  }));
  const std::string other = b.folder.write("b.checkpoint", "something else");
  b.preview->keep(other);
  std::string news;
  REQUIRE(b.comes([&] { return !(news = b.preview->news()).empty(); }));
  CHECK_THAT(news, containsText("is no checkpoint"));
  CHECK(std::filesystem::file_size(other) == 14);
  b.preview->keep(b.folder / "a.checkpoint");
  b.preview.reset();
  CHECK(std::filesystem::exists(b.folder / "a.checkpoint"));
}

TEST_CASE("without a whole picture nothing is kept", "[window][preview]") {
  Bench b("camera pinhole { location <0, 1, -4> look_at }\n");  // broken
  b.preview->keep(b.folder / "a.checkpoint");
  std::string news;
  REQUIRE(b.comes([&] { return !(news = b.preview->news()).empty(); }));
  CHECK(news == "there is no whole picture to keep yet");
  CHECK_FALSE(std::filesystem::exists(b.folder / "a.checkpoint"));
}

TEST_CASE("a region is known by its shares of the film", "[window][preview]") {
  Bench b(scene("<0.8, 0.1, 0.1>"));
  b.wish.region = std::array<double, 4>{0, 0, 0.5, 0.25}, ++b.wish.picture;
  b.want();
  REQUIRE(b.comes([&] { return b.isFinished(4); }));
  const auto s = b.preview->snapshot();
  CHECK(s->part == std::array<float, 4>{0, 0, 0.5f, 0.25f});
  CHECK(s->means.width == 80);
  CHECK(s->filmWidth == 160);
}
