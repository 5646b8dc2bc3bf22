// SPDX-License-Identifier: Apache-2.0
// The Host that plugins of a scene are created with: files beside the scene text, shared textures.
#pragma once
#include <set>
#include <string>

#include "engine/image/image.h"

namespace vestige {

class SceneHost final : public Host {
 public:
  /// `files` receives the places of all files that are looked for; null: nobody asks.
  SceneHost(const SceneDesc& description, TextureStore& textures, Diagnostics& diagnostics,
            std::set<std::string>* files)
      : description_(description), textures_(textures), diagnostics_(diagnostics), files_(files) {}

  std::string find(const std::string& file, Span span, std::string& error) override;
  std::shared_ptr<const Texture> texture(const TextureRequest& request,
                                         std::string& error) override;
  void warn(Span span, const std::string& message) override;
  void note(const std::string& message) override;
  /// Where spans point that a plugin did not set: at the block it was made for.
  void setPlace(Span span) { place_ = span; }

 private:
  const SceneDesc& description_;
  TextureStore& textures_;
  Diagnostics& diagnostics_;
  std::set<std::string>* files_;
  Span place_;
  std::set<std::string> noted_;
};

}  // namespace vestige
