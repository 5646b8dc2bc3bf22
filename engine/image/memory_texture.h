// SPDX-License-Identifier: Apache-2.0
// The lookup in the inner loop, private to engine/image.
#pragma once
#include <vestige/host.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <type_traits>
#include <utility>

#include "engine/image/ellipse.h"
#include "engine/image/texels.h"

namespace vestige {

/// The two texels around a coordinate and the share of the second.
struct Neighbours {
  std::int32_t first, second;
  float share;  ///< [0, 1]
};

/// Along an axis of n texels, centres at (i + 0.5) / n. A coordinate that is not a number, or so
/// large that it has no fraction left, counts as 0.
inline Neighbours neighbours(Real t, std::int32_t n, Wrap wrap) noexcept {
  if (!(std::abs(t) < Real(1e9))) t = 0;
  if (wrap == Wrap::clamp) {
    t = t < 0 ? 0 : t > 1 ? 1 : t;
  } else if (wrap == Wrap::repeat) {
    t -= Real(floorInt(t));
  } else {
    t -= 2 * Real(floorInt(t / 2));
    if (t > 1) t = 2 - t;
  }
  const Real x = t * Real(n) - Real(0.5);  // t in [0, 1]
  const std::int32_t i = floorInt(x);
  const auto share = float(x - Real(i));
  std::int32_t first = i, second = i + 1;
  // Beyond the edge lies the other edge where the picture repeats, else the edge again.
  if (first < 0) first = wrap == Wrap::repeat ? n - 1 : 0;
  if (second >= n) second = wrap == Wrap::repeat ? 0 : n - 1;
  if (first >= n) first = n - 1;  // t rounded up to 1
  return {first, second, share};
}

using FourFloats = float __attribute__((vector_size(16)));

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

/// A picture held in memory with its pyramid. Up to a texel bilinear at full resolution, beyond two
/// the filter of ellipse.h, between them a mixture.
template <class Code, int kChannels>
class MemoryTexture final : public Texture {
 public:
  MemoryTexture(std::shared_ptr<const Texels> texels, Wrap wrapU, Wrap wrapV)
      : texels_(std::move(texels)),
        codes_(array().codes.data()),
        width_(texels_->width),
        height_(texels_->height),
        wrapU_(wrapU),
        wrapV_(wrapV) {
    if constexpr (!std::is_same_v<Code, float>)
      colour_ = array().colour->data(), alpha_ = array().alpha->data();
    full_.width = width_, full_.height = height_;
  }

  Rgba lookup(Vec2 uv, const Vec2 dUv[2]) const noexcept override {
    const Moments m = outerProducts(dUv, width_, height_);
    // The trace is an upper bound of the longest axis squared. NaN asks for a point.
    return m.xx + m.yy > 1 ? filtered(uv, dUv) : bilinear(uv);
  }

  Rgba texel(int x, int y) const noexcept override {
    const Code* at = row(y) + x * kChannels;
    return gather([&](int i) { return decoded(at, i); });
  }

  int width() const noexcept override { return width_; }
  int height() const noexcept override { return height_; }
  bool hasAlpha() const noexcept override { return kAlpha; }
  Rgba mean() const noexcept override { return texels_->mean; }

 private:
  static constexpr bool kAlpha = kChannels == 2 || kChannels == 4;

  Rgba bilinear(Vec2 uv) const noexcept {
    const Neighbours x = neighbours(uv.x, width_, wrapU_), y = neighbours(uv.y, height_, wrapV_);
    const Code *low = row(y.first), *high = row(y.second);
    const Code *a = low + x.first * kChannels, *b = low + x.second * kChannels;
    const Code *c = high + x.first * kChannels, *d = high + x.second * kChannels;
    const float wa = (1 - x.share) * (1 - y.share), wb = x.share * (1 - y.share);
    const float wc = (1 - x.share) * y.share, wd = x.share * y.share;
    return gather([&](int i) {
      return wa * decoded(a, i) + wb * decoded(b, i) + wc * decoded(c, i) + wd * decoded(d, i);
    });
  }

  /// Beside the fast path, not in it.
  [[gnu::noinline]] Rgba filtered(Vec2 uv, const Vec2 dUv[2]) const noexcept {
    const int levels = int(texels_->pyramid.levels.size()) + 1;
    const Wanted wanted = wantedFilter(boundedProducts(dUv, width_, height_), levels);
    if (wanted.longest <= 1) return bilinear(uv);
    const Vec2 at{broughtHome(uv.x, wrapU_), broughtHome(uv.y, wrapV_)};
    Rgba result = averaged(at, wanted.covariance, wanted.level);
    if (wanted.levelPart < 1)
      result = mixed(averaged(at, wanted.covariance, wanted.level - 1), result, wanted.levelPart);
    if (wanted.longest < 2) result = mixed(bilinear(uv), result, wanted.longest - 1);
    return result;
  }

  static Rgba mixed(const Rgba& a, const Rgba& b, float share) noexcept {
    const Real s = share;
    return {(1 - s) * a.colour + s * b.colour, (1 - s) * a.alpha + s * b.alpha};
  }

  Rgba averaged(Vec2 uv, const Moments& covariance, int index) const noexcept {
    const Level& level = index ? texels_->pyramid.levels[std::size_t(index) - 1] : full_;
    const Bump bump = bumpOn(level, covariance, level.width == 1 && wrapU_ != Wrap::clamp,
                             level.height == 1 && wrapV_ != Wrap::clamp);
    if (index == 0)
      return averaged(
          uv, level, bump, 0, [&](std::int32_t y) { return row(y); },
          [&](const Code* at) {
            FourFloats x{};
            for (int c = 0; c < kChannels; ++c) x[c] = decoded(at, c);
            return x;
          },
          1.f);
    return std::visit(
        [&]<class Number>(const std::vector<Number>& numbers) {
          constexpr float kUnit = std::is_same_v<Number, float> ? 1 : 1 / Pyramid::kUnitCodes;
          const std::ptrdiff_t stride = std::ptrdiff_t(level.width + 2) * kChannels;
          const Number* origin = numbers.data() + level.start + stride + kChannels;
          return averaged(
              uv, level, bump, 1, [&](std::int32_t y) { return origin + y * stride; },
              [](const Number* at) { return four(at); }, kUnit);
        },
        texels_->pyramid.texels);
  }

  /// The weighted average of a level's texels, times `unit`. `rowAt(y)` points to a row's texel 0,
  /// `value(texel)` gives its channels; `border` as in wrappedIndex().
  template <class RowAt, class Value>
  Rgba averaged(Vec2 uv, const Level& level, const Bump& bump, int border, RowAt rowAt, Value value,
                float unit) const noexcept {
    const Real cx = uv.x * Real(level.width) - Real(0.5);
    const Real cy = uv.y * Real(level.height) - Real(0.5);
    float sum = 0;
    FourFloats channels{};
    const std::int32_t last = floorInt(cy + Real(bump.reachY));
    for (std::int32_t y = -floorInt(Real(bump.reachY) - cy); y <= last; ++y) {
      const auto dy = float(Real(y) - cy);
      const float peak = std::max(1 - bump.perY2 * dy * dy, 0.f);
      const Real middle = cx + Real(bump.slant * dy), half = Real(bump.reachX * std::sqrt(peak));
      const std::int32_t first = -floorInt(half - middle), end = floorInt(middle + half) + 1;
      const auto* texels = rowAt(wrappedIndex(y, level.height, wrapV_, border));
      const auto add = [&](std::int32_t x, std::int32_t i) {
        const auto dx = float(Real(x) - middle);
        const float root = peak - bump.perX2 * dx * dx, weight = root * root;
        sum += weight;
        channels += weight * value(texels + std::ptrdiff_t(i) * kChannels);
      };
      if (first >= 0 && end <= level.width)
        for (std::int32_t x = first; x < end; ++x) add(x, x);
      else
        for (std::int32_t x = first; x < end; ++x)
          add(x, wrappedIndex(x, level.width, wrapU_, border));
    }
    const float scale = unit / sum;
    return gather([&](int i) { return scale * channels[i]; });
  }

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

  template <class Channel>
  static Rgba gather(Channel channel) noexcept {
    Rgba result;
    if constexpr (kChannels < 3)
      result.colour = grey(Real(channel(0)));
    else
      result.colour = {Real(channel(0)), Real(channel(1)), Real(channel(2))};
    if constexpr (kAlpha) result.alpha = Real(channel(kChannels - 1));
    return result;
  }

  std::shared_ptr<const Texels> texels_;
  const Code* codes_;
  const float* colour_ = nullptr;  ///< decode tables; null for float
  const float* alpha_ = nullptr;
  std::int32_t width_, height_;
  Level full_;
  Wrap wrapU_, wrapV_;
};

}  // namespace vestige
