// SPDX-License-Identifier: Apache-2.0
// What a build takes over from the one before, and that nobody can see it in the picture.
#include "engine/scene/build_cache.h"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "engine/render/session.h"
#include "engine/scene/scene.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/small_png.h"
#include "support/temp_folder.h"

using namespace vestige;
using namespace vestige::test;
namespace fs = std::filesystem;

namespace {

/// Files whose times differ however soon they follow each other.
class Files {
 public:
  const TempFolder folder;
  const std::string mesh = folder / "mesh.ply", other = folder / "other.obj",
                    materials = folder / "other.mtl", picture = folder / "picture.png";

  Files() { writeMesh(1), writeOther("0.2 0.5 0.9"), writePicture(200); }
  /// A pyramid of some height.
  void writeMesh(double height) {
    std::ofstream(mesh) << "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n"
                           "property float y\nproperty float z\nelement face 3\n"
                           "property list uchar int vertex_indices\nend_header\n"
                           "-1 0 0\n1 0 0\n0 0 -1\n0 "
                        << height << " 0\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
    changed(mesh);
  }
  void writeOther(const std::string& colour) {
    std::ofstream(other) << "mtllib other.mtl\nv -1 0 1\nv 1 0 1\nv 0 1 1\nusemtl paint\nf 1 2 3\n";
    std::ofstream(materials) << "newmtl paint\nKd " << colour << "\n";
    changed(materials);
  }
  void writePicture(int code) {
    std::vector<int> codes(16 * 16 * 3, 40);
    for (std::size_t i = 0; i < codes.size(); i += 5) codes[i] = code;
    writePng(picture, 16, 16, 3, 8, codes);
    changed(picture);
  }

 private:
  void changed(const std::string& file) {
    fs::last_write_time(file, fs::file_time_type::clock::now() + std::chrono::seconds(++count_));
  }
  int count_ = 0;
};

Affine moved(double x, double y, double z) {
  Affine a;
  a.m[0][3] = x, a.m[1][3] = y, a.m[2][3] = z;
  return a;
}

Block meshBlock(const std::string& file, const Affine& place, std::vector<Block> children = {}) {
  Block b = makeBlock("shape", "mesh", {{"file", textValue(file)}}, std::move(children));
  b.world = place;
  return b;
}

enum Part {
  kCamera,
  kFilm,
  kIntegrator,
  kArea,
  kPoint,
  kFloor,
  kBall,
  kGlow,
  kOnce,
  kTwins,
  kLeft
};

/// One of everything that is kept: a picture, a mesh placed once, one placed twice, one with
/// materials of its own, analytic shapes, one of which shines, and a light with a surface.
SceneDesc sceneWith(const Files& files) {
  SceneDesc s;
  const Block image = makeBlock("pigment", "image", {{"file", textValue(files.picture)}});
  s.blocks = {
      makeBlock("camera", "pinhole",
                {{"location", vectorValue({0, 1.5, -6})}, {"look_at", vectorValue({0, 0.5, 0})}}),
      makeBlock("film", "", {{"resolution", vectorValue({24, 18})}}),
      makeBlock("integrator", "path", {{"depth", numberValue(3)}}),
      makeBlock("light", "area",
                {{"corner", vectorValue({-1, 4, -1})},
                 {"edge1", vectorValue({2, 0, 0})},
                 {"edge2", vectorValue({0, 0, 2})},
                 {"radiance", colourValue(5, 5, 5)}}),
      makeBlock("light", "point",
                {{"location", vectorValue({3, 3, -3})}, {"intensity", colourValue(9, 8, 7)}}),
      quad({-4, 0, -4}, {8, 0, 0}, {0, 0, 8},
           {makeBlock("brdf", "lambert", {{"diffuse", blockValue(image)}})}),
      makeBlock("shape", "sphere",
                {{"centre", vectorValue({-1.5, 0.7, 0})}, {"radius", numberValue(0.7)}},
                {lambert(0.4)}),
      makeBlock("shape", "sphere",
                {{"centre", vectorValue({2, 2, 1})},
                 {"radius", numberValue(0.2)},
                 {"emission", colourValue(3, 2, 1)}}),
      meshBlock(files.other, moved(0, 1, 0)),
      meshBlock(files.mesh, moved(1.5, 0, 0), {lambert(0.6)}),
      meshBlock(files.mesh, moved(0, 0, -1.5), {lambert(0.3)})};
  return s;
}

std::vector<float> pixelsOf(Scene& scene) {
  Film film = makeFilm(scene, 0, 0, nullptr, {});
  render(scene, film, {.samples = 4, .threads = 2});
  const auto means = film.means();
  return {means.pixels.begin(), means.pixels.end()};
}

class Reloads {
 public:
  BuildOptions options;
  Reloads() { options.cache = std::make_shared<BuildCache>(); }

  const BuildCache& cache() const { return *options.cache; }
  /// Null after an error.
  std::unique_ptr<Scene> build(const SceneDesc& text, const Registry& r = registry()) {
    Diagnostics diagnostics;
    auto scene = buildScene(text, r, options, diagnostics);
    warnings = diagnostics.warnings();
    return scene;
  }
  /// Builds with the cache and without it: nobody can tell from the picture.
  BuildCache::Use use(const SceneDesc& text) {
    const auto scene = build(text);
    REQUIRE(scene);
    Diagnostics diagnostics;
    BuildOptions fresh = options;
    fresh.cache = nullptr;
    const auto other = buildScene(text, registry(), fresh, diagnostics);
    REQUIRE(other);
    CHECK(warnings == diagnostics.warnings());
    CHECK(scene->triangles() == other->triangles());
    pixels = pixelsOf(*scene);
    CHECK(pixels == pixelsOf(*other));
    return options.cache->use();
  }

  int warnings = 0;
  std::vector<float> pixels;
};

std::size_t openFiles() {
  return std::size_t(std::distance(fs::directory_iterator("/proc/self/fd"), {}));
}

constexpr int kShapes = 5, kPictures = 1;  ///< that differ

void check(const BuildCache::Use& use, int shapesMade, int texturesMade, bool isWorldTaken,
           int shapes = kShapes) {
  CHECK(use.shapesMade == shapesMade);
  CHECK(use.shapesTaken == shapes - shapesMade);
  CHECK(use.texturesMade == texturesMade);
  CHECK(use.texturesTaken == kPictures - texturesMade);
  CHECK(use.isWorldTaken == isWorldTaken);
}

}  // namespace

TEST_CASE("a second build reads and builds only what has changed", "[cache]") {
  Files files;
  Reloads reloads;
  SceneDesc s = sceneWith(files);
  check(reloads.use(s), kShapes, kPictures, false);
  const std::vector<float> before = reloads.pixels;
  bool isSeen = true;

  SECTION("nothing") {
    check(reloads.use(s), 0, 0, true);
    isSeen = false;
  }
  SECTION("a colour") {
    s.blocks[kBall].children = {lambert(0.9)};
    check(reloads.use(s), 0, 0, true);
  }
  SECTION("the radiance of lights") {
    s.blocks[kArea].settings.edit().back().value = colourValue(1, 2, 3);
    s.blocks[kGlow].settings.edit().back().value = colourValue(1, 2, 3);
    check(reloads.use(s), 0, 0, true);
  }
  SECTION("which shapes shine, and with them the numbers of lights") {
    s.blocks[kBall].settings.push_back({"emission", colourValue(1, 2, 3), {}});
    s.blocks.erase(s.blocks.begin() + kPoint);
    check(reloads.use(s), 0, 0, true);
  }
  SECTION("camera, film and integrator") {
    s.blocks[kCamera].settings.edit()[0].value = vectorValue({1, 2, -5});
    s.blocks[kFilm].settings.edit()[0].value = vectorValue({20, 20});
    s.blocks[kIntegrator].settings.edit()[0].value = numberValue(2);
    check(reloads.use(s), 0, 0, true);
  }
  SECTION("opacity") {
    s.blocks[kBall].children.edit()[0].settings.push_back({"opacity", numberValue(0.5), {}});
    check(reloads.use(s), 0, 0, false);
  }
  SECTION("which rays meet a shape") {
    s.blocks[kBall].settings.push_back({"no_shadow", numberValue(1), {}});
    check(reloads.use(s), 0, 0, false);
  }
  SECTION("a picture") {
    files.writePicture(10);
    check(reloads.use(s), 0, 1, true);
  }
  SECTION("a mesh") {
    files.writeMesh(2);
    check(reloads.use(s), 1, 0, false);
  }
  SECTION("a file that a mesh names") {
    files.writeOther("0.9 0.1 0.1");
    check(reloads.use(s), 1, 0, false);
  }
  SECTION("the place of a mesh that is there twice") {
    s.blocks[kLeft].world = moved(0, 0.3, -2);
    check(reloads.use(s), 0, 0, false);
  }
  SECTION("the place of a mesh that is there once") {
    s.blocks[kOnce].world = moved(0.5, 1, 0);
    check(reloads.use(s), 0, 0, false);
  }
  SECTION("the place of a light with a surface") {
    s.blocks[kArea].settings.edit()[0].value = vectorValue({-1, 3, -2});
    check(reloads.use(s), 0, 0, false);
  }
  SECTION("a shape more") {
    s.blocks.insert(s.blocks.begin() + kBall,
                    makeBlock("shape", "sphere",
                              {{"centre", vectorValue({0, 0.3, -2})}, {"radius", numberValue(0.3)}},
                              {lambert(0.4)}));
    check(reloads.use(s), 1, 0, false, kShapes + 1);
  }
  SECTION("a shape less") {
    s.blocks.erase(s.blocks.begin() + kBall);
    check(reloads.use(s), 0, 0, false, kShapes - 1);
    CHECK(reloads.cache().entries() == kShapes - 1 + kPictures);
  }
  SECTION("one of two places less: the mesh is no instance any more") {
    s.blocks.pop_back();
    check(reloads.use(s), 0, 0, false);
  }
  CHECK((before != reloads.pixels) == isSeen);
}

TEST_CASE("a scene that could not be built leaves the cache as it was", "[cache]") {
  Files files;
  Reloads reloads;
  const SceneDesc s = sceneWith(files);
  reloads.use(s);
  SceneDesc wrong = s;
  wrong.blocks[kBall] = meshBlock("missing.ply", {});
  CHECK_FALSE(reloads.build(wrong));
  check(reloads.use(s), 0, 0, true);
}

TEST_CASE("a file that was missing is found when it comes", "[cache]") {
  Files files;
  Reloads reloads;
  const SceneDesc s = sceneWith(files);
  fs::remove(files.materials);
  reloads.use(s);
  CHECK(reloads.warnings == 1);
  check(reloads.use(s), 0, 0, true);
  CHECK(reloads.warnings == 1);  // said again, as on a fresh start
  files.writeOther("0.9 0.1 0.1");
  check(reloads.use(s), 1, 0, false);
  CHECK(reloads.warnings == 0);
}

TEST_CASE("files of shapes that were taken over are still told", "[cache]") {
  Files files;
  Reloads reloads;
  const SceneDesc s = sceneWith(files);
  std::set<std::string> first, second;
  reloads.options.files = &first;
  reloads.build(s);
  reloads.options.files = &second;
  reloads.build(s);
  CHECK(first == second);
  CHECK(second.contains(files.mesh));
  CHECK(second.contains(files.materials));
  CHECK(second.contains(files.picture));
}

TEST_CASE("the old scene renders while the new one is built", "[cache]") {
  Files files;
  Reloads reloads;
  SceneDesc s = sceneWith(files);
  auto old = reloads.build(s);
  REQUIRE(old);
  const std::vector<float> expected = pixelsOf(*old);
  std::atomic<bool> stop{false};
  std::atomic<int> wrong{0};
  std::thread other([&] {
    while (!stop) wrong += pixelsOf(*old) != expected;
  });
  for (int k = 0; k < 20; ++k) {
    s.blocks[kLeft].world = moved(0, 0.01 * (k / 2), -1.5);
    CHECK(reloads.build(s));
  }
  stop = true;
  other.join();
  CHECK(wrong == 0);
}

TEST_CASE("nothing grows with the number of reloads", "[cache]") {
  const bool isPaged = GENERATE(false, true);
  Files files;
  Reloads reloads;
  setenv("VESTIGE_CACHE", files.folder.path().c_str(), 1);
  if (isPaged) reloads.options.textureMemory = 0;
  SceneDesc s = sceneWith(files);
  std::unique_ptr<Scene> shown = reloads.build(s);
  REQUIRE(shown);
  pixelsOf(*shown);
  const std::size_t entries = reloads.cache().entries(), bytes = reloads.cache().textureBytes();
  CHECK(entries == kShapes + kPictures);
  CHECK((bytes > 0) != isPaged);
  const std::size_t open = openFiles();
  for (int k = 0; k < 200; ++k) {
    if (k % 10 == 0) files.writePicture(k), files.writeMesh(1 + k);
    s.blocks[kBall].settings.edit()[1].value = numberValue(0.5 + 0.001 * k);
    s.blocks[kLeft].world = moved(0, 0, -1.5 - 0.01 * k);
    shown = reloads.build(s);
    REQUIRE(shown);
    REQUIRE(reloads.cache().entries() == entries);
    REQUIRE(reloads.cache().textureBytes() == bytes);
    if (k % 20 == 0) pixelsOf(*shown);
  }
  pixelsOf(*shown);
  CHECK(openFiles() == open);
  unsetenv("VESTIGE_CACHE");
}

TEST_CASE("what is held and what is paged is as on a fresh start", "[cache][paging]") {
  Files files;
  Reloads reloads;
  setenv("VESTIGE_CACHE", files.folder.path().c_str(), 1);
  const SceneDesc s = sceneWith(files);
  const auto paged = [&](std::size_t budget) {
    reloads.options.textureMemory = budget;
    const auto scene = reloads.build(s);
    REQUIRE(scene);
    const TextureUse use = scene->textureUse();
    CHECK(use.paged == (budget == 0));
    CHECK((use.held > 0) == (budget > 0));
    CHECK(reloads.use(s).texturesTaken == 1);
    return use.taken == 1;
  };
  CHECK_FALSE(paged(0));
  CHECK(paged(0));
  CHECK_FALSE(paged(1 << 20));  // its texels are nowhere yet
  CHECK(paged(1 << 20));
  CHECK(paged(0));
  unsetenv("VESTIGE_CACHE");
}

TEST_CASE("shapes of a library that was built anew are not taken", "[cache]") {
  TempFolder folder;
  const std::string library = folder / "shape_sphere.so";
  const auto install = [&](int seconds) {
    fs::remove(library);  // the loader still has the old one
    fs::copy_file(std::string(VESTIGE_PLUGINS) + "/shape_sphere.so", library);
    fs::last_write_time(library, fs::file_time_type::clock::now() + std::chrono::seconds(seconds));
  };
  const auto load = [&] {
    std::vector<std::string> refused;
    return Registry::load({VESTIGE_PLUGINS, folder.path()}, refused);
  };
  Files files;
  Reloads reloads;
  const SceneDesc s = sceneWith(files);
  install(1);
  CHECK(reloads.build(s, load()));
  CHECK(reloads.build(s, load()));
  check(reloads.cache().use(), 0, 0, true);
  install(2);
  CHECK(reloads.build(s, load()));
  check(reloads.cache().use(), 2, 0, false);  // both spheres
}
