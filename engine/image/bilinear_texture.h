// SPDX-License-Identifier: Apache-2.0
// The lookup in the inner loop, private to engine/image.
#pragma once
#include <vestige/host.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <utility>

#include "engine/image/texels.h"

namespace vestige {

/// Largest integer not above x, |x| < 2^31: std::floor is a call on baseline x86-64.
inline std::int32_t floorInt(Real x) noexcept {
  const auto i = std::int32_t(x);
  return i - (Real(i) > x);
}

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

/// A picture held in memory. Today every lookup is bilinear at full resolution, whatever its
/// footprint: the footprint is taken as below a texel.
template <class Code, int kChannels>
class BilinearTexture final : public Texture {
 public:
  BilinearTexture(std::shared_ptr<const Texels> texels, Wrap wrapU, Wrap wrapV)
      : texels_(std::move(texels)),
        codes_(array().codes.data()),
        width_(texels_->width),
        height_(texels_->height),
        wrapU_(wrapU),
        wrapV_(wrapV) {
    if constexpr (!std::is_same_v<Code, float>)
      colour_ = array().colour->data(), alpha_ = array().alpha->data();
  }

  Rgba lookup(Vec2 uv, const Vec2*) const noexcept override {
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
  Wrap wrapU_, wrapV_;
};

}  // namespace vestige
