// SPDX-License-Identifier: Apache-2.0
// Whether calls into a plugin from elsewhere cost what calls into ours do: bench/call_cost builds
// some of our BRDFs against the installed SDK, as a stranger would, and gives both libraries to
// this program. In turn in one run; the least of the turns.
//
//     call_cost OURS.so THEIRS.so [OURS.so THEIRS.so ...]
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "engine/scene/plugin_library.h"
#include "judge/judge.h"

using namespace vestige;

namespace {

constexpr int kTurns = 60;

Plugin opened(const std::string& file) {
  std::string why;
  const auto plugin = openPlugin(file, promisedBy(file), why);
  if (plugin) return *plugin;
  std::fprintf(stderr, "call_cost: '%s': %s\n", file.c_str(), why.c_str());
  std::exit(3);
}

void keepLeast(std::vector<judge::Timing>& least, const Plugin& plugin) {
  const std::vector<judge::Timing> now = judge::timings(judge::brdfCases(plugin, 4, 1));
  if (least.empty()) least = now;
  for (std::size_t i = 0; i < now.size(); ++i)
    least[i].nanoseconds = std::min(least[i].nanoseconds, now[i].nanoseconds);
}

void compare(const Plugin& ours, const Plugin& theirs) {
  std::vector<judge::Timing> a, b;
  for (int turn = 0; turn < kTurns; ++turn) {
    keepLeast(a, ours);
    keepLeast(b, theirs);
  }
  for (std::size_t i = 0; i < a.size(); ++i)
    std::printf("%-18s %-22s %7.1f %7.1f %6.2f\n", ours.name.c_str(), a[i].method.c_str(),
                a[i].nanoseconds, b[i].nanoseconds, b[i].nanoseconds / a[i].nanoseconds);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3 || argc % 2 == 0) {
    std::fprintf(stderr, "usage: call_cost OURS.so THEIRS.so [OURS.so THEIRS.so ...]\n");
    return 2;
  }
  std::printf("%-18s %-22s %7s %7s %6s\n", "nanoseconds", "", "ours", "theirs", "ratio");
  for (int i = 1; i + 1 < argc; i += 2) compare(opened(argv[i]), opened(argv[i + 1]));
}
