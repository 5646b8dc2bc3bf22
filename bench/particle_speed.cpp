// SPDX-License-Identifier: Apache-2.0
// Particles a second, what carrying their footprints costs, and memory:
//
//     ninja -C build/release particle_speed
//     build/release/bin/particle_speed examples/paper/fig4.scene [PARTICLES] [THREADS]
//
// Wall-clock seconds; each particle that carries a footprint beside one that does not, in one run.
#include <sys/resource.h>

#include <chrono>

#include "bench/scene.h"
#include "plugins/integrator/particle/irradiance.h"
#include "plugins/integrator/particle/shooting.h"

using namespace vestige;
using namespace vestige::particle;

namespace {

double now() {
  using namespace std::chrono;
  return duration<double>(steady_clock::now().time_since_epoch()).count();
}

struct Run {
  double seconds;
  Booking booking;
};
Run send(const SceneView& scene, Hierarchy& hierarchy, const FootprintSettings& footprint,
         std::uint64_t particles, int threads) {
  const Shooting shooting{scene,     hierarchy, footprint,        FootprintArea::covariance,
                          particles, 0,         totalPower(scene)};
  Run run{};
  const double start = now();
  for (std::uint64_t at = 0, next; at < particles; at = next) {
    next = std::min(at + passAfter(at), particles);
    shooting.pass(at, next, threads, run.booking);
    hierarchy.pause();
  }
  run.seconds = now() - start;
  return run;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2 || argc > 4)
    return std::fprintf(stderr, "usage: particle_speed SCENE [PARTICLES] [THREADS]\n"), 2;
  const std::uint64_t particles = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1'000'000;
  const int threads = argc > 3 ? std::max(1, std::atoi(argv[3])) : 2;
  const auto scene = bench::read(argv[1]);
  const SceneView& view = scene->view();
  HierarchySettings settings;
  settings.minArea = sqr(Real(2e-4) * length(view.bounds().size()));
  FootprintSettings carried;
  carried.deltas.bound = Bound::global, carried.deltas.limit = kDefaultLimit;
  carried.deltas.fewest = 3;
  FootprintSettings none = carried;
  none.deltas.bound = Bound::none;
  HierarchySettings coarse = settings;
  coarse.maxLevel = 0;

  Hierarchy without(view, coarse), with(view, settings);
  const Run bare = send(view, without, none, particles, threads);
  const Run full = send(view, with, carried, particles, threads);
  const double built = now();
  const Irradiance light(view, with, 1);
  const double build = now() - built;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::printf("%s, %.2f million particles, %d threads, %.2f hits a particle\n", argv[1],
              double(particles) * 1e-6, threads,
              double(full.booking.hits) / double(full.booking.particles));
  std::printf(
      "thousand particles a second: %.0f; without footprints and elements %.0f (%.2f times)\n",
      double(particles) * 1e-3 / full.seconds, double(particles) * 1e-3 / bare.seconds,
      full.seconds / bare.seconds);
  std::printf("%u elements of %zu bytes; %zu leaves to see, made in %.2f s; peak memory %.0f MiB\n",
              with.elements().size(), sizeof(Element), light.leaves(), build,
              double(usage.ru_maxrss) / 1024);
}
