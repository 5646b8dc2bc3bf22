// SPDX-License-Identifier: Apache-2.0
#include "engine/film/film.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <stdexcept>

#include <sys/resource.h>
#include <unistd.h>

namespace vestige {

namespace {

constexpr std::size_t kColours = 3;

/// Radiance in units of the film, rounded to nearest; |x| is at most kRadianceLimit.
Int128 inUnits(double x) noexcept {
  const double units = x / kRadianceUnit;  // exact: a power of two
  if (std::abs(units) < 0x1p52) return std::int64_t(units + std::copysign(0.5, units));
  if (std::abs(units) < 0x1p63) return std::int64_t(units);  // has no fraction
  // On the bits of the number: the compiler's own conversion calls a library.
  const auto bits = std::bit_cast<std::uint64_t>(units);
  const std::uint64_t one = std::uint64_t(1) << 52;
  const Int128 whole = Int128((bits & (one - 1)) | one) << (int(bits >> 52 & 0x7ff) - (1023 + 52));
  return x < 0 ? -whole : whole;
}

/// Bytes that this process may ever have.
double wholeMemory() noexcept {
  const double machine = double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGESIZE));
  rlimit limit{};
  const bool isLimited = getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
  return isLimited ? std::min(machine, double(limit.rlim_cur)) : machine;
}

std::string gigabytes(double bytes) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f GB", bytes / 1e9);
  return text;
}

/// False if the sum does not fit: it then stays at its largest value.
template <class Sum>
bool addTo(Sum& sum, Sum x) noexcept {
  constexpr Sum kQuarter = Sum(1) << (8 * sizeof(Sum) - 2);
  constexpr Sum kMost = kQuarter - 1 + kQuarter;
  if (!__builtin_add_overflow(sum, x, &sum)) return true;
  sum = x > 0 ? kMost : -kMost;
  return false;
}

}  // namespace

bool Film::wantsFootprint() const noexcept {
  return std::any_of(layers_.begin(), layers_.end(),
                     [](const FilmLayer& l) { return l.needsFootprint; });
}

Film::Film(int width, int height, Crop crop, const std::vector<std::string>& aovs, double sceneSize,
           std::span<const AovSlot> own)
    : width_(width), height_(height), crop_(crop) {
  assert(0 <= crop.x0 && crop.x0 < crop.x1 && crop.x1 <= width);
  assert(0 <= crop.y0 && crop.y0 < crop.y1 && crop.y1 <= height);
  for (const std::string& name : aovs) {
    std::optional<FilmLayer> layer = layerOf(name, sceneSize, own);
    if (!layer) throw std::runtime_error("there is no AOV '" + name + "'");
    stored_ += std::size_t(layer->stored());
    layers_.push_back(std::move(*layer));
  }
  const std::size_t pixels = std::size_t(crop.x1 - crop.x0) * std::size_t(crop.y1 - crop.y0);
  const double bytes = double(pixels) * double(sizeof counts_[0] + kColours * sizeof radiance_[0] +
                                               stored_ * sizeof sums_[0]);
  if (bytes > wholeMemory())  // the system would grant it, and end the program later
    throw std::runtime_error("the film of " + std::to_string(width) + " x " +
                             std::to_string(height) + " pixels takes " + gigabytes(bytes) +
                             ", more than this machine's " + gigabytes(wholeMemory()) +
                             ": choose a smaller resolution or a crop");
  counts_.assign(pixels, 0);
  radiance_.assign(pixels * kColours, 0);
  sums_.assign(pixels * stored_, 0);
  cuts_.resize(layers_.size());
}

std::size_t Film::index(int x, int y) const noexcept {
  assert(crop_.x0 <= x && x < crop_.x1 && crop_.y0 <= y && y < crop_.y1);
  return std::size_t(y - crop_.y0) * std::size_t(crop_.x1 - crop_.x0) + std::size_t(x - crop_.x0);
}

void Film::add(int x, int y, Rgb radiance, const Aovs& aovs, Counters& counters) noexcept {
  const std::size_t pixel = index(x, y);
  ++counts_[pixel];
  if (!isFinite(radiance)) {
    radiance = {};
    ++counters.nonFinite;
  }
  bool isClamped = false;
  Int128* sum = &radiance_[pixel * kColours];
  for (const double c : {double(radiance.r), double(radiance.g), double(radiance.b)}) {
    const double fitting = std::clamp(c, -kRadianceLimit, kRadianceLimit);
    isClamped |= fitting != c;
    isClamped |= !addTo(*sum++, inUnits(fitting));
  }
  counters.clamped += isClamped;
  std::int64_t* stored = sums_.data() + pixel * stored_;
  for (int i = 0; i < layers_.size(); ++i) {
    Real v[3];
    const int count = values(layers_[i], aovs, v);
    addLayer(i, {v, std::size_t(count)}, stored);
    stored += count;
  }
}

void Film::addLayer(int layer, std::span<const Real> values, std::int64_t* sums) noexcept {
  const double unit = layers_[layer].unit;
  const double limit = layers_[layer].limit();
  bool isCut = false;
  for (const Real v : values) {
    const double finite = std::isfinite(v) ? double(v) : 0;
    const double fitting = std::clamp(finite, -limit, limit);
    isCut |= !(fitting == double(v));
    const double units = fitting / unit;
    isCut |= !addTo(*sums++, std::int64_t(units + std::copysign(0.5, units)));
  }
  if (isCut) std::atomic_ref(cuts_[layer]).fetch_add(1, std::memory_order_relaxed);
}

void Film::merge(const Film& other, Counters& counters) {
  if (width_ != other.width_ || height_ != other.height_ || crop_ != other.crop_ ||
      layers_ != other.layers_)
    throw std::runtime_error(
        "films can only be merged if their sizes, crop windows, AOVs and units are the same");
  for (std::size_t pixel = 0; pixel < counts_.size(); ++pixel) {
    counts_[pixel] += other.counts_[pixel];
    bool isClamped = false;
    for (std::size_t i = pixel * kColours; i < (pixel + 1) * kColours; ++i)
      isClamped |= !addTo(radiance_[i], other.radiance_[i]);
    counters.clamped += isClamped;
    std::size_t at = pixel * stored_;
    for (int layer = 0; layer < layers_.size(); ++layer) {
      bool isCut = false;
      for (int i = 0; i < layers_[layer].stored(); ++i, ++at)
        isCut |= !addTo(sums_[at], other.sums_[at]);
      cuts_[layer] += isCut;
    }
  }
  for (int layer = 0; layer < layers_.size(); ++layer) cuts_[layer] += other.cuts_[layer];
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
  const Int128* sum = &radiance_[pixel * kColours];
  const double total = 0.2126 * double(sum[0]) + 0.7152 * double(sum[1]) + 0.0722 * double(sum[2]);
  return total * kRadianceUnit / counts_[pixel];
}

Film::Means Film::means() const {
  Means m{crop_.x1 - crop_.x0, crop_.y1 - crop_.y0, {"R", "G", "B"}, {}};
  for (const FilmLayer& l : layers_)
    m.channels.insert(m.channels.end(), l.channels.begin(), l.channels.end());
  m.pixels.reserve(counts_.size() * m.channels.size());
  std::size_t at = 0;
  for (std::size_t pixel = 0; pixel < counts_.size(); ++pixel) {
    const std::uint32_t count = counts_[pixel];
    const auto put = [&](double sum) { m.pixels.push_back(count > 0 ? float(sum / count) : 0); };
    for (std::size_t i = pixel * kColours; i < (pixel + 1) * kColours; ++i)
      put(double(radiance_[i]) * kRadianceUnit);
    for (const FilmLayer& l : layers_) {
      if (l.isCount) m.pixels.push_back(float(count));
      for (int i = 0; i < l.stored(); ++i) put(double(sums_[at++]) * l.unit);
    }
  }
  return m;
}

std::array<std::span<std::byte>, 4> Film::storage() noexcept {
  return {std::as_writable_bytes(std::span(radiance_)), std::as_writable_bytes(std::span(sums_)),
          std::as_writable_bytes(std::span(counts_)),
          std::as_writable_bytes(std::span(cuts_.data(), std::size_t(cuts_.size())))};
}

std::array<std::span<const std::byte>, 4> Film::storage() const noexcept {
  return {std::as_bytes(std::span(radiance_)), std::as_bytes(std::span(sums_)),
          std::as_bytes(std::span(counts_)),
          std::as_bytes(std::span(cuts_.data(), std::size_t(cuts_.size())))};
}

Film withoutAovs(const Film& film) {
  Film bare(film.width(), film.height(), film.crop(), {});
  bare.radiance_ = film.radiance_;
  bare.counts_ = film.counts_;
  return bare;
}

}  // namespace vestige
