// SPDX-License-Identifier: Apache-2.0
// A camera over its film, through one point of the lens.
#include "judge/camera_maps.h"
#include "judge/pictures.h"
#include "judge/ray_differences.h"

namespace vestige::judge {
namespace {

constexpr int kColumns = 128, kRows = 96;
constexpr Real kAspect = Real(kColumns) / kRows;
const Vec2 kLens = {Real(0.3), Real(0.4)};
const char* const kOverFilm =
    " Across: film.x, 0 to 1; down: film.y, 0 to 1; aspect 4:3, lens <0.3, 0.4>.";

CameraNumbers at(double x, double y) { return {{Real(x), Real(y)}, kLens, kAspect}; }

/// Density of directions around a film point for uniform film points, from four rays half a cell
/// away, 1/sr.
double densityOfRays(const Camera& camera, double x, double y) {
  const double w = 0.5 / kColumns, h = 0.5 / kRows;
  const auto a = camera.sample(at(x - w, y - h)), b = camera.sample(at(x + w, y + h));
  const auto c = camera.sample(at(x - w, y + h)), d = camera.sample(at(x + w, y - h));
  if (!a || !b || !c || !d) return 0;
  const double angle =
      double(length(cross(b->direction - a->direction, d->direction - c->direction))) / 2;
  return angle > 1e-9 ? 4 * w * h / angle : 0;  // rays that are parallel have none
}

Picture density(const CameraCase& c) {
  const Grid rays =
      gridOf(kColumns, kRows, [&](double x, double y) { return densityOfRays(*c.camera, x, y); });
  const Grid pdf = gridOf(kColumns, kRows, [&](double x, double y) {
    const auto s = c.camera->sample(at(x, y));
    return s ? double(c.camera->pdf(s->origin, s->direction, kAspect)) : 0;
  });
  const Grid weight = gridOf(kColumns, kRows, [&](double x, double y) {
    const auto s = c.camera->sample(at(x, y));
    return s ? double(luminance(s->weight)) : 0;
  });
  // A panorama's density has no bound at its poles: the scale is chosen for most of the film.
  std::vector<double> sorted = pdf.values;
  std::sort(sorted.begin(), sorted.end());
  const double white = 1.25 * sorted[sorted.size() * 9 / 10], most = largest(weight);
  std::vector<Grid> panels = {rays, pdf, weight};
  for (double& w : panels[2].values) w *= most > 0 ? white / most : 0;
  if (!(white > 0)) panels = {weight};
  const std::string densities =
      "density of directions: left of neighbouring rays of sample(), middle by pdf(), white is " +
      withUnit(white, "/sr") + "; right sample().weight";
  return {"density.png", greyPanels(panels, white > 0 ? white : most),
          c.title + ": " +
              (white > 0 ? densities : "sample().weight (directions have no density)") +
              ", white is " + withUnit(most, "") + "." + kOverFilm};
}

/// Error of a ray by its numbers k and k + 1, in units of what is allowed.
double errorOfRay(const Camera& camera, CameraNumbers n, int first) {
  const auto s = camera.sample(n);
  if (!s) return kNothingSaid;
  const RayJacobian j = camera.sampleDerivatives(n);
  double error = kNothingSaid;
  for (int k = first; k < first + 2; ++k) {
    const auto direction = [&](double h) { return movedRay(camera, n, k, h, true); };
    const auto origin = [&](double h) { return movedRay(camera, n, k, h, false); };
    if (const auto e = compared(direction, j.dDirection[k], 1)) error = std::max(error, e->error);
    if (const auto e = compared(origin, j.dOrigin[k], sizeOf(s->origin)))
      error = std::max(error, e->error);
  }
  return error;
}

Picture derivative(const CameraCase& c) {
  const auto panel = [&](int first) {
    return gridOf(kColumns, kRows,
                  [&](double x, double y) { return errorOfRay(*c.camera, at(x, y), first); });
  };
  std::vector<Grid> panels = {panel(0)};
  if (c.camera->variables() > 2) panels.push_back(panel(2));
  return {"derivative.png", errorPanels(panels),
          std::string("error of sampleDerivatives() against differences of sample()") +
              (panels.size() > 1 ? ": left by the film's numbers, right by the lens's."
                                 : " by the film's numbers.") +
              kOverFilm + " Colours: " + kErrorColours + "."};
}

}  // namespace

std::vector<Picture> cameraPictures(const CameraCase& c, const Effort&) {
  return {density(c), derivative(c)};
}

}  // namespace vestige::judge
