// SPDX-License-Identifier: Apache-2.0
#include "hierarchy.h"

#include "clusters.h"

namespace vestige::particle {
namespace {

/// A divided element while one thread makes its children; others wait for it.
constexpr ElementId kBusy = ~ElementId(0);
/// How far elements reach on an infinite plane, in diameters of everything finite.
constexpr Real kPlaneReach = 2;

/// A square in uv of an infinite plane around the middle of everything finite.
Cell aroundEverything(const SceneView& scene, int patch) noexcept {
  const Bounds b = scene.bounds();
  if (b.isEmpty()) return {{}, {}, {}, false};
  const SurfacePoint s = scene.patchPoint(patch, {});
  const Vec3 away = Real(0.5) * (b.low + b.high) - s.position;
  const Real perU = lengthSquared(s.dPdu), perV = lengthSquared(s.dPdv);
  const Vec2 centre = {dot(away, s.dPdu) / perU, dot(away, s.dPdv) / perV};
  const Real reach = kPlaneReach * length(b.size());
  const Vec2 half = {reach / std::sqrt(perU), reach / std::sqrt(perV)};
  return {centre - half, {2 * half.x, 0}, {0, 2 * half.y}, false};
}

/// Whether hits vary over the four parts of an element more than chance explains: Pearson's sum,
/// three degrees of freedom, one in a hundred.
bool varies(const Element& e, const Element* children[4]) noexcept {
  constexpr double kLeastHits = 32, kChance = 11.34;
  double hits = 0;
  for (int k = 0; k < 4; ++k) hits += children[k]->hits;
  if (hits < kLeastHits) return false;
  double sum = 0;
  for (int k = 0; k < 4; ++k) {
    const double expected = hits * double(children[k]->area) / double(e.area);
    if (expected > 0) sum += sqr(children[k]->hits - expected) / expected;
  }
  return sum > kChance;
}

}  // namespace

Hierarchy::Hierarchy(const SceneView& scene, const HierarchySettings& settings)
    : scene_(scene), settings_(settings) {
  const auto patches = scene.patches();
  firstCluster_ = clusterEnd_ = rootOf(int(patches.size()), false);
  std::vector<ClusterMember> members;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const Patch& p = patches[i];
    if (!std::isfinite(p.area)) {
      planeOf_.resize(patches.size(), -1);
      planeOf_[i] = int(planes_.size());
      planes_.push_back(aroundEverything(scene, int(i)));
    } else if (settings.clusters && lengthSquared(p.normal) > 0 && p.area > 0) {
      const Vec3 centre = Real(0.5) * (p.bounds.low + p.bounds.high);
      for (const bool back : {false, true})
        members.push_back(
            {centre, back ? -p.normal : p.normal, p.bounds, double(p.area), rootOf(int(i), back)});
    }
  }
  const Clusters clusters = makeClusters(members);
  clusterEnd_ = firstCluster_ + ElementId(clusters.list.size());
  elements_.start(clusterEnd_);

  const auto idOf = [&](std::uint32_t above) { return above ? firstCluster_ + above - 1 : 0; };
  for (std::size_t i = 0; i < patches.size(); ++i)
    for (const bool back : {false, true}) {
      Element& e = elements_[rootOf(int(i), back)];
      const Cell cell = cellOf(int(i));
      e.area = float(std::isfinite(patches[i].area)
                         ? patches[i].area
                         : scene.patchArea(int(i), cell.at({0, 0}), cell.at({1, 1})));
    }
  for (std::size_t i = 0; i < members.size(); ++i)
    elements_[members[i].root].parent = idOf(clusters.above[i]);
  for (std::size_t i = 0; i < clusters.list.size(); ++i) {
    Element& e = elements_[firstCluster_ + ElementId(i)];
    e.area = float(clusters.list[i].area), e.level = -1, e.parent = idOf(clusters.list[i].parent);
  }
}

Cell Hierarchy::cellOf(int patch) const noexcept {
  if (!planeOf_.empty() && planeOf_[std::size_t(patch)] >= 0)
    return planes_[std::size_t(planeOf_[std::size_t(patch)])];
  return {{}, {1, 0}, {0, 1}, scene_.patches()[std::size_t(patch)].isTriangle};
}

Vec2 Hierarchy::local(const Place& p) const noexcept {
  if (planeOf_.empty() || planeOf_[std::size_t(p.patch)] < 0) return p.uv;
  const Cell c = planes_[std::size_t(planeOf_[std::size_t(p.patch)])];
  return {(p.uv.x - c.origin.x) / c.a.x, (p.uv.y - c.origin.y) / c.b.y};
}

ElementId Hierarchy::root(const Place& p) const noexcept {
  if (p.patch < 0) return 0;
  const ElementId e = rootOf(p.patch, p.back);
  if (!(elements_[e].area > 0)) return 0;
  const Vec2 l = local(p);
  return l.x >= 0 && l.y >= 0 && l.x <= 1 && l.y <= 1 ? e : 0;
}

ElementId Hierarchy::divide(ElementId id, int patch, const Cell& cell) {
  Element& e = elements_[id];
  ElementId expected = 0;
  if (!e.children.compare_exchange_strong(expected, kBusy, std::memory_order_acq_rel)) {
    while (expected == kBusy) expected = e.children.load(std::memory_order_acquire);
    return expected;
  }
  const ElementId first = elements_.add(4);
  double areas[4], sum = 0;
  for (int k = 0; k < 4; ++k) {
    const Cell c = cell.child(k);
    areas[k] = cell.isTriangle ? 1 : double(scene_.patchArea(patch, c.at({0, 0}), c.at({1, 1})));
    sum += areas[k];
  }
  for (int k = 0; k < 4; ++k) {
    Element& c = elements_[first + ElementId(k)];
    c.parent = id, c.level = std::int8_t(e.level + 1);
    c.area = float(sum > 0 ? double(e.area) * areas[k] / sum : double(e.area) / 4);
  }
  e.children.store(first, std::memory_order_release);
  return first;
}

ElementId Hierarchy::byArea(const Place& p, ElementId e, Real area) {
  if (Real(elements_[e].area) <= area) {
    for (ElementId up; (up = elements_[e].parent) && Real(elements_[up].area) <= area;) e = up;
    return e;
  }
  Vec2 at = local(p);
  Cell cell = cellOf(p.patch);
  while (Real(elements_[e].area) > area) {
    ElementId children = elements_[e].children.load(std::memory_order_acquire);
    if (children == 0 || children == kBusy) {
      if (!mayDivide(elements_[e])) return e;
      children = divide(e, p.patch, cell);
    }
    const int k = descend(at, cell.isTriangle);
    e = children + ElementId(k), cell = cell.child(k);
  }
  return e;
}

ElementId Hierarchy::byTrial(const Place& p, ElementId e) {
  Vec2 at = local(p);
  Cell cell = cellOf(p.patch);
  for (bool isLast = false; !isLast;) {
    ElementId children = elements_[e].children.load(std::memory_order_acquire);
    if (children == 0 || children == kBusy) {
      if (!mayDivide(elements_[e])) return e;
      elements_[e].isTrial.store(true, std::memory_order_relaxed);
      children = divide(e, p.patch, cell);
    }
    isLast = elements_[e].isTrial.load(std::memory_order_relaxed);
    const int k = descend(at, cell.isTriangle);
    e = children + ElementId(k), cell = cell.child(k);
  }
  return e;
}

void Hierarchy::deposit(const Place& p, Real footprintArea, const Flux& flux) {
  const ElementId top = root(p);
  if (top == 0) return;
  const ElementId e = settings_.oracle == Oracle::variance  ? byTrial(p, top)
                      : settings_.oracle == Oracle::uniform ? byArea(p, top, 0)
                                                            : byArea(p, top, footprintArea);
  elements_[e].deposit(flux);
}

void Hierarchy::judge(ElementId id) {
  Element& e = elements_[id];
  const ElementId first = e.children;
  if (first == 0) return;
  if (e.isTrial) {
    const Element* children[4];
    for (int k = 0; k < 4; ++k) children[k] = &elements_[first + ElementId(k)];
    if (varies(e, children)) e.isTrial = false;
    return;
  }
  for (int k = 0; k < 4; ++k) judge(first + ElementId(k));
}

bool Hierarchy::pause() {
  if (!canDivide_) return false;
  if (settings_.oracle == Oracle::variance)
    for (ElementId e = 1; e < firstCluster_; ++e) judge(e);
  canDivide_ = elements_.bytes() < settings_.memory;
  return !canDivide_;
}

}  // namespace vestige::particle
