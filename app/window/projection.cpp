// SPDX-License-Identifier: Apache-2.0
#include "app/window/projection.h"

#include <vector>

namespace vestige::app {
namespace {

constexpr int kSteps = 16;
constexpr Real kNear = Real(1e-4);  ///< of the film's side
constexpr Real kFarthest = 3;       ///< film points beyond are of no use to anybody
constexpr Real kLongestStep = Real(0.5);

std::optional<Vec2> solve(const Camera& camera, Vec3 point, Real aspect, Vec2 at) {
  for (int step = 0; step < kSteps; ++step) {
    const CameraNumbers n{at, {Real(0.5), Real(0.5)}, aspect};
    const auto ray = camera.sample(n);
    if (!ray) return std::nullopt;
    const Vec3 d = ray->direction, to = point - ray->origin;
    const Real t = dot(to, d);
    const Vec3 miss = to - t * d;
    const RayJacobian j = camera.sampleDerivatives(n);
    // How the ray's point at distance t moves, across the ray.
    const auto across = [&](int i) {
      const Vec3 v = j.dOrigin[i] + t * j.dDirection[i];
      return v - dot(v, d) * d;
    };
    const Vec3 x = across(0), y = across(1);
    const Real xx = dot(x, x), xy = dot(x, y), yy = dot(y, y), det = xx * yy - xy * xy;
    if (!(std::abs(det) > 0)) return std::nullopt;
    const Real mx = dot(x, miss), my = dot(y, miss);
    Vec2 by = {(yy * mx - xy * my) / det, (xx * my - xy * mx) / det};
    const Real size = std::hypot(by.x, by.y);
    if (!std::isfinite(size)) return std::nullopt;
    if (size < kNear) return t > 0 ? std::optional(at + by) : std::nullopt;
    if (size > kLongestStep) by = (kLongestStep / size) * by;
    at = at + by;
    if (std::abs(at.x) > kFarthest || std::abs(at.y) > kFarthest) return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Vec2> onFilm(const Camera& camera, Vec3 point, Real aspect, Vec2 start) {
  // A panorama has the same point beyond its edges again: on the film counts first.
  std::optional<Vec2> beside;
  std::vector<Vec2> starts = {start};
  for (const Real y : {Real(0.5), Real(0.2), Real(0.8)})
    for (const Real x : {Real(0.5), Real(0.2), Real(0.8)}) starts.push_back({x, y});
  for (const Vec2 at : starts) {
    const auto found = solve(camera, point, aspect, at);
    if (found && found->x >= 0 && found->x <= 1 && found->y >= 0 && found->y <= 1) return found;
    if (!beside) beside = found;
  }
  return beside;
}

}  // namespace vestige::app
