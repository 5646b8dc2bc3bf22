// SPDX-License-Identifier: Apache-2.0
// Whatever the schema allows and wherever one stands, no light and no camera answers with NaN,
// infinity or a negative density: the ends of the random numbers, points in the plane of a light,
// on it, a hair above it and far away, film corners, films like ribbons.
#include <vestige/camera.h>
#include <vestige/light.h>

#include <map>

#include "support/catch.h"
#include "support/harsh.h"
#include "support/lights.h"

namespace vestige::test {
namespace {

/// A point that looks: anywhere near, far away, or at some height above a point of the light.
Vec3 lookout(const Light& light, Random& r) {
  const Vec3 anywhere = r.point(-3, 3);
  const Real kind = r.number();
  if (kind < Real(0.4)) return anywhere;
  if (kind < Real(0.5)) return Real(1e4) * anywhere;
  const auto p = light.emit({harshPair(r), harshPair(r)});
  if (!p) return anywhere;
  const Vec3 normal = isUnit(p->normal) ? p->normal : p->direction;
  // In its plane, or 1e-4 to 1 above it.
  const Real height = r.number() < Real(0.3) ? 0 : std::pow(Real(10), r.number(-4, 0));
  const Vec3 across = r.number() < Real(0.5) ? Vec3{} : projection(normal) * anywhere;
  return p->origin + height * normal + across;
}

/// The promise that a light breaks, or "".
std::string brokenPromise(const Light& light, Vec3 from, Vec2 u) {
  const auto s = light.sample(from, u);
  if (!s) return "";
  if (!isUnit(s->hit.toLight)) return "toLight is no unit vector";
  if (!(s->hit.distance > 0)) return "the distance is not positive";
  if (!isColour(s->radiance)) return "the radiance is no colour";
  if (!(s->pdf > 0) || !std::isfinite(s->pdf)) return "the sample's pdf is not positive";
  if (!isDensity(light.pdf(s->hit))) return "pdf() is no density";
  if (!isColour(light.eval(s->hit))) return "eval() is no colour";
  const LightJacobian j = light.sampleDerivatives(from, u);
  if (!isFinite(j.du) || !isFinite(j.dFrom)) return "sampleDerivatives is not finite";
  const LightLogGradient g = light.logGradient(from, u);
  if (!isFinite(g.dFrom) || !std::isfinite(g.du.x + g.du.y)) return "logGradient is not finite";
  return "";
}
std::string brokenPromise(const Light& light, EmissionNumbers u) {
  const auto p = light.emit(u);
  if (!p) return "";
  if (!isFinite(p->origin)) return "a particle's origin is not finite";
  if (!isUnit(p->direction)) return "a particle's direction is no unit vector";
  if (!isColour(p->power)) return "a particle's power is no colour";
  return isFinite(light.emissionDerivatives(u)) ? "" : "emissionDerivatives is not finite";
}

std::string brokenPromise(const Camera& camera, CameraNumbers n) {
  const auto s = camera.sample(n);
  if (!s) return "";
  if (!isFinite(s->origin) || !isUnit(s->direction)) return "the ray is none";
  if (!isColour(s->weight)) return "the weight is no colour";
  if (!isDensity(camera.pdf(s->origin, s->direction, n.aspect))) return "pdf() is no density";
  return isFinite(camera.sampleDerivatives(n)) ? "" : "sampleDerivatives is not finite";
}

}  // namespace

TEST_CASE("light: nothing is ever infinite, negative or not a number", "[light][fuzz]") {
  Random r(51);
  std::vector<HarshCase<Light>> cases = harshCases<Light>("light", 60, r);
  for (const HarshCase<Light>& c : cases) c.made->setScene({{-3, -2, -3}, {3, 2, 4}});
  for (const LightCase& c : lightCases()) cases.push_back({c.name, c.light});
  std::map<std::string, int> broken;
  for (const HarshCase<Light>& c : cases)
    for (int i = 0; i < 1000; ++i) {
      const Vec3 from = lookout(*c.made, r);
      const Vec2 u = harshPair(r), v = harshPair(r);
      for (const std::string& what :
           {brokenPromise(*c.made, from, u), brokenPromise(*c.made, EmissionNumbers{u, v})}) {
        if (what.empty() || broken[what]++ > 0) continue;
        FAIL_CHECK(what << ": " << c.title << "; from " << from.x << ", " << from.y << ", "
                        << from.z << "; u " << u.x << ", " << u.y << "; " << v.x << ", " << v.y);
      }
    }
  CHECK(cases.size() > 5 * 60);
}

TEST_CASE("camera: nothing is ever infinite or not a number", "[camera][fuzz]") {
  Random r(52);
  const std::vector<HarshCase<Camera>> cases = harshCases<Camera>("camera", 100, r);
  CHECK(cases.size() >= 4 * 100);
  const auto end = [&] {
    const Real x = harsh(r);
    return x == kOneMinusEpsilon ? Real(1) : x;  // the film's far edge belongs to it
  };
  std::map<std::string, int> broken;
  for (const HarshCase<Camera>& c : cases)
    for (int i = 0; i < 500; ++i) {
      const Real x = end(), y = end();
      const CameraNumbers n = {{x, y}, harshPair(r), std::pow(Real(10), r.number(-2, 2))};
      const std::string what = brokenPromise(*c.made, n);
      if (what.empty() || broken[what]++ > 0) continue;
      FAIL_CHECK(what << ": " << c.title << "; film " << x << ", " << y << "; lens " << n.lens.x
                      << ", " << n.lens.y << "; aspect " << n.aspect);
    }
}

}  // namespace vestige::test
