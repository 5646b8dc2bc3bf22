// SPDX-License-Identifier: Apache-2.0
#include "engine/trace/world.h"

#include <cstring>
#include <map>
#include <tuple>

#include "engine/trace/embree.h"
#include "engine/trace/patches.h"
#include "engine/trace/solids.h"

namespace vestige {
namespace {

/// Rounding steps between a surface and the start of a ray that leaves it: of its position in the
/// object, in the world, of the ray's origin, each sqrt(3) halves of an epsilon at most.
constexpr Real kSteps = 4;
/// Shapes compute in double with lengths up to their own size. What is left near a point of small
/// coordinates, as on a large ball that touches the origin: a difference of squares, 8 epsilon of
/// the size squared over twice the size, with room for a root that was searched for.
constexpr Real kInside = 32 * Real(std::numeric_limits<double>::epsilon());
/// Triangles are met in float, whatever Real is.
constexpr Real kFloat = std::numeric_limits<float>::epsilon();

/// What many layers let through. In double, so that a thousand thin ones keep their digits.
struct Product {
  double r = 1, g = 1, b = 1;
  TreeHit last{-1, 0, 0, {}};  ///< the farthest layer so far
  void multiply(Rgb c) noexcept {
    r *= double(c.r);
    g *= double(c.g);
    b *= double(c.b);
  }
  Rgb rgb() const noexcept { return {Real(r), Real(g), Real(b)}; }
};

Rgb clampedShare(Rgb c) noexcept {
  const auto share = [](Real x) { return std::clamp(x, Real(0), Real(1)); };
  return {share(c.r), share(c.g), share(c.b)};
}

/// Whether a hit lies where rounding may give it to the triangle beyond the edge as well.
bool isAtEdge(const TreeHit& hit) noexcept {
  constexpr Real kNear = Real(1e-4);
  return std::min({hit.b.x, hit.b.y, 1 - hit.b.x - hit.b.y}) < kNear;
}

bool isLess(Rgb a, Rgb b) noexcept { return std::tie(a.r, a.g, a.b) < std::tie(b.r, b.g, b.b); }

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
  const Real rounding = kSteps * epsilon *
                        std::max(maxAbsComponent(world), item.place.norm * maxAbsComponent(object));
  return rounding + item.inside;
}

// By bits: what is taken over must be what would be made, and -0 is not 0.
bool isSame(const Affine& a, const Affine& b) noexcept {
  return std::memcmp(&a, &b, sizeof a) == 0;
}
template <class Element>
bool isSame(const std::vector<Element>& a, const std::vector<Element>& b) noexcept {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Element)) == 0);
}
bool isSame(const TriangleMesh& a, const TriangleMesh& b) noexcept {
  return isSame(a.positions, b.positions) && isSame(a.normals, b.normals) && isSame(a.uvs, b.uvs) &&
         isSame(a.triangles, b.triangles);
}

/// Of all but the light. A mesh without a shape, that of a light, is made anew by each scene.
bool isSamePlace(const Placement& a, const Placement& b) noexcept {
  if (a.shape != b.shape || a.object != b.object || a.closed != b.closed ||
      a.translucent != b.translucent || a.visibleTo != b.visibleTo ||
      a.isDielectric != b.isDielectric || a.priority != b.priority || !isSame(a.toWorld, b.toWorld))
    return false;
  return a.mesh == b.mesh || (!a.shape && a.mesh && b.mesh && isSame(*a.mesh, *b.mesh));
}

}  // namespace

struct World::Body {
  /// Takes trees of meshes over from `before`, if not null.
  Body(const std::vector<Placement>& placements, const Body* before);

  std::vector<Item> items;
  std::map<const TriangleMesh*, TriangleMesh> own;  ///< of those that no shape keeps alive
  std::map<const TriangleMesh*, std::shared_ptr<const Triangles>> meshes;
  Tree tree;
  Patches patches;
  Bounds bounds;
  std::size_t dropped = 0, triangles = 0;
  bool hasLayers = false;
  std::vector<Solid> solids;  ///< by number; none has number 0

  void fill(Surface& s, const Ray& ray, const TreeHit& hit) const noexcept;
  /// Whether the ray went through one point, on an edge between two triangles.
  int solidsAtOnce = 0;

  bool isOnePoint(const TreeHit& a, const TreeHit& b, Vec3 direction) const noexcept;

 private:
  void addItem(Placement p);
  void addTriangles(Item& item, const Body* before);
  void fillTriangle(Surface& s, const Item& item, const Ray& ray, TreeHit hit) const noexcept;
  void fillShape(Surface& s, const Item& item, const Ray& ray, const TreeHit& hit) const noexcept;
};

World::Body::Body(const std::vector<Placement>& placements, const Body* before) {
  items.reserve(placements.size());
  for (const Placement& p : placements) addItem(p);
  std::map<const TriangleMesh*, int> uses;
  for (const Item& item : items) ++uses[item.placement.mesh];
  for (Item& item : items) {
    if (!item.placement.mesh) {
      item.bounds = item.placement.shape->bounds();
      if (!item.bounds.isInfinite()) item.bounds = item.place.bounds(item.bounds);
      if (!item.bounds.isInfinite()) item.inside = kInside * maxAbsComponent(item.bounds.size());
    } else {
      item.baked = uses[item.placement.mesh] == 1;
      addTriangles(item, before);
      item.bounds =
          item.baked ? item.triangles->bounds() : item.place.bounds(item.triangles->bounds());
    }
    if (!item.bounds.isInfinite()) bounds.add(item.bounds);
  }
  solids = numberSolids(items, solidsAtOnce);
  for (Item& item : items) {
    item.isLayer = item.placement.translucent || solids[item.solid].meetsOthers;
    hasLayers |= item.isLayer;
  }
  patches.number(items);
  tree.build(items, before ? &before->tree : nullptr);
}

void World::Body::addItem(Placement p) {
  p.light = -1;  // the world's
  if (p.mesh && !p.shape) p.mesh = &own.emplace(p.mesh, *p.mesh).first->second;
  items.emplace_back(p);
}

/// Those of another item with the same mesh, here or in the world before, or new ones.
void World::Body::addTriangles(Item& item, const Body* before) {
  const TriangleMesh* mesh = item.placement.mesh;
  std::shared_ptr<const Triangles>& t = meshes[mesh];
  if (!t) {
    const Affine toSpace = item.baked ? item.placement.toWorld : Affine{};
    // A mesh of the world before is still there, so another one cannot lie at its address.
    const auto old = before ? before->meshes.find(mesh) : meshes.end();
    if (before && old != before->meshes.end() && isSame(old->second->toSpace(), toSpace))
      t = old->second;
    else
      t = std::make_shared<Triangles>(*mesh, toSpace);
    dropped += t->dropped(), triangles += t->size();
  }
  item.triangles = t.get();
}

struct World::Impl {
  std::vector<Placement> placements;  ///< until commit()
  std::shared_ptr<const Body> body;
  std::vector<int> lights;  ///< by item

  void fill(Surface& s, const Ray& ray, const TreeHit& hit) const noexcept {
    body->fill(s, ray, hit);
    s.light = lights[std::size_t(hit.item)];
  }
  /// transmittance() where shadow rays may pass through a surface.
  Rgb throughLayers(const Ray& ray, Opacity opacity, const void* context) const noexcept;
  /// Takes in layers, by t. Surfaces at the same t have no order but that of their values.
  void multiply(Product& product, const Ray& ray, std::span<const TreeHit> hits, Opacity opacity,
                const void* context) const noexcept {
    std::array<Rgb, Layers::kMost> shares;
    Surface surface;
    for (std::size_t first = 0, k = 0; k < hits.size(); ++k) {
      shares[k] = grey(1);
      if (!isCounted(hits, k, product.last, ray.direction)) {
        fill(surface, ray, hits[k]);
        shares[k] = grey(1) - clampedShare(opacity(context, surface));
      }
      if (k + 1 < hits.size() && hits[k + 1].t == hits[k].t) continue;
      if (k > first) std::sort(shares.begin() + first, shares.begin() + k + 1, isLess);
      for (; first <= k; ++first) product.multiply(shares[first]);
    }
    if (!hits.empty()) product.last = hits.back();
  }
  /// Whether the ray met hit k a moment before in the next triangle; `last`: of the round before.
  bool isCounted(std::span<const TreeHit> hits, std::size_t k, const TreeHit& last,
                 Vec3 direction) const noexcept {
    if (!isAtEdge(hits[k])) return false;
    constexpr Real kClose = 1 - Real(1e-3);
    for (std::size_t i = k; i-- > 0 && hits[i].t >= kClose * hits[k].t;)
      if (body->isOnePoint(hits[i], hits[k], direction)) return true;
    return last.item >= 0 && last.t >= kClose * hits[k].t &&
           body->isOnePoint(last, hits[k], direction);
  }
};

inline void World::Body::fillTriangle(Surface& s, const Item& item, const Ray& ray,
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

void World::Body::fillShape(Surface& s, const Item& item, const Ray& ray,
                            const TreeHit& hit) const noexcept {
  const Vec3 near = item.place.objectPoint(ray, hit.t);
  SurfacePoint& point = s;
  point = item.placement.shape->surface(near, {hit.t, hit.primitive, hit.b});
  const Vec3 local = point.position;
  if (!item.place.identity) point = item.place.world(point);
  s.distance = hit.t;
  s.patchUv = s.uv;
  s.offset = shapeOffset(item, local, s.position);
}

inline void World::Body::fill(Surface& s, const Ray& ray, const TreeHit& hit) const noexcept {
  const Item& item = items[hit.item];
  if (item.triangles)
    fillTriangle(s, item, ray, hit);
  else
    fillShape(s, item, ray, hit);
  s.object = item.placement.object;
  s.solid = item.solid;
  s.mediaInFront = s.mediaBehind = ray.media;
  s.primitive = hit.primitive;
  s.patch = patches.index(hit.item, hit.primitive);
  s.time = ray.time;
}

bool World::Body::isOnePoint(const TreeHit& a, const TreeHit& b, Vec3 direction) const noexcept {
  if (a.item != b.item || !isAtEdge(a) || !isAtEdge(b)) return false;
  const Triangles* t = items[a.item].triangles;
  if (!t) return false;
  int shared = 0;  // by position: corners of a seam differ in their uv
  for (const std::uint32_t i : t->indices()[std::size_t(a.primitive)])
    for (const std::uint32_t j : t->indices()[std::size_t(b.primitive)])
      shared += t->positions()[i] == t->positions()[j];
  if (shared != 2) return false;
  // By one of them in, by the other out: an edge of a solid, met twice.
  const Vec3 own = items[a.item].baked ? direction : items[a.item].place.toObject.vector(direction);
  const auto side = [&](const TreeHit& h) {
    return dot(own, t->edges(std::uint32_t(h.primitive)).normal) < 0;
  };
  return side(a) == side(b);
}

World::World() : impl_(std::make_unique<Impl>()) {}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

void World::add(const Placement& placement) { impl_->placements.push_back(placement); }

void World::commit(const std::shared_ptr<const Body>& before) {
  std::vector<Placement> placements;
  placements.swap(impl_->placements);
  for (const Placement& p : placements) impl_->lights.push_back(p.light);
  const auto isSameItem = [](const Item& item, const Placement& p) {
    return isSamePlace(item.placement, p);
  };
  const bool isTaken = before && std::equal(before->items.begin(), before->items.end(),
                                            placements.begin(), placements.end(), isSameItem);
  impl_->body = isTaken ? before : std::make_shared<const Body>(placements, before.get());
}

std::shared_ptr<const World::Body> World::body() const noexcept { return impl_->body; }
std::size_t World::dropped() const noexcept { return impl_->body ? impl_->body->dropped : 0; }
std::vector<Placement> World::placements() const {
  std::vector<Placement> placements;
  for (const Item& item : impl_->body->items) placements.push_back(item.placement);
  return placements;
}
std::size_t World::triangles() const noexcept { return impl_->body ? impl_->body->triangles : 0; }
Bounds World::bounds() const noexcept { return impl_->body ? impl_->body->bounds : Bounds{}; }
std::span<const Patch> World::patches() const noexcept {
  return impl_->body ? impl_->body->patches.all() : std::span<const Patch>{};
}
SurfacePoint World::patchPoint(int patch, Vec2 uv) const noexcept {
  return impl_->body->patches.point(patch, uv);
}
Real World::patchArea(int patch, Vec2 low, Vec2 high) const noexcept {
  return impl_->body->patches.area(patch, low, high);
}

bool World::intersect(const Ray& ray, Surface& surface) const noexcept {
  TreeHit hit;
  if (!impl_->body || !impl_->body->tree.closest(ray, everything(ray.kind), hit)) return false;
  impl_->fill(surface, ray, hit);
  return true;
}

Rgb World::transmittance(const Ray& ray, Opacity opacity, const void* context) const noexcept {
  if (!impl_->body || !(ray.tMin < ray.tMax)) return grey(1);
  if (impl_->body->hasLayers) return impl_->throughLayers(ray, opacity, context);
  return grey(impl_->body->tree.occluded(ray, opaque(RayKind::shadow)) ? 0 : 1);
}

Rgb World::Impl::throughLayers(const Ray& ray, Opacity opacity,
                               const void* context) const noexcept {
  const Tree& tree = body->tree;
  constexpr RayKind kind = RayKind::shadow;
  Layers layers;
  if (!tree.gather(ray, everything(kind), ray.tMin, layers)) return {};
  Product product;
  for (;;) {
    layers.settle();
    multiply(product, ray, layers.hits(), opacity, context);
    if (!layers.isCut() || isBlack(product.rgb())) return product.rgb();
    const Real from = layers.goOn();
    tree.gather(ray, translucent(kind), from, layers);
  }
}

int World::solidsAtOnce() const noexcept { return impl_->body ? impl_->body->solidsAtOnce : 0; }
int World::solids() const noexcept { return impl_->body ? int(impl_->body->solids.size()) - 1 : 0; }
const World::Solid& World::solid(std::uint32_t number) const noexcept {
  return impl_->body->solids[number];
}

int World::boundaries(const Ray& ray, std::span<Surface> found) const noexcept {
  Layers layers;
  impl_->body->tree.gather(ray, translucent(ray.kind), ray.tMin, layers);
  layers.settle();
  std::size_t n = 0;
  for (const TreeHit& hit : layers.hits())
    if (n < found.size() && impl_->body->items[std::size_t(hit.item)].solid != 0)
      impl_->fill(found[n++], ray, hit);
  return int(n);
}

std::string World::embreeVersion() { return RTC_VERSION_STRING; }

}  // namespace vestige
