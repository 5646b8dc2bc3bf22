// SPDX-License-Identifier: Apache-2.0
// Textures whose texels are held in memory with their pyramid, private to engine/texture.
#pragma once
#include <memory>
#include <type_traits>

#include "engine/texture/texel_filter.h"
#include "engine/texture/texels.h"

namespace vestige {

/// Four numbers of a pyramid, those behind a texel's channels to be ignored.
inline FourFloats four(const float* at) noexcept {
  FourFloats x;
  std::memcpy(&x, at, sizeof(x));
  return x;
}
inline FourFloats four(const std::uint16_t* at) noexcept {
  using Codes = std::uint16_t __attribute__((vector_size(8)));
  using Integers = std::int32_t __attribute__((vector_size(16)));
  Codes x;
  std::memcpy(&x, at, sizeof(x));
  return __builtin_convertvector(__builtin_convertvector(x, Integers), FourFloats);
}

/// The Source of a FilteredTexture, see there.
template <class Code, int kChannelCount>
class MemoryTexels {
 public:
  static constexpr int kChannels = kChannelCount;

  explicit MemoryTexels(std::shared_ptr<const Texels> texels)
      : texels_(std::move(texels)),
        codes_(array().codes.data()),
        width_(texels_->width),
        height_(texels_->height) {
    if constexpr (!std::is_same_v<Code, float>)
      colour_ = array().colour->data(), alpha_ = array().alpha->data();
  }

  int width() const noexcept { return width_; }
  int height() const noexcept { return height_; }
  const Table<Level>& levels() const noexcept { return texels_->pyramid.levels; }
  Rgba mean() const noexcept { return texels_->mean; }

  /// A texel of the full resolution, decoded on request.
  struct Texel {
    const MemoryTexels& of;
    const Code* at;
    float operator[](int channel) const noexcept { return of.decoded(at, channel); }
  };

  class Reader {
   public:
    explicit Reader(const MemoryTexels& texels) noexcept : texels_(texels) {}

    Texel texel(std::int32_t x, std::int32_t y) const noexcept {
      return {texels_, texels_.row(y) + x * kChannels};
    }

    template <class Visit>
    Rgba read(int index, Visit visit) const noexcept {
      const MemoryTexels& t = texels_;
      if (index == 0)
        return visit(
            [&t](std::int32_t y) {
              return [&t, row = t.row(y)](std::int32_t x) {
                FourFloats value{};
                for (int c = 0; c < kChannels; ++c)
                  value[c] = t.decoded(row + std::ptrdiff_t(x) * kChannels, c);
                return value;
              };
            },
            1.f, 0);
      const Level& level = t.levels()[index - 1];
      return std::visit(
          [&]<class Number>(const std::vector<Number>& numbers) {
            constexpr float kUnit = std::is_same_v<Number, float> ? 1 : 1 / Pyramid::kUnitCodes;
            const std::ptrdiff_t stride = std::ptrdiff_t(level.width + 2) * kChannels;
            const Number* origin = numbers.data() + level.start + stride + kChannels;
            return visit(
                [=](std::int32_t y) {
                  return [row = origin + y * stride](std::int32_t x) {
                    return four(row + std::ptrdiff_t(x) * kChannels);
                  };
                },
                kUnit, 1);
          },
          t.texels_->pyramid.texels);
    }

    static constexpr bool failed() noexcept { return false; }

   private:
    const MemoryTexels& texels_;
  };

 private:
  static constexpr bool kAlpha = kChannels == 2 || kChannels == 4;

  const TexelArray<Code>& array() const { return std::get<TexelArray<Code>>(texels_->data); }

  /// Row 0 is the bottom one here, the last in memory.
  const Code* row(std::int32_t y) const noexcept {
    return codes_ + std::ptrdiff_t(height_ - 1 - y) * width_ * kChannels;
  }

  float decoded(const Code* at, int channel) const noexcept {
    if constexpr (std::is_same_v<Code, float>)
      return at[channel];
    else
      return (kAlpha && channel == kChannels - 1 ? alpha_ : colour_)[at[channel]];
  }

  std::shared_ptr<const Texels> texels_;
  const Code* codes_;
  const float* colour_ = nullptr;  ///< decode tables; null for float
  const float* alpha_ = nullptr;
  std::int32_t width_, height_;
};

template <class Code, int kChannels>
using MemoryTexture = FilteredTexture<MemoryTexels<Code, kChannels>>;

}  // namespace vestige
