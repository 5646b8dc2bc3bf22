// SPDX-License-Identifier: Apache-2.0
#include "engine/light/surface_light.h"

#include <vestige/footprint/differentials.h>
#include <vestige/tools/differences.h>
#include <vestige/tools/sampling.h>

namespace vestige {

LightSample SurfaceLight::seen(Vec3 from, const SurfacePoint& p, Vec3 toLight, Real distance,
                               Real pdf) const {
  LightHit hit{from, toLight, distance, p.position, p.geometricNormal, p.uv};
  hit.offset = offset_;
  return {hit, radiance_(p), pdf};
}

std::optional<LightSample> SurfaceLight::sample(const Receiver& r, Vec2 u) const noexcept {
  const std::optional<AreaSample> a = draw(u);
  if (!a) return std::nullopt;
  const Vec3 way = a->point.position - r.position;
  const Real distance = length(way);
  if (!(distance > 0)) return std::nullopt;
  const Vec3 toLight = way / distance;
  const Real cosine = std::abs(dot(a->point.geometricNormal, toLight));
  if (!(cosine > 0) || !shinesTo(a->point.geometricNormal, toLight)) return std::nullopt;
  return seen(r.position, a->point, toLight, distance, a->pdf * distance * distance / cosine);
}

Real SurfaceLight::pdf(const Receiver&, const LightHit& hit) const noexcept {
  const Real cosine = std::abs(dot(hit.normal, hit.toLight));
  if (!(cosine > 0) || !shinesTo(hit.normal, hit.toLight)) return 0;
  return areaPdf(hit.normal) * hit.distance * hit.distance / cosine;
}

Rgb SurfaceLight::eval(const LightHit& hit) const noexcept {
  if (!shinesTo(hit.normal, hit.toLight)) return {};
  SurfacePoint p;
  p.position = hit.position, p.uv = hit.uv;
  p.geometricNormal = p.normal = hit.normal;
  return radiance_(p);
}

LightJacobian SurfaceLight::sampleDerivatives(const Receiver& r, Vec2 u) const noexcept {
  const std::optional<AreaSample> a = draw(u);
  if (!a) return {};
  const Vec3 way = a->point.position - r.position;
  const Real distance = length(way);
  if (!(distance > 0)) return {};
  const Mat3 across = (1 / distance) * projection(way / distance);  // d(W) = P(W) (dP - dV) / d
  return {across * a->du, Real(-1) * across};
}

LightLogGradient SurfaceLight::logGradient(const Receiver& r, Vec2 u) const noexcept {
  const std::optional<AreaSample> a = draw(u);
  if (!a) return {};
  const Vec3 way = a->point.position - r.position;
  const Real distance = length(way);
  if (!(distance > 0)) return {};
  const Vec3 w = way / distance, n = a->point.geometricNormal;
  const Real cosine = dot(n, w);
  if (std::abs(cosine) < Real(1e-3)) return {};  // grazing: grows without bound [MATH 3.4]
  // log (n.w / d^2): (dn.w + n.dw) / (n.w) - 2 w.(dP - dV) / d [MATH 1.14]
  const Vec3 slope = (Real(1) / cosine * (n - cosine * w) - Real(2) * w) / distance;  // by dP
  const auto along = [&](Vec3 dP, Vec3 dN) {
    return dot(slope, dP) + dot(dN, w) / cosine + radianceSlope(a->point, dP);
  };
  return {{along(a->du.c[0], a->dNdu.c[0]), along(a->du.c[1], a->dNdu.c[1])}, -slope};
}

Real SurfaceLight::radianceSlope(const SurfacePoint& p, Vec3 dP) const noexcept {
  const Real here = luminance(radiance_(p));
  if (!(here > 0)) return 0;
  SurfaceMotion motion;
  motion.arrive(p, -p.geometricNormal);
  const Vec2 dUv = {dot(motion.du, dP), dot(motion.dv, dP)};
  const auto moved = [&](Real h) -> std::optional<Real> {
    SurfacePoint q = p;
    q.position += h * dP, q.uv = q.uv + h * dUv;
    return luminance(radiance_(q));
  };
  return differences::derivative(moved, here, differences::kStep, here) / here;
}

SurfaceLight::Side SurfaceLight::side(Vec2 u) const noexcept {
  if (!twoSided_) return {1, u, 1};
  const bool back = u.x >= Real(0.5);
  return {back ? Real(-1) : Real(1), {2 * u.x - (back ? 1 : 0), u.y}, 2};
}

std::optional<Particle> SurfaceLight::emit(EmissionNumbers u) const noexcept {
  if (!isDrawn_) return std::nullopt;
  const std::optional<AreaSample> a = draw(u.point);
  if (!a) return std::nullopt;
  const Side s = side(u.direction);
  const Vec3 n = s.sign * a->point.geometricNormal;
  const Vec3 direction = normalize(Frame::around(n).toWorld(cosineHemisphere(s.u).d));
  // L cos / (pdf of the point x cos / pi x 1/2 where there are two sides to choose from)
  return Particle{a->point.position, direction, n, s.stretch * kPi / a->pdf * radiance_(a->point),
                  4};
}

RayJacobian SurfaceLight::emissionDerivatives(EmissionNumbers u) const noexcept {
  const std::optional<AreaSample> a = draw(u.point);
  if (!a) return {};
  const Side s = side(u.direction);
  const Vec3 n = s.sign * a->point.geometricNormal;
  const Frame frame = Frame::around(n);
  const Direction d = cosineHemisphere(s.u);
  const Vec3 direction = frame.toWorld(d.d);
  RayJacobian j;
  for (int k = 0; k < 2; ++k) {
    j.dOrigin[k] = a->du.c[k];
    j.dDirection[k] = cross(cross(n, s.sign * a->dNdu.c[k]), direction);  // [MATH 1.12]
  }
  j.dDirection[2] = s.stretch * frame.toWorld(d.du.c[0]);
  j.dDirection[3] = frame.toWorld(d.du.c[1]);
  return j;
}

LightExtent SurfaceLight::extent() const noexcept {
  LightExtent e = oneSided();
  if (twoSided_) e.spread = kPi;
  return e;
}

Rgb SurfaceLight::power() const noexcept { return kPi * area() * (twoSided_ ? 2 : 1) * mean_; }

}  // namespace vestige
