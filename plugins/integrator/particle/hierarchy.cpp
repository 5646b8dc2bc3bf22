// SPDX-License-Identifier: Apache-2.0
#include "hierarchy.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <thread>

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
  const Real uu = dot(s.dPdu, s.dPdu), uv = dot(s.dPdu, s.dPdv), vv = dot(s.dPdv, s.dPdv);
  const Real u = dot(away, s.dPdu), v = dot(away, s.dPdv), det = uu * vv - uv * uv;
  const Vec2 centre = {(vv * u - uv * v) / det, (uu * v - uv * u) / det};
  const Real reach = kPlaneReach * length(b.size());
  const Vec2 half = {reach / std::sqrt(uu), reach / std::sqrt(vv)};
  return {centre - half, {2 * half.x, 0}, {0, 2 * half.y}, false};
}

/// Whether hits vary over the four parts of an element, of these areas, more than chance explains:
/// Pearson's sum, three degrees of freedom, one in fifty.
bool isUneven(const Element& e, const double (&areas)[4]) noexcept {
  constexpr double kUnlikely = 9.84;
  const double hits = double(e.hits()), area = areas[0] + areas[1] + areas[2] + areas[3];
  double sum = 0;
  for (int k = 0; k < 4; ++k) {
    const double expected = area > 0 ? hits * areas[k] / area : 0;
    if (expected > 0) sum += sqr(e.quarter[k] - expected) / expected;
  }
  return sum > kUnlikely;
}
/// Fewer hits say nothing.
constexpr std::uint64_t kLeastHits = 8;

/// Whether a material has a diffuse part at a point of a patch, seen from either side.
bool isDiffuseAt(const SceneView& scene, int patch, Vec2 uv) noexcept {
  Surface s;
  static_cast<SurfacePoint&>(s) = scene.patchPoint(patch, uv);
  s.object = scene.patches()[std::size_t(patch)].object;
  s.patch = patch;
  s.patchUv = uv;
  for (const Vec3 toPrev : {s.geometricNormal, -s.geometricNormal}) {
    InputBuffer inputs;
    const Interaction x = scene.shade(s, toPrev, {}, inputs);
    if (x.brdf && !isBlack(x.brdf->diffuse(x.point).albedo)) return true;
  }
  return false;
}

/// Looks at points all over an object until one is diffuse. `patches`: all of the object. The
/// points follow the additive recurrence in three dimensions [Roberts 2018, "The unreasonable
/// effectiveness of quasirandom sequences", R3]: patch, u and v.
bool isDiffuse(const SceneView& scene, std::span<const int> patches) noexcept {
  constexpr std::size_t kMostLooks = 1024, kLooksAtPatch = 64;
  constexpr double kStep[3] = {0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
  const std::size_t looks = std::min(kMostLooks, kLooksAtPatch * patches.size());
  for (std::size_t i = 0; i < looks; ++i) {
    double at[3];
    for (int k = 0; k < 3; ++k) at[k] = std::fmod(0.5 + double(i) * kStep[k], 1.0);
    const int patch = patches[std::size_t(at[0] * double(patches.size()))];
    Vec2 uv{Real(at[1]), Real(at[2])};
    if (scene.patches()[std::size_t(patch)].isTriangle && uv.x + uv.y > 1)
      uv = {1 - uv.x, 1 - uv.y};
    if (isDiffuseAt(scene, patch, uv)) return true;
  }
  return false;
}

/// By patch: whether its object counts as diffuse.
std::vector<bool> diffusePatches(const SceneView& scene) {
  const auto patches = scene.patches();
  std::vector<int> byObject(patches.size());
  std::iota(byObject.begin(), byObject.end(), 0);
  const auto objectOf = [&](int patch) { return patches[std::size_t(patch)].object; };
  std::stable_sort(byObject.begin(), byObject.end(),
                   [&](int a, int b) { return objectOf(a) < objectOf(b); });
  std::vector<bool> result(patches.size());
  for (std::size_t first = 0, last = 0; first < byObject.size(); first = last) {
    while (last < byObject.size() && objectOf(byObject[last]) == objectOf(byObject[first])) ++last;
    const auto own = std::span<const int>(byObject).subspan(first, last - first);
    if (!isDiffuse(scene, own)) continue;
    for (const int patch : own) result[std::size_t(patch)] = true;
  }
  return result;
}

bool hasInfiniteLight(const SceneView& scene) noexcept {
  return std::any_of(scene.lights().begin(), scene.lights().end(),
                     [](const Light* l) { return l->traits().isInfinite; });
}

}  // namespace

Hierarchy::Hierarchy(const SceneView& scene, const HierarchySettings& settings)
    : scene_(scene), settings_(settings) {
  const auto patches = scene.patches();
  const std::vector<bool> isDiffuse = diffusePatches(scene);
  firstCluster_ = clusterEnd_ = rootOf(int(patches.size()), false);
  std::vector<ClusterMember> members;
  // Light from infinity is sent to what is finite only: a plane gets too little of it.
  const bool isOpen = hasInfiniteLight(scene);
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const Patch& p = patches[i];
    if (!std::isfinite(p.area)) {
      planeOf_.resize(patches.size(), -1);
      planeOf_[i] = int(planes_.size());
      planes_.push_back(isOpen ? Cell{{}, {}, {}} : aroundEverything(scene, int(i)));
    } else if (settings.clusters && isDiffuse[i] && lengthSquared(p.normal) > 0 && p.area > 0) {
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
      if (!isDiffuse[i]) continue;  // an area of 0: nothing is kept there
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

Vec2 Hierarchy::local(const PatchPoint& p) const noexcept {
  if (planeOf_.empty() || planeOf_[std::size_t(p.patch)] < 0) return p.uv;
  const Cell c = planes_[std::size_t(planeOf_[std::size_t(p.patch)])];
  return {(p.uv.x - c.origin.x) / c.a.x, (p.uv.y - c.origin.y) / c.b.y};
}

ElementId Hierarchy::root(const PatchPoint& p) const noexcept {
  if (p.patch < 0) return 0;
  const ElementId e = rootOf(p.patch, p.back);
  if (!(elements_[e].area > 0)) return 0;
  const Vec2 l = local(p);
  return l.x >= 0 && l.y >= 0 && l.x <= 1 && l.y <= 1 ? e : 0;
}

void Hierarchy::areasOfParts(int patch, const Cell& cell, double (&areas)[4]) const noexcept {
  for (int k = 0; k < 4; ++k) {
    const Cell c = cell.child(k);
    areas[k] = cell.isTriangle ? 1 : double(scene_.patchArea(patch, c.at({0, 0}), c.at({1, 1})));
  }
}

ElementId Hierarchy::divide(ElementId id, int patch, const Cell& cell) {
  Element& e = elements_[id];
  ElementId expected = 0;
  if (!e.children.compare_exchange_strong(expected, kBusy, std::memory_order_acq_rel)) {
    for (; expected == kBusy; expected = e.children.load(std::memory_order_acquire))
      std::this_thread::yield();
    if (expected == 0) throw std::bad_alloc();  // as it was for the thread that we waited for
    return expected;
  }
  ElementId first;
  try {
    first = elements_.add(4);
  } catch (...) {
    e.children.store(0, std::memory_order_release);
    throw;
  }
  double areas[4];
  areasOfParts(patch, cell, areas);
  const double sum = areas[0] + areas[1] + areas[2] + areas[3];
  for (int k = 0; k < 4; ++k) {
    Element& c = elements_[first + ElementId(k)];
    c.parent = id, c.level = std::int8_t(e.level + 1);
    c.area = float(sum > 0 ? double(e.area) * areas[k] / sum : double(e.area) / 4);
  }
  e.children.store(first, std::memory_order_release);
  return first;
}

void Hierarchy::deposit(const PatchPoint& p, Real footprintArea, const Flux& flux) {
  ElementId e = root(p);
  if (e == 0) return;
  const Real area = settings_.oracle == Oracle::variance  ? kInfinity
                    : settings_.oracle == Oracle::uniform ? 0
                                                          : footprintArea;
  Vec2 at = local(p);
  Cell cell = cellOf(p.patch);
  const bool climbs = settings_.oracle == Oracle::footprint && !elements_[e].varies;
  if (climbs && Real(elements_[e].area) <= area)
    for (ElementId up; (up = elements_[e].parent) && Real(elements_[up].area) <= area;) e = up;
  while (elements_[e].level >= 0 && (Real(elements_[e].area) > area || elements_[e].varies)) {
    ElementId children = elements_[e].children.load(std::memory_order_acquire);
    if (children == 0 || children == kBusy) {
      if (!mayDivide(elements_[e])) break;
      children = divide(e, p.patch, cell);
    }
    const int k = descend(at, cell.isTriangle);
    e = children + ElementId(k), cell = cell.child(k);
  }
  elements_[e].deposit(flux, descend(at, cell.isTriangle));
}

void Hierarchy::handDown(ElementId id, int patch, const Cell& cell) {
  const ElementId first = divide(id, patch, cell);
  Element& e = elements_[id];
  const auto hits = std::int64_t(e.hits());
  for (auto& sum : e.flux) {
    // In two steps, so that the product does not overflow: whole units a hit, then the rest.
    const std::int64_t whole = sum / hits, rest = sum % hits;
    std::int64_t left = sum;
    for (int k = 0; k < 4; ++k) {
      const std::int64_t n = e.quarter[k];
      const std::int64_t part = k == 3 ? left : whole * n + rest * n / hits;
      elements_[first + ElementId(k)].flux[&sum - e.flux] += part;
      left -= part;
    }
    sum = 0;
  }
  e.varies = true;
}

void Hierarchy::judge(ElementId id, int patch, const Cell& cell) {
  Element& e = elements_[id];
  // Not in each pass: a few hits more say nothing new.
  const std::uint64_t hits = e.hits();
  if (!e.varies && hits >= kLeastHits && hits > e.judged + e.judged / 16 && mayDivide(e)) {
    e.judged = std::uint32_t(hits);
    double areas[4];
    areasOfParts(patch, cell, areas);
    if (isUneven(e, areas)) handDown(id, patch, cell);
  }
  const ElementId first = e.children;
  for (int k = 0; first != 0 && k < 4; ++k) judge(first + ElementId(k), patch, cell.child(k));
}

bool Hierarchy::pause() {
  if (!canDivide_) return false;
  if (settings_.oracle == Oracle::variance ||
      (settings_.oracle == Oracle::footprint && settings_.edges))
    for (ElementId e = 1; e < firstCluster_; ++e)
      if (elements_[e].area > 0) judge(e, patchOf(e), cellOf(patchOf(e)));
  canDivide_ = elements_.bytes() < settings_.memory;
  return !canDivide_;
}

}  // namespace vestige::particle
