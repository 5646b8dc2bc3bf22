// SPDX-License-Identifier: Apache-2.0
#include "engine/film/aov.h"

#include <algorithm>
#include <cmath>

namespace vestige {
namespace {

/// What decides the unit of an AOV's sums.
enum class Measure {
  length,      ///< goes with the scene's size
  coordinate,  ///< uv: within [0,1], or a length
  number       ///< does not
};

using Read = int (*)(const Aovs& from, Real out[3]) noexcept;

struct Row {
  const char* name;
  std::vector<const char*> channels;
  Measure measure;
  int unit;  ///< exponent of two, for a scene of size 1
  Read read;
  bool needsFootprint = false;
};

int put(Real value, Real out[3]) noexcept {
  out[0] = value;
  return 1;
}

int put(Vec3 v, Real out[3]) noexcept {
  out[0] = v.x;
  out[1] = v.y;
  out[2] = v.z;
  return 3;
}

/// Limits for a scene of size 1 are 2^(52 + unit).
const std::vector<Row>& rows() {
  static const std::vector<Row> all = {
      {"normal",
       {"normal.X", "normal.Y", "normal.Z"},
       Measure::number,
       -40,
       [](const Aovs& a, Real out[3]) noexcept { return put(a.normal, out); }},
      {"albedo",
       {"albedo.R", "albedo.G", "albedo.B"},
       Measure::number,
       -36,
       [](const Aovs& a, Real out[3]) noexcept {
         return put(Vec3{a.albedo.r, a.albedo.g, a.albedo.b}, out);
       }},
      {"depth",
       {"depth.Z"},
       Measure::length,
       -32,
       [](const Aovs& a, Real out[3]) noexcept { return put(a.depth, out); }},
      {"position",
       {"position.X", "position.Y", "position.Z"},
       Measure::length,
       -32,
       [](const Aovs& a, Real out[3]) noexcept { return put(a.position, out); }},
      {"uv",
       {"uv.U", "uv.V"},
       Measure::coordinate,
       -28,
       [](const Aovs& a, Real out[3]) noexcept { return put(a.uv.x, out) + put(a.uv.y, out + 1); }},
      {"samples", {"samples"}, Measure::number, 0, [](const Aovs&, Real*) noexcept { return 0; }},
      {"footprint",
       {"footprint"},
       Measure::length,
       -32,
       [](const Aovs& a, Real out[3]) noexcept { return put(a.footprint, out); },
       true},
      {"footprint.texels",
       {"footprint.texels"},
       Measure::number,
       -28,
       [](const Aovs& a, Real out[3]) noexcept { return put(a.footprintTexels, out); },
       true},
      {"gradient",
       {"gradient"},
       Measure::number,
       -24,
       [](const Aovs& a, Real out[3]) noexcept { return put(a.gradient, out); },
       true},
  };
  return all;
}

/// Exponent of the smallest power of two that is not below the size.
int exponentOf(double size) noexcept {
  constexpr int kMost = 200;  // keeps units and limits within double
  if (!(size > 0) || !std::isfinite(size)) return 0;
  return std::clamp(int(std::ceil(std::log2(size))), -kMost, kMost);
}

int shift(Measure measure, double sceneSize) noexcept {
  constexpr int kWide = 20;  // 2^20: planes have coordinates in scene units, and 16 times that fits
  const int size = exponentOf(sceneSize);
  if (measure == Measure::length) return size;
  return measure == Measure::coordinate ? std::max(0, size - kWide) : 0;
}

FilmLayer layerOf(const Row& row, double sceneSize) {
  FilmLayer layer;
  layer.name = row.name;
  layer.channels.assign(row.channels.begin(), row.channels.end());
  layer.unit = std::ldexp(1.0, row.unit + shift(row.measure, sceneSize));
  layer.isCount = layer.name == "samples";
  layer.needsFootprint = row.needsFootprint;
  layer.read = row.read;
  return layer;
}

FilmLayer layerOf(const AovSlot& slot, int index, double sceneSize) {
  const bool isLength = slot.measure == AovMeasure::length;
  FilmLayer layer;
  layer.name = slot.name;
  layer.channels = {slot.name};
  const int exponent = std::clamp(std::ilogb(slot.step), -200, 200);
  layer.unit =
      std::ldexp(1.0, exponent + shift(isLength ? Measure::length : Measure::number, sceneSize));
  layer.slot = index;
  return layer;
}

}  // namespace

std::vector<std::string> aovNames(std::span<const AovSlot> own) {
  std::vector<std::string> names;
  for (const Row& row : rows()) names.emplace_back(row.name);
  for (const AovSlot& slot : own) names.emplace_back(slot.name);
  return names;
}

std::optional<FilmLayer> layerOf(std::string_view name, double sceneSize,
                                 std::span<const AovSlot> own) {
  for (const Row& row : rows())
    if (name == row.name) return layerOf(row, sceneSize);
  for (std::size_t i = 0; i < own.size(); ++i)
    if (name == own[i].name) return layerOf(own[i], int(i), sceneSize);
  return std::nullopt;
}

int values(const FilmLayer& layer, const Aovs& from, Real out[3]) noexcept {
  if (layer.read) return layer.read(from, out);
  const auto slot = std::size_t(layer.slot);
  return put(slot < from.own.size() ? from.own[slot] : Real(0), out);
}

}  // namespace vestige
