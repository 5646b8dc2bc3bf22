// SPDX-License-Identifier: Apache-2.0
#include "judge/pictures.h"

#include "engine/image/image.h"
#include "judge/brdf_tests.h"

namespace vestige::judge {
namespace {

constexpr int kColumns = 128, kRows = 64, kGap = 4, kSide = 128;
constexpr Real kDerivativeScale = 4e-3;  ///< relative error that is white

Image blank(int width, int height) {
  Image image;
  image.width = width, image.height = height;
  image.channels = {"R", "G", "B"};
  image.pixels.assign(std::size_t(width) * height * 3, 0);
  return image;
}
void paint(Image& image, int x, int y, double r, double g, double b) {
  float* p = image.at(x, y);
  p[0] = float(r), p[1] = float(g), p[2] = float(b);
}

/// Equal areas: the row goes by z, the column by longitude.
Vec3 directionAt(double column, double row) {
  const double z = 1 - 2 * row / kRows, phi = 2 * M_PI * column / kColumns - M_PI;
  const double s = std::sqrt(std::max(0.0, 1 - z * z));
  return {Real(s * std::cos(phi)), Real(s * std::sin(phi)), Real(z)};
}

Image densityPicture(const Brdf& brdf, const ScatterPoint& p, const Effort& effort) {
  const int samples = std::max(effort.samples, 1 << 18);
  std::vector<double> seen(kColumns * kRows, 0), told(kColumns * kRows, 0);
  Random r(effort.seed);
  const double area = 4 * M_PI / (kColumns * kRows);
  for (int i = 0; i < samples; ++i) {
    const auto s = brdf.sample(p, numbers(r));
    if (!s || s->specular) continue;
    const double phi = std::atan2(double(s->toNext.y), double(s->toNext.x)) + M_PI;
    const int x = std::clamp(int(phi / (2 * M_PI) * kColumns), 0, kColumns - 1);
    const int y = std::clamp(int((1 - double(s->toNext.z)) / 2 * kRows), 0, kRows - 1);
    seen[std::size_t(y * kColumns + x)] += 1 / (samples * area);
  }
  double most = 1e-30;
  for (int y = 0; y < kRows; ++y)
    for (int x = 0; x < kColumns; ++x) {
      double& t = told[std::size_t(y * kColumns + x)];
      for (int k = 0; k < 16; ++k)
        t += double(brdf.pdf(p, directionAt(x + (k % 4 + 0.5) / 4, y + (k / 4 + 0.5) / 4))) / 16;
      most = std::max(most, t);
    }
  Image image = blank(2 * kColumns + kGap, kRows);
  for (int y = 0; y < kRows; ++y)
    for (int x = 0; x < kColumns; ++x) {
      const std::size_t i = std::size_t(y * kColumns + x);
      const double a = seen[i] / most, b = told[i] / most;
      paint(image, x, y, a, a, a), paint(image, x + kColumns + kGap, y, b, b, b);
    }
  for (int y = 0; y < kRows; ++y)
    for (int x = 0; x < kGap; ++x) paint(image, kColumns + x, y, 0.1, 0.1, 0.4);
  return image;
}

Image derivativePicture(const Brdf& brdf, const ScatterPoint& p) {
  Image image = blank(kSide, kSide);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const Vec2 u = {Real((x + 0.5) / kSide), Real((y + 0.5) / kSide)};
      const ScatterNumbers n = {Real(0.5), u};
      const auto s = brdf.sample(p, n);
      double error = -1;
      if (s && !s->specular) {
        const Mat3x2 du = brdf.sampleDerivatives(p, n).du;
        const double size = std::max({sizeOf(du.c[0]), sizeOf(du.c[1]), 1e-30});
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
      }
      if (error < 0)
        paint(image, x, y, 0.1, 0.1, 0.2);
      else
        paint(image, x, y, std::min(error, 1.0), std::min(error / 4, 1.0),
              std::min(error / 4, 1.0));
    }
  return image;
}

}  // namespace

bool writePictures(const Plugin& plugin, const Effort& effort, const std::string& folder,
                   std::string& error) {
  if (plugin.kind != "brdf") return true;
  const BrdfCase c = brdfCase(plugin, {});
  const Real half = std::sqrt(Real(0.5));
  const ScatterPoint p = c.at({half, 0, half}, false);
  return writeImage(folder + "/density.png", densityPicture(*c.brdf, p, effort), {}, error) &&
         writeImage(folder + "/derivative.png", derivativePicture(*c.brdf, p), {}, error);
}

}  // namespace vestige::judge
