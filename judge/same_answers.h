// SPDX-License-Identifier: Apache-2.0
// Tests that methods have no hidden state: repeated calls return the same bits.
#pragma once
#include <array>
#include <atomic>
#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "judge/verdict.h"

namespace vestige::judge {

/// Numbers of a result, compared by their bits: NaN equals itself.
class Bits {
 public:
  void add(Real x) {
    const double d = double(x);
    hash_ = (hash_ ^ std::bit_cast<std::uint64_t>(d)) * 0x9e3779b97f4a7c15u;
    hash_ ^= hash_ >> 29;
  }
  void add(Vec3 v) { add(v.x), add(v.y), add(v.z); }
  void add(Rgb c) { add(c.r), add(c.g), add(c.b); }
  bool operator==(const Bits&) const = default;

 private:
  std::uint64_t hash_ = 1;
};

inline constexpr int kThreads = 4, kRounds = 3;

/// Calls ask(i, method) for all questions in order, then backwards with the methods reversed, then
/// from many threads at once. `describe(i, what)` makes an event of a question.
template <class Ask, class Describe>
Finding sameAnswers(std::size_t questions, std::span<const char* const> methods, const Ask& ask,
                    const Describe& describe) {
  Finding f{"repeated calls and threads get the same results", "all"};
  const std::size_t n = methods.size(), all = questions * n;
  std::vector<Bits> first(all);
  for (std::size_t k = 0; k < all; ++k) first[k] = ask(k / n, k % n);
  const auto see = [&](std::size_t k, bool same, const char* when) {
    f.worst.see(same ? 0 : 2, [&] {
      f.method = methods[k % n];
      return describe(k / n, f.method + " returns another result " + when);
    });
  };
  for (std::size_t k = all; k-- > 0;)
    see(k, ask(k / n, k % n) == first[k], "when called again in another order");
  std::vector<std::atomic<bool>> differs(all);
  const auto work = [&](std::size_t thread) {
    for (int round = 0; round < kRounds; ++round)
      for (std::size_t i = 0; i < all; ++i) {
        const std::size_t k = (i + all * thread / kThreads) % all;
        if (!(ask(k / n, k % n) == first[k])) differs[k] = true;
      }
  };
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < kThreads; ++t) threads.emplace_back(work, t);
  for (std::thread& t : threads) t.join();
  for (std::size_t k = 0; k < all; ++k) see(k, !differs[k], "while other threads call it");
  return f;
}

}  // namespace vestige::judge
