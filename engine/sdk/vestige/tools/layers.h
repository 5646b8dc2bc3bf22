// SPDX-License-Identifier: Apache-2.0
// Partly transparent surfaces: a path either scatters there or passes straight through, and any
// number of them may lie between two vertices.
#pragma once
#include <vestige/integrator.h>

#include <limits>

namespace vestige {

/// No scene has as many layers behind one another. A ray that meets the same surface again and
/// again must end nevertheless.
inline constexpr std::uint32_t kMaxLayers = 1u << 20;
/// The radiance of such a path: not a number, which the film counts and the program reports.
inline constexpr Rgb kEndless = grey(std::numeric_limits<Real>::quiet_NaN());

/// Dimension of the random number that decides at one layer before a vertex. The golden ratio's
/// multiples spread evenly over 32 bits: layers of one vertex never share a dimension, and up to
/// 29,000 of them share none with those of any other vertex.
inline constexpr std::uint32_t layerDimension(std::uint32_t vertex, std::uint32_t layer) noexcept {
  return dimension::vertex(vertex) + dimension::kOpacity + layer * 0x9e3779b9u;
}

/// What a path does at a surface that lets light through.
struct Passage {
  bool stays;   ///< it scatters here; else it goes straight on
  Real chance;  ///< (0,1], of that choice: tell the footprint
  Rgb weight;   ///< multiplies the throughput; exactly 1 where opacity is grey
};

/// Whether a path stays, by u in [0,1). The chance is the opacity as the path's colour sees it, so
/// that r + g + b of the throughput is the same after any number of layers.
inline Passage drawPassage(Rgb opacity, Rgb throughput, Real u) noexcept {
  const bool isGrey = opacity.r == opacity.g && opacity.g == opacity.b;
  const auto sum = [](Rgb c) { return std::abs(c.r) + std::abs(c.g) + std::abs(c.b); };
  const Real all = sum(throughput);
  const Real staying =
      isGrey || !(all > 0) ? opacity.r : std::min(sum(opacity * throughput) / all, Real(1));
  const bool stays = u < staying;
  const Real chance = stays ? staying : 1 - staying;
  if (isGrey || !(chance > 0)) return {stays, chance > 0 ? chance : Real(1), grey(1)};
  return {stays, chance, (stays ? opacity : grey(1) - opacity) / chance};
}
/// Decides whether a path scatters at a surface or passes through. `vertex`: number of the vertex
/// where it may scatter, `layer`: how many layers it passed before on the same edge, `index`: of
/// the path in its sequences.
inline Passage meetLayer(const Sampler& sampler, std::uint32_t vertex, std::uint32_t layer,
                         std::uint32_t index, Rgb opacity, Rgb throughput) noexcept {
  if (isOpaque(opacity)) return {true, 1, grey(1)};
  return drawPassage(opacity, throughput, sampler.number(layerDimension(vertex, layer), index));
}

}  // namespace vestige
