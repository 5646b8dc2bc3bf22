// SPDX-License-Identifier: Apache-2.0
#include "engine/trace/tree.h"

#include <algorithm>
#include <map>

#include "engine/trace/embree.h"

namespace vestige {
namespace {

using embree::check;

/// Analytic shapes of one mask: one user geometry, one primitive a placement.
struct Group {
  const std::vector<Item>* items;
  std::vector<int> members;  ///< indices of items, by primitive
};

/// Travels with a ray through Embree; the context comes first so that one address serves both.
struct Query {
  embree::Context context;
  const Ray* ray = nullptr;  ///< in full precision, for analytic shapes
  const std::vector<Item>* items = nullptr;
  const std::vector<int>* itemOfGeometry = nullptr;
  Layers* layers = nullptr;    ///< null: whatever is met blocks
  TreeHit* nearest = nullptr;  ///< receives the nearest analytic hit
};

std::optional<ShapeHit> meet(const Item& item, const Ray& world, float tFar) noexcept {
  Ray ray = item.place.object(world);
  ray.tMax = std::min(ray.tMax, Real(tFar));
  return item.placement.shape->intersect(ray);
}

/// All meetings with an analytic shape, from the ray's own start: a shape may find slightly
/// different points from another one.
void gatherShape(const Item& item, int index, const Ray& world, Layers& layers) noexcept {
  Ray ray = item.place.object(world);
  std::array<Crossing, 16> found;
  for (;;) {
    const int n = item.placement.shape->crossings(ray, found);
    for (int k = 0; k < n; ++k) {
      const ShapeHit& hit = found[std::size_t(k)].hit;
      layers.add({index, hit.part, hit.t, hit.uv});
    }
    if (n < int(found.size())) return;
    ray.tMin = std::nextafter(std::max(ray.tMin, found.back().hit.t), kInfinity);
  }
}

/// Outward, so that the float box holds whatever Real says.
void roundOut(const Bounds& b, RTCBounds& out) noexcept {
  const Real pad = 4 * std::numeric_limits<float>::epsilon() *
                   std::max(maxAbsComponent(b.low), maxAbsComponent(b.high));
  out.lower_x = float(b.low.x - pad), out.upper_x = float(b.high.x + pad);
  out.lower_y = float(b.low.y - pad), out.upper_y = float(b.high.y + pad);
  out.lower_z = float(b.low.z - pad), out.upper_z = float(b.high.z + pad);
}

void boundsOfPrimitive(const RTCBoundsFunctionArguments* a) {
  const Group& group = *static_cast<const Group*>(a->geometryUserPtr);
  roundOut((*group.items)[group.members[a->primID]].bounds, *a->bounds_o);
}

void intersectPrimitive(const RTCIntersectFunctionNArguments* a) {
  if (!a->valid[0]) return;
  const Group& group = *static_cast<const Group*>(a->geometryUserPtr);
  Query& query = *reinterpret_cast<Query*>(a->context);
  auto& ray = *reinterpret_cast<RTCRayHit*>(a->rayhit);
  const int item = group.members[a->primID];
  const std::optional<ShapeHit> hit = meet((*group.items)[item], *query.ray, ray.ray.tfar);
  if (!hit) return;
  *query.nearest = {item, hit->part, hit->t, hit->uv};
  ray.ray.tfar = float(hit->t);
  ray.hit.geomID = a->geomID, ray.hit.primID = a->primID;
  ray.hit.instID[0] = a->context->instID[0];
}

void occludePrimitive(const RTCOccludedFunctionNArguments* a) {
  if (!a->valid[0]) return;
  const Group& group = *static_cast<const Group*>(a->geometryUserPtr);
  const Query& query = *reinterpret_cast<const Query*>(a->context);
  auto& ray = *reinterpret_cast<RTCRay*>(a->ray);
  const int index = group.members[a->primID];
  const Item& item = (*group.items)[index];
  if (query.layers && item.isLayer) return gatherShape(item, index, *query.ray, *query.layers);
  if (meet(item, *query.ray, ray.tfar)) ray.tfar = -std::numeric_limits<float>::infinity();
}

/// Called where a shadow ray meets a triangle that may be translucent; those are noted, and the ray
/// goes on.
void filterTriangle(const RTCFilterFunctionNArguments* a) {
  const Query& query = *reinterpret_cast<const Query*>(a->context);
  if (!a->valid[0] || !query.layers) return;
  const RTCHit& hit = *reinterpret_cast<const RTCHit*>(a->hit);
  const unsigned instance = a->context->instID[0];
  const int item =
      (*query.itemOfGeometry)[instance != RTC_INVALID_GEOMETRY_ID ? instance : hit.geomID];
  if (!(*query.items)[item].isLayer) return;
  const float t = reinterpret_cast<const RTCRay*>(a->ray)->tfar;
  query.layers->add({item, int(hit.primID), Real(t), {Real(hit.u), Real(hit.v)}});
  a->valid[0] = 0;
}

unsigned maskOf(const Item& item) noexcept {
  const RayKind kinds = item.placement.visibleTo;
  return item.isLayer ? translucent(kinds) : opaque(kinds);
}

void fillRay(RTCRay& ray, const Ray& r, unsigned mask) noexcept {
  ray.org_x = float(r.origin.x), ray.org_y = float(r.origin.y), ray.org_z = float(r.origin.z);
  ray.dir_x = float(r.direction.x), ray.dir_y = float(r.direction.y);
  ray.dir_z = float(r.direction.z);
  ray.tnear = float(r.tMin), ray.tfar = float(r.tMax);
  ray.mask = mask;
  ray.time = float(r.time);
  ray.id = ray.flags = 0;
}

}  // namespace

void Layers::add(const TreeHit& hit) noexcept {
  if (hasBegun_ && !(last_ < hit)) return;
  const auto begin = hits_.begin();
  if (count_ < kMost) {
    hits_[std::size_t(count_++)] = hit;
    if (count_ == kMost) std::make_heap(begin, hits_.end());
    return;
  }
  isCut_ = true;
  if (!(hit < hits_[0])) return;
  std::pop_heap(begin, hits_.end());
  hits_.back() = hit;
  std::push_heap(begin, hits_.end());
}

void Layers::settle() noexcept {
  const auto begin = hits_.begin(), end = begin + count_;
  std::sort(begin, end);
  const auto isSame = [](const TreeHit& a, const TreeHit& b) {
    return a.t == b.t && a.item == b.item;
  };
  count_ = int(std::unique(begin, end, isSame) - begin);
  if (!isCut_) return;
  int whole = count_;
  while (whole > 0 && hits_[std::size_t(whole - 1)].t == hits_[std::size_t(count_ - 1)].t) --whole;
  if (whole > 0) count_ = whole;
}

Real Layers::goOn() noexcept {
  last_ = hits_[std::size_t(count_ - 1)];
  hasBegun_ = true;
  count_ = 0;
  isCut_ = false;
  return last_.t;
}

/// The tree of a mesh that is placed several times; several trees of all may share it.
struct MeshTree {
  std::shared_ptr<embree::Device> device;  ///< kept alive
  embree::Scene scene;
};

struct Tree::Impl {
  explicit Impl(std::shared_ptr<embree::Device> d) : device(std::move(d)) {}

  std::shared_ptr<embree::Device> device;
  embree::Scene scene{rtcNewScene(device->get())};
  std::map<const Triangles*, std::shared_ptr<const MeshTree>> instanced;
  const std::vector<Item>* items = nullptr;
  std::map<unsigned, Group> groups;  ///< by mask; they stay where they are
  std::vector<int> unbounded;        ///< items tested one by one
  std::vector<int> itemOfGeometry;   ///< -1: analytic

  void setFlags(RTCScene s) const {
    // Robust: closed meshes have no cracks and thin bounds are not missed, for 15 % of the speed.
    rtcSetSceneFlags(s, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(s, RTC_BUILD_QUALITY_MEDIUM);
  }
  void attach(RTCGeometry g, unsigned mask, int item) {
    rtcSetGeometryMask(g, mask);  // the default differs between Embree 3 and 4
    rtcCommitGeometry(g);
    const unsigned id = rtcAttachGeometry(scene.get(), g);
    if (itemOfGeometry.size() <= id) itemOfGeometry.resize(id + 1, -1);
    itemOfGeometry[id] = item;
  }
  embree::Geometry triangleGeometry(const Triangles& t) const;
  std::shared_ptr<const MeshTree> meshTree(const Triangles& t) const;
  void addInstance(RTCScene object, const Item& item, int index);
  void addGroup(Group& group, unsigned mask);
  /// The nearest of them, if any: ends the ray there.
  bool meetUnbounded(Ray& ray, unsigned mask, Query& query) const noexcept;
  /// The nearest of all others.
  bool closestBounded(Query& query, unsigned mask) const noexcept;
};

embree::Geometry Tree::Impl::triangleGeometry(const Triangles& t) const {
  embree::Geometry g(rtcNewGeometry(device->get(), RTC_GEOMETRY_TYPE_TRIANGLE));
  auto* p = static_cast<float*>(rtcSetNewGeometryBuffer(
      g.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, t.positions().size()));
  auto* i = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(g.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, t.size()));
  check(device->get(), "storing triangles");
  // Trees of instances are shared, so their triangles may be translucent in one place only.
  rtcSetGeometryOccludedFilterFunction(g.get(), filterTriangle);
  for (const Vec3 v : t.positions()) *p++ = float(v.x), *p++ = float(v.y), *p++ = float(v.z);
  for (const auto& c : t.indices()) i = std::copy(c.begin(), c.end(), i);
  return g;
}

std::shared_ptr<const MeshTree> Tree::Impl::meshTree(const Triangles& t) const {
  embree::Scene s(rtcNewScene(device->get()));
  setFlags(s.get());
  const embree::Geometry g = triangleGeometry(t);
  rtcSetGeometryMask(g.get(), ~0u);  // the instance's counts
  rtcCommitGeometry(g.get());
  rtcAttachGeometry(s.get(), g.get());
  rtcCommitScene(s.get());
  return std::shared_ptr<const MeshTree>(new MeshTree{device, std::move(s)});
}

void Tree::Impl::addInstance(RTCScene object, const Item& item, int index) {
  const embree::Geometry g(rtcNewGeometry(device->get(), RTC_GEOMETRY_TYPE_INSTANCE));
  rtcSetGeometryInstancedScene(g.get(), object);
  float m[12];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j) m[4 * i + j] = float(item.place.toWorld.m[i][j]);
  rtcSetGeometryTransform(g.get(), 0, RTC_FORMAT_FLOAT3X4_ROW_MAJOR, m);
  attach(g.get(), maskOf(item), index);
}

void Tree::Impl::addGroup(Group& group, unsigned mask) {
  const embree::Geometry g(rtcNewGeometry(device->get(), RTC_GEOMETRY_TYPE_USER));
  rtcSetGeometryUserPrimitiveCount(g.get(), unsigned(group.members.size()));
  rtcSetGeometryUserData(g.get(), &group);
  rtcSetGeometryBoundsFunction(
      g.get(), [](const RTCBoundsFunctionArguments* a) { boundsOfPrimitive(a); }, nullptr);
  rtcSetGeometryIntersectFunction(g.get(), intersectPrimitive);
  rtcSetGeometryOccludedFunction(g.get(), occludePrimitive);
  attach(g.get(), mask, -1);
}

bool Tree::Impl::meetUnbounded(Ray& ray, unsigned mask, Query& query) const noexcept {
  bool found = false;
  for (const int k : unbounded) {
    const Item& item = (*items)[k];
    if (!(maskOf(item) & mask)) continue;
    const auto met = item.placement.shape->intersect(item.place.object(ray));
    if (!met) continue;
    found = true;
    *query.nearest = {k, met->part, met->t, met->uv};
    ray.tMax = met->t;
  }
  return found;
}

inline bool Tree::Impl::closestBounded(Query& query, unsigned mask) const noexcept {
  RTCRayHit rayHit;
  fillRay(rayHit.ray, *query.ray, mask);
  rayHit.hit.geomID = rayHit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  embree::initialise(query.context);
  embree::intersect(scene.get(), rayHit, query.context);
  const RTCHit& h = rayHit.hit;
  if (h.geomID == RTC_INVALID_GEOMETRY_ID) return false;
  const bool isInstance = h.instID[0] != RTC_INVALID_GEOMETRY_ID;
  const int item = itemOfGeometry[std::size_t(isInstance ? h.instID[0] : h.geomID)];
  if (item >= 0)
    *query.nearest = {item, int(h.primID), Real(rayHit.ray.tfar), {Real(h.u), Real(h.v)}};
  return true;
}

Tree::Tree() = default;
Tree::~Tree() = default;

void Tree::build(const std::vector<Item>& items, const Tree* before) {
  const Impl* old = before ? before->impl_.get() : nullptr;
  // One device for both: trees of different devices cannot be joined.
  impl_ = std::make_unique<Impl>(old ? old->device
                                     : std::make_shared<embree::Device>(embree::newDevice()));
  Impl& t = *impl_;
  t.items = &items;
  t.setFlags(t.scene.get());
  for (int k = 0; k < int(items.size()); ++k) {
    const Item& item = items[k];
    if (!item.triangles) {
      const bool finite = !item.bounds.isInfinite();
      (finite ? t.groups[maskOf(item)].members : t.unbounded).push_back(k);
    } else if (item.triangles->size() == 0) {
      continue;
    } else if (item.baked) {
      t.attach(t.triangleGeometry(*item.triangles).get(), maskOf(item), k);
    } else {
      std::shared_ptr<const MeshTree>& mesh = t.instanced[item.triangles];
      if (!mesh && old && old->instanced.contains(item.triangles))
        mesh = old->instanced.at(item.triangles);
      if (!mesh) mesh = t.meshTree(*item.triangles);
      t.addInstance(mesh->scene.get(), item, k);
    }
  }
  for (auto& [mask, group] : t.groups) {
    group.items = &items;
    t.addGroup(group, mask);
  }
  rtcCommitScene(t.scene.get());
  check(t.device->get(), "building the tree");
}

bool Tree::closest(const Ray& ray, unsigned mask, TreeHit& hit) const noexcept {
  const Impl& t = *impl_;
  Query query;
  query.ray = &ray;
  query.nearest = &hit;
  if (t.unbounded.empty()) return t.closestBounded(query, mask);
  Ray shortened = ray;
  query.ray = &shortened;
  const bool isFound = t.meetUnbounded(shortened, mask, query);
  return t.closestBounded(query, mask) || isFound;
}

bool Tree::occluded(const Ray& ray, unsigned mask) const noexcept {
  const Impl& t = *impl_;
  for (const int k : t.unbounded) {
    const Item& item = (*t.items)[k];
    if ((maskOf(item) & mask) && item.placement.shape->intersect(item.place.object(ray)))
      return true;
  }
  Query query;
  query.ray = &ray;
  embree::initialise(query.context);
  RTCRay r;
  fillRay(r, ray, mask);
  embree::occluded(t.scene.get(), r, query.context);
  return r.tfar < 0;
}

bool Tree::gather(const Ray& ray, unsigned mask, Real from, Layers& layers) const noexcept {
  const Impl& t = *impl_;
  for (const int k : t.unbounded) {
    const Item& item = (*t.items)[k];
    if (!(maskOf(item) & mask)) continue;
    if (item.isLayer)
      gatherShape(item, k, ray, layers);
    else if (item.placement.shape->intersect(item.place.object(ray)))
      return false;
  }
  Query query;
  query.ray = &ray;
  query.items = t.items;
  query.itemOfGeometry = &t.itemOfGeometry;
  query.layers = &layers;
  embree::initialise(query.context);
  RTCRay r;
  fillRay(r, ray, mask);
  r.tnear = std::max(r.tnear, float(from) * (1 - 4 * std::numeric_limits<float>::epsilon()));
  embree::occluded(t.scene.get(), r, query.context);
  return !(r.tfar < 0);
}

}  // namespace vestige
