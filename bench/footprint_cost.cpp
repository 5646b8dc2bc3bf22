// SPDX-License-Identifier: Apache-2.0
// Nanoseconds a vertex that carrying differentials adds: arrive and scatter, and, counted apart,
// the region that a texture asks for; without the ray and the shading that they serve. CPU time of
// one thread.
//
//     footprint_cost [PLUGIN_FOLDER]
#include <vestige/footprint.h>
#include <vestige/tools/sampling.h>

#include <time.h>

#include <array>
#include <cstdio>
#include <vector>

#include "engine/scene/registry.h"

using namespace vestige;

namespace {

/// A surface and what a path does there, all but the differentials worked out before the clock
/// runs.
struct Event {
  Surface surface;
  Interaction x;
  Scatter drawn;
  ScatterNumbers numbers;
};
constexpr int kDepth = 9;
using Path = std::array<Event, kDepth>;

const RayJacobian kCamera = {{}, {{{Real(0.001), 0, 0}, {0, Real(0.001), 0}}}};

/// A curved surface that faces the path somehow, and a direction drawn there.
Event makeEvent(const Brdf& brdf, const InputBuffer& inputs, Vec3 arriving, std::uint32_t seed,
                std::uint32_t k) {
  for (std::uint32_t i = 0;; ++i) {
    const Sampler s(seed, i, k, 1);
    Event e;
    const Vec3 n = Frame::around(-arriving).toWorld(cosineHemisphere(s.pair(0)).d);
    const Frame f = Frame::around(n);
    e.surface.geometricNormal = e.surface.normal = n;
    e.surface.distance = 1 + s.number(4);
    e.surface.dPdu = f.s, e.surface.dPdv = f.t;
    e.surface.dNdu = Real(0.3) * f.s, e.surface.dNdv = Real(0.2) * f.t;
    e.x.brdf = &brdf, e.x.toPrev = -arriving;
    e.x.frame = f, e.x.geometricNormal = n;
    e.x.point = {.toPrev = f.toLocal(e.x.toPrev), .inputs = Inputs(inputs.data())};
    e.numbers = {s.number(5), s.pair(6)};
    if (const auto drawn = drawScatter(e.x, e.numbers)) {
      e.drawn = *drawn;
      return e;
    }
  }
}

Path makePath(const Brdf& brdf, const InputBuffer& inputs, std::uint32_t seed) {
  Path path;
  Vec3 direction{0, 0, 1};
  for (std::uint32_t k = 0; k < kDepth; ++k) {
    path[k] = makeEvent(brdf, inputs, direction, seed, k);
    direction = path[k].drawn.toNext;
  }
  return path;
}

double cpuNanoseconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e9 * double(t.tv_sec) + double(t.tv_nsec);
}

struct Work {
  int depth;
  bool gradient, region;
};

double nanosecondsAVertex(const std::vector<Path>& paths, Work work, double& sink) {
  constexpr int kPaths = 20000;
  const double start = cpuNanoseconds();
  for (int p = 0; p < kPaths; ++p) {
    const Path& path = paths[std::size_t(p) % paths.size()];
    PathFootprint<> f;
    f.begin(kCamera, {0, 0, 1}, 2, std::uint64_t(p), 16, {}, work.gradient);
    for (int k = 0; k < work.depth; ++k) {
      const Event& e = path[std::size_t(k)];
      f.arrive(e.surface, 10);
      if (work.region) sink += double(f.footprint().dUv[0].x);
      if (k + 1 < work.depth) f.scatter(e.surface, e.x, e.drawn, e.numbers), f.chance(Real(0.9));
    }
  }
  return (cpuNanoseconds() - start) / kPaths / work.depth;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> refused;
  const Registry registry = Registry::load({argc > 1 ? argv[1] : installedPluginFolder()}, refused);
  double sink = 0;
  std::printf(
      "nanoseconds a vertex   carried         with gradient    the region besides\n"
      "scatterings            2      8             2      8             2      8\n");
  struct NoHost final : Host {
    std::string find(const std::string&, Span, std::string&) override { return {}; }
    std::shared_ptr<const Texture> texture(const TextureRequest&, std::string&) override {
      return nullptr;
    }
    void warn(Span, const std::string&) override {}
  } host;
  for (const char* name :
       {"lambert", "phong", "rough_conductor", "rough_dielectric", "principled"}) {
    const Schema* schema = registry.schema("brdf", name);
    if (!schema) return std::fprintf(stderr, "no brdf %s\n", name), 3;
    std::vector<Value> values;
    for (const Parameter& row : schema->params) values.push_back(row.initial);
    VestigeError why{"", -1, -1};
    const auto brdf = registry.create<Brdf>("brdf", name, Values(values, {}), host, why);
    InputBuffer inputs{};
    for (std::size_t i = 0; i < schema->inputs.size(); ++i)
      for (int c = 0; c < 4; ++c) inputs[i].v[c] = Real(schema->inputs[i].initial.v[c]);
    for (InputValue& v : inputs)
      if (v.v[0] == 0 && v.v[1] == 0)
        v = {{Real(0.5), Real(0.5), Real(0.5), 1}};  // no lobe, no path
    std::vector<Path> paths;
    for (std::uint32_t i = 0; i < 64; ++i) paths.push_back(makePath(*brdf, inputs, i));
    const Work works[] = {{3, false, false},     {kDepth, false, false}, {3, true, false},
                          {kDepth, true, false}, {3, false, true},       {kDepth, false, true}};
    double time[6];
    std::fill_n(time, 6, 1e9);  // the best of some: what disturbs only ever adds
    for (int i = 0; i < 15; ++i)
      for (int k = 0; k < 6; ++k)
        time[k] = std::min(time[k], nanosecondsAVertex(paths, works[k], sink));
    std::printf("%-18s %6.0f %6.0f        %6.0f %6.0f        %6.0f %6.0f\n", name, time[0], time[1],
                time[2], time[3], time[4] - time[0], time[5] - time[1]);
  }
  return sink == 1 ? 1 : 0;
}
