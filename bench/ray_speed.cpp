// SPDX-License-Identifier: Apache-2.0
// How near a render comes to what Embree gives: rays a second of a whole render (sampling, shading,
// textures, film) over rays a second of bare Embree that replays the very same rays, in the same
// order, on the same triangles. One thread, CPU time, in turn in one run; the median of the turns.
//
//     ninja -C build/release ray_speed && build/release/bin/ray_speed examples/cornell.scene
//     [SAMPLES]
//
// Scenes of triangles only: bare Embree knows no other shapes.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "bench/scene.h"
#include "engine/render/session.h"
#include "engine/render/start_path.h"
#include "engine/scene/scene_impl.h"
#include "engine/trace/embree.h"

using namespace vestige;

namespace {

constexpr int kTurns = 5;
constexpr int kTile = 16;  ///< pixels, as a render goes through the picture
constexpr std::uint32_t kSeed = 1;

double cpuSeconds() {
  std::timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

struct Query {
  Ray ray;
  bool isShadow;
};

/// Remembers the rays that it was asked for.
class Recorder final : public Tracer {
 public:
  Recorder(const Tracer& tracer, std::vector<Query>& queries)
      : tracer_(tracer), queries_(queries) {}

  bool intersect(const Ray& ray, Surface& surface) const noexcept override {
    queries_.push_back({ray, false});
    return tracer_.intersect(ray, surface);
  }
  Rgb transmittance(const Ray& ray) const noexcept override {
    queries_.push_back({ray, true});
    return tracer_.transmittance(ray);
  }
  MediumStack mediaAt(Vec3 position) const noexcept override { return tracer_.mediaAt(position); }
  Rgb mediumTransmittance(const Ray& ray, Real distance) const noexcept override {
    return tracer_.mediumTransmittance(ray, distance);
  }
  Bounds bounds() const noexcept override { return tracer_.bounds(); }

 private:
  const Tracer& tracer_;
  std::vector<Query>& queries_;
};

/// The rays of the first samples of all pixels, tile by tile.
std::vector<Query> raysOf(Scene& scene, int samples) {
  std::vector<Query> queries;
  const SceneView& view = scene.view();
  const Recorder recorder(view.tracer, queries);
  const SceneView recorded{recorder, view.materials, view.lightSet, view.patchSet, view.middle};
  const int width = scene.film().width, height = scene.film().height;
  const PathSource source{.scene = recorded,
                          .camera = scene.camera(),
                          .filter = PixelFilterSampler(scene.film().filter),
                          .width = width,
                          .height = height,
                          .seed = kSeed,
                          .declaredSamples = std::uint64_t(samples),
                          .wantsJacobian = true};
  Counters counters;
  const auto sample = [&](int x, int y, int i) {
    StartedPath path = startPath(source, x, y, std::uint32_t(i), {.counters = counters});
    if (!isBlack(path.weight)) scene.integrator().estimate(path.context);
  };
  for (int ty = 0; ty < height; ty += kTile)
    for (int tx = 0; tx < width; tx += kTile)
      for (int y = ty; y < std::min(ty + kTile, height); ++y)
        for (int x = tx; x < std::min(tx + kTile, width); ++x)
          for (int i = 0; i < samples; ++i) sample(x, y, i);
  return queries;
}

/// All triangles of a scene in one Embree geometry, built and traced as we ask Embree to, or with
/// what is fastest there.
class Bare {
 public:
  Bare(const World& world, RTCSceneFlags flags)
      : device_(embree::newDevice()), scene_(rtcNewScene(device_.get())) {
    std::vector<float> positions;
    std::vector<std::uint32_t> corners;
    for (const Placement& p : world.placements()) {
      if (!p.mesh) {
        std::fprintf(stderr, "ray_speed: the scene has a shape that is no mesh\n");
        std::exit(3);
      }
      const auto first = std::uint32_t(positions.size() / 3);
      for (const Vec3 v : p.mesh->positions) {
        const Vec3 w = p.toWorld.point(v);
        positions.insert(positions.end(), {float(w.x), float(w.y), float(w.z)});
      }
      for (const auto& t : p.mesh->triangles)
        for (const std::uint32_t c : t) corners.push_back(first + c);
    }
    const embree::Geometry g(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
    std::copy(
        positions.begin(), positions.end(),
        static_cast<float*>(rtcSetNewGeometryBuffer(g.get(), RTC_BUFFER_TYPE_VERTEX, 0,
                                                    RTC_FORMAT_FLOAT3, 12, positions.size() / 3)));
    std::copy(corners.begin(), corners.end(),
              static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
                  g.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, corners.size() / 3)));
    rtcCommitGeometry(g.get());
    rtcAttachGeometry(scene_.get(), g.get());
    rtcSetSceneFlags(scene_.get(), flags);
    rtcCommitScene(scene_.get());
    embree::check(device_.get(), "building the tree");
  }

  /// Seconds to trace them all; `hits` keeps the compiler from leaving it out.
  double replay(const std::vector<Query>& queries, std::size_t& hits) const {
    const double start = cpuSeconds();
    embree::Context context;
    for (const Query& q : queries) {
      embree::initialise(context);
      RTCRayHit r;
      fill(r.ray, q.ray);
      if (q.isShadow) {
        embree::occluded(scene_.get(), r.ray, context);
        hits += r.ray.tfar < 0;
      } else {
        r.hit.geomID = r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        embree::intersect(scene_.get(), r, context);
        hits += r.hit.geomID != RTC_INVALID_GEOMETRY_ID;
      }
    }
    return cpuSeconds() - start;
  }

 private:
  static void fill(RTCRay& to, const Ray& r) {
    to.org_x = float(r.origin.x), to.org_y = float(r.origin.y), to.org_z = float(r.origin.z);
    to.dir_x = float(r.direction.x), to.dir_y = float(r.direction.y);
    to.dir_z = float(r.direction.z);
    to.tnear = float(r.tMin), to.tfar = float(r.tMax);
    to.mask = ~0u, to.time = 0, to.id = to.flags = 0;
  }

  embree::Device device_;
  embree::Scene scene_;
};

double median(std::vector<double> x) {
  std::sort(x.begin(), x.end());
  return x[x.size() / 2];
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2 || argc > 3) return std::fprintf(stderr, "usage: ray_speed SCENE [SAMPLES]\n"), 2;
  const int samples = argc > 2 ? std::max(1, std::atoi(argv[2])) : 2;
  const auto scene = bench::read(argv[1]);
  const std::vector<Query> queries = raysOf(*scene, samples);
  const World& world = scene->impl().world;
  const Bare alike(world, RTC_SCENE_FLAG_ROBUST), fastest(world, RTC_SCENE_FLAG_NONE);
  std::size_t hits = 0;
  std::vector<double> render, same, best;
  for (int turn = 0; turn < kTurns; ++turn) {
    Film film = makeFilm(*scene, 0, 0, nullptr, {});
    const double start = cpuSeconds();
    const RenderResult r =
        vestige::render(*scene, film, {.samples = samples, .seed = kSeed, .threads = 1});
    render.push_back((cpuSeconds() - start) / double(r.counters.rays + r.counters.shadowRays));
    same.push_back(alike.replay(queries, hits) / double(queries.size()));
    best.push_back(fastest.replay(queries, hits) / double(queries.size()));
  }
  const auto shadows =
      std::count_if(queries.begin(), queries.end(), [](const Query& q) { return q.isShadow; });
  const auto share = [&](const std::vector<double>& bare) {
    std::vector<double> ratios;
    for (int i = 0; i < kTurns; ++i)
      ratios.push_back(bare[std::size_t(i)] / render[std::size_t(i)]);
    return 100 * median(ratios);
  };
  std::printf("%s, %d samples a pixel: %.2f million rays, %.0f %% of them shadow rays\n", argv[1],
              samples, double(queries.size()) * 1e-6,
              100 * double(shadows) / double(queries.size()));
  std::printf("million rays a second of one thread: whole render %.2f\n", 1e-6 / median(render));
  std::printf("  bare Embree, robust as we ask for   %.2f   render/bare %.0f %%\n",
              1e-6 / median(same), share(same));
  std::printf("  bare Embree, its default flags      %.2f   render/bare %.0f %%\n",
              1e-6 / median(best), share(best));
  return hits == 0;
}
