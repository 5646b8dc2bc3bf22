// SPDX-License-Identifier: Apache-2.0
#include "judge/picture.h"

#include <fmt/format.h>

namespace vestige::judge {
namespace {

constexpr int kGap = 4;         ///< pixels between panels
constexpr int kCellPixels = 3;  ///< each cell is a square of them

using Colour = std::array<double, 3>;

void paintCell(Image& image, int left, int top, const Colour& c) {
  for (int y = 0; y < kCellPixels; ++y)
    for (int x = 0; x < kCellPixels; ++x)
      for (int k = 0; k < 3; ++k) image.at(left + x, top + y)[k] = float(c[std::size_t(k)]);
}

/// `colour` of each cell, panels from left to right with a blue gap between them.
template <class ColourOf>
Image painted(const std::vector<Grid>& panels, const ColourOf& colourOf) {
  const int columns = panels[0].columns, rows = panels[0].rows;
  const int width = columns * kCellPixels + kGap;
  Image image;
  image.width = int(panels.size()) * width - kGap, image.height = rows * kCellPixels;
  image.channels = {"R", "G", "B"};
  for (int i = 0; i < image.width * image.height; ++i)
    image.pixels.insert(image.pixels.end(), {0.1F, 0.1F, 0.4F});
  for (std::size_t i = 0; i < panels.size(); ++i)
    for (int y = 0; y < rows; ++y)
      for (int x = 0; x < columns; ++x)
        paintCell(image, int(i) * width + x * kCellPixels, y * kCellPixels,
                  colourOf(panels[i].at(x, y)));
  return image;
}

}  // namespace

double largest(const Grid& g) { return *std::max_element(g.values.begin(), g.values.end()); }

Image greyPanels(const std::vector<Grid>& panels, double white) {
  return painted(panels, [&](double value) {
    const double grey = white > 0 ? std::clamp(value / white, 0.0, 1.0) : 0;
    return Colour{grey, grey, grey};
  });
}

Image errorPanels(const std::vector<Grid>& panels) {
  return painted(panels, [](double e) {
    const double most = std::min(e, 1.0), over = std::clamp((e - 1) / 3, 0.0, 1.0);
    return e < 0 ? Colour{0.1, 0.1, 0.2} : Colour{most, over, over};
  });
}

std::string withUnit(double value, const std::string& unit) {
  return fmt::format("{:.3g}{}", value, unit);
}

Vec3 onSphere(double x, double y) {
  const double z = 1 - 2 * y, phi = 2 * M_PI * x - M_PI;
  const double s = std::sqrt(std::max(0.0, 1 - z * z));
  return {Real(s * std::cos(phi)), Real(s * std::sin(phi)), Real(z)};
}

double& cellTowards(Grid& sphere, Vec3 d) {
  const double phi = std::atan2(double(d.y), double(d.x)) + M_PI;
  const int x = int(phi / (2 * M_PI) * sphere.columns);
  const int y = int((1 - double(d.z)) / 2 * sphere.rows);
  return sphere.at(std::clamp(x, 0, sphere.columns - 1), std::clamp(y, 0, sphere.rows - 1));
}

}  // namespace vestige::judge
