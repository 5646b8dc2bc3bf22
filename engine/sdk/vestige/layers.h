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

/// What a path does at a surface.
struct LayerEvent {
  bool passes = false;
  Real chance = 1;      ///< probability of what the path does, (0,1]
  Rgb weight{1, 1, 1};  ///< factor of the path's throughput
};

/// Decides whether a path scatters at a surface or passes through. `vertex`: number of the vertex
/// where it may scatter, `layer`: how many layers it passed before on the same edge, `index`: of
/// the path in its sequences.
inline LayerEvent meetLayer(const Sampler& sampler, std::uint32_t vertex, std::uint32_t layer,
                            std::uint32_t index, const Interaction& x) noexcept {
  if (x.opacity >= 1) return {};
  const bool passes = !(sampler.number(layerDimension(vertex, layer), index) < x.opacity);
  return {passes, passes ? 1 - x.opacity : x.opacity};
}

}  // namespace vestige
