// SPDX-License-Identifier: Apache-2.0
#include "engine/scene/media.h"

namespace vestige {
namespace {

/// A ray that meets boundaries again and again must end nevertheless.
constexpr int kMostBoundaries = 1 << 16;

bool entersAt(const Surface& s, Vec3 direction) noexcept {
  return dot(direction, s.geometricNormal) < 0;
}

/// Of a ray, whether a boundary is there: what fills the place changes.
bool isThere(const Surface& s) noexcept { return s.mediaInFront.top() != s.mediaBehind.top(); }

/// Beer's law. Most solids do not absorb.
Rgb attenuation(Rgb depth) noexcept {
  if (isBlack(depth)) return grey(1);
  return {std::exp(-depth.r), std::exp(-depth.g), std::exp(-depth.b)};
}

}  // namespace

void Media::build(const World& world, const std::vector<const Material*>& materials) {
  indices_ = {1};
  absorption_ = {Rgb{}};
  visibleTo_ = {RayKind::any};
  isRestricted_ = false;
  bounds_ = {};
  for (std::uint32_t k = 1; k <= std::uint32_t(world.solids()); ++k) {
    const World::Solid& solid = world.solid(k);
    const Material& m = *materials[std::size_t(solid.object)];
    indices_.push_back(m.meanIndex());
    absorption_.push_back(m.absorption);
    visibleTo_.push_back(solid.visibleTo);
    isRestricted_ |= solid.visibleTo != RayKind::any;
    bounds_.add(solid.bounds);
  }
}

MediumStack Media::seenBy(const MediumStack& solids, RayKind kind) const noexcept {
  if (!isRestricted_) return solids;
  MediumStack seen = solids;
  for (const std::uint32_t solid : solids.solids())
    if (solid != 0 && !shareKind(visibleTo_[solid], kind)) seen = seen.without(solid);
  return seen;
}

void Media::addDepth(Rgb& depth, Rgb absorption, Real distance) noexcept {
  const auto along = [&](Real a) { return a > 0 ? a * distance : Real(0); };  // no 0 * infinity
  depth += Rgb{along(absorption.r), along(absorption.g), along(absorption.b)};
}

Rgb Media::transmittance(const MediumStack& media, Real distance) const noexcept {
  Rgb depth;
  addDepth(depth, absorption_[media.top()], distance);
  return attenuation(depth);
}

template <class Visit>
void Media::visitTouching(const World& world, Vec3 direction, const Surface& s,
                          const Visit& visit) const noexcept {
  if (!world.solid(s.solid).meetsOthers) return;
  // From where a ray would leave to one side to where it would leave to the other.
  const Vec3 across = entersAt(s, direction) ? -s.geometricNormal : s.geometricNormal;
  const Ray ray{s.position - s.offset * across, across, 0, 2 * s.offset};
  std::array<Surface, 8> found;
  const int n = world.boundaries(ray, found);
  for (int k = 0; k < n; ++k) {
    const Surface& other = found[std::size_t(k)];
    if (other.solid != s.solid) visit(other.solid, entersAt(other, across));
  }
}

void Media::cross(const World& world, Vec3 direction, const MediumStack& media,
                  Surface& s) const noexcept {
  MediumStack near = media, far = media;
  const auto pass = [&](std::uint32_t solid, bool enters) {
    near = enters ? near.without(solid) : near.with(solid);
    far = enters ? far.with(solid) : far.without(solid);
  };
  const bool enters = entersAt(s, direction);
  pass(s.solid, enters);
  visitTouching(world, direction, s, pass);
  s.mediaInFront = enters ? near : far;
  s.mediaBehind = enters ? far : near;
}

bool Media::follow(const World& world, const Ray& ray, Surface& s) const noexcept {
  Ray rest = ray;
  Real passed = 0;  // from ray.origin to rest.origin
  for (int k = 0; k < kMostBoundaries; ++k) {
    s.distance += passed;
    if (s.solid == 0) return true;
    cross(world, ray.direction, rest.media, s);
    if (isThere(s)) return true;
    rest = spawnRay(s, ray.direction, ray.kind);
    passed = dot(rest.origin - ray.origin, ray.direction);
    rest.tMax = ray.tMax - passed;
    if (!world.intersect(rest, s)) return false;
  }
  return false;
}

MediumStack Media::at(const World& world, Vec3 position) const noexcept {
  if (isNone() || !bounds_.contains(position)) return {};
  // Solids that are left without having been entered. The direction is along no edge of a scene.
  Ray ray{position, normalize(Vec3{Real(0.3713), Real(0.8131), Real(0.4483)})};
  MediumStack around, entered;
  const auto pass = [&](std::uint32_t solid, bool enters) {
    if (enters)
      entered = entered.with(solid);
    else if (entered.contains(solid))
      entered = entered.without(solid);
    else
      around = around.with(solid);
  };
  Surface s;
  for (int k = 0; k < kMostBoundaries && world.intersect(ray, s); ++k) {
    if (s.solid != 0) {
      pass(s.solid, entersAt(s, ray.direction));
      visitTouching(world, ray.direction, s, pass);
    }
    ray = spawnRay(s, ray.direction);
  }
  return around;
}

bool Media::Shadow::pass(Surface s) noexcept {
  media.cross(world, direction, stack, s);
  const bool enters = entersAt(s, direction);
  const MediumStack& near = enters ? s.mediaInFront : s.mediaBehind;
  addDepth(opticalDepth, media.absorption_[near.top()], s.distance - from);
  from = s.distance;
  stack = enters ? s.mediaBehind : s.mediaInFront;
  return isThere(s);
}

Rgb Media::Shadow::transmittance(Real distance) noexcept {
  addDepth(opticalDepth, media.absorption_[stack.top()], distance - from);
  return attenuation(opticalDepth);
}

}  // namespace vestige
