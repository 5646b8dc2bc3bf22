// SPDX-License-Identifier: Apache-2.0
#include <map>
#include <tuple>

#include "engine/image/image.h"
#include "engine/image/memory_texture.h"
#include "engine/image/texels.h"

namespace vestige {

namespace {

template <class Code>
std::shared_ptr<const Texture> withChannels(const std::shared_ptr<const Texels>& texels, Wrap u,
                                            Wrap v) {
  switch (texels->channels) {
    case 1:
      return std::make_shared<MemoryTexture<Code, 1>>(texels, u, v);
    case 2:
      return std::make_shared<MemoryTexture<Code, 2>>(texels, u, v);
    case 3:
      return std::make_shared<MemoryTexture<Code, 3>>(texels, u, v);
    default:
      return std::make_shared<MemoryTexture<Code, 4>>(texels, u, v);
  }
}

std::shared_ptr<const Texture> makeTexture(const std::shared_ptr<const Texels>& texels, Wrap u,
                                           Wrap v) {
  return std::visit(
      [&]<class Code>(const TexelArray<Code>&) { return withChannels<Code>(texels, u, v); },
      texels->data);
}

}  // namespace

struct TextureStore::Impl {
  /// By file and colour space: textures that differ in how they wrap share their texels.
  std::map<std::pair<std::string, std::string>, std::shared_ptr<const Texels>> texels;
  std::map<std::tuple<std::string, std::string, Wrap, Wrap>, std::shared_ptr<const Texture>>
      textures;
};

TextureStore::TextureStore() : impl_(std::make_unique<Impl>()) {}
TextureStore::~TextureStore() = default;

std::shared_ptr<const Texture> TextureStore::texture(const std::string& file,
                                                     const TextureRequest& request,
                                                     std::string& error) {
  error.clear();
  const auto key = std::tuple(file, request.colourSpace, request.wrapU, request.wrapV);
  if (const auto known = impl_->textures.find(key); known != impl_->textures.end())
    return known->second;
  const std::pair source(file, request.colourSpace);
  auto texels = impl_->texels[source];
  if (!texels) texels = loadTexels(file, request.colourSpace, error);
  if (!texels) {
    impl_->texels.erase(source);
    return nullptr;
  }
  impl_->texels[source] = texels;
  return impl_->textures[key] = makeTexture(texels, request.wrapU, request.wrapV);
}

std::size_t TextureStore::bytes() const {
  std::size_t sum = 0;
  for (const auto& [source, texels] : impl_->texels) sum += texels->bytes;
  return sum;
}

std::size_t TextureStore::nonFinite() const {
  std::size_t sum = 0;
  for (const auto& [source, texels] : impl_->texels) sum += texels->nonFinite;
  return sum;
}

}  // namespace vestige
