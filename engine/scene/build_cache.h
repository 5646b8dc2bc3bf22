// SPDX-License-Identifier: Apache-2.0
// What a build of a scene may take over from the one before: a preview reads its text again after
// every change of it, and most of the scene stays.
#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/files/file_stamp.h"
#include "engine/texture/texture_store.h"
#include "engine/trace/world.h"

namespace vestige {

/// Holds shapes, texels and trees of the last build that worked, and nothing of those before. What
/// it holds never changes, so the scene of that build may be rendering while the next one is made.
/// The picture is to the bit that of a scene built without. One thread builds with it at a time.
class BuildCache {
 public:
  /// What became of the last build.
  struct Use {
    int shapesTaken = 0, shapesMade = 0;      ///< shapes that say the same count once
    int texturesTaken = 0, texturesMade = 0;  ///< pictures, however often they are looked up
    bool isWorldTaken = false;                ///< whether no tree was built
  };
  const Use& use() const noexcept { return use_; }
  /// How many shapes and pictures wait for the next build, and the bytes of texels held.
  std::size_t entries() const;
  std::size_t textureBytes() const;

 private:
  friend class SceneBuilder;

  /// A shape, and what creating it would do again.
  struct KeptShape {
    std::shared_ptr<const Shape> shape;
    std::map<std::string, FileStamp> files;  ///< that it read, or missed
    struct Said {
      std::string setting;  ///< at whose value; "": at the shape
      std::string message;
      bool isNote;
    };
    std::vector<Said> said;

    bool isFresh() const;  ///< whether its files are as they were
  };

  std::map<std::string, KeptShape> shapes_;  ///< by what creates them: builder.cpp, shapeKey()
  std::shared_ptr<const TextureStore> textures_;
  std::shared_ptr<const World::Body> world_;
  Use use_;
};

}  // namespace vestige
