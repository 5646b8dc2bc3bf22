// SPDX-License-Identifier: Apache-2.0
// Base class of flat lights with an area. A derived class gives the outline and the radiance; this
// class implements the methods of Light.
//
//     class Disc final : public AreaLight {
//      public:
//       explicit Disc(const Values& v) {
//         const Aim a = ownAim(v, kLocation, kPointAt);
//         place(v.toWorld(), a.location, v.real(kRadius) * a.frame.s, v.real(kRadius) * a.frame.t);
//       }
//       Disk outline(Vec2 u) const noexcept override { return concentricDisk(u); }
//       Rgb radiance(Vec2 at, Vec3 d) const noexcept override;
//     };
#pragma once
#include <vestige/light.h>
#include <vestige/tools/aim.h>
#include <vestige/tools/sampling.h>

namespace vestige {

/// Gradient of the log of a radiance's luminance.
struct RadianceGradient {
  Vec2 at{};         ///< per unit of the plane's coordinates
  Vec3 direction{};  ///< 1/rad, in the light's own frame; what lies along d does not count
};

/// Points are drawn uniformly by area.
class AreaLight : public Light {
 public:
  using Differences = AreaLight;

  /// The point of the plane for a pair of random numbers, with its derivatives. Uniform by area:
  /// |du[0] x du[1]| is constant. The rim of the unit square maps to the rim of the light.
  virtual Disk outline(Vec2 u) const noexcept = 0;

  /// Radiance from a point of the plane along unit d, d.z > 0, W/(m^2 sr). d is in the light's own
  /// frame, where z is the normal.
  virtual Rgb radiance(Vec2 at, Vec3 d) const noexcept = 0;

  /// Called only where the radiance is not black. By default: finite differences, and a note to the
  /// user.
  virtual RadianceGradient logRadianceGradient(Vec2 at, Vec3 d) const noexcept;

  const TriangleMesh* geometry() const noexcept override { return &mesh_; }

  std::optional<LightSample> sample(const Receiver& r, Vec2 u) const noexcept override {
    const Vec2 at = outline(u).d;
    const Vec3 position = world(at), way = position - r.position;
    const Real distance = length(way);
    if (!(distance > 0)) return std::nullopt;
    std::optional<LightSample> s(std::in_place);
    s->hit = {r.position, way / distance, distance, position, frame_.n, at};
    s->hit.offset = offset_;
    s->radiance = eval(s->hit);
    s->pdf = AreaLight::pdf(r, s->hit);
    if (!(s->pdf > 0) || !std::isfinite(s->pdf)) s.reset();
    return s;
  }

  Real pdf(const Receiver&, const LightHit& hit) const noexcept override {
    const Real c = -dot(frame_.n, hit.toLight);
    return c > 0 ? sqr(hit.distance) / (area_ * c) : 0;
  }

  Rgb eval(const LightHit& hit) const noexcept override {
    const Vec3 d = frame_.toLocal(-hit.toLight);
    return d.z > 0 ? radiance(hit.uv, d) : Rgb{};
  }

  LightJacobian sampleDerivatives(const Receiver& r, Vec2 u) const noexcept override {
    const Disk p = outline(u);
    const Vec3 way = world(p.d) - r.position;  // [MATH 1.11]
    const Mat3 turn = (1 / length(way)) * projection(normalize(way));
    return {.du = turn * edges(p), .dFrom = Real(-1) * turn};
  }

  LightLogGradient logGradient(const Receiver& r, Vec2 u) const noexcept override {
    const Disk p = outline(u);
    const Vec3 way = world(p.d) - r.position, d = frame_.toLocal(-normalize(way));
    const Real c = dot(frame_.n, way);
    if (!(d.z > 0) || !(luminance(radiance(p.d, d)) > 0)) return {};
    const RadianceGradient g = logRadianceGradient(p.d, d);
    // log(cos / distance^2) = log |normal . way| - 3/2 log way^2; d turns against the way.
    const Vec3 turned = projection(normalize(way)) * frame_.toWorld(g.direction) / length(way);
    const Vec3 dWay = frame_.n / c - 3 / lengthSquared(way) * way - turned;
    const Mat3x2 e = edges(p);
    return {{dot(dWay, e.c[0]) + dot(g.at, p.du[0]), dot(dWay, e.c[1]) + dot(g.at, p.du[1])},
            -dWay};
  }

  std::optional<Particle> emit(EmissionNumbers u) const noexcept override {
    const Vec2 at = outline(u.point).d;
    const Vec3 d = cosineHemisphere(u.direction).d;
    return Particle{.origin = world(at),
                    .direction = frame_.toWorld(d),
                    .normal = frame_.n,
                    .power = kPi * area_ * radiance(at, d),  // radiance cos / (cos / pi . 1 / area)
                    .variables = 4};
  }

  RayJacobian emissionDerivatives(EmissionNumbers u) const noexcept override {
    const Mat3x2 e = edges(outline(u.point)), du = cosineHemisphere(u.direction).du;
    return {.dOrigin = {e.c[0], e.c[1]},
            .dDirection = {Vec3{}, Vec3{}, frame_.toWorld(du.c[0]), frame_.toWorld(du.c[1])}};
  }

  LightExtent extent() const noexcept override {
    LightExtent e{{}, frame_.n, 0};
    for (const Vec3& p : mesh_.positions) e.box.add(p);
    return e;
  }

  /// By default the mean over 64 x 64 evenly spread particles. Called once a scene, not once a
  /// path.
  Rgb power() const noexcept override {
    constexpr int n = 64;
    Rgb sum;
    for (int i = 0; i < n * n; ++i) {
      // Each direction of a grid starts from a different point: an additive sequence by powers of
      // the plastic number.
      const double x = 0.5 + i * 0.7548776662466927, y = 0.5 + i * 0.5698402909980532;
      const Vec2 point = {Real(x - std::floor(x)), Real(y - std::floor(y))};
      const Vec2 direction = {(i % n + Real(0.5)) / n, (i / n + Real(0.5)) / n};
      sum += radiance(outline(point).d, cosineHemisphere(direction).d);
    }
    return kPi * area_ / (n * n) * sum;
  }

 protected:
  /// Places the plane, in the block's own space; call it in the constructor of a final class.
  /// Points are centre + x s + y t. The light shines to the side of cross(s, t).
  void place(const Affine& toWorld, Vec3 centre, Vec3 s, Vec3 t);

  const Frame& frame() const noexcept { return frame_; }
  Real area() const noexcept { return area_; }

 private:
  Vec3 world(Vec2 at) const noexcept { return centre_ + plane_ * at; }
  Mat3x2 edges(const Disk& p) const noexcept { return {plane_ * p.du[0], plane_ * p.du[1]}; }

  Vec3 centre_;
  Mat3x2 plane_{};
  Frame frame_{};    ///< orthonormal: s along the plane's s, n the side that shines
  Real area_ = 0;    ///< world, scene units squared
  Real offset_ = 0;  ///< LightHit::offset
  TriangleMesh mesh_;
};

inline RadianceGradient AreaLight::logRadianceGradient(Vec2 at, Vec3 d) const noexcept {
  const Real here = std::log(luminance(radiance(at, d)));
  const auto slope = [&](const auto& moved) {
    const auto map = [&](Real h) -> std::optional<Real> {
      const Real l = moved(h);
      return l > 0 ? std::optional(std::log(l)) : std::nullopt;
    };
    return differences::derivative(map, here, differences::kStep, 1 + std::abs(here));
  };
  const auto along = [&](Vec3 tangent) {
    return slope([&](Real h) {
      const Vec3 turned = differences::turned(d, tangent, h);
      return turned.z > 0 ? luminance(radiance(at, turned)) : Real(0);
    });
  };
  const Frame f = Frame::along(d, {0, 0, 1});
  return {{slope([&](Real h) {
             return luminance(radiance({at.x + h, at.y}, d));
           }),
           slope([&](Real h) {
             return luminance(radiance({at.x, at.y + h}, d));
           })},
          along(f.s) * f.s + along(f.t) * f.t};
}

inline void AreaLight::place(const Affine& toWorld, Vec3 centre, Vec3 s, Vec3 t) {
  constexpr int kSide = 24;  // points of the rim, for each side of the square
  centre_ = toWorld.point(centre);
  plane_ = {toWorld.vector(s), toWorld.vector(t)};
  const bool isMirrored = toWorld.determinant() < 0;
  const Vec3 across = (isMirrored ? Real(-1) : Real(1)) * cross(plane_.c[0], plane_.c[1]);
  frame_ = Frame::along(normalize(across), plane_.c[0]);
  const Disk middle = outline({Real(0.5), Real(0.5)});
  area_ = length(across) * std::abs(cross(middle.du[0], middle.du[1]));
  offset_ = kRayError * std::max(maxAbsComponent(plane_.c[0]), maxAbsComponent(plane_.c[1]));
  mesh_ = {};
  const auto add = [&](Vec2 at) {
    mesh_.positions.push_back(world(at));
    mesh_.uvs.push_back(at);
  };
  add(middle.d);
  for (int i = 0; i < 4 * kSide; ++i) {
    const Real x = Real(i % kSide) / kSide;
    const Vec2 rim[4] = {{x, 0}, {1, x}, {1 - x, 1}, {0, 1 - x}};
    add(outline(rim[i / kSide]).d);
  }
  // The rim's orientation depends on whether the maps preserve orientation.
  const bool isTurned = (cross(middle.du[0], middle.du[1]) < 0) != isMirrored;
  for (std::uint32_t i = 0; i < 4 * kSide; ++i) {
    const std::uint32_t a = 1 + i, b = 1 + (i + 1) % (4 * kSide);
    mesh_.triangles.push_back(isTurned ? std::array{0u, b, a} : std::array{0u, a, b});
  }
}

}  // namespace vestige
