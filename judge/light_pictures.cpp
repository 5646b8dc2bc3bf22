// SPDX-License-Identifier: Apache-2.0
// Pictures of a light from a suitable receiver, and of its particles.
#include "judge/light_maps.h"
#include "judge/light_sphere.h"
#include "judge/pictures.h"
#include "judge/ray_differences.h"

namespace vestige::judge {
namespace {

constexpr int kSide = 128;
const char* const kAround =
    " Across: around +y, -180 to 180 degrees, +z in the middle, +x right of it; up: y, -1 to 1.";

std::string told(Vec3 v) {
  std::ostringstream text;
  text.precision(3);
  text << v;
  return text.str();
}

/// The receiver among several candidates whose directions to the light are spread most evenly.
Vec3 placeToLook(const Light& light, unsigned seed) {
  Random r(seed);
  Vec3 best;
  double most = -1;
  for (int i = 0; i < 64; ++i) {
    const Vec3 from = r.point(-3, 3);
    double spread = 0;
    for (int k = 0; k < 64; ++k)
      if (const auto s = light.sample({from}, r.pair())) spread += 1 / (1 + double(s->pdf));
    if (spread > most) most = spread, best = from;
  }
  return best;
}

/// The hit of a ray with the light's surface, or at infinity.
std::optional<LightHit> hitOf(const Light& light, Vec3 from, Vec3 d) {
  if (light.traits().isInfinite) return LightHit{from, d, kInfinity, {}, {}, {}};
  const TriangleMesh* mesh = light.geometry();
  if (!mesh) return std::nullopt;
  std::optional<LightHit> nearest;
  for (const auto& t : mesh->triangles) {
    const Vec3 a = mesh->positions[t[0]], b = mesh->positions[t[1]] - a,
               c = mesh->positions[t[2]] - a, across = cross(b, c);
    const Real way = dot(a - from, across) / dot(d, across);
    const Vec3 q = from + way * d - a;
    const Real x = dot(cross(q, c), across) / lengthSquared(across);
    const Real y = dot(cross(b, q), across) / lengthSquared(across);
    if (!(way > 0 && x >= 0 && y >= 0 && x + y <= 1)) continue;
    if (nearest && nearest->distance <= way) continue;
    nearest = LightHit{from, d, way, from + way * d, normalize(across), {x, y}};
  }
  return nearest;
}

Picture density(const LightCase& c, Vec3 from, const Effort& effort) {
  const int samples = std::max(effort.samples, 1 << 18);
  const double cell = 4 * M_PI / kSphereCells;
  Grid seen{kSphereColumns, kSphereRows};
  Random r(effort.seed);
  for (int i = 0; i < samples; ++i)
    if (const auto d = toLight(*c.light, {from}, r.pair()))
      cellTowards(seen, zUp(*d)) += 1 / (samples * cell);
  const Grid density = sphereOf([&](Vec3 d) {
    const auto hit = hitOf(*c.light, from, yUp(d));
    return hit ? c.light->pdf({from}, *hit) : 0;
  });
  const double white = std::max(largest(density), 1e-30);
  return {"density.png", greyPanels({seen, density}, white),
          "directions towards " + c.title + " from " + told(from) +
              ": left by sample(), right by pdf(); white is " + withUnit(white, "/sr") + "." +
              kAround};
}

/// Flux through a sphere, W/m^2: of particles, and of sample().
Picture flux(const LightCase& c, const Effort& effort) {
  constexpr int kParticles = 1 << 20, kPerPoint = 16;
  Random r(effort.seed);
  const LightSphere s = sphereFor(*c.light, r);
  const double cell = 4 * M_PI * double(sqr(s.radius)) / kSphereCells;
  Grid brought{kSphereColumns, kSphereRows};
  for (int i = 0; i < kParticles; ++i)
    if (const auto p = c.light->emit({r.pair(), r.pair()}))
      if (const auto at = crossing(*p, s, c.light->traits().isInfinite))
        cellTowards(brought, zUp(normalize(*at))) +=
            double(luminance(p->power)) / (kParticles * cell);
  const Grid arriving = sphereOf([&](Vec3 z) {
    const Vec3 d = yUp(z), normal = c.light->traits().isInfinite ? d : -d;
    const int n = c.light->traits().isDelta ? 1 : kPerPoint;
    double sum = 0;
    for (int i = 0; i < n; ++i)
      sum += irradiance(*c.light, s.centre + s.radius * d, normal, r.pair());
    return sum / n;
  });
  const double white = std::max(largest(arriving), 1e-30);
  return {"flux.png", greyPanels({brought, arriving}, white),
          "what crosses a sphere of radius " + withUnit(double(s.radius), "") + " around " +
              told(s.centre) +
              ": left what particles of emit() bring, right by sample(); white is " +
              withUnit(white, " W/m^2") + "." + kAround};
}

/// Error of du at random numbers u, in units of the tolerance.
double errorOfDu(const Light& light, Vec3 from, Vec2 u) {
  if (!light.sample({from}, u)) return kNothingSaid;
  const Mat3x2 du = light.sampleDerivatives({from}, u).du;
  double error = kNothingSaid;
  for (const int k : {0, 1}) {
    const auto map = [&](double h) { return toLight(light, {from}, u + Real(h) * axis2(k)); };
    if (const auto e = compared(map, du.c[k], 1)) error = std::max(error, e->error);
  }
  return error;
}

/// Error of the derivatives of a particle's origin and direction by its random numbers k and k + 1.
double errorOfParticle(const Light& light, EmissionNumbers u, int first) {
  const auto p = light.emit(u);
  if (!p) return kNothingSaid;
  const RayJacobian j = light.emissionDerivatives(u);
  double error = kNothingSaid;
  for (int k = first; k < first + 2; ++k) {
    const auto direction = [&](double h) { return movedDirection(light, u, k, h); };
    const auto origin = [&](double h) { return movedOrigin(light, u, p->direction, k, h); };
    if (const auto e = compared(direction, j.dDirection[k], 1)) error = std::max(error, e->error);
    if (const auto e = compared(origin, j.dOrigin[k], 1 + sizeOf(p->origin)))
      error = std::max(error, e->error);
  }
  return error;
}

Picture derivative(const LightCase& c, Vec3 from) {
  const Grid errors = gridOf(kSide, kSide, [&](double x, double y) {
    return errorOfDu(*c.light, from, {Real(x), Real(y)});
  });
  return {"derivative.png", errorPanels({errors}),
          "error of sampleDerivatives().du against differences of sample(), from " + told(from) +
              ". Across: u.x, 0 to 1; down: u.y, 0 to 1; " + kErrorColours + "."};
}

Picture emission(const LightCase& c) {
  const Vec2 still = {Real(0.3), Real(0.4)};
  const auto panel = [&](int first) {
    return gridOf(kSide, kSide, [&](double x, double y) {
      const Vec2 u = {Real(x), Real(y)};
      return errorOfParticle(*c.light, {first == 0 ? u : still, first == 0 ? still : u}, first);
    });
  };
  return {"emission.png", errorPanels({panel(0), panel(2)}),
          "error of emissionDerivatives() against differences of emit(): left over its numbers "
          "`point`, right over `direction`, the others at <0.3, 0.4>. Across: x, 0 to 1; down: y, "
          "0 to 1; " +
              kErrorColours + "."};
}

}  // namespace

std::vector<Picture> lightPictures(const LightCase& c, const Effort& effort) {
  std::vector<Picture> list;
  if (!c.light->traits().isDelta) {
    const Vec3 from = placeToLook(*c.light, effort.seed);
    list = {density(c, from, effort), derivative(c, from)};
  }
  if (c.emits) {
    list.push_back(flux(c, effort));
    list.push_back(emission(c));
  }
  return list;
}

}  // namespace vestige::judge
