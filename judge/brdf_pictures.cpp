// SPDX-License-Identifier: Apache-2.0
// Pictures of a BRDF with toPrev 45 degrees from the normal.
#include "judge/pictures.h"

namespace vestige::judge {
namespace {

constexpr int kSide = 128;
constexpr Real kDerivativeScale = 4e-3;  ///< relative error that is allowed

Picture density(const BrdfCase& c, const ScatterPoint& p, const Effort& effort) {
  const int samples = std::max(effort.samples, 1 << 18);
  const double cell = 4 * M_PI / kSphereCells;
  Grid seen{kSphereColumns, kSphereRows};
  Random r(effort.seed);
  for (int i = 0; i < samples; ++i)
    if (const auto s = c.brdf->sample(p, numbers(r)); s && !s->specular)
      cellTowards(seen, s->toNext) += 1 / (samples * cell);
  const Grid told = sphereOf([&](Vec3 d) { return c.brdf->pdf(p, d); });
  const double white = std::max(largest(told), 1e-30);
  return {"density.png", greyPanels({seen, told}, white),
          "where " + c.title() +
              " sends toNext: left by sample(), right by evaluate().pdf; white is " +
              withUnit(white, "/sr") +
              ". Across: azimuth, -180 to 180 degrees, toPrev at 0 in the middle; up: toNext.z, -1 "
              "to 1, the surface at half the height."};
}

/// Error of du at numbers u, in units of what is allowed.
double errorOfDu(const Brdf& brdf, const ScatterPoint& p, Vec2 u) {
  const ScatterNumbers n = {Real(0.5), u};
  const auto s = brdf.sample(p, n);
  if (!s || s->specular) return kNothingSaid;
  const Mat3x2 du = brdf.sampleDerivatives(p, n).du;
  const double size = std::max({sizeOf(du.c[0]), sizeOf(du.c[1]), 1e-30});
  double error = kNothingSaid;
  for (const int k : {0, 1}) {
    const auto map = [&](double h) -> std::optional<Vec3> {
      const Vec2 moved = k == 0 ? Vec2{u.x + Real(h), u.y} : Vec2{u.x, u.y + Real(h)};
      if (!(moved.x >= 0 && moved.x < 1 && moved.y >= 0 && moved.y < 1)) return std::nullopt;
      const auto t = brdf.sample(p, {n.lobe, moved});
      return t && t->lobe == s->lobe ? std::optional(t->toNext) : std::nullopt;
    };
    const auto seen = trustedDifference(map, kDouble ? 1e-3 : 1e-2, kDerivativeScale * size);
    if (seen) error = std::max(error, sizeOf(*seen - du.c[k]) / size / kDerivativeScale);
  }
  return error;
}

Picture derivative(const BrdfCase& c, const ScatterPoint& p) {
  const Grid errors = gridOf(kSide, kSide, [&](double x, double y) {
    return errorOfDu(*c.brdf, p, {Real(x), Real(y)});
  });
  return {"derivative.png", errorPanels({errors}),
          "error of sampleDerivatives().du against differences of sample(), lobe number 0.5. "
          "Across: u.x, 0 to 1; down: u.y, 0 to 1; " +
              kErrorColours + "."};
}

}  // namespace

std::vector<Picture> brdfPictures(const BrdfCase& c, const Effort& effort) {
  const Real half = std::sqrt(Real(0.5));
  const ScatterPoint p = c.at({half, 0, half}, false);
  return {density(c, p, effort), derivative(c, p)};
}

}  // namespace vestige::judge
