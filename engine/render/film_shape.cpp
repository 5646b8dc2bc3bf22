// SPDX-License-Identifier: Apache-2.0
#include "engine/render/film_shape.h"

#include <algorithm>
#include <cmath>

namespace vestige {

FilmShape filmShape(const Scene& scene, int width, int height, const double crop[4]) {
  const FilmSettings& f = scene.film();
  // One side given: the other keeps the shape of the picture.
  int w = width > 0 ? width : f.width, h = height > 0 ? height : f.height;
  if (width > 0 && height <= 0) h = std::max(1, int(std::lround(double(f.height) * w / f.width)));
  if (height > 0 && width <= 0) w = std::max(1, int(std::lround(double(f.width) * h / f.height)));
  const double* c = crop ? crop : f.crop;
  Crop window{int(std::floor(c[0] * w)), int(std::floor(c[1] * h)), int(std::ceil(c[2] * w)),
              int(std::ceil(c[3] * h))};
  window.x0 = std::clamp(window.x0, 0, w - 1);
  window.y0 = std::clamp(window.y0, 0, h - 1);
  window.x1 = std::clamp(window.x1, window.x0 + 1, w);
  window.y1 = std::clamp(window.y1, window.y0 + 1, h);
  return {w, h, window};
}

double sceneSize(const Scene& scene) {
  const FilmSettings& film = scene.film();
  const Real aspect = Real(film.width) / Real(film.height);
  Bounds extent = scene.view().bounds();
  for (const Vec2 at : {Vec2{0, 0}, Vec2{1, 0}, Vec2{0, 1}, Vec2{1, 1}, Vec2{0.5, 0.5}})
    if (const auto s = scene.camera().sample({at, {0.5, 0.5}, aspect})) extent.add(s->origin);
  const auto farthest = [](Real a, Real b) { return double(std::max(std::abs(a), std::abs(b))); };
  const double size =
      std::hypot(farthest(extent.low.x, extent.high.x), farthest(extent.low.y, extent.high.y),
                 farthest(extent.low.z, extent.high.z));
  return size > 0 && std::isfinite(size) ? size : 1;
}

Film makeFilm(const Scene& scene, int width, int height, const double crop[4],
              const std::vector<std::string>& aovs) {
  const FilmShape s = filmShape(scene, width, height, crop);
  return Film(s.width, s.height, s.crop, aovs, sceneSize(scene), scene.integrator().aovs());
}

}  // namespace vestige
