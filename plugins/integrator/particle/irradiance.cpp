// SPDX-License-Identifier: Apache-2.0
#include "irradiance.h"

#include <algorithm>
#include <unordered_map>

namespace vestige::particle {
namespace {

/// Vertices this close are one, in diameters of the scene.
constexpr Real kSame = Real(1e-6);
/// ... if their normals agree that well: a box keeps its edges.
constexpr Real kSameNormal = Real(0.8);
/// No edge is divided more often than elements are.
constexpr int kMostHalvings = 24;

/// ... but not closer than rounding knows far from the origin.
Real closeness(const Bounds& b) noexcept {
  if (b.isEmpty()) return kSame;
  const Real far = std::max(maxAbsComponent(b.low), maxAbsComponent(b.high));
  return std::max(kSame * length(b.size()), 8 * std::numeric_limits<Real>::epsilon() * far);
}

std::uint32_t mixed(std::uint32_t h, std::uint32_t k) noexcept {
  h = (h ^ k) * 0x9e3779b9u;
  return h ^ (h >> 15);
}

Rgb scaled(const Flux& f, double scale) noexcept {
  return {Real(double(f[0]) * scale), Real(double(f[1]) * scale), Real(double(f[2]) * scale)};
}

}  // namespace

/// One thread, once: what is only needed to build.
class Irradiance::Build {
 public:
  Build(Irradiance& into, const SceneView& scene, const Hierarchy& hierarchy, double scale)
      : to_(into),
        scene_(scene),
        hierarchy_(hierarchy),
        scale_(scale),
        same_(closeness(scene.bounds())) {}

  void run() {
    to_.roots_.assign(hierarchy_.firstCluster(), 0);
    to_.nodes_.resize(4);  // children begin at multiples of four, and 0 is none
    const std::vector<bool> lit = litObjects();
    for (ElementId r = 1; r < hierarchy_.firstCluster(); ++r)
      if (lit[objectSide(r)] && hierarchy_.elements()[r].area > 0) addRoot(r);
    balance();
    for (const auto& level : byDepth_)
      for (const Leaf& l : level)
        if (to_.nodes_[l.node].children == 0) addVertices(l), ++to_.leaves_;
    between_.resize(vertices_.size());
    joinEdges();
    to_.values_.reserve(vertices_.size());
    for (const Vertex& v : vertices_) to_.values_.push_back(v.sum / Real(std::max(1, v.count)));
    for (std::uint32_t v = 0; v < between_.size(); ++v) settle(v);
  }

 private:
  std::size_t objectSide(ElementId root) const noexcept {
    const int object = scene_.patches()[std::size_t(Hierarchy::patchOf(root))].object;
    return std::size_t(2 * object) + (root - 1) % 2;
  }

  /// A side of an object that nothing reached needs no elements.
  std::vector<bool> litObjects() const {
    std::size_t most = 0;
    for (ElementId r = 1; r < hierarchy_.firstCluster(); ++r) most = std::max(most, objectSide(r));
    std::vector<bool> lit(most + 1);
    for (ElementId r = 1; r < hierarchy_.firstCluster(); ++r) {
      bool any = hierarchy_.elements()[r].children != 0;
      for (ElementId e = r; e && !any; e = hierarchy_.elements()[e].parent)
        any = hierarchy_.elements()[e].hits() > 0;
      if (any) lit[objectSide(r)] = true;
    }
    return lit;
  }

  void addRoot(ElementId r) {
    Rgb above;
    for (ElementId e = hierarchy_.elements()[r].parent; e; e = hierarchy_.elements()[e].parent)
      above += density(hierarchy_.elements()[e]);
    const std::uint32_t node = addNodes();
    to_.roots_[r] = node;
    addTree(r, node, above, {node, r, hierarchy_.cellOf(Hierarchy::patchOf(r)), 0});
  }

  std::uint32_t addNodes() {
    to_.nodes_.resize(to_.nodes_.size() + 4);
    return std::uint32_t(to_.nodes_.size() - 4);
  }

  Rgb density(const Element& e) const noexcept {
    return e.area > 0 ? scaled(e.sum(), scale_ / double(e.area)) : Rgb{};
  }

  void addTree(ElementId id, std::uint32_t node, Rgb e, const Leaf& here) {
    const Element& element = hierarchy_.elements()[id];
    e += density(element);
    const ElementId first = element.children;
    const bool isClusters = first == 0 && here.depth == 0 && element.hits() == 0 &&
                            element.parent != 0 && hierarchy_.elements()[element.parent].hits() > 0;
    to_.nodes_[node].level = isClusters ? std::int8_t(-1) : element.level;
    if (first == 0) {
      to_.nodes_[node].e = e;
      remember(here);
      return;
    }
    const std::uint32_t children = addNodes();
    to_.nodes_[node].children = children;
    for (int k = 0; k < 4; ++k)
      addTree(first + ElementId(k), children + std::uint32_t(k), e,
              {children + std::uint32_t(k), here.root, here.cell.child(k), here.depth + 1});
  }

  void remember(const Leaf& l) {
    if (byDepth_.size() <= std::size_t(l.depth)) byDepth_.resize(std::size_t(l.depth) + 1);
    byDepth_[std::size_t(l.depth)].push_back(l);
  }

  // ------------------------------------------------------------ balance: neighbours one level
  // apart
  void balance() {
    for (std::size_t depth = byDepth_.size(); depth-- > 2;)
      for (std::size_t i = 0; i < byDepth_[depth].size(); ++i) {
        const Leaf leaf = byDepth_[depth][i];
        for (int edge = 0; edge < leaf.cell.corners(); ++edge) divideBeyond(leaf, edge);
      }
  }

  /// Until what lies beyond the edge, on the same patch, is not more than twice as wide.
  void divideBeyond(const Leaf& leaf, int edge) {
    const Cell whole = hierarchy_.cellOf(Hierarchy::patchOf(leaf.root));
    const Vec2 middle = edgeMiddle(leaf.cell, edge);
    const Vec2 away = middle - (leaf.cell.isTriangle ? Vec2{Real(1) / 3, Real(1) / 3}
                                                     : Vec2{Real(0.5), Real(0.5)});
    const Vec2 p = leaf.cell.at(middle + Real(0.01) * away);
    Vec2 local = {(p.x - whole.origin.x) / whole.a.x, (p.y - whole.origin.y) / whole.b.y};
    if (local.x < 0 || local.y < 0 || local.x > 1 || local.y > 1) return;
    if (whole.isTriangle && local.x + local.y > 1) return;
    Leaf at{to_.roots_[leaf.root], leaf.root, whole, 0};
    for (; at.depth < leaf.depth - 1; ++at.depth) {
      if (to_.nodes_[at.node].children == 0) divide(at);
      const int k = descend(local, whole.isTriangle);
      at.node = to_.nodes_[at.node].children + std::uint32_t(k), at.cell = at.cell.child(k);
    }
  }

  void divide(const Leaf& at) {
    const std::uint32_t children = addNodes();
    Node& parent = to_.nodes_[at.node];
    parent.children = children;
    for (int k = 0; k < 4; ++k) {
      Node& c = to_.nodes_[children + std::uint32_t(k)];
      c.e = parent.e, c.level = parent.level, c.isAdded = true;
      remember({children + std::uint32_t(k), at.root, at.cell.child(k), at.depth + 1});
    }
  }

  static Vec2 edgeMiddle(const Cell& c, int edge) noexcept {
    return Real(0.5) * (c.corner(edge) + c.corner((edge + 1) % c.corners()));
  }

  // ------------------------------------------------------------ vertices
  void addVertices(const Leaf& l) {
    Node& n = to_.nodes_[l.node];
    for (int i = 0; i < l.cell.corners(); ++i) {
      const std::uint32_t v = vertex(l, l.cell.at(l.cell.corner(i)), true);
      n.vertices[i] = v;
      vertices_[v].sum += n.e, ++vertices_[v].count;
    }
  }

  /// The vertex at a point of the leaf's patch; kNone if there is none and `make` is false.
  std::uint32_t vertex(const Leaf& l, Vec2 uv, bool make) {
    const SurfacePoint s = scene_.patchPoint(Hierarchy::patchOf(l.root), uv);
    const Vec3 normal = (l.root - 1) % 2 ? -s.normal : s.normal;
    // Grid cells are much wider than the tolerance: a second cell is seldom searched.
    const Real width = 16 * same_;
    const Vec3 low = (s.position - Vec3{same_, same_, same_}) / width;
    const Vec3 high = (s.position + Vec3{same_, same_, same_}) / width;
    for (double x = std::floor(low.x); x <= high.x; ++x)
      for (double y = std::floor(low.y); y <= high.y; ++y)
        for (double z = std::floor(low.z); z <= high.z; ++z) {
          const auto found = grid_.find(key(x, y, z));
          for (std::uint32_t v = found == grid_.end() ? kNone : found->second; v != kNone;
               v = vertices_[v].next)
            if (lengthSquared(vertices_[v].position - s.position) <= sqr(same_) &&
                dot(vertices_[v].normal, normal) > kSameNormal)
              return v;
        }
    if (!make) return kNone;
    const Vec3 at = s.position / width;
    const auto [entry, isNew] = grid_.try_emplace(
        key(std::floor(double(at.x)), std::floor(double(at.y)), std::floor(double(at.z))), kNone);
    const auto id = std::uint32_t(vertices_.size());
    vertices_.push_back({s.position, normal, {}, 0, entry->second});
    entry->second = id;
    return id;
  }

  static std::uint64_t key(double x, double y, double z) noexcept {
    const auto part = [](double v) { return std::uint64_t(std::int64_t(v)) & 0x1fffff; };
    return part(x) << 42 | part(y) << 21 | part(z);
  }

  /// A vertex in the middle of another leaf's edge is interpolated between the edge's ends, or
  /// there is a crack.
  void joinEdges() {
    for (const auto& level : byDepth_)
      for (const Leaf& l : level) {
        const Node& n = to_.nodes_[l.node];
        if (n.children != 0) continue;
        for (int i = 0; i < l.cell.corners(); ++i) {
          const int j = (i + 1) % l.cell.corners();
          joinEdge(l, l.cell.at(l.cell.corner(i)), l.cell.at(l.cell.corner(j)), n.vertices[i],
                   n.vertices[j], 0);
        }
      }
  }
  void joinEdge(const Leaf& l, Vec2 a, Vec2 b, std::uint32_t va, std::uint32_t vb, int halvings) {
    if (va == vb || halvings > kMostHalvings) return;
    const Vec2 middle = Real(0.5) * (a + b);
    const std::uint32_t v = vertex(l, middle, false);
    if (v == kNone || v == va || v == vb) return;
    const Real longness = length(vertices_[va].position - vertices_[vb].position);
    if (longness > between_[v].length) between_[v] = {va, vb, longness};
    joinEdge(l, a, middle, va, v, halvings + 1);
    joinEdge(l, middle, b, v, vb, halvings + 1);
  }

  /// The ends of the edge first, which may hang on others; four patches in a ring may hang on each
  /// other.
  void settle(std::uint32_t v) {
    Between& b = between_[v];
    if (b.length <= 0 || b.isSettled) return;
    b.isSettled = true;
    settle(b.a), settle(b.b);
    to_.values_[v] = Real(0.5) * (to_.values_[b.a] + to_.values_[b.b]);
  }

  static constexpr std::uint32_t kNone = ~std::uint32_t(0);

  Irradiance& to_;
  const SceneView& scene_;
  const Hierarchy& hierarchy_;
  const double scale_;
  const Real same_;
  std::vector<std::vector<Leaf>> byDepth_;
  std::vector<Vertex> vertices_;
  std::unordered_map<std::uint64_t, std::uint32_t> grid_;
  std::vector<Between> between_;  ///< by vertex
};

Irradiance::Irradiance(const SceneView& scene, const Hierarchy& hierarchy, double scale)
    : hierarchy_(&hierarchy) {
  Build(*this, scene, hierarchy, scale).run();
}

bool Irradiance::covers(const PatchPoint& p) const noexcept {
  return hierarchy_ && hierarchy_->keeps(p);
}

Irradiance::Found Irradiance::find(const PatchPoint& p) const noexcept {
  const ElementId root = hierarchy_ ? hierarchy_->root(p) : 0;
  if (root == 0 || roots_[root] == 0) return {nullptr, {}, 0};
  const bool isTriangle = hierarchy_->cellOf(p.patch).isTriangle;
  Found f{&nodes_[roots_[root]], hierarchy_->local(p), mixed(root, 0)};
  while (f.node->children != 0) {
    const int k = descend(f.local, isTriangle);
    f.node = &nodes_[f.node->children + std::uint32_t(k)];
    if (!f.node->isAdded) f.path = mixed(f.path, std::uint32_t(k) + 1);
  }
  return f;
}

Rgb Irradiance::at(const PatchPoint& p, bool smooth) const noexcept {
  const Found f = find(p);
  if (!f.node) return {};
  if (!smooth) return f.node->e;
  const auto value = [&](int i) { return values_[f.node->vertices[i]]; };
  const Real u = f.local.x, v = f.local.y;
  if (hierarchy_->cellOf(p.patch).isTriangle)
    return (1 - u - v) * value(0) + u * value(1) + v * value(2);
  return (1 - v) * ((1 - u) * value(0) + u * value(1)) + v * ((1 - u) * value(3) + u * value(2));
}

ElementInfo Irradiance::element(const PatchPoint& p) const noexcept {
  const Found f = find(p);
  if (!f.node) return {};
  return {f.node->level, f.path >> 8};
}

SeenElement Irradiance::seen(const PatchPoint& p) const noexcept {
  ElementId id = hierarchy_ ? hierarchy_->root(p) : 0;
  if (id == 0) return {};
  // Not by the nodes: balancing has divided some elements that are one.
  const Elements& all = hierarchy_->elements();
  const bool isTriangle = hierarchy_->cellOf(p.patch).isTriangle;
  Vec2 local = hierarchy_->local(p);
  while (const ElementId first = all[id].children)
    id = first + ElementId(descend(local, isTriangle));
  const ElementInfo info = element(p);
  if (info.level < 0) id = all[id].parent;
  const Real area = Real(all[id].area);
  return {info.level, info.id, area, area * at(p, false), all[id].hits()};
}

}  // namespace vestige::particle
