// SPDX-License-Identifier: Apache-2.0
// Compares a camera's rays through one point of its lens with pdf().
#include <vestige/tools/sampling.h>

#include "judge/camera_tests.h"
#include "judge/statistics.h"

namespace vestige::judge {
namespace {

/// Directions of n uniform film points; fewer if some have no ray.
std::vector<Vec3> drawn(const Camera& camera, Vec2 lens, Real aspect, int n, Random& r) {
  std::vector<Vec3> list;
  for (int i = 0; i < n; ++i)
    if (const auto s = camera.sample({r.pair(), lens, aspect}); s && isFinite(s->direction))
      list.push_back(s->direction);
  return list;
}

/// Integral of the density over each cell, by the solid angles between neighbouring rays of a fine
/// film: a cell's own quadrature would miss the sharp edges of a film.
std::vector<double> overFilm(const Camera& camera, CameraNumbers at, const SpherePartition& cells) {
  constexpr int kFine = 256;
  const auto ray = [&](double x, double y) {
    return camera.sample({{Real(x / kFine), Real(y / kFine)}, at.lens, at.aspect});
  };
  std::vector<double> sums(cells.cells(), 0);
  for (int i = 0; i < kFine * kFine; ++i) {
    const double x = i % kFine, y = i / kFine;
    const auto a = ray(x, y), b = ray(x + 1, y + 1), c = ray(x, y + 1), d = ray(x + 1, y);
    const auto s = ray(x + 0.5, y + 0.5);
    if (!a || !b || !c || !d || !s) continue;
    const double angle =
        double(length(cross(b->direction - a->direction, d->direction - c->direction))) / 2;
    sums[cells.cellOf(s->direction)] +=
        angle * double(camera.pdf(s->origin, s->direction, at.aspect));
  }
  return sums;
}

/// Rough integral over all directions: the density must be zero outside the film.
double overSphere(const Camera& camera, Vec3 origin, Real aspect) {
  constexpr int kFine = 256;
  double sum = 0;
  for (int i = 0; i < kFine * kFine; ++i) {
    const Vec2 u = {(i % kFine + Real(0.5)) / kFine, (i / kFine + Real(0.5)) / kFine};
    sum += double(camera.pdf(origin, uniformCap(u, -1).d, aspect));
  }
  return sum * 4 * M_PI / (kFine * kFine);
}

/// The first ray through the lens point; all its rays share the origin if the camera has a density.
std::optional<CameraSample> oneRay(const Camera& camera, CameraNumbers n, Random& r) {
  for (int i = 0; i < 50; ++i, n.film = r.pair())
    if (const auto s = camera.sample(n)) return s;
  return std::nullopt;
}

void seeDistribution(CameraDensityFindings& f, const CameraCase& c, CameraNumbers at, double level,
                     const Effort& effort, Random& r) {
  const Camera& camera = *c.camera;
  const auto one = oneRay(camera, at, r);
  if (!one || camera.pdf(one->origin, one->direction, at.aspect) == 0) return;
  const int n = effort.samples;
  const SpherePartition cells(drawn(camera, at.lens, at.aspect, std::max(n / 4, 1 << 13), r),
                              effort.depth);
  const std::vector<Vec3> samples = drawn(camera, at.lens, at.aspect, n, r);
  std::vector<double> expected = overFilm(camera, at, cells);
  double mass = 0;
  for (double& e : expected) mass += e, e *= n;
  std::vector<double> seen(cells.cells(), 0);
  for (const Vec3 d : samples) ++seen[cells.cellOf(d)];
  const double share = double(samples.size()) / n, p = chiSquareTest(expected, seen);
  const double ratio = relative(mass, share) > 0.02 ? share / mass : worstRatio(expected, seen);
  f.distribution.worst.see(std::log(std::max(p, 1e-300)) / std::log(level), [&] {
    std::ostringstream text;
    text.precision(3);
    text << "rays of sample() go " << ratio << " times as often there as pdf() predicts (p-value "
         << p << ")";
    return cameraEvent(c, at, text.str());
  });
  const double edge = share < 1 ? 0.02 : 2e-3;  // of what the film sees, cut into cells
  const double deviation = std::sqrt(share * (1 - share) / n) + edge;
  f.mass.worst.see(std::abs(mass - share) / (5 * deviation), [&] {
    return cameraEvent(c, at, told("the integral of pdf() over the film is", mass, share));
  });
  const double all = overSphere(camera, one->origin, at.aspect);
  f.mass.worst.see((all - share) / 0.25, [&] {
    return cameraEvent(c, at, told("the integral of pdf() over all directions is", all, share));
  });
}

}  // namespace

CameraDensityFindings cameraRaysFollowPdf(const CameraCases& cases, const Effort& effort) {
  CameraDensityFindings f{{"rays are distributed as pdf() predicts", "pdf()"},
                          {"pdf() integrates to 1 - P(nullopt) over directions", "pdf()"}};
  constexpr int kPlaces = 3;
  const double level = sidakLevel(effort.falseAlarm, cases.size() * kPlaces);
  Random r(effort.seed + 1);
  for (const CameraCase& c : cases)
    for (int i = 0; i < kPlaces; ++i) {
      const Vec2 film = r.pair(), lens = r.pair();
      seeDistribution(f, c, {film, lens, r.number(Real(0.5), 2)}, level, effort, r);
    }
  return f;
}

}  // namespace vestige::judge
