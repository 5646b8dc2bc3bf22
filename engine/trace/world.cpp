// SPDX-License-Identifier: Apache-2.0
#include "engine/trace/world.h"

#include <map>

#include "engine/trace/embree.h"
#include "engine/trace/patches.h"

namespace vestige {
namespace {

/// Rounding steps between a surface and the start of a ray that leaves it: of its position in the
/// object, in the world, of the ray's origin, each sqrt(3) halves of an epsilon at most.
constexpr Real kSteps = 4;
/// Triangles are met in float, whatever Real is.
constexpr Real kFloat = std::numeric_limits<float>::epsilon();

/// Shadow rays pass no more layers than this.
constexpr int kMostLayers = 64;

/// Into the triangle: rounding leaves it by a little.
Vec2 clampBarycentric(Vec2 b) noexcept {
  b = {std::clamp(b.x, Real(0), Real(1)), std::clamp(b.y, Real(0), Real(1))};
  const Real sum = b.x + b.y;
  return sum > 1 ? b * (1 / sum) : b;
}

/// In float the position is off by its own rounding; Embree's distance from the plane by that of
/// the vectors to the triangle's corners; an instance takes the ray through its matrix, in float.
Real triangleOffset(const Item& item, const SurfacePoint& s, Real extent) noexcept {
  Real position = maxAbsComponent(s.position);
  if (!item.baked) {
    extent *= item.place.norm;
    position = std::max(position, item.place.condition * (position + item.place.shift));
  }
  return kSteps * kFloat * (position + extent);
}

Real shapeOffset(const Item& item, Vec3 object, Vec3 world) noexcept {
  constexpr Real epsilon = std::numeric_limits<Real>::epsilon();
  return kSteps * epsilon *
         std::max(maxAbsComponent(world), item.place.norm * maxAbsComponent(object));
}

}  // namespace

struct World::Impl {
  std::vector<Placement> placements;
  std::vector<Item> items;
  std::vector<std::unique_ptr<Triangles>> meshes;
  std::unique_ptr<Tree> tree;
  Patches patches;
  Bounds bounds;
  std::size_t dropped = 0, triangles = 0;
  bool translucent = false;

  void prepareItems();
  void fill(Surface& s, const Ray& ray, const TreeHit& hit) const noexcept;
  void fillTriangle(Surface& s, const Item& item, const Ray& ray, TreeHit hit) const noexcept;
  void fillShape(Surface& s, const Item& item, const Ray& ray, const TreeHit& hit) const noexcept;
};

void World::Impl::prepareItems() {
  std::map<const TriangleMesh*, int> uses;
  for (const Placement& p : placements)
    if (p.mesh) ++uses[p.mesh];
  std::map<const TriangleMesh*, const Triangles*> shared;
  for (const Placement& p : placements) {
    Item& item = items.emplace_back(p);
    translucent |= p.translucent;
    if (!p.mesh) {
      item.bounds = p.shape->bounds();
      if (!item.bounds.isInfinite()) item.bounds = item.place.bounds(item.bounds);
    } else {
      item.baked = uses[p.mesh] == 1;
      const Triangles*& t = shared[p.mesh];
      if (!t) {
        meshes.push_back(std::make_unique<Triangles>(*p.mesh, item.baked ? p.toWorld : Affine{}));
        t = meshes.back().get();
        dropped += t->dropped(), triangles += t->size();
      }
      item.triangles = t;
      item.bounds = item.baked ? t->bounds() : item.place.bounds(t->bounds());
    }
    if (!item.bounds.isInfinite()) bounds.add(item.bounds);
  }
}

void World::Impl::fillTriangle(Surface& s, const Item& item, const Ray& ray,
                               TreeHit hit) const noexcept {
  if constexpr (sizeof(Real) == 8) {  // Embree found the triangle in float; now where exactly
    const Ray local = item.baked ? ray : item.place.object(ray);
    const auto exact = item.triangles->meet(std::uint32_t(hit.primitive), local);
    hit.t = exact.t, hit.b = exact.b;
  }
  const Vec2 b = clampBarycentric(hit.b);
  const Real extent = item.triangles->at(std::uint32_t(hit.primitive), b, s);
  if (!item.baked) static_cast<SurfacePoint&>(s) = item.place.world(s);
  s.distance = hit.t;
  s.patchUv = b;
  s.offset = triangleOffset(item, s, extent);
}

void World::Impl::fillShape(Surface& s, const Item& item, const Ray& ray,
                            const TreeHit& hit) const noexcept {
  const Vec3 near = item.place.object(ray).at(hit.t);
  const SurfacePoint local = item.placement.shape->surface(near, hit.primitive);
  static_cast<SurfacePoint&>(s) = item.place.world(local);
  s.distance = hit.t;
  s.patchUv = s.uv;
  s.offset = shapeOffset(item, local.position, s.position);
}

void World::Impl::fill(Surface& s, const Ray& ray, const TreeHit& hit) const noexcept {
  const Item& item = items[hit.item];
  if (item.triangles)
    fillTriangle(s, item, ray, hit);
  else
    fillShape(s, item, ray, hit);
  s.object = item.placement.object;
  s.light = item.placement.light;
  s.closed = item.placement.closed;
  s.primitive = hit.primitive;
  s.patch = patches.index(hit.item, hit.primitive);
}

World::World() : impl_(std::make_unique<Impl>()) {}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

void World::add(const Placement& placement) { impl_->placements.push_back(placement); }

void World::commit() {
  Impl& w = *impl_;
  w.items.reserve(w.placements.size());
  w.prepareItems();
  w.patches.number(w.items);
  w.tree = std::make_unique<Tree>();
  w.tree->build(w.items);
}

std::size_t World::dropped() const noexcept { return impl_->dropped; }
std::size_t World::triangles() const noexcept { return impl_->triangles; }
const std::vector<Placement>& World::placements() const noexcept { return impl_->placements; }
Bounds World::bounds() const noexcept { return impl_->bounds; }
std::span<const Patch> World::patches() const noexcept { return impl_->patches.all(); }
SurfacePoint World::patchPoint(int patch, Vec2 uv) const noexcept {
  return impl_->patches.point(patch, uv);
}
Real World::patchArea(int patch, Vec2 low, Vec2 high) const noexcept {
  return impl_->patches.area(patch, low, high);
}

bool World::intersect(const Ray& ray, Surface& surface) const noexcept {
  TreeHit hit;
  if (!impl_->tree || !impl_->tree->closest(ray, kEverything, hit)) return false;
  impl_->fill(surface, ray, hit);
  return true;
}

Real World::transmittance(const Ray& ray, Opacity opacity, const void* context) const noexcept {
  if (!impl_->tree || !(ray.tMin < ray.tMax)) return 1;
  if (impl_->tree->occluded(ray, kOpaque)) return 0;
  if (!impl_->translucent) return 1;
  Real left = 1;
  Ray rest = ray;
  for (int layer = 0;; ++layer) {
    TreeHit hit;
    if (!impl_->tree->closest(rest, kTranslucent, hit)) return left;
    if (layer == kMostLayers) return 0;
    Surface surface;
    impl_->fill(surface, ray, hit);
    left *= 1 - std::clamp(opacity(context, surface), Real(0), Real(1));
    if (!(left > 0)) return 0;
    // The same ray meets the same surface at the same t again: just past it.
    rest.tMin = hit.t + 4 * kFloat * std::abs(hit.t) + std::numeric_limits<float>::min();
  }
}

std::string World::embreeVersion() { return RTC_VERSION_STRING; }

}  // namespace vestige
