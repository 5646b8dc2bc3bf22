// SPDX-License-Identifier: Apache-2.0
// Textures whose texels are paged in from a file, private to engine/texture.
#pragma once
#include <type_traits>

#include "engine/texture/page_cache.h"
#include "engine/texture/texel_filter.h"

namespace vestige {

/// The Source of a FilteredTexture, see there. Number: of the file, uint16_t or float.
template <class Number, int kChannelCount>
class PagedTexels {
 public:
  static constexpr int kChannels = kChannelCount;

  explicit PagedTexels(std::shared_ptr<const PagedFile> file) : file_(std::move(file)) {
    if constexpr (std::is_same_v<Number, float>) return;
    colour_ = file_->plan.colour->data(), alpha_ = file_->plan.alpha->data();
    lastCode_ = Code(file_->plan.colour->size() - 1);
  }

  int width() const noexcept { return file_->plan.width; }
  int height() const noexcept { return file_->plan.height; }
  const Table<Level>& levels() const noexcept { return file_->levels; }
  Rgba mean() const noexcept { return file_->facts.mean; }

  /// Holds the tiles that it has used last, so that most texels cost no search.
  class Reader {
   public:
    explicit Reader(const PagedTexels& texels) noexcept : texels_(texels) {}
    ~Reader() {
      for (const Slot& slot : slots_)
        if (slot.tile) texels_.file_->giveBack(slot.tile);
    }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;

    FourFloats texel(std::int32_t x, std::int32_t y) noexcept { return Row<true>(*this, 0, y)(x); }

    template <class Visit>
    Rgba read(int index, Visit visit) noexcept {
      if (index == 0)
        return visit([this](std::int32_t y) { return Row<true>(*this, 0, y); }, 1.f, 0);
      constexpr float kUnit = std::is_same_v<Number, float> ? 1 : 1 / Pyramid::kUnitCodes;
      return visit([this, index](std::int32_t y) { return Row<false>(*this, index, y); }, kUnit, 1);
    }

    bool failed() const noexcept { return failed_; }

   private:
    /// Of one level. Row 0 is the bottom one, the last in the file.
    template <bool kFull>
    class Row {
     public:
      Row(Reader& reader, int level, std::int32_t y) noexcept
          : reader_(reader),
            level_(level),
            y_(kFull ? reader.texels_.height() - 1 - y
                     : reader.texels_.levels()[level - 1].height - y) {}

      FourFloats operator()(std::int32_t x) noexcept {
        if constexpr (!kFull) ++x;  // the border
        if (x >> kTileShift != column_) {
          column_ = x >> kTileShift;
          at_ = reader_.numbers(level_, column_, y_ >> kTileShift) +
                (y_ & (kTileSide - 1)) * kTileSide * kChannels;
        }
        const Number* texel = at_ + (x & (kTileSide - 1)) * kChannels;
        FourFloats value{};
        for (int c = 0; c < kChannels; ++c)
          value[c] = kFull ? reader_.texels_.decoded(texel[c], c) : float(texel[c]);
        return value;
      }

     private:
      Reader& reader_;
      int level_;
      std::int32_t y_, column_ = -1;
      const Number* at_ = nullptr;
    };

    struct Slot {
      std::uint64_t name = ~std::uint64_t(0);
      OIIO::ImageCache::Tile* tile = nullptr;
      const Number* numbers = nullptr;
    };

    /// The numbers of a tile, valid until the next call.
    const Number* numbers(int level, std::int32_t column, std::int32_t row) noexcept {
      Slot& slot = slots_[(column & 1) | (row & 1) << 1];  // neighbours have one each
      const std::uint64_t name =
          std::uint64_t(level) << 56 | std::uint64_t(column) << 28 | std::uint64_t(row);
      if (slot.name != name) fill(slot, name, level, column, row);
      return slot.numbers;
    }

    [[gnu::noinline]] void fill(Slot& slot, std::uint64_t name, int level, std::int32_t column,
                                std::int32_t row) noexcept {
      constexpr auto kFormat =
          std::is_same_v<Number, float> ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT16;
      if (slot.tile) texels_.file_->giveBack(slot.tile);
      const void* found = nullptr;
      slot.tile =
          texels_.file_->tile(level, column << kTileShift, row << kTileShift, kFormat, found);
      slot.name = name;
      slot.numbers = static_cast<const Number*>(found);
      failed_ |= !slot.tile;
    }

    const PagedTexels& texels_;
    Slot slots_[4];
    bool failed_ = false;
  };

 private:
  using Code = std::uint16_t;
  static constexpr bool kAlpha = kChannels == 2 || kChannels == 4;

  float decoded(Number number, int channel) const noexcept {
    if constexpr (std::is_same_v<Number, float>)
      return number;
    else  // a table ends where codes of its pictures do, but a damaged file may hold others
      return (kAlpha && channel == kChannels - 1 ? alpha_ : colour_)[number & lastCode_];
  }

  std::shared_ptr<const PagedFile> file_;
  const float* colour_ = nullptr;  ///< decode tables; null for float
  const float* alpha_ = nullptr;
  Code lastCode_ = 0;
};

template <class Number, int kChannels>
using PagedTexture = FilteredTexture<PagedTexels<Number, kChannels>>;

}  // namespace vestige
