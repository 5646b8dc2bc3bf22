// SPDX-License-Identifier: Apache-2.0
#include "engine/trace/triangles.h"

#include <map>

#include "engine/trace/place.h"

namespace vestige {
namespace {

/// Embree leaves out what lies beyond; we do so ourselves, to count it.
constexpr Real kFarthest = Real(1e18);

/// In double: the normal of a sliver is a difference of products that nearly cancel.
struct Exact {
  double x, y, z;
};
Exact difference(Vec3 a, Vec3 b) noexcept {
  return {double(a.x) - b.x, double(a.y) - b.y, double(a.z) - b.z};
}
Exact product(Exact a, Exact b) noexcept {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
double scalar(Exact a, Exact b) noexcept { return a.x * b.x + a.y * b.y + a.z * b.z; }
double norm(Exact a) noexcept { return std::sqrt(scalar(a, a)); }
/// Normal of a triangle, twice its area long.
Exact across(const std::vector<Vec3>& p, const std::array<std::uint32_t, 3>& c) noexcept {
  return product(difference(p[c[1]], p[c[0]]), difference(p[c[2]], p[c[0]]));
}
Vec3 rounded(Exact a) noexcept { return {Real(a.x), Real(a.y), Real(a.z)}; }

}  // namespace

Triangles::Triangles(const TriangleMesh& mesh, const Affine& toSpace)
    : source_(&mesh), toSpace_(toSpace), side_(toSpace.determinant() < 0 ? Real(-1) : Real(1)) {
  positions_.reserve(mesh.positions.size());
  for (const Vec3 p : mesh.positions) positions_.push_back(toSpace.point(p));
  if (mesh.normals.size() == mesh.positions.size()) {
    const Mat3 carry = Place(toSpace).normals;
    normals_.reserve(mesh.normals.size());
    for (const Vec3 n : mesh.normals) normals_.push_back(carry * n);
  }
  hasUvs_ = mesh.uvs.size() == mesh.positions.size();
  triangles_.reserve(mesh.triangles.size());
  for (const auto& corners : mesh.triangles)
    if (isSound(corners)) triangles_.push_back(corners);
  dropped_ = mesh.triangles.size() - triangles_.size();
  faces_.reserve(triangles_.size());
  for (std::uint32_t k = 0; k < size(); ++k) {
    const Exact n = across(positions_, triangles_[k]);
    const double s = double(side_) / norm(n);
    faces_.push_back(rounded({s * n.x, s * n.y, s * n.z}));
  }
}

bool Triangles::isSound(const std::array<std::uint32_t, 3>& corners) const noexcept {
  for (const std::uint32_t i : corners)
    if (i >= positions_.size() || !(maxAbsComponent(positions_[i]) < kFarthest) ||
        !isFinite(positions_[i]))
      return false;
  const Vec3 a = positions_[corners[0]];
  const Exact ab = difference(positions_[corners[1]], a),
              ac = difference(positions_[corners[2]], a);
  // Thinner than 1e-10 of its length: no area that rounding of the corners has not made up.
  return norm(product(ab, ac)) > 1e-10 * std::max(scalar(ab, ab), scalar(ac, ac));
}

Bounds Triangles::bounds() const noexcept {
  Bounds b;
  for (const auto& corners : triangles_)
    for (const std::uint32_t i : corners) b.add(positions_[i]);
  return b;
}

Triangles::Edges Triangles::edges(std::uint32_t triangle) const noexcept {
  const auto& c = triangles_[triangle];
  const Vec3 a = positions_[c[0]];
  return {a, positions_[c[1]] - a, positions_[c[2]] - a, faces_[triangle]};
}

Real Triangles::area(std::uint32_t triangle) const noexcept {
  return Real(norm(across(positions_, triangles_[triangle])) / 2);
}

bool Triangles::isWatertight() const {
  // Corners of a seam differ in their normal or uv: one number for all at the same position.
  std::map<std::array<Real, 3>, std::uint32_t> known;
  std::vector<std::uint32_t> corner;
  for (const Vec3 p : positions_) {
    // + 0: -0 is the same place. No triangle has a corner that is not finite.
    const Vec3 at = isFinite(p) ? p : Vec3{};
    const std::array<Real, 3> key{at.x + 0, at.y + 0, at.z + 0};
    corner.push_back(known.try_emplace(key, std::uint32_t(known.size())).first->second);
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges, reversed;
  double volume = 0;  // six times that, by signed tetrahedra
  for (const auto& c : triangles_) {
    for (const int k : {0, 1, 2}) {
      edges.push_back({corner[c[k]], corner[c[(k + 1) % 3]]});
      reversed.push_back({edges.back().second, edges.back().first});
    }
    const Vec3 from = positions_[triangles_[0][0]];
    volume += scalar(difference(positions_[c[0]], from), across(positions_, c));
  }
  std::sort(edges.begin(), edges.end());
  std::sort(reversed.begin(), reversed.end());
  const bool isOnce = std::adjacent_find(edges.begin(), edges.end()) == edges.end();
  return isOnce && edges == reversed && double(side_) * volume > 0;
}

Real Triangles::at(std::uint32_t triangle, Vec2 b, SurfacePoint& s) const noexcept {
  const auto& c = triangles_[triangle];
  const Vec3 p0 = positions_[c[0]], p1 = positions_[c[1]], p2 = positions_[c[2]];
  // In double and rounded once: so the point is off the plane by its own rounding only, however
  // large the triangle.
  const auto blend = [b](Real x0, Real x1, Real x2) {
    return Real(double(x0) + b.x * (double(x1) - x0) + b.y * (double(x2) - x0));
  };
  s.position = {blend(p0.x, p1.x, p2.x), blend(p0.y, p1.y, p2.y), blend(p0.z, p1.z, p2.z)};
  s.geometricNormal = s.normal = faces_[triangle];
  s.uv = b;
  s.dPdu = p1 - p0, s.dPdv = p2 - p0;
  s.dNdu = s.dNdv = s.dPduu = s.dPduv = s.dPdvv = {};
  const Real extent = std::max(maxAbsComponent(s.dPdu), maxAbsComponent(s.dPdv));
  if (!normals_.empty()) bend(s, c);
  if (hasUvs_) followUvs(s, c);
  return extent;
}

void Triangles::bend(SurfacePoint& s, const std::array<std::uint32_t, 3>& c) const noexcept {
  const Vec3 n0 = normals_[c[0]], d1 = normals_[c[1]] - n0, d2 = normals_[c[2]] - n0;
  const Vec3 n = n0 + s.uv.x * d1 + s.uv.y * d2;
  const Real l = length(n);
  if (!(l > Real(1e-6))) return;  // opposite normals blend to nothing: then flat
  s.normal = n / l;
  s.dNdu = (d1 - dot(s.normal, d1) * s.normal) / l;  // [MATH 1.4]
  s.dNdv = (d2 - dot(s.normal, d2) * s.normal) / l;
}

void Triangles::followUvs(SurfacePoint& s, const std::array<std::uint32_t, 3>& c) const noexcept {
  const Vec2 t0 = source_->uvs[c[0]], t1 = source_->uvs[c[1]] - t0, t2 = source_->uvs[c[2]] - t0;
  s.uv = t0 + s.uv.x * t1 + s.uv.y * t2;
  const Real det = cross(t1, t2);
  // Corners on one line of the uv plane: no direction of u, the edges serve as a frame.
  if (!(std::abs(det) > Real(1e-6) * std::sqrt(dot(t1, t1) * dot(t2, t2)))) return;
  const Vec2 bu = Vec2{t2.y, -t1.y} * (1 / det), bv = Vec2{-t2.x, t1.x} * (1 / det);
  const Vec3 ab = s.dPdu, ac = s.dPdv, dNab = s.dNdu, dNac = s.dNdv;
  s.dPdu = bu.x * ab + bu.y * ac, s.dPdv = bv.x * ab + bv.y * ac;
  s.dNdu = bu.x * dNab + bu.y * dNac, s.dNdv = bv.x * dNab + bv.y * dNac;
}

Triangles::Meeting Triangles::meet(std::uint32_t triangle, const Ray& ray) const noexcept {
  const auto& c = triangles_[triangle];
  const Vec3 a = positions_[c[0]];
  const Exact ab = difference(positions_[c[1]], a), ac = difference(positions_[c[2]], a);
  const Exact d = difference(ray.direction, {}), o = difference(ray.origin, a);
  const Exact n = product(ab, ac), q = product(d, o);
  const double dn = scalar(d, n);
  return {Real(-scalar(o, n) / dn), {Real(scalar(q, ac) / dn), Real(-scalar(q, ab) / dn)}};
}

}  // namespace vestige
