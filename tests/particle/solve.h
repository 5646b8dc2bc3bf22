// SPDX-License-Identifier: Apache-2.0
// Scenes of a few lines, and their light by particles.
#pragma once
#include "plugins/integrator/particle/irradiance.h"
#include "plugins/integrator/particle/shooting.h"
#include "support/text_scene.h"

namespace vestige::particle {

/// Around whatever a test adds: a camera, and six inner walls of a box from <0, 0, 0> to <2, 2, 2>
/// that look inwards.
inline std::string box(const std::string& wall) {
  std::string text = "camera pinhole { location <1, 1, 0.1> look_at <1, 1, 2> }\n";
  for (const char* quad : {"<0, 0, 0>, <0, 0, 2>, <2, 0, 0>", "<0, 2, 0>, <2, 0, 0>, <0, 0, 2>",
                           "<0, 0, 0>, <0, 2, 0>, <0, 0, 2>", "<2, 0, 0>, <0, 0, 2>, <0, 2, 0>",
                           "<0, 0, 0>, <2, 0, 0>, <0, 2, 0>", "<0, 0, 2>, <0, 2, 0>, <2, 0, 0>"})
    text += std::string("quad { ") + quad + " " + wall + " }\n";
  return text;
}

struct Solution {
  std::unique_ptr<Scene> scene;
  std::unique_ptr<Hierarchy> hierarchy;
  Booking booking;
  double power = 0;
  bool filled = false;  ///< memory was used up

  double scale() const { return power * kFluxUnit / double(booking.particles); }

  /// Of all elements of one side of a patch, clusters left out.
  Flux total(int patch, bool back = false) const { return below(Hierarchy::rootOf(patch, back)); }
  Flux below(ElementId e) const {
    Flux sum = hierarchy->elements()[e].sum();
    const ElementId first = hierarchy->elements()[e].children;
    for (ElementId k = 0; first && k < 4; ++k) {
      const Flux child = below(first + k);
      for (std::size_t c = 0; c < 3; ++c) sum[c] += child[c];
    }
    return sum;
  }
  /// W/m^2, first channel.
  double irradiance(int patch) const {
    return double(total(patch)[0]) * scale() /
           double(scene->view().patches()[std::size_t(patch)].area);
  }
};

inline FootprintSettings particleFootprint() {
  FootprintSettings s;
  s.deltas.bound = Bound::global, s.deltas.limit = kDefaultLimit, s.deltas.fewest = 3;
  return s;
}

inline HierarchySettings settings(Oracle oracle, bool clusters = false) {
  HierarchySettings s;
  s.oracle = oracle, s.clusters = clusters;
  s.minArea = Real(1e-5);
  if (oracle == Oracle::uniform) s.maxLevel = 4;
  return s;
}

/// Particles [first, last) of `declared`.
inline Solution solve(const std::string& text, std::uint64_t declared, HierarchySettings how,
                      int threads = 2, std::uint64_t first = 0, std::uint64_t last = 0) {
  Solution s;
  s.scene = test::sceneOf(text);
  const SceneView& view = s.scene->view();
  s.hierarchy = std::make_unique<Hierarchy>(view, how);
  s.power = totalPower(view);
  const Shooting shooting{
      view, *s.hierarchy, particleFootprint(), FootprintArea::covariance, declared, 7, s.power};
  if (last == 0) last = declared;
  for (std::uint64_t at = first, next; at < last; at = next) {
    next = std::min(at + passAfter(at - first), last);
    shooting.pass(at, next, threads, s.booking);
    s.filled |= s.hierarchy->pause();
  }
  return s;
}

}  // namespace vestige::particle
