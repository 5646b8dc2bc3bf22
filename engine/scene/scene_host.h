// SPDX-License-Identifier: Apache-2.0
// The Host that plugins of a scene are created with: files beside the scene text, shared textures.
#pragma once
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "engine/files/file_stamp.h"
#include "engine/texture/texture_store.h"

namespace vestige {

/// What a plugin asked and said while it was created.
struct HostRecord {
  std::map<std::string, FileStamp> files;  ///< looked for, found or not
  struct Said {
    Span span;
    std::string message;
    bool isNote;
  };
  std::vector<Said> said;
};

class SceneHost final : public Host {
 public:
  /// `files` receives the places of all files that are looked for; null: nobody asks. `before` is
  /// where textures that have not changed are taken from; null: nowhere.
  SceneHost(const SceneDesc& description, TextureStore& textures, Diagnostics& diagnostics,
            std::set<std::string>* files, const TextureStore* before)
      : description_(description),
        textures_(textures),
        diagnostics_(diagnostics),
        files_(files),
        before_(before) {}

  std::string find(const std::string& file, Span span, std::string& error) override;
  std::shared_ptr<const Texture> texture(const TextureRequest& request,
                                         std::string& error) override;
  void warn(Span span, const std::string& message) override;
  void note(const std::string& message) override;
  NestedBrdf brdf(const Block* block) override { return nested_.brdf(block); }
  std::shared_ptr<const Pigment> pigment(const Block& block) override {
    return nested_.pigment(block);
  }
  std::shared_ptr<const Medium> medium(const Block& block) override {
    return nested_.medium(block);
  }
  std::shared_ptr<const PhaseFunction> phase(const Block& block) override {
    return nested_.phase(block);
  }

  /// Who makes plugins inside others: the builder.
  struct Nested {
    std::function<NestedBrdf(const Block*)> brdf;
    std::function<std::shared_ptr<const Pigment>(const Block&)> pigment;
    std::function<std::shared_ptr<const Medium>(const Block&)> medium;
    std::function<std::shared_ptr<const PhaseFunction>(const Block&)> phase;
  };
  void setNested(Nested nested) { nested_ = std::move(nested); }
  /// Where spans point that a plugin did not set: at the block it was made for.
  void setPlace(Span span) { place_ = span; }
  Span place() const { return place_; }
  /// From now on; null: no more.
  void recordTo(HostRecord* record) { record_ = record; }

 private:
  const SceneDesc& description_;
  TextureStore& textures_;
  Diagnostics& diagnostics_;
  std::set<std::string>* files_;
  const TextureStore* before_;
  HostRecord* record_ = nullptr;
  Span place_;
  Nested nested_;
  std::set<std::string> noted_;
};

}  // namespace vestige
