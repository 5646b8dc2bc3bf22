// SPDX-License-Identifier: Apache-2.0
#include "engine/scene/build_cache.h"

#include <algorithm>

namespace vestige {

bool BuildCache::KeptShape::isFresh() const {
  return std::all_of(files.begin(), files.end(),
                     [](const auto& file) { return stampOf(file.first) == file.second; });
}

std::size_t BuildCache::entries() const {
  return shapes_.size() + std::size_t(textures_ ? textures_->pictures() : 0);
}

std::size_t BuildCache::textureBytes() const { return textures_ ? textures_->bytes() : 0; }

}  // namespace vestige
