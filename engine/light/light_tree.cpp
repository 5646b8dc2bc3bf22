// SPDX-License-Identifier: Apache-2.0
#include "engine/light/light_tree.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace vestige {
namespace {

/// The share of all choices that is spread evenly over the lights.
constexpr double kEvenShare = 0.1;
/// Number of candidate splits of a node along each axis.
constexpr int kBins = 12;

double sane(double power) { return std::isfinite(power) && power > 0 ? power : 0; }

/// Cost of a cluster [CK18 Sec. 4.1, simplified]: power, spread in space and in directions.
Real cost(const LightCluster& c) noexcept {
  return c.power * lengthSquared(c.box.size()) * (Real(0.1) + 1 - std::cos(c.angle + c.reach));
}

/// Shares of 1 by power, with an even part by count. `counts`: how many lights each power is of.
std::vector<double> sharesOf(const std::vector<double>& powers, const std::vector<double>& counts) {
  double power = 0, count = 0;
  for (const double p : powers) power += sane(p);
  for (const double c : counts) count += c;
  std::vector<double> shares;
  for (std::size_t i = 0; i < powers.size(); ++i) {
    const double even = counts[i] / count;
    shares.push_back(power > 0 ? (1 - kEvenShare) * sane(powers[i]) / power + kEvenShare * even
                               : even);
  }
  return shares;
}

/// Lights that share one part of all choices.
struct LightGroup {
  std::vector<double> powers, counts;

  void add(double power, double count) {
    powers.push_back(power);
    counts.push_back(count);
  }
  double power() const { return std::accumulate(powers.begin(), powers.end(), 0.0); }
  double count() const { return std::accumulate(counts.begin(), counts.end(), 0.0); }
};

/// Chances of all entries of two groups, one after the other: half to each if both have power.
std::vector<double> chancesOf(const LightGroup& first, const LightGroup& second) {
  std::vector<double> halves = {0.5, 0.5};
  if (!(first.power() > 0 && second.power() > 0) && first.count() + second.count() > 0)
    halves = sharesOf({first.power(), second.power()}, {first.count(), second.count()});
  std::vector<double> chances;
  for (const LightGroup* group : {&first, &second})
    for (const double share : sharesOf(group->powers, group->counts))
      chances.push_back(halves[group == &first ? 0 : 1] * share);
  return chances;
}

struct Bin {
  std::optional<LightCluster> cluster;
  void add(const LightCluster& c) { cluster = cluster ? LightCluster(*cluster, c) : c; }
};

/// A split of a node's lights.
struct Part {
  Real cost = kInfinity;
  int axis = 0;
  Real at = 0;
};

/// The best of kBins - 1 places along an axis.
Part bestAlong(int axis, const Bounds& centres, std::span<const std::int32_t> lights,
               const std::vector<LightCluster>& clusters) {
  const Real low = centres.low[axis], size = centres.size()[axis];
  if (!(size > 0)) return {};
  std::array<Bin, kBins> bins;
  for (const std::int32_t l : lights) {
    const LightCluster& c = clusters[std::size_t(l)];
    const Real share = (c.box.centre()[axis] - low) / size;
    bins[std::size_t(std::clamp(int(share * kBins), 0, kBins - 1))].add(c);
  }
  std::array<Real, kBins> below{};
  Bin sum;
  for (int i = 0; i < kBins - 1; ++i) {
    if (bins[std::size_t(i)].cluster) sum.add(*bins[std::size_t(i)].cluster);
    below[std::size_t(i)] = sum.cluster ? cost(*sum.cluster) : 0;
  }
  Part best;
  Bin above;
  for (int i = kBins - 1; i > 0; --i) {
    if (bins[std::size_t(i)].cluster) above.add(*bins[std::size_t(i)].cluster);
    if (!above.cluster) continue;
    const Real both = below[std::size_t(i) - 1] + cost(*above.cluster);
    if (both < best.cost) best = {both, axis, low + size * Real(i) / kBins};
  }
  return best;
}

}  // namespace

void LightTable::build(const std::vector<double>& powers) {
  set(sharesOf(powers, std::vector<double>(powers.size(), 1)));
}

void LightTable::set(const std::vector<double>& chances) {
  double sum = 0;
  chances_.clear();
  upTo_.clear();
  for (const double chance : chances) {
    sum += chance;
    chances_.push_back(Real(chance));
    upTo_.push_back(Real(sum));
  }
}

LightChoice LightTable::choose(Real u) const noexcept {
  const auto found = std::upper_bound(upTo_.begin(), upTo_.end() - 1, u);
  const int entry = int(found - upTo_.begin());
  const Real low = chanceBefore(entry);
  return {entry, chance(entry), std::clamp((u - low) / chance(entry), Real(0), kOneMinusEpsilon)};
}

LightCluster::LightCluster(const LightExtent& light, Real watts) noexcept
    : box(light.box),
      axis(light.axis),
      angle(std::clamp(light.spread, Real(0), kPi)),
      reach(std::clamp(light.reach, Real(0), kPi)),
      power(watts) {}

LightCluster::LightCluster(const LightCluster& a, const LightCluster& b) noexcept
    : box(a.box), reach(std::max(a.reach, b.reach)), power(a.power + b.power) {
  box.add(b.box);
  // The narrowest cone around both cones of axes [CK18 Alg. 1].
  const LightCluster &wide = a.angle >= b.angle ? a : b, &narrow = a.angle >= b.angle ? b : a;
  const Real between = std::acos(std::clamp(dot(wide.axis, narrow.axis), Real(-1), Real(1)));
  axis = wide.axis, angle = wide.angle;
  if (between + narrow.angle <= wide.angle) return;
  angle = (wide.angle + between + narrow.angle) / 2;
  const Vec3 across = narrow.axis - dot(wide.axis, narrow.axis) * wide.axis;
  if (angle >= kPi || !(lengthSquared(across) > Real(1e-12))) {
    angle = kPi;
    return;
  }
  const Real turn = angle - wide.angle;
  axis = normalize(std::cos(turn) * wide.axis + std::sin(turn) * normalize(across));
}

Real LightCluster::importance(Vec3 at) const noexcept {
  const Vec3 way = at - box.centre();
  const Real d2 = lengthSquared(way), diagonal2 = lengthSquared(box.size());
  // The mean of 1 / distance^2 over the points of a ball as large as the box: at its centre three
  // over its radius squared, from its surface on about that of the centre.
  const Real near = power / std::max({d2, (d2 + diagonal2 / 7) / 3, Real(1e-20)});
  // Inside the sphere around the box directions are unknown.
  const Real radius2 = diagonal2 / 4;
  if (!(d2 > radius2) || angle + reach >= kPi) return near;
  const Real away = std::acos(std::clamp(dot(axis, way) / std::sqrt(d2), Real(-1), Real(1)));
  const Real least = away - angle - std::asin(std::sqrt(radius2 / d2));
  // Rounding may not make a light dark that just reaches the point.
  if (least > reach + Real(1e-3)) return 0;
  return near * std::max(std::cos(std::max(least, Real(0))), Real(0.01));
}

void LightTree::build(std::span<const Light* const> lights) {
  std::vector<LightCluster> clusters;
  std::vector<std::int32_t> inside, unplaced;
  std::vector<double> powers;
  outside_.clear(), nodes_.clear(), parents_.clear();
  places_.assign(lights.size(), {-1, -1});
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const Light& light = *lights[i];
    const LightTraits traits = light.traits();
    powers.push_back(sane(double(luminance(light.power()))));
    const LightExtent extent = light.extent();
    clusters.emplace_back(extent, Real(powers.back()));
    if (!traits.isDrawn && !traits.isDelta) continue;
    const bool isPlaced = !extent.box.isEmpty() && !extent.box.isInfinite();
    (traits.isInfinite ? outside_ : isPlaced ? inside : unplaced).push_back(std::int32_t(i));
  }
  LightGroup infinite, finite;
  for (const std::int32_t l : outside_) infinite.add(powers[std::size_t(l)], 1);
  for (const std::int32_t l : unplaced) finite.add(powers[std::size_t(l)], 1);
  outside_.insert(outside_.end(), unplaced.begin(), unplaced.end());
  for (std::size_t k = 0; k < outside_.size(); ++k)
    places_[std::size_t(outside_[k])].entry = std::int32_t(k);
  if (!inside.empty()) finite.add(growAll(inside, clusters), double(inside.size()));
  table_.set(chancesOf(infinite, finite));
  only_ = -1;
  if (inside.size() + outside_.size() == 1) only_ = inside.empty() ? outside_[0] : inside[0];
}

double LightTree::growAll(std::span<std::int32_t> lights, std::vector<LightCluster>& clusters) {
  double power = 0;
  for (const std::int32_t l : lights) power += double(clusters[std::size_t(l)].power);
  // A light whose power is unknown or too small must not become dark.
  const double least = power > 0 ? kEvenShare * power / double(lights.size()) : 1;
  for (const std::int32_t l : lights) {
    clusters[std::size_t(l)].power = std::max(clusters[std::size_t(l)].power, Real(least));
    places_[std::size_t(l)].entry = std::int32_t(outside_.size());
  }
  nodes_.push_back({clusters[std::size_t(lights[0])], 0});
  parents_.push_back(-1);
  grow(0, lights, clusters);
  return power;
}

void LightTree::grow(std::int32_t node, std::span<std::int32_t> lights,
                     const std::vector<LightCluster>& clusters) {
  LightCluster all = clusters[std::size_t(lights[0])];
  Bounds centres;
  for (const std::int32_t l : lights) centres.add(clusters[std::size_t(l)].box.centre());
  for (const std::int32_t l : lights.subspan(1)) all = LightCluster(all, clusters[std::size_t(l)]);
  nodes_[std::size_t(node)].cluster = all;
  if (lights.size() == 1) {
    nodes_[std::size_t(node)].child = ~lights[0];
    places_[std::size_t(lights[0])].node = node;
    return;
  }
  Part best;
  for (int axis = 0; axis < 3; ++axis) {
    const Part p = bestAlong(axis, centres, lights, clusters);
    if (p.cost < best.cost) best = p;
  }
  auto middle = std::partition(lights.begin(), lights.end(), [&](std::int32_t l) {
    return clusters[std::size_t(l)].box.centre()[best.axis] < best.at;
  });
  // All lights at one point, or no best split: split in halves, so that the tree stays flat.
  if (middle == lights.begin() || middle == lights.end())
    middle = lights.begin() + std::ptrdiff_t(lights.size() / 2);
  const auto first = std::int32_t(nodes_.size());
  nodes_[std::size_t(node)].child = first;
  for (int i = 0; i < 2; ++i) nodes_.push_back({all, 0}), parents_.push_back(node);
  const auto size = std::size_t(middle - lights.begin());
  grow(first, lights.first(size), clusters);
  grow(first + 1, lights.subspan(size), clusters);
}

std::optional<Real> LightTree::firstChance(std::int32_t first, Vec3 at) const noexcept {
  const Real a = nodes_[std::size_t(first)].cluster.importance(at);
  const Real b = nodes_[std::size_t(first) + 1].cluster.importance(at);
  return a + b > 0 ? std::optional(a / (a + b)) : std::nullopt;
}

bool LightTree::skipsTree(Vec3 at) const noexcept {
  return !outside_.empty() && !nodes_.empty() && !(nodes_[0].cluster.importance(at) > 0);
}

std::optional<LightChoice> LightTree::chooseAmongMany(const Receiver& r, Real u) const noexcept {
  if (table_.isEmpty()) return std::nullopt;
  const int tree = int(outside_.size());
  const Real all = skipsTree(r.position) ? table_.chanceBefore(tree) : Real(1);
  const LightChoice entry = table_.choose(u * all);
  if (entry.light < tree)
    return LightChoice{outside_[std::size_t(entry.light)], entry.chance / all, entry.rest};
  Real chance = entry.chance;
  u = entry.rest;
  for (std::int32_t node = 0;;) {
    const std::int32_t child = nodes_[std::size_t(node)].child;
    if (child < 0) return LightChoice{~child, chance, u};
    const std::optional<Real> p = firstChance(child, r.position);
    if (!p) return std::nullopt;
    const bool isFirst = u < *p;
    const Real share = isFirst ? *p : 1 - *p;
    u = std::clamp((isFirst ? u : u - *p) / share, Real(0), kOneMinusEpsilon);
    chance *= share;
    node = isFirst ? child : child + 1;
  }
}

Real LightTree::chance(int light, const Receiver& r) const noexcept {
  if (light == only_) return 1;
  const Place& place = places_[std::size_t(light)];
  if (place.entry < 0) return 0;
  const int tree = int(outside_.size());
  const bool skips = skipsTree(r.position);
  if (place.entry < tree)
    return table_.chance(place.entry) / (skips ? table_.chanceBefore(tree) : Real(1));
  if (skips) return 0;
  Real chance = table_.chance(tree);
  for (std::int32_t node = place.node; node > 0; node = parents_[std::size_t(node)]) {
    const std::int32_t first = node - (node % 2 == 1 ? 0 : 1);
    const std::optional<Real> p = firstChance(first, r.position);
    if (!p) return 0;
    chance *= node == first ? *p : 1 - *p;
  }
  return chance;
}

}  // namespace vestige
