// SPDX-License-Identifier: Apache-2.0
// Differentials of a path against differences of that path, number by number and vertex by vertex.
#pragma once
#include "support/catch.h"
#include "support/judge.h"
#include "support/path_trace.h"

namespace vestige::test {

inline constexpr bool kIsDouble = sizeof(Real) == 8;
inline constexpr double kPathStep = kIsDouble ? 2e-4 : 4e-3;
/// Differences that disagree with those of half the step by more say nothing.
inline constexpr double kTrust = kIsDouble ? 1e-5 : 1e-2;

/// Errors of one kind, judged together.
struct Errors {
  std::vector<double> all;
  void add(double e) { all.push_back(std::isfinite(e) ? e : 1e30); }
  double at(double share) {
    REQUIRE(!all.empty());
    std::sort(all.begin(), all.end());
    return all[std::min(all.size() - 1, std::size_t(share * double(all.size())))];
  }
};

/// One number of the path moved by h.
inline PathNumbers moved(PathNumbers n, int j, double h) {
  Vec2& pair = n.pairs[std::size_t(j / 2)];
  (j % 2 == 0 ? pair.x : pair.y) += Real(h);
  return n;
}

/// Where a clamp of the module takes over, after which its answers are no derivatives.
inline bool isClamped(const TracedVertex& v) {
  return std::abs(dot(v.direction, v.surface.geometricNormal)) < 2 * kGrazing ||
         dot(v.x.frame.n, v.x.toPrev) < Real(0.01) ||
         (v.drawn && std::abs(v.drawn->toNext.z) < Real(0.01));
}

struct Judged {
  Errors position, direction, gradient;
  long asked = 0, judged = 0;
};

/// Compares at every vertex of one random path.
inline void judgePath(const PathTracer& tracer, const PathNumbers& n, int vertices,
                      Judged& result) {
  std::vector<PathDifferentials> carried;
  const auto base = tracer.trace(n, vertices, nullptr, &carried);
  int last = 0;
  while (last < int(base.size()) && !(last > 0 && isClamped(base[std::size_t(last - 1)]))) ++last;
  if (last > 0 && isClamped(base[std::size_t(last - 1)])) --last;
  // Number j of the path is pair numbers[j / 2]: specular vertices use none.
  std::vector<int> numbers = {0, 1, 2, 3};
  for (int k = 0; k < last; ++k) {
    const PathDifferentials& d = carried[std::size_t(k)];
    REQUIRE(d.size() == int(numbers.size()));
    double largest = 0;
    for (int j = 0; j < d.size(); ++j) largest = std::max(largest, double(length(d.dVertex(j))));
    for (int j = 0; j < d.size(); ++j) {
      const int number = numbers[std::size_t(j)];
      if (!differsSmoothly(n.pairs[std::size_t(number / 2)], Real(3 * kPathStep))) continue;
      const double size = double(length(d.dVertex(j))) + double(length(d.dDirection(j)));
      const double h = kPathStep / std::max(1.0, size);
      const auto value = [&](auto pick) {
        return [&, pick](double x) -> std::optional<decltype(pick(base[0]))> {
          const auto p = tracer.trace(moved(n, number, x), k + 1, &base);
          if (int(p.size()) <= k) return std::nullopt;
          return pick(p[std::size_t(k)]);
        };
      };
      ++result.asked;
      const double scale = std::max(double(length(d.dVertex(j))), 0.01 * largest);
      const auto v = trustedDifference(
          value([](const TracedVertex& t) { return t.surface.position; }), h, kTrust * scale, 3);
      if (!v) continue;
      ++result.judged;
      result.position.add(double(length(d.dVertex(j) - *v)) /
                          std::max(double(length(*v)), 0.01 * largest));
      const auto dir =
          trustedDifference(value([](const TracedVertex& t) { return t.direction; }), h,
                            kTrust * std::max(1.0, double(length(d.dDirection(j)))));
      if (dir)
        result.direction.add(double(length(d.dDirection(j) - *dir)) /
                             std::max(1.0, double(length(*dir))));
      const auto g = trustedDifference(value([](const TracedVertex& t) { return t.logF; }), h,
                                       kTrust * std::max(1.0, double(std::abs(d.gradient(j)))), 5);
      if (g)
        result.gradient.add(std::abs(double(d.gradient(j) - *g)) /
                            std::max(1.0, std::abs(double(*g))));
    }
    if (base[std::size_t(k)].drawn && !base[std::size_t(k)].drawn->specular)
      numbers.push_back(2 * (k + 2)), numbers.push_back(2 * (k + 2) + 1);
    if (numbers.size() > 12) break;
  }
}

inline PathNumbers randomNumbers(Random& r, int vertices) {
  PathNumbers n;
  for (int i = 0; i < vertices + 2; ++i) n.pairs.push_back(r.pair());
  for (int i = 0; i < vertices; ++i) n.lobes.push_back(r.number());
  return n;
}

inline void checkErrors(Errors& e) {
  CHECK(e.at(0.5) < (kIsDouble ? 1e-6 : 2e-3));
  CHECK(e.at(0.99) < (kIsDouble ? 1e-4 : 2e-2));
}

/// Trace, xy and yy of a footprint's covariance in the plane across n.
inline Real covariance(const Footprint& f, Vec3 n, int entry) {
  const Frame frame = Frame::around(n);
  const auto moment = [&](Vec3 a, Vec3 b) {
    return dot(f.dP[0], a) * dot(f.dP[0], b) + dot(f.dP[1], a) * dot(f.dP[1], b);
  };
  return entry == 0   ? moment(frame.s, frame.s) + moment(frame.t, frame.t)
         : entry == 1 ? moment(frame.s, frame.t)
                      : moment(frame.t, frame.t);
}

/// What the light puts into the contribution: its radiance, and what turns a measure of its own
/// into solid angle.
enum class LightMeasure {
  constant,   ///< neither counts
  direction,  ///< a direction was drawn, or there was no choice: the radiance alone
  area,       ///< a point was drawn by area: cos / distance^2 too
};

inline Real lightFactor(const LightSample& s, LightMeasure measure) {
  if (measure == LightMeasure::constant) return 1;
  const Real area = std::abs(dot(s.hit.normal, s.hit.toLight)) / sqr(s.hit.distance);
  return luminance(s.radiance) * (measure == LightMeasure::area ? area : Real(1));
}

/// The connection from each vertex of a path to the point of a light that u draws.
inline void judgeConnection(const PathTracer& tracer, const Light& light, LightMeasure measure,
                            const PathNumbers& n, Vec2 u, Judged& result) {
  std::vector<PathFootprint<16>> carried;
  const auto base = tracer.trace(n, int(n.lobes.size()), nullptr, nullptr, &carried);
  for (std::size_t k = 0; k < base.size() && !isClamped(base[k]); ++k) {
    const TracedVertex& v = base[k];
    const Vec3 from = v.surface.position;
    const auto drawn = light.sample({from}, u);
    if (!v.x.brdf || !drawn || !differsSmoothly(u, Real(3 * kPathStep))) return;
    const auto f = [&](const TracedVertex& at, const LightSample& s) -> std::optional<Real> {
      const Real value =
          luminance(evaluateScatter(at.x, s.hit.toLight).fCos) * lightFactor(s, measure);
      return value > Real(1e-12) ? std::optional(std::log(value)) : std::nullopt;
    };
    const bool isGrazing = std::abs(dot(v.x.frame.n, drawn->hit.toLight)) < Real(0.05) ||
                           (measure == LightMeasure::area &&
                            std::abs(dot(drawn->hit.normal, drawn->hit.toLight)) < Real(0.05));
    if (!f(v, *drawn) || isGrazing) return;
    const LightJacobian jacobian = light.sampleDerivatives({from}, u);
    const LightLogGradient slope =
        measure == LightMeasure::constant ? LightLogGradient{} : light.logGradient({from}, u);
    const auto all = carried[k].connect(v.surface, v.x, drawn->hit.toLight, jacobian, slope);
    REQUIRE(all.size() == carried[k].differentials().size() + 2);
    // What the integrators limit by is the same.
    const auto limited = carried[k].connected(v.surface, v.x, drawn->hit, jacobian, slope);
    for (int j = 0; j < limited.differentials().size(); ++j)
      CHECK(limited.differentials().gradient(j) == all.gradient(j));
    for (int j = 0; j < all.size(); ++j) {
      const int own = j - (all.size() - 2);
      // Only the first four numbers and the light's own are sure to be where they are looked for.
      if (own < 0 && (j >= 4 || !differsSmoothly(n.pairs[std::size_t(j / 2)], Real(3 * kPathStep))))
        continue;
      const double size = double(length(carried[k].differentials().dVertex(std::min(j, 3))));
      const double h = kPathStep / std::max(1.0, own < 0 ? size : 1.0);
      const auto value = [&](auto pick) {
        return [&, pick](double x) -> decltype(pick(v, *drawn)) {
          if (own >= 0) {
            const Vec2 uu = own == 0 ? Vec2{u.x + Real(x), u.y} : Vec2{u.x, u.y + Real(x)};
            const auto s = light.sample({from}, uu);
            if (!s) return std::nullopt;
            return pick(v, *s);
          }
          const auto p = tracer.trace(moved(n, j, x), int(k) + 1, &base);
          if (p.size() <= k) return std::nullopt;
          const auto s = light.sample({p[k].surface.position}, u);
          if (!s) return std::nullopt;
          return pick(p[k], *s);
        };
      };
      ++result.asked;
      const auto direction =
          trustedDifference(value([](const TracedVertex&, const LightSample& s) {
                              return std::optional(s.hit.toLight);
                            }),
                            h, kTrust * std::max(1.0, double(length(all.dDirection(j)))));
      if (!direction) continue;
      ++result.judged;
      result.direction.add(double(length(all.dDirection(j) - *direction)) /
                           std::max(1.0, double(length(*direction))));
      const auto g = trustedDifference(
          value([&](const TracedVertex& at, const LightSample& s) -> std::optional<Real> {
            const auto log = f(at, s);
            return log ? std::optional(at.logF + *log) : std::nullopt;
          }),
          h, kTrust * std::max(1.0, std::abs(double(all.gradient(j)))), 5);
      if (g)
        result.gradient.add(std::abs(double(all.gradient(j) - *g)) /
                            std::max(1.0, std::abs(double(*g))));
    }
  }
}

}  // namespace vestige::test
