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

struct Row {
  const char* name;
  std::vector<const char*> channels;
  Measure measure;
  int unit;  ///< exponent of two, for a scene of size 1
};

/// Limits for a scene of size 1 are 2^(52 + unit).
const Row& row(Aov aov) noexcept {
  static const Row rows[] = {
      {"normal", {"normal.X", "normal.Y", "normal.Z"}, Measure::number, -40},
      {"albedo", {"albedo.R", "albedo.G", "albedo.B"}, Measure::number, -36},
      {"depth", {"depth.Z"}, Measure::length, -32},
      {"position", {"position.X", "position.Y", "position.Z"}, Measure::length, -32},
      {"uv", {"uv.U", "uv.V"}, Measure::coordinate, -28},
      {"samples", {"samples"}, Measure::number, 0},
      {"footprint", {"footprint"}, Measure::length, -32},
      {"footprint.texels", {"footprint.texels"}, Measure::number, -28},
      {"gradient", {"gradient"}, Measure::number, -24},
      {"element.level", {"element.level"}, Measure::number, -16},
      {"element.id", {"element.id"}, Measure::number, -16},
  };
  return rows[int(aov)];
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

}  // namespace

const char* name(Aov aov) noexcept { return row(aov).name; }

FilmLayer layerOf(Aov aov, double sceneSize) {
  const Row& r = row(aov);
  return {r.name,
          {r.channels.begin(), r.channels.end()},
          std::ldexp(1.0, r.unit + shift(r.measure, sceneSize)),
          aov == Aov::samples};
}

int values(Aov aov, const Aovs& from, Real out[3]) noexcept {
  int count = 0;
  const auto put = [&](auto... v) {
    ((out[count++] = v), ...);
    return count;
  };
  switch (aov) {
    case Aov::normal:
      return put(from.normal.x, from.normal.y, from.normal.z);
    case Aov::albedo:
      return put(from.albedo.r, from.albedo.g, from.albedo.b);
    case Aov::depth:
      return put(from.depth);
    case Aov::position:
      return put(from.position.x, from.position.y, from.position.z);
    case Aov::uv:
      return put(from.uv.x, from.uv.y);
    case Aov::samples:
      return 0;
    case Aov::footprint:
      return put(from.footprint);
    case Aov::footprintTexels:
      return put(from.footprintTexels);
    case Aov::gradient:
      return put(from.gradient);
    case Aov::elementLevel:
      return put(from.elementLevel);
    case Aov::elementId:
      return put(from.elementId);
  }
  return 0;
}

}  // namespace vestige
