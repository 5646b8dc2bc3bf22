// SPDX-License-Identifier: Apache-2.0
#include "engine/trace/place.h"

namespace vestige {
namespace {

/// Cofactors of the linear part over |det|^(2/3), with the sign of the determinant.
Mat3 normalMatrix(const Affine& a, double det) {
  const double scale = std::copysign(std::pow(std::abs(det), -2.0 / 3.0), det);
  Mat3 r;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      r.c[j][i] = Real(scale * (a.m[i1][j1] * a.m[i2][j2] - a.m[i1][j2] * a.m[i2][j1]));
    }
  return r;
}

double largestRow(const Affine& a) {
  double most = 0;
  for (const auto& row : a.m)
    most = std::max(most, std::abs(row[0]) + std::abs(row[1]) + std::abs(row[2]));
  return most;
}

/// Columns of equal length, at right angles.
bool keepsAngles(const Affine& a) {
  double g[3][3] = {};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) g[i][j] += a.m[k][i] * a.m[k][j];
  const double tolerance = 1e-6 * g[0][0];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (!(std::abs(g[i][j] - (i == j ? g[0][0] : 0)) <= tolerance)) return false;
  return true;
}

}  // namespace

Place::Place(const Affine& objectToWorld)
    : toWorld(objectToWorld),
      toObject(objectToWorld.inverse()),
      linear(objectToWorld.linear()),
      normals(normalMatrix(objectToWorld, objectToWorld.determinant())),
      areaScale(Real(std::pow(std::abs(objectToWorld.determinant()), 2.0 / 3.0))),
      norm(Real(largestRow(toWorld))),
      condition(Real(largestRow(toWorld) * largestRow(toObject))),
      shift(Real(std::max(
          {std::abs(toWorld.m[0][3]), std::abs(toWorld.m[1][3]), std::abs(toWorld.m[2][3])}))),
      similarity(keepsAngles(objectToWorld)),
      identity(objectToWorld.isIdentity()) {}

SurfacePoint Place::world(const SurfacePoint& o) const noexcept {
  if (identity) return o;
  SurfacePoint w;
  w.position = toWorld.point(o.position);
  w.geometricNormal = normalize(normals * o.geometricNormal);
  const Vec3 n = normals * o.normal;
  const Real l = length(n);
  w.normal = n / l;
  w.uv = o.uv;
  w.dPdu = linear * o.dPdu, w.dPdv = linear * o.dPdv;
  w.dPduu = linear * o.dPduu, w.dPduv = linear * o.dPduv, w.dPdvv = linear * o.dPdvv;
  const auto turn = [&](Vec3 d) {  // N = n/|n|, so dN = P(N) dn / |n|
    const Vec3 x = normals * d;
    return (x - dot(w.normal, x) * w.normal) / l;
  };
  w.dNdu = turn(o.dNdu), w.dNdv = turn(o.dNdv);
  return w;
}

Bounds Place::bounds(const Bounds& o) const noexcept {
  Bounds w;
  if (o.isEmpty()) return w;
  for (int k = 0; k < 8; ++k)
    w.add(toWorld.point(
        {k & 1 ? o.high.x : o.low.x, k & 2 ? o.high.y : o.low.y, k & 4 ? o.high.z : o.low.z}));
  return w;
}

}  // namespace vestige
