// SPDX-License-Identifier: Apache-2.0
// Where particles leave their flux: pieces of surface, each divided into four. Made while others
// deposit, so they never move; sums are integers, so they do not depend on who came first.
#pragma once
#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>

#include <vestige/math.h>

namespace vestige::particle {

/// Flux in units of kFluxUnit times the power of all lights, summed over particles.
using Flux = std::array<std::int64_t, 3>;
/// 2^32 particles that each bring what all lights send, 32 times, and no sum overflows.
inline constexpr double kFluxUnit = 0x1p-26;

/// Number of an element; 0: none.
using ElementId = std::uint32_t;

struct Element {
  std::atomic<std::int64_t> flux[3] = {};      ///< that arrived here and in no child
  std::atomic<std::uint32_t> quarter[4] = {};  ///< how many particles brought it, by part
  std::atomic<ElementId> children{0};          ///< the first of four; 0: not divided
  std::uint32_t judged = 0;                    ///< hits when it was last asked whether they vary
  ElementId parent = 0;                        ///< 0: nothing above
  float area = 0;                              ///< world, scene units squared
  std::int8_t level = 0;  ///< divisions below the patch; -1: a cluster of patches
  /// Hits vary in it: what it held, and what is meant for it, is its children's. Changes between
  /// passes only.
  bool varies = false;

  void deposit(const Flux& f, int part) noexcept {
    for (int c = 0; c < 3; ++c)
      if (f[std::size_t(c)] != 0) flux[c].fetch_add(f[std::size_t(c)], std::memory_order_relaxed);
    quarter[part].fetch_add(1, std::memory_order_relaxed);
  }
  Flux sum() const noexcept {
    return {flux[0].load(std::memory_order_relaxed), flux[1].load(std::memory_order_relaxed),
            flux[2].load(std::memory_order_relaxed)};
  }
  std::uint64_t hits() const noexcept {
    std::uint64_t n = 0;
    for (const auto& q : quarter) n += q.load(std::memory_order_relaxed);
    return n;
  }
};

/// A list that grows while it is read: what was handed out stays where it is.
class Elements {
 public:
  Element& operator[](ElementId i) const noexcept {
    return chunks_[i >> kChunkBits].load(std::memory_order_acquire)[i & (kChunk - 1)];
  }
  /// One past the last.
  ElementId size() const noexcept { return size_.load(std::memory_order_relaxed); }
  std::size_t bytes() const noexcept { return std::size_t(size()) * sizeof(Element); }

  /// The first of n new ones, side by side. n is at most 4, and always the same while threads
  /// share the list. [any thread]
  ElementId add(std::uint32_t n) {
    const ElementId first = size_.fetch_add(n, std::memory_order_relaxed);
    need((first + n - 1) >> kChunkBits);
    return first;
  }
  /// Makes room for n at the beginning, before anybody else looks. [one thread]
  void start(std::uint32_t n) {
    n = (n + 3) & ~3u;
    for (std::uint32_t c = 0; c <= n >> kChunkBits; ++c) need(c);
    size_ = n;
  }

 private:
  static constexpr int kChunkBits = 16;
  static constexpr std::uint32_t kChunk = 1u << kChunkBits;

  void need(std::uint32_t chunk) {
    if (chunks_[chunk].load(std::memory_order_acquire)) return;
    const std::lock_guard lock(mutex_);
    if (chunks_[chunk].load(std::memory_order_relaxed)) return;
    owned_[chunk] = std::make_unique<Element[]>(kChunk);
    chunks_[chunk].store(owned_[chunk].get(), std::memory_order_release);
  }

  std::array<std::atomic<Element*>, 1u << (32 - kChunkBits)> chunks_ = {};
  std::array<std::unique_ptr<Element[]>, 1u << (32 - kChunkBits)> owned_;
  std::atomic<ElementId> size_{0};
  std::mutex mutex_;
};

}  // namespace vestige::particle
