// SPDX-License-Identifier: Apache-2.0
#include "clusters.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace vestige::particle {
namespace {

const Real kLeastCosine =
    std::cos(Real(kPi) / 6);  ///< of a member's normal with the mean: 30 degrees
constexpr Real kMostDepth =
    Real(0.02);                        ///< across the mean plane, in sides of the cluster's square
constexpr Real kMostSpread = Real(8);  ///< square of the diagonal, in areas: 2 for a full square

/// Divisions before members are halved by number: 2^32 of them at most then.
constexpr int kMostByMiddle = 48;

using Members = std::span<ClusterMember>;

bool isFlat(Members members, double area) {
  Vec3 mean, middle;
  Bounds bounds;
  for (const ClusterMember& m : members) {
    mean += Real(m.area / area) * m.normal, middle += Real(m.area / area) * m.centre;
    bounds.add(m.bounds);
  }
  if (!(lengthSquared(bounds.size()) <= kMostSpread * Real(area)) || !(lengthSquared(mean) > 0))
    return false;
  const Frame frame = Frame::around(normalize(mean));
  const Real deep = kMostDepth * std::sqrt(Real(area));
  Bounds flat;  // in the plane
  for (const ClusterMember& m : members) {
    const Vec3 half = Real(0.5) * m.bounds.size(), to = m.bounds.low + half - middle;
    const auto reach = [&](Vec3 axis) {
      return std::abs(half.x * axis.x) + std::abs(half.y * axis.y) + std::abs(half.z * axis.z);
    };
    if (dot(m.normal, frame.n) < kLeastCosine || std::abs(dot(to, frame.n)) + reach(frame.n) > deep)
      return false;
    const Vec3 r = {reach(frame.s), reach(frame.t), 0}, at = frame.toLocal(to);
    flat.add(Vec3{at.x, at.y, 0} - r), flat.add(Vec3{at.x, at.y, 0} + r);
  }
  // More area than fits side by side: one covers another and would take light from it.
  return Real(area) <= Real(1.05) * flat.size().x * flat.size().y;
}

/// In two, across the middle of the widest of place and direction: what looks elsewhere goes
/// elsewhere. How many come first. Members that crowd in one place, level after level, are halved
/// by number.
std::size_t split(Members members, int depth) {
  Bounds places, normals;
  for (const ClusterMember& m : members) places.add(m.centre), normals.add(m.normal);
  const Real size = std::max(length(places.size()), std::numeric_limits<Real>::min());
  const Vec3 place = places.size() / size, normal = Real(0.5) * normals.size();
  const auto widest = [](Vec3 v) { return v.x >= v.y && v.x >= v.z ? 0 : v.y >= v.z ? 1 : 2; };
  const int byPlace = widest(place), byNormal = widest(normal);
  const bool turns = normal[byNormal] > place[byPlace];
  const auto along = [&](const ClusterMember& m) {
    return turns ? m.normal[byNormal] : m.centre[byPlace];
  };
  const Bounds& extent = turns ? normals : places;
  const int axis = turns ? byNormal : byPlace;
  const Real middle = Real(0.5) * (extent.low[axis] + extent.high[axis]);
  if (depth < kMostByMiddle) {
    const auto second = std::stable_partition(members.begin(), members.end(),
                                              [&](const auto& m) { return along(m) < middle; });
    if (second != members.begin() && second != members.end())
      return std::size_t(second - members.begin());
  }
  const auto half = members.begin() + std::ptrdiff_t(members.size() / 2);
  std::nth_element(members.begin(), half, members.end(), [&](const auto& a, const auto& b) {
    return along(a) != along(b) ? along(a) < along(b) : a.root < b.root;
  });
  return members.size() / 2;
}

struct Builder {
  Clusters made;

  void build(Members members, std::size_t first, std::uint32_t parent, int depth = 0) {
    if (members.size() < 2) {
      if (!members.empty()) made.above[first] = parent;
      return;
    }
    double area = 0;
    for (const ClusterMember& m : members) area += m.area;
    if (area > 0 && isFlat(members, area)) {
      made.list.push_back({area, parent});
      parent = std::uint32_t(made.list.size());
    }
    const std::size_t left = split(members, depth);
    build(members.subspan(0, left), first, parent, depth + 1);
    build(members.subspan(left), first + left, parent, depth + 1);
  }
};

}  // namespace

Clusters makeClusters(std::vector<ClusterMember>& members) {
  Builder b;
  b.made.above.assign(members.size(), 0);
  b.build(members, 0, 0);
  return std::move(b.made);
}

}  // namespace vestige::particle
