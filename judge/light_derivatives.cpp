// SPDX-License-Identifier: Apache-2.0
#include "judge/light_maps.h"
#include "judge/ray_differences.h"

namespace vestige::judge {
namespace {

/// Whether a point is near the border of the square or the rim of a concentric disk, where
/// derivatives have no bound.
bool isSmoothAt(Vec2 u) {
  return differsSmoothly(u, Real(0.025)) &&
         std::max(std::abs(2 * u.x - 1), std::abs(2 * u.y - 1)) < Real(0.85);
}

/// Log of the radiance, and of cos / distance^2 where a point of the light was drawn by area.
std::optional<Real> logFactor(const Light& light, const Receiver& from, Vec2 u) {
  const auto s = light.sample(from, u);
  if (!s) return std::nullopt;
  const Real measure =
      light.geometry() ? std::abs(dot(s->hit.normal, s->hit.toLight)) / sqr(s->hit.distance) : 1;
  const Real f = luminance(s->radiance) * measure;
  return f > Real(1e-20) ? std::optional(std::log(f)) : std::nullopt;
}

}  // namespace

Finding lightAreaIsInverseDensity(const LightCases& cases, const Effort& effort) {
  Finding f{"|du.c0 x du.c1| pdf = 1", "sampleDerivatives().du"};
  forLightEvents(cases, effort, [&](const LightCase& c, const Receiver& from, Vec2 u, Random&) {
    const auto s = c.light->sample(from, u);
    if (!s || c.light->traits().isDelta) return;
    const Mat3x2 du = c.light->sampleDerivatives(from, u).du;
    const double area = double(length(cross(du.c[0], du.c[1])) * s->pdf);
    const double stretch = double(length(du.c[0]) * length(du.c[1]) * s->pdf);
    f.worst.see(std::abs(area - 1) / ((kDouble ? 1e-9 : 2e-3) + 50 * kEpsilon * stretch),
                [&] { return lightEvent(c, from, u, told("|du0 x du1| pdf is", area, 1)); });
  });
  return f;
}

Finding lightDuIsTheDerivative(const LightCases& cases, const Effort& effort) {
  Finding f{"du is the derivative of sample() by its random numbers", "sampleDerivatives().du"};
  forLightEvents(cases, effort, [&](const LightCase& c, const Receiver& from, Vec2 u, Random&) {
    if (!c.light->sample(from, u) || !isSmoothAt(u)) return;
    const LightJacobian j = c.light->sampleDerivatives(from, u);
    for (const int k : {0, 1}) {
      const auto map = [&](double h) { return toLight(*c.light, from, u + Real(h) * axis2(k)); };
      seeDifference(f, map, j.du.c[k], 1, "du.c" + std::to_string(k),
                    [&](const std::string& what) { return lightEvent(c, from, u, what); });
    }
  });
  return f;
}

Finding lightFromIsTheDerivative(const LightCases& cases, const Effort& effort) {
  Finding f{"dFrom is the derivative of sample() by from", "sampleDerivatives().dFrom"};
  forLightEvents(cases, effort, [&](const LightCase& c, const Receiver& from, Vec2 u, Random&) {
    if (!c.light->sample(from, u)) return;
    const LightJacobian j = c.light->sampleDerivatives(from, u);
    for (const int k : {0, 1, 2}) {
      const auto map = [&](double h) { return toLight(*c.light, moved(from, k, h), u); };
      seeDifference(f, map, j.dFrom * axis3(k), 1, "dFrom.c" + std::to_string(k),
                    [&](const std::string& what) { return lightEvent(c, from, u, what); });
    }
  });
  return f;
}

Finding lightLogGradientIsTheDerivative(const LightCases& cases, const Effort& effort) {
  Finding f{"logGradient() is the derivative of the log of the light's factor", "logGradient()"};
  forLightEvents(cases, effort, [&](const LightCase& c, const Receiver& from, Vec2 u, Random&) {
    const auto here = logFactor(*c.light, from, u);
    if (!here || !isSmoothAt(u)) return;
    const LightLogGradient g = c.light->logGradient(from, u);
    const double noise = 1 + std::abs(double(*here));
    const auto describe = [&](const std::string& what) { return lightEvent(c, from, u, what); };
    for (int k = 0; k < 5; ++k) {
      // As the first component of a vector, so that one comparison serves all.
      const auto map = [&](double h) -> std::optional<Vec3> {
        const Receiver at = k < 2 ? from : moved(from, k - 2, h);
        const auto l = logFactor(*c.light, at, k < 2 ? u + Real(h) * axis2(k) : u);
        return l ? std::optional(Vec3{*l, 0, 0}) : std::nullopt;
      };
      const Real found = k < 2 ? (k == 0 ? g.du.x : g.du.y) : g.dFrom[k - 2];
      seeDifference(f, map, {found, 0, 0}, noise, k < 2 ? "du" : "dFrom", describe);
    }
  });
  return f;
}

Finding emissionIsTheDerivative(const LightCases& cases, const Effort& effort) {
  Finding f{"emissionDerivatives() are those of emit()", "emissionDerivatives()"};
  forLightEvents(cases, effort, [&](const LightCase& c, const Receiver&, Vec2 point, Random& r) {
    const EmissionNumbers u = {point, r.pair()};
    const auto p = c.light->emit(u);
    const Vec2 half = {2 * u.direction.x - std::floor(2 * u.direction.x), u.direction.y};
    if (!p || !isSmoothAt(u.point) || !isSmoothAt(u.direction) || !isSmoothAt(half)) return;
    if (std::abs(p->direction.z) < Real(0.2)) return;  // Frame::around jumps at z = 0
    const RayJacobian j = c.light->emissionDerivatives(u);
    const auto describe = [&](const std::string& what) {
      std::ostringstream text;
      text.precision(9);
      text << what << "; direction numbers " << u.direction;
      Event e = lightEvent(c, {}, u.point, text.str());
      e.where = "", e.what = what;
      return e;
    };
    for (int k = 0; k < 4; ++k) {
      const auto direction = [&](double h) { return movedDirection(*c.light, u, k, h); };
      const auto origin = [&](double h) { return movedOrigin(*c.light, u, p->direction, k, h); };
      const std::string number = std::to_string(k);
      seeDifference(f, direction, j.dDirection[k], 1, "dDirection[" + number + "]", describe);
      seeDifference(f, origin, j.dOrigin[k], 1 + sizeOf(p->origin), "dOrigin[" + number + "]",
                    describe);
    }
  });
  return f;
}

}  // namespace vestige::judge
