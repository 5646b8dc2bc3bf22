// SPDX-License-Identifier: Apache-2.0
// How long render() goes on when somebody no longer wants its picture: milliseconds from setting
// the cancel flag to its return, median and worst of many trials at any moment of a pass.
//
//     ninja -C build/release cancel_wait && build/release/bin/cancel_wait examples/pieces.scene
//     [WIDTH] [INTEGRATOR]
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "bench/scene.h"
#include "engine/render/session.h"

using namespace vestige;

namespace {

constexpr int kTrials = 40;

double now() {
  using namespace std::chrono;
  return duration<double>(steady_clock::now().time_since_epoch()).count();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return std::fprintf(stderr, "cancel_wait: SCENE [WIDTH] [INTEGRATOR]\n"), 2;
  const auto scene = bench::read(argv[1], {}, argc > 3 ? argv[3] : "");
  const int width = argc > 2 ? std::atoi(argv[2]) : 1280;
  std::vector<double> waits;
  Film film = makeFilm(*scene, width, 0, nullptr, {});
  for (int i = 0; i < kTrials; ++i) {
    std::atomic<bool> cancel{false};
    double asked = 0;
    std::thread hand([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(150 + 17 * i % 101));
      asked = now(), cancel = true;
    });
    RenderOptions options{.samples = kMostSamples, .cancel = &cancel};
    options.mostInPass = 4, options.isPrepared = i > 0;  // as the window has it
    render(*scene, film, options);
    const double ended = now();
    hand.join();
    waits.push_back(1000 * (ended - asked));
  }
  std::sort(waits.begin(), waits.end());
  std::printf("%s, %d wide: median %.1f ms, worst %.1f ms\n", argv[1], width,
              waits[waits.size() / 2], waits.back());
}
