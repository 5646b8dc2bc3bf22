// SPDX-License-Identifier: Apache-2.0
// The lookup in the inner loop, wherever the texels lie; private to engine/texture.
#pragma once
#include <vestige/host.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>

#include "engine/texture/ellipse.h"

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

/// Up to a texel bilinear at full resolution, beyond two the filter of ellipse.h, between them a
/// mixture.
///
/// Source: where the texels are. It has kChannels, width(), height(), levels() (those of the
/// pyramid), mean(), and Reader, made of a Source and alive for one lookup, with
///   texel(x, y)      a texel of the full resolution: [channel] is its value;
///   read(index, visit)  calls visit(rowAt, unit, border) for a level, 0 the full resolution:
///                    rowAt(y)(x) is a texel's four numbers, to be multiplied by unit; `border` as
///                    in wrappedIndex();
///   failed() whether a texel could not be read: the texture's mean replaces it.
template <class Source>
class FilteredTexture final : public Texture {
 public:
  FilteredTexture(Source source, Wrap wrapU, Wrap wrapV)
      : source_(std::move(source)),
        width_(source_.width()),
        height_(source_.height()),
        wrapU_(wrapU),
        wrapV_(wrapV) {
    full_.width = width_, full_.height = height_;
  }

  Rgba lookup(Vec2 uv, const Vec2 dUv[2]) const noexcept override {
    const Moments m = outerProducts(dUv, width_, height_);
    // The trace is an upper bound of the longest axis squared. NaN means a point lookup.
    if (m.xx + m.yy > 1) return filtered(uv, dUv);
    Reader reader(source_);
    return checked(reader, bilinear(reader, uv));
  }

  Rgba texel(int x, int y) const noexcept override {
    Reader reader(source_);
    const auto value = reader.texel(x, y);
    return checked(reader, gather([&](int i) { return value[i]; }));
  }

  int width() const noexcept override { return width_; }
  int height() const noexcept override { return height_; }
  bool hasAlpha() const noexcept override { return kAlpha; }
  Rgba mean() const noexcept override { return source_.mean(); }

 private:
  using Reader = typename Source::Reader;
  static constexpr int kChannels = Source::kChannels;
  static constexpr bool kAlpha = kChannels == 2 || kChannels == 4;

  Rgba checked(const Reader& reader, const Rgba& found) const noexcept {
    return reader.failed() ? source_.mean() : found;
  }

  /// Most lookups end here, and a call would take a sixth of their time.
  [[gnu::always_inline]] Rgba bilinear(Reader& reader, Vec2 uv) const noexcept {
    const Neighbours x = neighbours(uv.x, width_, wrapU_), y = neighbours(uv.y, height_, wrapV_);
    const auto a = reader.texel(x.first, y.first), b = reader.texel(x.second, y.first);
    const auto c = reader.texel(x.first, y.second), d = reader.texel(x.second, y.second);
    const float wa = (1 - x.share) * (1 - y.share), wb = x.share * (1 - y.share);
    const float wc = (1 - x.share) * y.share, wd = x.share * y.share;
    return gather([&](int i) { return wa * a[i] + wb * b[i] + wc * c[i] + wd * d[i]; });
  }

  /// Beside the fast path, not in it.
  [[gnu::noinline]] Rgba filtered(Vec2 uv, const Vec2 dUv[2]) const noexcept {
    Reader reader(source_);
    const int levels = source_.levels().size() + 1;
    const Wanted wanted = wantedFilter(boundedProducts(dUv, width_, height_), levels);
    if (wanted.longest <= 1) return checked(reader, bilinear(reader, uv));
    const Vec2 at{broughtHome(uv.x, wrapU_), broughtHome(uv.y, wrapV_)};
    Rgba result = averaged(reader, at, wanted.covariance, wanted.level);
    if (wanted.levelPart < 1)
      result = mixed(averaged(reader, at, wanted.covariance, wanted.level - 1), result,
                     wanted.levelPart);
    if (wanted.longest < 2) result = mixed(bilinear(reader, uv), result, wanted.longest - 1);
    return checked(reader, result);
  }

  static Rgba mixed(const Rgba& a, const Rgba& b, float share) noexcept {
    const Real s = share;
    return {(1 - s) * a.colour + s * b.colour, (1 - s) * a.alpha + s * b.alpha};
  }

  Rgba averaged(Reader& reader, Vec2 uv, const Moments& covariance, int index) const noexcept {
    const Level& level = index ? source_.levels()[index - 1] : full_;
    const Bump bump = bumpOn(level, covariance, level.width == 1 && wrapU_ != Wrap::clamp,
                             level.height == 1 && wrapV_ != Wrap::clamp);
    return reader.read(index, [&](auto rowAt, float unit, int border) {
      return averaged(uv, level, bump, rowAt, unit, border);
    });
  }

  /// The weighted average of a level's texels.
  template <class RowAt>
  Rgba averaged(Vec2 uv, const Level& level, const Bump& bump, RowAt rowAt, float unit,
                int border) const noexcept {
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
      auto row = rowAt(wrappedIndex(y, level.height, wrapV_, border));
      const auto add = [&](std::int32_t x, std::int32_t i) {
        const auto dx = float(Real(x) - middle);
        const float root = peak - bump.perX2 * dx * dx, weight = root * root;
        sum += weight;
        channels += weight * row(i);
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

  Source source_;
  std::int32_t width_, height_;
  Level full_;
  Wrap wrapU_, wrapV_;
};

}  // namespace vestige
