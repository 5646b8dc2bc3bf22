// SPDX-License-Identifier: Apache-2.0
// The textures of a scene: read once, held in memory or paged from files.
#pragma once
#include <cstddef>
#include <memory>
#include <string>

#include <vestige/host.h>

namespace vestige {

/// Memory use and errors of textures.
struct TextureUse {
  std::size_t held = 0;        ///< bytes of textures that are in memory whole
  int paged = 0;               ///< how many are read from files piece by piece
  std::size_t pagedLimit = 0;  ///< bytes that their pieces may take together; 0: none is paged
  std::size_t pagedUsed = 0;   ///< bytes that they take now
  std::size_t readErrors = 0;  ///< pieces that could not be read; the texture's mean was seen there
  std::string unreadable;      ///< one file of those
  int taken = 0, made = 0;     ///< pictures that came from another store, and that were read
};

/// Reads textures once, converts them to rendering space (linear Rec. 709) by their metadata or the
/// named colour space. In order of request they are held in memory as long as the budget has room
/// for the whole of one; others are paged: written into the cache folder once, as .tx, and read
/// from there when looked up. Lookups give the same bits either way.
class TextureStore {
 public:
  static constexpr std::size_t kDefaultBudget = std::size_t(4) << 30;

  TextureStore();
  ~TextureStore();
  /// Bytes for all textures together, for those requested from now on. Paged ones share what is
  /// left of it, but never less than 32 MB.
  void setBudget(std::size_t bytes);
  /// `file` is an absolute name. The same object for the same request; null with `error`. What
  /// another store, `before`, has of a file that has not changed since is not read again: held
  /// texels are shared. What is held and what is paged is as without it.
  std::shared_ptr<const Texture> texture(const std::string& file, const TextureRequest& request,
                                         std::string& error, const TextureStore* before = nullptr);
  /// A warning about the last texture, which was loaded nevertheless, or "".
  std::string takeWarning();
  TextureUse use() const;
  /// Bytes held by all textures but paged ones.
  std::size_t bytes() const;
  /// How many files, once for each colour space they are read in.
  std::size_t pictures() const;
  /// Numbers in all textures that were NaN or infinite; they read as 0.
  std::size_t nonFinite() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vestige
