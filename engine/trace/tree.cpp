// SPDX-License-Identifier: Apache-2.0
#include "engine/trace/tree.h"

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
  int item = -1;             ///< of the nearest analytic hit so far
  ShapeHit hit = {};         ///< where
};

std::optional<ShapeHit> meet(const Item& item, const Ray& world, float tFar) noexcept {
  Ray ray = item.place.object(world);
  ray.tMax = std::min(ray.tMax, Real(tFar));
  return item.placement.shape->intersect(ray);
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
  query.item = item, query.hit = *hit;
  ray.ray.tfar = float(hit->t);
  ray.hit.geomID = a->geomID, ray.hit.primID = a->primID;
  ray.hit.instID[0] = a->context->instID[0];
}

void occludePrimitive(const RTCOccludedFunctionNArguments* a) {
  if (!a->valid[0]) return;
  const Group& group = *static_cast<const Group*>(a->geometryUserPtr);
  const Query& query = *reinterpret_cast<const Query*>(a->context);
  auto& ray = *reinterpret_cast<RTCRay*>(a->ray);
  if (meet((*group.items)[group.members[a->primID]], *query.ray, ray.tfar))
    ray.tfar = -std::numeric_limits<float>::infinity();
}

unsigned maskOf(const Item& item) noexcept {
  return item.placement.translucent ? kTranslucent : kOpaque;
}

void fillRay(RTCRay& ray, const Ray& r, unsigned mask) noexcept {
  ray.org_x = float(r.origin.x), ray.org_y = float(r.origin.y), ray.org_z = float(r.origin.z);
  ray.dir_x = float(r.direction.x), ray.dir_y = float(r.direction.y);
  ray.dir_z = float(r.direction.z);
  ray.tnear = float(r.tMin), ray.tfar = float(r.tMax);
  ray.mask = mask, ray.time = 0, ray.id = ray.flags = 0;
}

}  // namespace

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
  Group groups[2];                  ///< opaque, translucent
  std::vector<int> unbounded;       ///< items tested one by one
  std::vector<int> itemOfGeometry;  ///< -1: analytic

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
};

embree::Geometry Tree::Impl::triangleGeometry(const Triangles& t) const {
  embree::Geometry g(rtcNewGeometry(device->get(), RTC_GEOMETRY_TYPE_TRIANGLE));
  auto* p = static_cast<float*>(rtcSetNewGeometryBuffer(
      g.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, t.positions().size()));
  auto* i = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(g.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, t.size()));
  check(device->get(), "storing triangles");
  for (const Vec3 v : t.positions()) *p++ = float(v.x), *p++ = float(v.y), *p++ = float(v.z);
  for (const auto& c : t.indices()) i = std::copy(c.begin(), c.end(), i);
  return g;
}

std::shared_ptr<const MeshTree> Tree::Impl::meshTree(const Triangles& t) const {
  embree::Scene s(rtcNewScene(device->get()));
  setFlags(s.get());
  const embree::Geometry g = triangleGeometry(t);
  rtcSetGeometryMask(g.get(), kEverything);
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
  if (group.members.empty()) return;
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
    if (met) found = true, query.item = k, query.hit = *met, ray.tMax = met->t;
  }
  return found;
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
  for (Group& g : t.groups) g.items = &items;
  for (int k = 0; k < int(items.size()); ++k) {
    const Item& item = items[k];
    if (!item.triangles) {
      const bool finite = !item.bounds.isInfinite();
      (finite ? t.groups[item.placement.translucent].members : t.unbounded).push_back(k);
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
  t.addGroup(t.groups[0], kOpaque);
  t.addGroup(t.groups[1], kTranslucent);
  rtcCommitScene(t.scene.get());
  check(t.device->get(), "building the tree");
}

bool Tree::closest(const Ray& ray, unsigned mask, TreeHit& hit) const noexcept {
  const Impl& t = *impl_;
  Query query;
  query.ray = &ray;
  Ray shortened;
  bool found = false;
  if (!t.unbounded.empty()) {
    shortened = ray, query.ray = &shortened;
    found = t.meetUnbounded(shortened, mask, query);
  }
  RTCRayHit rayHit;
  fillRay(rayHit.ray, *query.ray, mask);
  rayHit.hit.geomID = rayHit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  embree::initialise(query.context);
  embree::intersect(t.scene.get(), rayHit, query.context);
  const RTCHit& h = rayHit.hit;
  if (h.geomID != RTC_INVALID_GEOMETRY_ID) {
    const bool instance = h.instID[0] != RTC_INVALID_GEOMETRY_ID;
    const int item = t.itemOfGeometry[instance ? h.instID[0] : h.geomID];
    if (item >= 0) {
      hit.item = item, hit.primitive = int(h.primID), hit.t = Real(rayHit.ray.tfar);
      hit.b = {Real(h.u), Real(h.v)};
      return true;
    }
    found = true;
  }
  if (found) hit.item = query.item, hit.primitive = query.hit.part, hit.t = query.hit.t;
  return found;
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

}  // namespace vestige
