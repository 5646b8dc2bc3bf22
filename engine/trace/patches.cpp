// SPDX-License-Identifier: Apache-2.0
#include "engine/trace/patches.h"

namespace vestige {
namespace {

int countOf(const Item& item) noexcept {
  if (item.triangles) return int(item.triangles->size());
  return item.bounds.isInfinite() ? 1 : item.placement.shape->faces();
}

/// Share of the triangle u + v <= 1 that lies in a rectangle, times its area 1/2.
double clippedArea(Vec2 low, Vec2 high) noexcept {
  const auto corner = [](double u, double v) {  // of all right and above of (u, v)
    const double x = std::max(0.0, 1 - u - v);
    return x * x / 2;
  };
  const double u0 = std::clamp<double>(low.x, 0, 1), v0 = std::clamp<double>(low.y, 0, 1);
  const double u1 = std::clamp<double>(high.x, u0, 1), v1 = std::clamp<double>(high.y, v0, 1);
  return corner(u0, v0) - corner(u1, v0) - corner(u0, v1) + corner(u1, v1);
}

/// Gauss and Legendre's rule on [-1, 1]: half of its nodes, the others are their negatives
/// [Abramowitz, Stegun 1964, table 25.4].
struct Rule {
  int nodes;
  double at[4], weight[4];
};
constexpr Rule kEight = {
    8,
    {0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363},
    {0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763}};
constexpr Rule kTwo = {2, {0.5773502691896257}, {1}};
/// Panels along each side of a face: the area element of a squashed sphere is smooth but steep.
constexpr double kPanels = 4;
/// Parts no wider than this are nearly flat.
constexpr double kSmall = 1. / 16;

/// Integral of |dP/du x dP/dv| and of the normal over a part of a face, world.
struct Integral {
  double area = 0;
  double normal[3] = {};
};

template <class Visit>
void quadrature(const Rule& rule, double low, double high, Visit visit) noexcept {
  const int panels = std::max(1, int(std::ceil(kPanels * (high - low))));
  const double h = (high - low) / panels / 2;
  for (int p = 0; p < panels; ++p)
    for (int k = 0; k < rule.nodes; ++k) {
      const double x = k % 2 ? -rule.at[k / 2] : rule.at[k / 2];
      visit(low + h * (2 * p + 1 + x), h * rule.weight[k / 2]);
    }
}

Integral integrate(const Item& item, int face, Vec2 low, Vec2 high) noexcept {
  Integral sum;
  const Rule& rule =
      std::max(double(high.x - low.x), double(high.y - low.y)) <= kSmall ? kTwo : kEight;
  quadrature(rule, low.x, high.x, [&](double u, double wu) {
    quadrature(rule, low.y, high.y, [&](double v, double wv) {
      const SurfacePoint s = item.place.world(item.placement.shape->at({Real(u), Real(v)}, face));
      const double dA = wu * wv * length(cross(s.dPdu, s.dPdv));
      sum.area += dA;
      for (int k = 0; k < 3; ++k) sum.normal[k] += dA * s.geometricNormal[k];
    });
  });
  return sum;
}

/// Of a face: its points on a grid, with room for what bulges between them.
Bounds boundsOfFace(const Item& item, int face) noexcept {
  constexpr int n = 16;
  if (item.placement.shape->faces() == 1) return item.bounds;
  Bounds b;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j)
      b.add(item.place.toWorld.point(
          item.placement.shape->at({Real(i) / n, Real(j) / n}, face).position));
  const Vec3 room = Real(0.02) * b.size();  // an arc bulges by 1 - cos(pi / n)
  return {maximum(b.low - room, item.bounds.low), minimum(b.high + room, item.bounds.high)};
}

Patch trianglePatch(const Item& item, int triangle) noexcept {
  const Triangles::Edges e = item.triangles->edges(std::uint32_t(triangle));
  Patch p{item.placement.object, item.triangles->area(std::uint32_t(triangle)), {}, e.normal, true};
  Vec3 corners[3] = {e.a, e.a + e.ab, e.a + e.ac};
  if (!item.baked) {
    for (Vec3& c : corners) c = item.place.toWorld.point(c);
    p.area *= item.place.stretch(e.normal);
    p.normal = normalize(item.place.normals * e.normal);
  }
  for (const Vec3 c : corners) p.bounds.add(c);
  return p;
}

Patch facePatch(const Item& item, int face) noexcept {
  if (item.bounds.isInfinite()) {
    const Vec3 n = item.place.world(item.placement.shape->surface({}, ShapeHit{})).geometricNormal;
    return {item.placement.object, kInfinity, item.bounds, n, false};
  }
  const Integral whole = integrate(item, face, {0, 0}, {1, 1});
  Vec3 n = {Real(whole.normal[0]), Real(whole.normal[1]), Real(whole.normal[2])};
  n = length(n) > Real(1e-3) * Real(whole.area) ? normalize(n) : Vec3{};
  return {item.placement.object, Real(whole.area), boundsOfFace(item, face), n, false};
}

}  // namespace

void Patches::number(const std::vector<Item>& items) {
  items_ = &items;
  first_.assign(1, 0);
  for (const Item& item : items) {
    const std::int64_t next = std::int64_t(first_.back()) + countOf(item);
    first_.push_back(int(std::min<std::int64_t>(next, std::numeric_limits<int>::max())));
  }
}

int Patches::index(int item, int primitive) const noexcept {
  const std::int64_t k = std::int64_t(first_[item]) + primitive;
  return k < first_[item + 1] ? int(k) : -1;
}

void Patches::make() const {
  patches_.reserve(first_.back());
  for (std::size_t k = 0; k < items_->size(); ++k) {
    const Item& item = (*items_)[k];
    for (int j = 0; j < first_[k + 1] - first_[k]; ++j)
      patches_.push_back(item.triangles ? trianglePatch(item, j) : facePatch(item, j));
  }
}

std::span<const Patch> Patches::all() const noexcept {
  if (!items_) return {};
  std::call_once(once_, [this] { make(); });
  return patches_;
}

int Patches::owner(int patch) const noexcept {
  return int(std::upper_bound(first_.begin(), first_.end(), patch) - first_.begin()) - 1;
}

SurfacePoint Patches::point(int patch, Vec2 uv) const noexcept {
  const int k = owner(patch);
  const Item& item = (*items_)[std::size_t(k)];
  const int part = patch - first_[std::size_t(k)];
  if (item.triangles) {
    SurfacePoint s;
    item.triangles->at(std::uint32_t(part), uv, s);
    return item.baked ? s : item.place.world(s);
  }
  if (!item.bounds.isInfinite()) return item.place.world(item.placement.shape->at(uv, part));
  SurfacePoint s = item.place.world(item.placement.shape->surface({}, ShapeHit{}));
  s.position += (uv.x - s.uv.x) * s.dPdu + (uv.y - s.uv.y) * s.dPdv;
  s.uv = uv;
  return s;
}

Real Patches::area(int patch, Vec2 low, Vec2 high) const noexcept {
  const int k = owner(patch);
  const Item& item = (*items_)[k];
  const int part = patch - first_[k];
  if (item.triangles) return Real(2 * clippedArea(low, high)) * trianglePatch(item, part).area;
  if (item.bounds.isInfinite()) {  // uv in scene units
    const SurfacePoint s = item.place.world(item.placement.shape->surface({}, ShapeHit{}));
    return length(cross(s.dPdu, s.dPdv)) * (high.x - low.x) * (high.y - low.y);
  }
  return Real(integrate(item, part, low, high).area);
}

}  // namespace vestige
