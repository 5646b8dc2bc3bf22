// SPDX-License-Identifier: Apache-2.0
#include "engine/texture/pyramid.h"

#include <algorithm>
#include <type_traits>

namespace vestige {

namespace {

/// The fine texels under one coarse texel and their shares of its length, which add up to 1. The
/// ratio of sizes is at most 2, so there are at most three.
struct Span {
  std::int32_t first = 0;
  int count = 1;
  float share[3] = {1, 0, 0};
};

/// One for every coarse texel and for the borders before and behind, which cover each other.
Table<Span> spans(std::int32_t fine, std::int32_t coarse) {
  Table<Span> list;
  list.push_back({-1});
  for (std::int64_t i = 0; i < coarse; ++i) {
    // In units of 1 / coarse of a fine texel all ends are integers.
    const std::int64_t begin = i * fine, end = begin + fine;
    Span s;
    s.first = std::int32_t(begin / coarse);
    s.count = int((end + coarse - 1) / coarse) - s.first;
    for (int k = 0; k < s.count; ++k) {
      const std::int64_t from = (s.first + k) * std::int64_t(coarse);
      const auto covered = std::min(from + coarse, end) - std::max(from, begin);
      s.share[k] = float(double(covered) / double(fine));
    }
    list.push_back(s);
  }
  list.push_back({fine});
  return list;
}

/// Variance that the spans add, in fine texels: that of their texels' centres about their own.
float addedSpread(const Table<Span>& list, std::int32_t fine, std::int32_t coarse) {
  double sum = 0;
  for (std::int32_t i = 0; i < coarse; ++i) {
    const Span& s = list[i + 1];
    const double centre = (i + 0.5) * fine / coarse;
    for (int k = 0; k < s.count; ++k) {
      const double d = s.first + k + 0.5 - centre;
      sum += s.share[k] * d * d;
    }
  }
  return float(sum / coarse);
}

/// Numbers of a row and of a whole level, borders included.
std::size_t rowNumbers(std::int32_t width, int channels) {
  return std::size_t(width + 2) * channels;
}
std::size_t levelNumbers(const Level& level, int channels) {
  return rowNumbers(level.width, channels) * (level.height + 2);
}

/// Makes a level from the next finer one. `readRow` writes a row of that, borders included.
template <class Number>
void halve(const Level& to, std::int32_t fineWidth, std::int32_t fineHeight, int channels,
           const ReadRow& readRow, Number* out) {
  const Table<Span> across = spans(fineWidth, to.width), up = spans(fineHeight, to.height);
  std::vector<float> fine(rowNumbers(fineWidth, channels)), sum(rowNumbers(to.width, channels));
  for (const Span& v : up) {
    std::fill(sum.begin(), sum.end(), 0.f);
    for (int j = 0; j < v.count; ++j) {
      readRow(v.first + j, fine.data());
      for (std::size_t i = 0; i < sum.size(); ++i) {
        const Span& u = across[int(i / channels)];
        const float* at = &fine[std::size_t(u.first + 1) * channels + i % channels];
        float x = 0;
        for (int k = 0; k < u.count; ++k) x += u.share[k] * at[k * channels];
        sum[i] += v.share[j] * x;
      }
    }
    for (const float x : sum) {
      if constexpr (std::is_same_v<Number, float>)
        *out++ = x;
      else
        *out++ = Number(std::clamp(x, 0.f, 1.f) * Pyramid::kUnitCodes + 0.5f);
    }
  }
}

/// A row of the full resolution with its edge texels once more at either side.
void readEdged(std::int32_t y, std::int32_t width, std::int32_t height, int channels,
               const ReadRow& readRow, float* row) {
  readRow(std::clamp(y, 0, height - 1), row + channels);
  std::copy_n(row + channels, channels, row);
  float* const end = row + rowNumbers(width, channels);
  std::copy_n(end - 2 * channels, channels, end - channels);
}

template <class Number>
void fill(std::vector<Number>& texels, const Table<Level>& levels, const Level& full, int channels,
          const ReadRow& readRow) {
  constexpr float kUnit = std::is_same_v<Number, float> ? 1 : 1 / Pyramid::kUnitCodes;
  texels.resize(pyramidNumbers(levels, channels));
  halve(
      levels[0], full.width, full.height, channels,
      [&](std::int32_t y, float* row) {
        readEdged(y, full.width, full.height, channels, readRow, row);
      },
      texels.data());
  for (int i = 1; i < levels.size(); ++i) {
    const Level& from = levels[i - 1];
    const std::size_t stride = rowNumbers(from.width, channels);
    const auto stored = [&](std::int32_t y, float* row) {
      const Number* at = &texels[from.start + stride * (y + 1)];
      for (std::size_t k = 0; k < stride; ++k) row[k] = kUnit * float(at[k]);
    };
    halve(levels[i], from.width, from.height, channels, stored, &texels[levels[i].start]);
  }
}

}  // namespace

Table<Level> pyramidLevels(std::int32_t width, std::int32_t height, int channels) {
  Table<Level> levels;
  Level last;
  last.width = width, last.height = height;
  std::size_t start = 0;
  while (last.width > 1 || last.height > 1) {
    Level next;
    next.width = (last.width + 1) / 2, next.height = (last.height + 1) / 2;
    next.start = start;
    next.scaleX = float(width) / float(next.width),
    next.scaleY = float(height) / float(next.height);
    const auto spread = [](std::int32_t fine, std::int32_t coarse, float scale) {
      return scale * scale * addedSpread(spans(fine, coarse), fine, coarse);
    };
    next.spreadX = last.spreadX + spread(last.width, next.width, last.scaleX);
    next.spreadY = last.spreadY + spread(last.height, next.height, last.scaleY);
    start += levelNumbers(next, channels);
    levels.push_back(last = next);
  }
  return levels;
}

std::size_t pyramidNumbers(const Table<Level>& levels, int channels) noexcept {
  constexpr std::size_t kPadding = 3;  // behind the last texel: lookups read four at a time
  if (levels.empty()) return 0;
  const Level& top = levels.back();
  return top.start + levelNumbers(top, channels) + kPadding;
}

std::size_t Pyramid::bytes() const noexcept {
  return std::visit([](const auto& list) { return list.size() * sizeof(list[0]); }, texels);
}

Pyramid makePyramid(std::int32_t width, std::int32_t height, int channels, bool unit,
                    const ReadRow& readRow) {
  Pyramid p;
  p.levels = pyramidLevels(width, height, channels);
  if (!unit) p.texels = std::vector<float>();
  if (p.levels.empty()) return p;
  Level full;
  full.width = width, full.height = height;
  std::visit([&](auto& texels) { fill(texels, p.levels, full, channels, readRow); }, p.texels);
  return p;
}

}  // namespace vestige
