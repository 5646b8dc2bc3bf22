// SPDX-License-Identifier: Apache-2.0
#include "judge/light_tests.h"
#include "judge/statistics.h"

namespace vestige::judge {
namespace {

/// Density of a direction at infinity, as for a ray that leaves the scene.
double densityTowards(const Light& light, const Receiver& from, Vec3 d) {
  return double(light.pdf(from, {from.position, d, kInfinity, {}, {}, {}}));
}

/// Integral of the density over each cell, by points of the light's surface: a cell's quadrature
/// would miss the sharp edges of a polygon.
std::vector<double> overSurface(const Light& light, const Receiver& from,
                                const SpherePartition& cells) {
  std::vector<double> sums(cells.cells(), 0);
  const TriangleMesh& mesh = *light.geometry();
  // The total number of points does not depend on the number of triangles.
  const int fine = std::max(16, int(400 / std::sqrt(double(mesh.triangles.size()) / 2)));
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.positions[t[0]], b = mesh.positions[t[1]] - a, c = mesh.positions[t[2]] - a;
    const Vec3 across = cross(b, c), normal = normalize(across);
    for (int i = 0; i < fine * fine; ++i) {
      Real x = (i % fine + Real(0.5)) / fine, y = (i / fine + Real(0.5)) / fine;
      if (x + y > 1) x = 1 - x, y = 1 - y;  // each half of the parallelogram once
      const Vec3 p = a + x * b + y * c, d = normalize(p - from.position);
      const LightHit hit = {from.position, d, length(p - from.position), p, normal, {x, y}};
      sums[cells.cellOf(d)] += double(light.pdf(from, hit) * std::abs(dot(normal, d)) /
                                      sqr(hit.distance) * length(across) / 2) /
                               (fine * fine);
    }
  }
  return sums;
}

std::vector<Vec3> drawn(const Light& light, const Receiver& from, int n, Random& r) {
  std::vector<Vec3> list;
  for (int i = 0; i < n; ++i)
    if (const auto s = light.sample(from, r.pair()); s && isFinite(s->hit.toLight))
      list.push_back(s->hit.toLight);
  return list;
}

void seeDistribution(LightDensityFindings& f, const LightCase& c, const Receiver& from,
                     double level, const Effort& effort, Random& r) {
  const int n = effort.samples;
  const SpherePartition cells(drawn(*c.light, from, std::max(n / 4, 1 << 13), r), effort.depth);
  const std::vector<Vec3> samples = drawn(*c.light, from, n, r);
  if (samples.empty()) return;
  std::vector<double> expected =
      c.light->geometry()
          ? overSurface(*c.light, from, cells)
          : cells.integrate([&](Vec3 d) { return densityTowards(*c.light, from, d); });
  double mass = 0;
  for (double& e : expected) mass += e, e *= n;
  std::vector<double> seen(cells.cells(), 0);
  for (const Vec3 d : samples) ++seen[cells.cellOf(d)];
  const double share = double(samples.size()) / n;
  const double p = chiSquareTest(expected, seen);
  const double ratio = relative(mass, share) > 0.02 ? share / mass : worstRatio(expected, seen);
  f.distribution.worst.see(std::log(std::max(p, 1e-300)) / std::log(level), [&] {
    std::ostringstream text;
    text.precision(3);
    text << "sample() lands " << ratio << " times as often as pdf() predicts (p-value " << p << ")";
    return lightEvent(c, from, {}, text.str());
  });
  const double deviation = std::sqrt(share * (1 - share) / n) + 2e-3;
  f.mass.worst.see(std::abs(mass - share) / (5 * deviation), [&] {
    return lightEvent(c, from, {}, told("the integral of pdf() is", mass, share));
  });
}

}  // namespace

LightDensityFindings lightSamplesFollowPdf(const LightCases& cases, const Effort& effort) {
  LightDensityFindings f{{"samples are distributed as pdf() predicts", "pdf()"},
                         {"pdf() integrates to 1 - P(nullopt)", "pdf()"},
                         {"a sample's pdf equals pdf()", "sample().pdf"},
                         {"a sample's radiance equals eval()", "eval()"}};
  constexpr int kPlaces = 4;
  const double level = sidakLevel(effort.falseAlarm, cases.size() * kPlaces);
  Random r(effort.seed + 1);
  for (const LightCase& c : cases) {
    const LightTraits traits = c.light->traits();
    const bool canBeHit = !traits.isDelta && (traits.isInfinite || c.light->geometry());
    for (int i = 0; i < kPlaces && canBeHit; ++i)
      seeDistribution(f, c, receiverAt(r.point(-3, 3), i), level, effort, r);
  }
  forLightEvents(cases, effort, [&](const LightCase& c, const Receiver& from, Vec2 u, Random&) {
    const auto s = c.light->sample(from, u);
    if (!s) return;
    const double pdf = c.light->traits().isDelta ? 1 : double(c.light->pdf(from, s->hit));
    f.ownPdf.worst.see(relative(double(s->pdf), pdf) / 1e-3, [&] {
      return lightEvent(c, from, u, told("sample().pdf is", double(s->pdf), pdf) + " as pdf()");
    });
    const Rgb radiance = c.light->traits().isDelta ? Rgb{} : s->radiance;
    const Rgb found = c.light->eval(s->hit);
    f.ownRadiance.worst.see(
        isBlack(found) && isBlack(radiance) ? 0 : relative(found, radiance) / 1e-3, [&] {
          return lightEvent(
              c, from, u,
              told("eval() gives", double(maxComponent(found)), double(maxComponent(radiance))) +
                  " as in sample()");
        });
  });
  return f;
}

}  // namespace vestige::judge
