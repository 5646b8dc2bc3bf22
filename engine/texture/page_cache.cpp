// SPDX-License-Identifier: Apache-2.0
#include "engine/texture/page_cache.h"

#include <algorithm>
#include <filesystem>

namespace vestige {

PageCache::PageCache() : cache_(OIIO::ImageCache::create(false)) {
  static std::atomic<std::uint64_t> count = 0;
  number_ = ++count;
  setLimit(0);
}

PageCache::~PageCache() { OIIO::ImageCache::destroy(cache_); }

void PageCache::setLimit(std::size_t bytes) {
  limit_ = std::max(bytes, kLeastBytes);
  cache_->attribute("max_memory_MB", float(double(limit_) / (1 << 20)));
}

std::size_t PageCache::bytesUsed() const {
  long long bytes = 0;
  cache_->getattribute("stat:cache_memory_used", OIIO::TypeDesc::INT64, &bytes);
  return std::size_t(bytes);
}

PagedFile::PagedFile(std::shared_ptr<PageCache> cache, const std::string& file, TexelPlan p,
                     const TextureFacts& f)
    : plan(std::move(p)),
      facts(f),
      levels(pyramidLevels(plan.width, plan.height, plan.channels)),
      cache_(std::move(cache)),
      file_(file),
      handle_(cache_->library().get_image_handle(OIIO::ustring(file))) {}

PagedFile::~PagedFile() {
  std::error_code ignored;
  if (failures_ > 0) std::filesystem::remove(file_, ignored);
}

OIIO::ImageCache::Tile* PagedFile::tile(int level, int x, int y, OIIO::TypeDesc::BASETYPE format,
                                        const void*& numbers) const noexcept {
  OIIO::ImageCache& library = cache_->library();
  try {
    // After a failed read the library may return an uninitialised tile on the next request.
    const bool bad = failures_ > 0 && isBad(level, x, y);
    OIIO::ImageCache::Tile* tile =
        bad ? nullptr : library.get_tile(handle_, cache_->thread(), 0, level, x, y, 0);
    if (tile) {
      OIIO::TypeDesc held;
      numbers = library.tile_pixels(tile, held);
      if (numbers && held.basetype == format) return tile;
      library.release_tile(tile);
    }
    library.geterror();  // else the library's messages pile up
    const std::lock_guard lock(badTilesMutex_);
    if (badTiles_.emplace(level, x, y).second) ++failures_;
  } catch (...) {  // no memory for the tile, and none for a message
    ++failures_;
  }
  static float nothing[kTileSide * kTileSide * 4];  // never written
  numbers = nothing;
  return nullptr;
}

}  // namespace vestige
