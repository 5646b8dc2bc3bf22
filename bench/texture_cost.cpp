// SPDX-License-Identifier: Apache-2.0
// Nanoseconds a texture lookup takes, held in memory against paged. CPU time of one thread; all
// tiles that are looked at fit into the cache, so what is compared is finding them, not reading.
//
//     texture_cost [SIDE]      of the picture, 2048
#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <vector>

#include "engine/picture/image.h"
#include "engine/texture/texture_store.h"

using namespace vestige;

namespace {

double cpuNanoseconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e9 * double(t.tv_sec) + double(t.tv_nsec);
}

struct Place {
  Vec2 uv, d[2];
};

/// Anywhere, or near the one before as rays of a tile are; `length` texels long.
std::vector<Place> places(int side, double length, double aspect, bool anywhere) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Place> list(200000);
  double u = 0.5, v = 0.5;
  for (Place& p : list) {
    if (anywhere)
      u = unit(random), v = unit(random);
    else
      u += (unit(random) - 0.5) * 4 / side, v += (unit(random) - 0.5) * 4 / side;
    const double angle = 6.2832 * unit(random), a = length / side, b = a / aspect;
    p.uv = {Real(u), Real(v)};
    p.d[0] = {Real(a * std::cos(angle)), Real(a * std::sin(angle))};
    p.d[1] = {Real(-b * std::sin(angle)), Real(b * std::cos(angle))};
  }
  return list;
}

double nanoseconds(const Texture& t, const std::vector<Place>& list, double& sum) {
  const double start = cpuNanoseconds();
  for (const Place& p : list) sum += double(t.lookup(p.uv, p.d).colour.g);
  return (cpuNanoseconds() - start) / double(list.size());
}

std::string writeNoise(int side) {
  std::mt19937 random(2);
  Image image{side, side, {"R", "G", "B"}, {}, {}};
  image.pixels.resize(std::size_t(side) * side * 3);
  for (float& x : image.pixels) x = float(random() % 1000) / 1000;
  const auto file = std::filesystem::temp_directory_path() / "vestige-texture-cost.png";
  std::string error;
  if (!writeImage(file.string(), image, {}, error)) std::printf("%s\n", error.c_str());
  return file.string();
}

}  // namespace

int main(int argc, char** argv) {
  const int side = argc > 1 ? std::max(std::atoi(argv[1]), 16) : 2048;
  const std::string file = writeNoise(side);
  TextureStore memory, pages;
  pages.setBudget(1);
  std::string error;
  const auto held = memory.texture(file, {file, {}, ""}, error);
  const auto paged = pages.texture(file, {file, {}, ""}, error);
  if (!held || !paged) return std::fprintf(stderr, "%s\n", error.c_str()), 3;
  std::filesystem::remove(file);
  if (pages.use().paged == 0) return std::fprintf(stderr, "not paged\n"), 3;

  std::printf("ns a lookup              held   paged   ratio\n");
  for (const auto& [length, aspect] : {std::pair(0., 1.), {3., 1.}, {12., 4.}, {48., 16.}})
    for (const bool anywhere : {false, true}) {
      const auto list = places(side, length, aspect, anywhere);
      double best[2] = {1e9, 1e9}, sum[2] = {};  // what disturbs only ever adds
      for (int i = 0; i < 5; ++i)
        for (int k = 0; k < 2; ++k)
          best[k] = std::min(best[k], nanoseconds(k ? *paged : *held, list, sum[k]));
      std::printf("%4.0f x %-4.1f %-10s %8.0f %7.0f %7.1f%s\n", length, length / aspect,
                  anywhere ? "anywhere" : "coherent", best[0], best[1], best[1] / best[0],
                  sum[0] == sum[1] ? "" : "  NOT THE SAME");
    }
}
