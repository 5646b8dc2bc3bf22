// SPDX-License-Identifier: Apache-2.0
#include "engine/film/film.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

namespace vestige {

namespace {

/// The channels that an AOV fills, and its part of Aovs.
struct Layer {
  const char* name;
  std::vector<const char*> channels;
};

const Layer& layer(Aov aov) noexcept {
  static const Layer layers[] = {
      {"normal", {"normal.X", "normal.Y", "normal.Z"}},
      {"albedo", {"albedo.R", "albedo.G", "albedo.B"}},
      {"depth", {"depth.Z"}},
      {"position", {"position.X", "position.Y", "position.Z"}},
      {"uv", {"uv.U", "uv.V"}},
      {"samples", {"samples"}},
      {"footprint", {"footprint"}},
      {"footprint.texels", {"footprint.texels"}},
      {"gradient", {"gradient"}},
      {"element.level", {"element.level"}},
      {"element.id", {"element.id"}},
  };
  return layers[int(aov)];
}

/// A number in units of the film, rounded to nearest; 0 for what is not finite.
std::int64_t inUnits(double x, bool& clamped) noexcept {
  if (!std::isfinite(x)) return 0;
  clamped = clamped || std::abs(x) > kFilmLimit;
  x = std::clamp(x, -kFilmLimit, kFilmLimit) / kFilmUnit;
  return std::int64_t(x + std::copysign(0.5, x));
}

/// Sums hold 2048 samples at the limit; beyond that they stay at their largest value.
bool addTo(std::int64_t& sum, std::int64_t x) noexcept {
  if (!__builtin_add_overflow(sum, x, &sum)) return true;
  sum = x > 0 ? std::numeric_limits<std::int64_t>::max() : std::numeric_limits<std::int64_t>::min();
  return false;
}

/// Values of one AOV; returns how many.
int values(Aov aov, const Aovs& from, Real out[3]) noexcept {
  const auto three = [&](Real a, Real b, Real c) { return out[0] = a, out[1] = b, out[2] = c, 3; };
  const auto one = [&](Real a) { return out[0] = a, 1; };
  switch (aov) {
    case Aov::normal:
      return three(from.normal.x, from.normal.y, from.normal.z);
    case Aov::albedo:
      return three(from.albedo.r, from.albedo.g, from.albedo.b);
    case Aov::depth:
      return one(from.depth);
    case Aov::position:
      return three(from.position.x, from.position.y, from.position.z);
    case Aov::uv:
      return out[0] = from.uv.x, out[1] = from.uv.y, 2;
    case Aov::samples:
      return one(0);  // means() knows
    case Aov::footprint:
      return one(from.footprint);
    case Aov::footprintTexels:
      return one(from.footprintTexels);
    case Aov::gradient:
      return one(from.gradient);
    case Aov::elementLevel:
      return one(from.elementLevel);
    case Aov::elementId:
      return one(from.elementId);
  }
  return 0;
}

}  // namespace

const char* name(Aov aov) noexcept { return layer(aov).name; }

bool Film::wantsFootprint() const noexcept {
  const auto isAbout = [](Aov a) {
    return a == Aov::footprint || a == Aov::footprintTexels || a == Aov::gradient;
  };
  return std::any_of(aovs_.begin(), aovs_.end(), isAbout);
}

Film::Film(int width, int height, Crop crop, std::vector<Aov> aovs)
    : width_(width), height_(height), crop_(crop), aovs_(std::move(aovs)), channels_(3) {
  assert(0 <= crop.x0 && crop.x0 < crop.x1 && crop.x1 <= width);
  assert(0 <= crop.y0 && crop.y0 < crop.y1 && crop.y1 <= height);
  for (const Aov aov : aovs_) channels_ += int(layer(aov).channels.size());
  const std::size_t pixels = std::size_t(crop.x1 - crop.x0) * std::size_t(crop.y1 - crop.y0);
  counts_.assign(pixels, 0);
  sums_.assign(pixels * std::size_t(channels_), 0);
}

std::size_t Film::index(int x, int y) const noexcept {
  assert(crop_.x0 <= x && x < crop_.x1 && crop_.y0 <= y && y < crop_.y1);
  return std::size_t(y - crop_.y0) * std::size_t(crop_.x1 - crop_.x0) + std::size_t(x - crop_.x0);
}

void Film::add(int x, int y, Rgb radiance, const Aovs& aovs, Counters& counters) noexcept {
  const std::size_t pixel = index(x, y);
  std::int64_t* sum = &sums_[pixel * std::size_t(channels_)];
  ++counts_[pixel];
  if (!std::isfinite(radiance.r) || !std::isfinite(radiance.g) || !std::isfinite(radiance.b))
    radiance = {}, ++counters.nonFinite;
  bool clamped = false;
  for (const Real c : {radiance.r, radiance.g, radiance.b})
    if (!addTo(*sum++, inUnits(c, clamped))) clamped = true;
  counters.clamped += clamped;
  for (const Aov aov : aovs_) {
    Real v[3];
    bool ignored = false;
    for (int i = 0, n = values(aov, aovs, v); i < n; ++i) addTo(*sum++, inUnits(v[i], ignored));
  }
}

std::uint32_t Film::samples(int x, int y) const noexcept { return counts_[index(x, y)]; }

std::uint32_t Film::minSamples() const noexcept {
  return *std::min_element(counts_.begin(), counts_.end());
}

std::uint32_t Film::maxSamples() const noexcept {
  return *std::max_element(counts_.begin(), counts_.end());
}

double Film::meanSamples() const noexcept {
  return std::accumulate(counts_.begin(), counts_.end(), 0.0) / double(counts_.size());
}

double Film::luminance(int x, int y) const noexcept {
  const std::size_t pixel = index(x, y);
  if (counts_[pixel] == 0) return 0;
  const std::int64_t* sum = &sums_[pixel * std::size_t(channels_)];
  const double total = 0.2126 * double(sum[0]) + 0.7152 * double(sum[1]) + 0.0722 * double(sum[2]);
  return total * kFilmUnit / counts_[pixel];
}

Film::Means Film::means() const {
  Means m{crop_.x1 - crop_.x0, crop_.y1 - crop_.y0, {"R", "G", "B"}, {}};
  int samplesChannel = -1;
  for (const Aov aov : aovs_) {
    if (aov == Aov::samples) samplesChannel = int(m.channels.size());
    m.channels.insert(m.channels.end(), layer(aov).channels.begin(), layer(aov).channels.end());
  }
  m.pixels.reserve(sums_.size());
  for (std::size_t i = 0; i < sums_.size(); ++i) {
    const std::uint32_t count = counts_[i / std::size_t(channels_)];
    const double mean = count > 0 ? double(sums_[i]) * kFilmUnit / count : 0;
    m.pixels.push_back(int(i % std::size_t(channels_)) == samplesChannel ? float(count)
                                                                         : float(mean));
  }
  return m;
}

Film withoutAovs(const Film& film) {
  Film bare(film.width(), film.height(), film.crop(), {});
  const std::size_t pixels = film.counts().size();
  const std::size_t from = film.sums().size() / pixels, to = bare.sums().size() / pixels;
  for (std::size_t i = 0; i < pixels; ++i)
    std::copy_n(&film.sums()[i * from], to, &bare.sums()[i * to]);
  std::copy(film.counts().begin(), film.counts().end(), bare.counts().begin());
  return bare;
}

}  // namespace vestige
