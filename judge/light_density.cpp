// SPDX-License-Identifier: Apache-2.0
#include "judge/light_tests.h"
#include "judge/statistics.h"

namespace vestige::judge {
namespace {

/// Where a ray meets a triangle of the light first; distance -1: nowhere.
LightHit hitOn(const TriangleMesh& mesh, Vec3 from, Vec3 d) {
  LightHit hit{from, d, -1, {}, {}, {}};
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.positions[t[0]], b = mesh.positions[t[1]] - a, c = mesh.positions[t[2]] - a;
    const Vec3 across = cross(b, c);
    const Real distance = dot(a - from, across) / dot(d, across);
    const Vec3 q = from + distance * d - a;
    const Real x = dot(cross(q, c), across) / lengthSquared(across);
    const Real y = dot(cross(b, q), across) / lengthSquared(across);
    if (!(distance > 0 && x >= 0 && y >= 0 && x + y <= 1)) continue;
    if (hit.distance > 0 && hit.distance < distance) continue;
    hit.distance = distance, hit.position = from + distance * d, hit.normal = normalize(across);
    if (!mesh.uvs.empty())
      hit.uv = (1 - x - y) * mesh.uvs[t[0]] + x * mesh.uvs[t[1]] + y * mesh.uvs[t[2]];
  }
  return hit;
}

/// Density of a direction, as a ray that meets the light by chance asks for it.
double densityTowards(const Light& light, Vec3 from, Vec3 d) {
  const LightHit hit = light.geometry() ? hitOn(*light.geometry(), from, d)
                                        : LightHit{from, d, kInfinity, {}, {}, {}};
  return hit.distance > 0 ? double(light.pdf(hit)) : 0;
}

std::vector<Vec3> drawn(const Light& light, Vec3 from, int n, Random& r) {
  std::vector<Vec3> list;
  for (int i = 0; i < n; ++i)
    if (const auto s = light.sample(from, r.pair()); s && isFinite(s->hit.toLight))
      list.push_back(s->hit.toLight);
  return list;
}

void seeDistribution(LightDensityFindings& f, const LightCase& c, Vec3 from, double level,
                     const Effort& effort, Random& r) {
  const int n = effort.samples;
  const SpherePartition cells(drawn(*c.light, from, std::max(n / 4, 1 << 13), r), effort.depth);
  const std::vector<Vec3> samples = drawn(*c.light, from, n, r);
  if (samples.empty()) return;
  std::vector<double> expected =
      cells.integrate([&](Vec3 d) { return densityTowards(*c.light, from, d); });
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
    text << "sample() lands " << ratio << " times as often as pdf() says (p-value " << p << ")";
    return lightEvent(c, from, {}, text.str());
  });
  const double deviation = std::sqrt(share * (1 - share) / n) + 2e-3;
  f.mass.worst.see(std::abs(mass - share) / (5 * deviation), [&] {
    return lightEvent(c, from, {}, told("the integral of pdf() is", mass, share));
  });
}

}  // namespace

LightDensityFindings lightSamplesFollowPdf(const LightCases& cases, const Effort& effort) {
  LightDensityFindings f{{"samples are distributed as pdf() says", "pdf()"},
                         {"pdf() integrates to 1 - P(nullopt)", "pdf()"},
                         {"a sample's pdf is what pdf() says", "sample().pdf"},
                         {"a sample's radiance is what eval() says", "eval()"}};
  constexpr int kPlaces = 4;
  const double level = sidakLevel(effort.falseAlarm, cases.size() * kPlaces);
  Random r(effort.seed + 1);
  for (const LightCase& c : cases) {
    const bool canBeHit = c.light->isInfinite() || c.light->geometry();
    for (int i = 0; i < kPlaces && !c.light->isDelta() && canBeHit; ++i)
      seeDistribution(f, c, r.point(-3, 3), level, effort, r);
  }
  forLightEvents(cases, effort, [&](const LightCase& c, Vec3 from, Vec2 u, Random&) {
    const auto s = c.light->sample(from, u);
    if (!s) return;
    const double pdf = c.light->isDelta() ? 1 : double(c.light->pdf(s->hit));
    f.ownPdf.worst.see(relative(double(s->pdf), pdf) / 1e-3, [&] {
      return lightEvent(c, from, u, told("sample().pdf is", double(s->pdf), pdf) + " as pdf()");
    });
    const Rgb radiance = c.light->isDelta() ? Rgb{} : s->radiance;
    const Rgb found = c.light->eval(s->hit);
    f.ownRadiance.worst.see(
        isBlack(found) && isBlack(radiance) ? 0 : relative(found, radiance) / 1e-3, [&] {
          return lightEvent(
              c, from, u,
              told("eval() gives", double(maxComponent(found)), double(maxComponent(radiance))) +
                  " as sample() says");
        });
  });
  return f;
}

}  // namespace vestige::judge
