// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <functional>
#include <map>
#include <tuple>
#include <utility>
#include <variant>

#include "engine/files/cache_folder.h"
#include "engine/files/file_stamp.h"
#include "engine/files/fingerprint.h"
#include "engine/texture/memory_texture.h"
#include "engine/texture/paged_texture.h"
#include "engine/texture/texels.h"
#include "engine/texture/texture_store.h"

namespace vestige {

namespace {

using Held = std::shared_ptr<const Texels>;
using Paged = std::shared_ptr<const PagedFile>;
using Source = std::variant<Held, Paged>;

/// A picture, and what makes it unnecessary to read its file again.
struct Picture {
  FileStamp stamp;  ///< before it was read
  TexelPlan plan;
  std::string contents;  ///< fingerprint of the file; "" unless it was needed
  Source source;

  /// Null where it is paged.
  Held held() const {
    const Held* texels = std::get_if<Held>(&source);
    return texels ? *texels : nullptr;
  }
};

template <template <class, int> class SourceOf, class Number, class Data>
std::shared_ptr<const Texture> withChannels(const Data& data, int channels, Wrap u, Wrap v) {
  const auto make = [&]<int kChannels>() -> std::shared_ptr<const Texture> {
    using Texels = SourceOf<Number, kChannels>;
    return std::make_shared<FilteredTexture<Texels>>(Texels(data), u, v);
  };
  switch (channels) {
    case 1:
      return make.template operator()<1>();
    case 2:
      return make.template operator()<2>();
    case 3:
      return make.template operator()<3>();
    default:
      return make.template operator()<4>();
  }
}

std::shared_ptr<const Texture> makeTexture(const Held& t, Wrap u, Wrap v) {
  return std::visit(
      [&]<class Code>(const TexelArray<Code>&) {
        return withChannels<MemoryTexels, Code>(t, t->channels, u, v);
      },
      t->data);
}

std::shared_ptr<const Texture> makeTexture(const Paged& f, Wrap u, Wrap v) {
  if (f->plan.isInteger())
    return withChannels<PagedTexels, std::uint16_t>(f, f->plan.channels, u, v);
  return withChannels<PagedTexels, float>(f, f->plan.channels, u, v);
}

}  // namespace

struct TextureStore::Impl {
  std::size_t budget = kDefaultBudget, held = 0;
  std::shared_ptr<PageCache> pages;  ///< null until the first texture is paged
  /// By file and colour space: textures that differ in how they wrap share their texels.
  std::map<std::pair<std::string, std::string>, Picture> pictures;
  std::map<std::tuple<std::string, std::string, Wrap, Wrap>, std::shared_ptr<const Texture>>
      textures;
  std::string warning;
  int taken = 0, made = 0;

  /// False with `error`. `before` is the same picture in another store, or null.
  bool load(const std::string& file, const std::string& colourSpace, const Picture* before,
            Picture& picture, std::string& error) {
    picture.stamp = stampOf(file);
    if (before && before->stamp != picture.stamp) before = nullptr;
    auto plan = before ? before->plan : planTexels(file, colourSpace, error);
    if (!plan) return false;
    picture.plan = *plan;
    if (before) picture.contents = before->contents;
    Held known = before ? before->held() : nullptr;
    bool isRead = !before;
    const auto texels = [&] {
      isRead |= !known;
      return known ? known : loadTexels(file, colourSpace, error);
    };
    if (held <= budget && plan->bytes <= budget - held)
      picture.source = texels();
    else
      picture.source = page(file, picture, texels);
    if (!error.empty()) return false;
    ++(isRead ? made : taken);
    if (const Held now = picture.held()) held += now->bytes;
    limitPages();
    return true;
  }

  void limitPages() {
    if (pages) pages->setLimit(budget > held ? budget - held : 0);
  }

 private:
  /// Paged from a file that is there or can be made, else held in memory with a warning. `texels`
  /// gives all of them, or null.
  Source page(const std::string& file, Picture& picture, const std::function<Held()>& texels) {
    std::string why;
    const std::string folder = cacheFolder(why);
    const TexelPlan& plan = picture.plan;
    if (picture.contents.empty()) picture.contents = fileFingerprint(file);
    const std::string words =
        fmt::format("{} {} {}", kTextureFileVersion, picture.contents, plan.colourKey);
    const std::string key = fingerprint(words.data(), words.size());
    const std::string paged = folder + '/' + key + ".tx";
    if (why.empty())
      if (const auto facts = readTextureFile(paged, plan, key)) return open(paged, plan, *facts);
    Held all = texels();
    if (!all) return all;
    if (why.empty() && writeTextureFile(paged, *all, plan, key, why))
      if (const auto facts = readTextureFile(paged, plan, key)) return open(paged, plan, *facts);
    const std::size_t more = held + all->bytes - budget;
    warning = fmt::format(
        "'{}' cannot be paged: {}; it is held in memory, and textures take {:.1f} MB more than "
        "they "
        "should",
        file, why.empty() ? fmt::format("'{}' cannot be read back", paged) : why,
        double(more) / 1e6);
    return all;
  }

  Source open(const std::string& file, const TexelPlan& plan, const TextureFacts& facts) {
    if (!pages) pages = std::make_shared<PageCache>();
    return std::make_shared<const PagedFile>(pages, file, plan, facts);
  }
};

TextureStore::TextureStore() : impl_(std::make_unique<Impl>()) {}
TextureStore::~TextureStore() = default;

void TextureStore::setBudget(std::size_t bytes) {
  impl_->budget = bytes;
  impl_->limitPages();
}

std::shared_ptr<const Texture> TextureStore::texture(const std::string& file,
                                                     const TextureRequest& request,
                                                     std::string& error,
                                                     const TextureStore* before) {
  error.clear();
  const auto key = std::tuple(file, request.colourSpace, request.wrapU, request.wrapV);
  if (const auto known = impl_->textures.find(key); known != impl_->textures.end())
    return known->second;
  const std::pair name(file, request.colourSpace);
  auto found = impl_->pictures.find(name);
  if (found == impl_->pictures.end()) {
    const Picture* other = nullptr;
    if (before)
      if (const auto old = before->impl_->pictures.find(name); old != before->impl_->pictures.end())
        other = &old->second;
    Picture picture;
    if (!impl_->load(file, request.colourSpace, other, picture, error)) return nullptr;
    found = impl_->pictures.emplace(name, std::move(picture)).first;
  }
  const auto make = [&](const auto& s) { return makeTexture(s, request.wrapU, request.wrapV); };
  return impl_->textures[key] = std::visit(make, found->second.source);
}

std::string TextureStore::takeWarning() { return std::exchange(impl_->warning, {}); }

TextureUse TextureStore::use() const {
  TextureUse use;
  use.held = impl_->held;
  if (impl_->pages)
    use.pagedLimit = impl_->pages->limit(), use.pagedUsed = impl_->pages->bytesUsed();
  use.taken = impl_->taken, use.made = impl_->made;
  for (const auto& [name, picture] : impl_->pictures) {
    const Paged* paged = std::get_if<Paged>(&picture.source);
    if (!paged) continue;
    ++use.paged;
    use.readErrors += (*paged)->failures();
    if ((*paged)->failures() > 0) use.unreadable = (*paged)->file();
  }
  return use;
}

std::size_t TextureStore::bytes() const { return impl_->held; }

std::size_t TextureStore::pictures() const { return impl_->pictures.size(); }

std::size_t TextureStore::nonFinite() const {
  std::size_t sum = 0;
  for (const auto& [name, picture] : impl_->pictures)
    if (const Held texels = picture.held())
      sum += texels->nonFinite;
    else
      sum += std::get<Paged>(picture.source)->facts.nonFinite;
  return sum;
}

}  // namespace vestige
