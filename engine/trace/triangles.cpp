// SPDX-License-Identifier: Apache-2.0
#include "engine/trace/triangles.h"

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

Real Triangles::at(std::uint32_t triangle, Vec2 b, SurfacePoint& s) const noexcept {
  const Edges e = edges(triangle);
  const auto& c = triangles_[triangle];
  const Vec3 p[3] = {positions_[c[0]], positions_[c[1]], positions_[c[2]]};
  // In double and rounded once: so the point is off the plane by its own rounding only, however
  // large the triangle.
  for (int k = 0; k < 3; ++k)
    s.position[k] = Real(double(p[0][k]) + b.x * (double(p[1][k]) - p[0][k]) +
                         b.y * (double(p[2][k]) - p[0][k]));
  s.geometricNormal = e.normal;
  shade(s, c, b, e);
  return std::max(maxAbsComponent(e.ab), maxAbsComponent(e.ac));
}

void Triangles::shade(SurfacePoint& s, const std::array<std::uint32_t, 3>& c, Vec2 b,
                      const Edges& e) const noexcept {
  s.normal = s.geometricNormal;
  Vec3 dN[2];  // by b [MATH 1.4]
  if (!normals_.empty()) {
    const Vec3 n0 = normals_[c[0]], d1 = normals_[c[1]] - n0, d2 = normals_[c[2]] - n0;
    const Vec3 n = n0 + b.x * d1 + b.y * d2;
    const Real l = length(n);
    if (l > Real(1e-6)) {  // opposite normals blend to nothing: then flat
      s.normal = n / l;
      dN[0] = (d1 - dot(s.normal, d1) * s.normal) / l;
      dN[1] = (d2 - dot(s.normal, d2) * s.normal) / l;
    }
  }
  s.uv = b;
  s.dPduu = s.dPduv = s.dPdvv = {};
  s.dPdu = e.ab, s.dPdv = e.ac, s.dNdu = dN[0], s.dNdv = dN[1];
  if (source_->uvs.size() != positions_.size()) return;
  const Vec2 t0 = source_->uvs[c[0]], t1 = source_->uvs[c[1]] - t0, t2 = source_->uvs[c[2]] - t0;
  s.uv = t0 + b.x * t1 + b.y * t2;
  const Real det = cross(t1, t2);
  // Corners on one line of the uv plane: no direction of u, the edges serve as a frame.
  if (!(std::abs(det) > Real(1e-6) * std::sqrt(dot(t1, t1) * dot(t2, t2)))) return;
  const Vec2 bu = Vec2{t2.y, -t1.y} * (1 / det), bv = Vec2{-t2.x, t1.x} * (1 / det);
  s.dPdu = bu.x * e.ab + bu.y * e.ac, s.dPdv = bv.x * e.ab + bv.y * e.ac;
  s.dNdu = bu.x * dN[0] + bu.y * dN[1], s.dNdv = bv.x * dN[0] + bv.y * dN[1];
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
