// SPDX-License-Identifier: Apache-2.0
#include "engine/scene/material.h"

namespace vestige {
namespace {

/// A shading normal is bent until it sees the path at this cosine at least.
constexpr Real kLeastCosine = Real(1e-3);

/// A texture may say anything; smaller refractive indices are taken as this.
constexpr Real kLeastIndex = Real(0.1);

Vec2 linearUv(const Affine& a, Vec2 d) noexcept {
  const Vec3 v = a.vector({d.x, d.y, 0});
  return {v.x, v.y};
}

InputValue toInput(const Rgba& c, const Material::TexturedInput& t) noexcept {
  const auto within = [&](Real x) { return std::clamp(x, t.low, t.high); };
  if (t.isReal) return {{within(luminance(c.colour)), 0, 0, 1}};
  return {{within(c.colour.r), within(c.colour.g), within(c.colour.b), c.alpha}};
}

/// Tangent-space normal of a map, on the surface's own side. u runs along s, v along t as the
/// surface's uv do, so mirrored uv read correctly.
Vec3 mappedNormal(const Surface& s, Vec3 normal, Rgb map) noexcept {
  const Frame f = Frame::along(normal, s.dPdu);
  const Real sign = dot(f.t, s.dPdv) < 0 ? Real(-1) : Real(1);
  const Vec3 local{2 * map.r - 1, sign * (2 * map.g - 1), std::max(2 * map.b - 1, Real(1e-3))};
  return normalize(f.toWorld(local));
}

/// The nearest normal to n that toPrev sees at kLeastCosine.
Vec3 bent(Vec3 n, Vec3 toPrev) noexcept {
  const Real c = dot(n, toPrev);
  if (c >= kLeastCosine) return n;
  // n' = a across + b toPrev with unit length and n'.toPrev = kLeastCosine
  const Vec3 across = n - c * toPrev;
  const Real l = length(across);
  if (!(l > 0)) return toPrev;
  return kLeastCosine * toPrev + (safeSqrt(1 - sqr(kLeastCosine)) / l) * across;
}

/// Refractive indices on both sides of a surface.
struct Sides {
  Real inFront, behind;
};
/// Its own index is that of the place where it was looked up, those of other solids are means. An
/// open surface has its own index behind it: docs/adr/0012.
Sides indicesAt(const Material& m, const Surface& s, const Inputs& inputs,
                const Real* indices) noexcept {
  const Sides around{indices[s.mediaInFront.top()], indices[s.mediaBehind.top()]};
  if (m.refractiveIndex < 0) return around;
  const Real own = m.indexOf(inputs);
  if (s.solid == 0) return {around.inFront, own};
  return {s.mediaInFront.top() == s.solid ? own : around.inFront,
          s.mediaBehind.top() == s.solid ? own : around.behind};
}

}  // namespace

Lookup PlacedPigment::inside(const Lookup& outside) const noexcept {
  Lookup lookup;
  lookup.position = fromScene.point(outside.position);
  const Vec3 uv = fromUv.point({outside.uv.x, outside.uv.y, 0});
  lookup.uv = {uv.x, uv.y};
  for (const int i : {0, 1}) {
    lookup.footprint.dP[i] = fromScene.vector(outside.footprint.dP[i]);
    lookup.footprint.dUv[i] = linearUv(fromUv, outside.footprint.dUv[i]);
  }
  lookup.footprint.alongMajor = outside.footprint.alongMajor;
  return lookup;
}

Rgba PlacedPigment::eval(const SurfacePoint& at, const Footprint& footprint) const noexcept {
  return eval(Lookup{at.position, at.uv, footprint});
}

Vec2 PlacedPigment::texels() const noexcept {
  const Vec2 n = pigment->texels();
  // A pigment's own scale packs more or fewer of them into the surface's uv.
  const Vec2 du = linearUv(fromUv, {1, 0}), dv = linearUv(fromUv, {0, 1});
  return {std::hypot(n.x * du.x, n.y * du.y), std::hypot(n.x * dv.x, n.y * dv.y)};
}

Vec2 Material::texels() const noexcept {
  Vec2 finest;
  for (const TexturedInput& t : textured)
    if (const Vec2 m = t.pigment.texels(); m.x * m.y > finest.x * finest.y) finest = m;
  return finest;
}

Real Material::indexOf(const Inputs& evaluated) const noexcept {
  return refractiveIndex < 0 ? Real(1) : std::max(evaluated.real(refractiveIndex), kLeastIndex);
}

bool Material::transmits() const noexcept {
  ScatterPoint p{.toPrev = {0, 0, 1}, .inputs = Inputs(constants.data())};
  p.etaNext = meanIndex();
  constexpr int kTries = 64;
  for (int k = 0; k < kTries; ++k) {
    const Real lobe = (Real(k) + Real(0.5)) / kTries;
    const auto s = brdf->sample(p, {lobe, {Real(0.5), Real(0.5)}});
    if (s && s->toNext.z < 0) return true;
  }
  return false;
}

Rgb Material::cut(Rgb c) const noexcept {
  const auto share = [&](Real x) {
    return cutoff < 0 ? std::clamp(x, Real(0), Real(1)) : Real(x >= cutoff ? 1 : 0);
  };
  return {share(c.r), share(c.g), share(c.b)};
}

Rgb Material::opacityAt(const SurfacePoint& at) const noexcept {
  if (!isTranslucent) return grey(1);
  for (const TexturedInput& t : textured)
    if (t.input == opacity) return cut(t.pigment.eval(at, {}).colour);
  return cut(Inputs(constants.data()).rgb(opacity));
}

Inputs Material::lookUp(const SurfacePoint& at, const Footprint& footprint,
                        InputBuffer& buffer) const noexcept {
  std::copy_n(constants.begin(), inputs, buffer.begin());
  for (const TexturedInput& t : textured)
    buffer[t.input] = toInput(t.pigment.eval(at, t.isFiltered ? footprint : Footprint{}), t);
  return Inputs(buffer.data());
}

void interact(const Material& material, const Surface& surface, Vec3 toPrev,
              const Footprint& footprint, const Real* indices, InputBuffer& buffer,
              Interaction& x) noexcept {
  x.toPrev = toPrev;
  x.brdf = material.brdf.get();
  x.point.inputs = material.evaluate(surface, footprint, buffer);

  Vec3 normal = surface.normal;
  if (dot(normal, surface.geometricNormal) < 0) normal = -normal;
  if (material.hasNormalMap)
    normal = mappedNormal(surface, normal, x.point.inputs.rgb(material.normalMap));
  const bool behind = dot(toPrev, surface.geometricNormal) < 0;
  x.geometricNormal = behind ? -surface.geometricNormal : surface.geometricNormal;
  x.frame = Frame::along(bent(behind ? -normal : normal, toPrev), surface.dPdu);
  x.point.toPrev = x.frame.toLocal(toPrev);
  x.point.behind = behind;
  const Sides eta = indicesAt(material, surface, x.point.inputs, indices);
  x.point.etaPrev = behind ? eta.behind : eta.inFront;
  x.point.etaNext = behind ? eta.inFront : eta.behind;
  x.receiver = {surface.position, x.frame.n, surface.time,
                (behind ? surface.mediaBehind : surface.mediaInFront).top()};
  x.opacity = material.isTranslucent ? material.cut(x.point.inputs.rgb(material.opacity)) : grey(1);
}

}  // namespace vestige
