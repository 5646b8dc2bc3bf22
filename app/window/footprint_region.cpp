// SPDX-License-Identifier: Apache-2.0
#include "app/window/footprint_region.h"

#include <vestige/footprint.h>

#include "engine/scene/scene_impl.h"

namespace vestige::app {
namespace {

/// delta_j under another bound.
Real deltaOf(const VertexDifferentials& d, int j, const Reckoning& how) {
  if (!how.bound) return d.delta[j];
  PathCount count;
  count.begin(std::uint64_t(how.samples - 1), std::uint64_t(how.samples), d.count.variables());
  count.chance(d.count.effective() / d.count.total());
  DeltaPolicy policy;
  policy.bound = *how.bound;
  Real delta = commonDelta(policy, count);
  const bool isFilms = j < 2;
  if (*how.bound == Bound::pixel && !isFilms) delta = 0;
  if (*how.bound == Bound::local && !isFilms) delta = 1;
  const Real g = std::abs(d.gradient[j]);
  return g > 0 ? std::min(delta, how.limit / g) : delta;
}

}  // namespace

Region3 regionOf(const PathVertex& vertex, const Reckoning& how) {
  const VertexDifferentials& d = vertex.differentials;
  const Frame frame = Frame::around(vertex.surface.geometricNormal);
  const auto lifted = [&](Vec2 v) { return v.x * frame.s + v.y * frame.t; };
  Region3 r;
  std::vector<Vec2> flat;
  Covariance m;
  for (int j = 0; j < d.size; ++j) {
    r.deltas.push_back(deltaOf(d, j, how));
    const Vec3 v = r.deltas.back() * d.dVertex[j];
    flat.push_back({dot(v, frame.s), dot(v, frame.t)});
    m.add(flat.back());
    r.vectors.push_back(lifted(flat.back()));
  }
  const Region axes = ellipse(m);
  r.a = lifted(axes.a), r.b = lifted(axes.b);
  r.area = polygonArea(flat);
  std::vector<Vec2> corners(2 * flat.size());
  polygon(flat, corners);
  for (const Vec2 c : corners) r.polygon.push_back(lifted(c));
  r.footprint.dP[0] = r.a, r.footprint.dP[1] = r.b;
  // uv of a vector in the tangent plane, by least squares.
  const Vec3 u = vertex.surface.dPdu, v = vertex.surface.dPdv;
  const Real uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), det = uu * vv - uv * uv;
  if (det > 0)
    for (int i = 0; i < 2; ++i) {
      const Real pu = dot(u, r.footprint.dP[i]), pv = dot(v, r.footprint.dP[i]);
      r.footprint.dUv[i] = {(vv * pu - uv * pv) / det, (uu * pv - uv * pu) / det};
    }
  return r;
}

Image textureAround(Scene& scene, const Surface& surface, const TextureWindow& window, int pixels) {
  const Scene::Impl& impl = scene.impl();
  if (surface.object < 0) return {};
  const Material& m = impl.materials[std::size_t(impl.objectMaterial[std::size_t(surface.object)])];
  if (m.textured.empty()) return {};
  Image image;
  image.width = image.height = pixels;
  image.channels = {"R", "G", "B"};
  image.pixels.resize(std::size_t(pixels) * pixels * 3);
  for (int y = 0; y < pixels; ++y)
    for (int x = 0; x < pixels; ++x) {
      SurfacePoint at = surface;
      const Vec2 by = {window.side * ((Real(x) + Real(0.5)) / Real(pixels) - Real(0.5)),
                       window.side * (Real(0.5) - (Real(y) + Real(0.5)) / Real(pixels))};
      at.uv = window.centre + by;
      const Vec2 off = at.uv - surface.uv;
      at.position = surface.position + off.x * surface.dPdu + off.y * surface.dPdv;
      const Rgb c = m.textured.front().pigment.eval(at, {}).colour;
      float* to = image.at(x, y);
      to[0] = float(c.r), to[1] = float(c.g), to[2] = float(c.b);
    }
  return image;
}

}  // namespace vestige::app
