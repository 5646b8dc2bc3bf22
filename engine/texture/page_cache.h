// SPDX-License-Identifier: Apache-2.0
// Tiles of texture files, in memory while there is room: OpenImageIO's ImageCache with our names.
// Private to engine/texture.
#pragma once
#include <OpenImageIO/imagecache.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "engine/texture/texture_file.h"

namespace vestige {

class PageCache {
 public:
  /// With less memory, tiles would be evicted before the next lookup needs them.
  static constexpr std::size_t kLeastBytes = std::size_t(32) << 20;

  PageCache();
  ~PageCache();
  PageCache(const PageCache&) = delete;
  PageCache& operator=(const PageCache&) = delete;

  /// At least kLeastBytes.
  void setLimit(std::size_t bytes);
  std::size_t limit() const noexcept { return limit_; }
  std::size_t bytesUsed() const;
  OIIO::ImageCache& library() const noexcept { return *cache_; }
  /// The library's data for the calling thread [any thread].
  OIIO::ImageCache::Perthread* thread() const {
    // By number: a later cache may lie at the same address.
    thread_local std::uint64_t known = 0;
    thread_local OIIO::ImageCache::Perthread* info = nullptr;
    if (known != number_) info = cache_->get_perthread_info(), known = number_;
    return info;
  }

 private:
  OIIO::ImageCache* cache_;
  std::uint64_t number_;  ///< from 1, no two the same
  std::size_t limit_ = 0;
};

/// A texture whose texels lie in a file.
class PagedFile {
 public:
  PagedFile(std::shared_ptr<PageCache> cache, const std::string& file, TexelPlan plan,
            const TextureFacts& facts);
  /// A file that could not be read is deleted, so that it is made anew the next time.
  ~PagedFile();
  PagedFile(const PagedFile&) = delete;
  PagedFile& operator=(const PagedFile&) = delete;

  const TexelPlan plan;
  const TextureFacts facts;
  const Table<Level> levels;

  /// The tile that begins at a place, to be given back, and its numbers. Null, and counted, if it
  /// cannot be read or holds another kind of numbers than `format`; they are zeros then [any
  /// thread].
  OIIO::ImageCache::Tile* tile(int level, int x, int y, OIIO::TypeDesc::BASETYPE format,
                               const void*& numbers) const noexcept;
  void giveBack(OIIO::ImageCache::Tile* tile) const noexcept {
    cache_->library().release_tile(tile);
  }

  /// How many tiles could not be read.
  std::size_t failures() const noexcept { return failures_; }
  const std::string& file() const noexcept { return file_; }

 private:
  std::shared_ptr<PageCache> cache_;
  std::string file_;
  OIIO::ImageCache::ImageHandle* handle_;
  mutable std::atomic<std::size_t> failures_ = 0;
  mutable std::mutex badTilesMutex_;
  mutable std::set<std::tuple<int, int, int>> badTiles_;  ///< level, x, y as requested

  bool isBad(int level, int x, int y) const {
    const std::lock_guard lock(badTilesMutex_);
    return badTiles_.contains({level, x, y});
  }
};

}  // namespace vestige
