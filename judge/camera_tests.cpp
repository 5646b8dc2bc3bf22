// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "judge/camera_maps.h"
#include "judge/harsh.h"
#include "judge/plain.h"
#include "judge/ray_differences.h"

namespace vestige::judge {
namespace {

struct Broken {
  const char *method, *what;
};

std::optional<Broken> brokenPromise(const Camera& camera, CameraNumbers n) {
  const auto s = camera.sample(n);
  if (!s) return std::nullopt;
  if (!isFinite(s->origin) || !isUnit(s->direction)) return Broken{"sample()", "the ray is none"};
  if (!isColour(s->weight)) return Broken{"sample().weight", "the weight is no colour"};
  if (!isDensity(camera.pdf(s->origin, s->direction, n.aspect)))
    return Broken{"pdf()", "pdf() is no density"};
  if (!isFinite(camera.sampleDerivatives(n)))
    return Broken{"sampleDerivatives()", "sampleDerivatives() is not finite"};
  return std::nullopt;
}

}  // namespace

Event cameraEvent(const CameraCase& c, CameraNumbers n, const std::string& what) {
  std::ostringstream line, where;
  line.precision(9), where.precision(3);
  line << c.title << "  film " << n.film << "  lens " << n.lens << "  aspect " << n.aspect << ": "
       << what;
  where << "at film " << n.film;
  return {line.str(), where.str(), what};
}

CameraCases cameraCases(const Plugin& plugin, int sets, unsigned seed, TriedRows* rows) {
  CameraCases cases;
  TriedRows ignored;
  if (!rows) rows = &ignored;
  Random r(seed + 31);
  for (int tried = 0; int(cases.size()) < sets && tried < 50 * sets; ++tried) {
    const Settings s = tried == 0 ? Settings{} : plainSettings(*plugin.schema, r);
    rows->offer(s);
    try {
      cases.push_back(
          {"camera " + plugin.name + " {" + textOfSettings(s) + " }", make<Camera>(plugin, s)});
      rows->accept(s);
    } catch (const std::runtime_error&) {
      continue;  // settings that contradict each other
    }
  }
  return cases;
}

Finding cameraRaysAreDifferentiated(const CameraCases& cases, const Effort& effort) {
  Finding f{"sampleDerivatives() are those of sample()", "sampleDerivatives()"};
  forCameraEvents(cases, effort, [&](const CameraCase& c, CameraNumbers n, Random&) {
    const auto s = c.camera->sample(n);
    if (!s || !differsSmoothly(n.lens, Real(0.02))) return;
    if (std::max(std::abs(n.film.x - Real(0.5)), std::abs(n.film.y - Real(0.5))) > Real(0.47))
      return;
    const RayJacobian j = c.camera->sampleDerivatives(n);
    const auto describe = [&](const std::string& what) { return cameraEvent(c, n, what); };
    for (int k = 0; k < 4; ++k) {
      const auto direction = [&](double h) { return movedRay(*c.camera, n, k, h, true); };
      const auto origin = [&](double h) { return movedRay(*c.camera, n, k, h, false); };
      const std::string number = fmt::format("[{}]", k);
      seeDifference(f, direction, j.dDirection[k], 1, "dDirection" + number, describe);
      seeDifference(f, origin, j.dOrigin[k], sizeOf(s->origin), "dOrigin" + number, describe);
    }
  });
  return f;
}

Finding cameraAreaIsInverseDensity(const CameraCases& cases, const Effort& effort) {
  Finding f{"|dDirection[0] x dDirection[1]| pdf() = 1", "pdf()"};
  forCameraEvents(cases, effort, [&](const CameraCase& c, CameraNumbers n, Random&) {
    const auto s = c.camera->sample(n);
    if (!s || std::abs(n.film.y - Real(0.5)) > Real(0.49)) return;  // near the pole of a panorama
    const Real pdf = c.camera->pdf(s->origin, s->direction, n.aspect);
    if (pdf == 0) return;
    const RayJacobian j = c.camera->sampleDerivatives(n);
    const double area = double(length(cross(j.dDirection[0], j.dDirection[1])) * pdf);
    f.worst.see(std::abs(area - 1) / (kDouble ? 1e-9 : 2e-3), [&] {
      return cameraEvent(c, n, told("|dDirection[0] x dDirection[1]| pdf() is", area, 1));
    });
  });
  return f;
}

Finding cameraIsNeverNan(const CameraCases& cases, const Effort& effort) {
  Finding f{"nothing is infinite, negative or not a number", "all"};
  forCameraEvents(cases, effort, [&](const CameraCase& c, CameraNumbers, Random& r) {
    const auto end = [&] {
      const Real x = harsh(r);
      return x == kOneMinusEpsilon ? Real(1) : x;  // the film's far edge belongs to it
    };
    const Real x = end(), y = end();
    const Vec2 film = {x, y}, lens = harshPair(r);
    const CameraNumbers n = {film, lens, std::pow(Real(10), r.number(-2, 2))};
    const auto broken = brokenPromise(*c.camera, n);
    f.worst.see(broken ? HUGE_VAL : 0, [&] {
      f.method = broken->method;
      return cameraEvent(c, n, broken->what);
    });
  });
  return f;
}

}  // namespace vestige::judge
