// SPDX-License-Identifier: Apache-2.0
#include "engine/trace/solids.h"

#include <map>
#include <tuple>

namespace vestige {
namespace {

/// Infinite for what has no end.
double volume(const Bounds& b) noexcept {
  if (b.isInfinite()) return std::numeric_limits<double>::infinity();
  const Vec3 size = b.size();
  return double(size.x) * double(size.y) * double(size.z);
}

/// Wide enough that solids which share a face do so after rounding.
Bounds grown(const Bounds& b) noexcept {
  if (b.isInfinite()) return b;
  const Real pad = 64 * std::numeric_limits<float>::epsilon() *
                   std::max(maxAbsComponent(b.low), maxAbsComponent(b.high));
  return {b.low - Vec3{pad, pad, pad}, b.high + Vec3{pad, pad, pad}};
}

/// Marks the solids whose bounds meet those of another, by a sweep along x.
/// Returns the most solids whose bounds hold the centre of one of them.
int markMeetings(std::vector<World::Solid>& solids) {
  std::vector<World::Solid*> byLow;
  for (std::size_t k = 1; k < solids.size(); ++k) byLow.push_back(&solids[k]);
  std::sort(byLow.begin(), byLow.end(),
            [](const auto* a, const auto* b) { return a->bounds.low.x < b->bounds.low.x; });
  std::vector<int> around(byLow.size(), 1);
  for (std::size_t i = 0; i < byLow.size(); ++i)
    for (std::size_t j = i + 1;
         j < byLow.size() && byLow[j]->bounds.low.x <= byLow[i]->bounds.high.x; ++j) {
      const Bounds &a = byLow[i]->bounds, &b = byLow[j]->bounds;
      if (!a.meets(b)) continue;
      byLow[i]->meetsOthers = byLow[j]->meetsOthers = true;
      around[i] += b.contains(a.centre());
      around[j] += a.contains(b.centre());
    }
  return around.empty() ? 0 : *std::max_element(around.begin(), around.end());
}

}  // namespace

std::vector<World::Solid> numberSolids(std::vector<Item>& items, int& mostAtOnce) {
  std::map<const Triangles*, bool> watertight;
  const auto isSolid = [&](const Item& item) {
    if (!item.placement.isDielectric) return false;
    if (!item.triangles) return item.placement.closed;
    const auto [known, isNew] = watertight.try_emplace(item.triangles);
    if (isNew) known->second = item.triangles->isWatertight();
    return known->second;
  };
  using Rank = std::tuple<int, double, std::size_t>;  // priority, smallness, place in the scene
  std::vector<std::pair<Rank, Item*>> ranked;
  for (std::size_t k = 0; k < items.size(); ++k)
    if (isSolid(items[k]))
      ranked.push_back({{items[k].placement.priority, -volume(items[k].bounds), k}, &items[k]});
  std::sort(ranked.begin(), ranked.end());
  std::vector<World::Solid> solids(1);
  for (const auto& [rank, item] : ranked) {
    item->solid = std::uint32_t(solids.size());
    solids.push_back({item->placement.object, grown(item->bounds), item->placement.visibleTo});
  }
  mostAtOnce = markMeetings(solids);
  return solids;
}

}  // namespace vestige
