// SPDX-License-Identifier: Apache-2.0
// [And20] as in flip.h; its section numbers stand at the functions.
#include "engine/picture/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace vestige {

namespace {

constexpr double kPiD = std::numbers::pi;
constexpr double kPixelsPerDegree = 0.7 * (3840 / 0.7) * (kPiD / 180);

using Colour = std::array<double, 3>;
using Plane = std::vector<float>;  ///< [height][width]
struct Size {
  int width, height;

  /// Value of a pixel in a plane; outside it that of the nearest edge pixel.
  std::size_t at(int x, int y) const {
    return std::size_t(std::clamp(y, 0, height - 1)) * width + std::clamp(x, 0, width - 1);
  }
};

// ---------------------------------------------------------------- colour spaces
constexpr double kToXyz[3][3] = {{0.41238656, 0.35759149, 0.18045049},
                                 {0.21263682, 0.71518298, 0.07218020},
                                 {0.01933062, 0.11919716, 0.95037259}};
constexpr double kFromXyz[3][3] = {{3.24100326, -1.53739899, -0.49861587},
                                   {-0.96922426, 1.87592999, 0.04155422},
                                   {0.05563942, -0.20401120, 1.05714897}};
/// XYZ of white.
constexpr Colour kWhite = {0.95042854, 1.0, 1.08890037};

Colour times(const double m[3][3], const Colour& c) {
  Colour r;
  for (int i = 0; i < 3; ++i) r[i] = m[i][0] * c[0] + m[i][1] * c[1] + m[i][2] * c[2];
  return r;
}

Colour toYCxCz(const Colour& rgb) {
  const Colour xyz = times(kToXyz, rgb);
  const double x = xyz[0] / kWhite[0], y = xyz[1] / kWhite[1], z = xyz[2] / kWhite[2];
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

Colour fromYCxCz(const Colour& c) {
  const double y = (c[0] + 16) / 116;
  return times(kFromXyz,
               {(y + c[1] / 500) * kWhite[0], y * kWhite[1], (y - c[2] / 200) * kWhite[2]});
}

/// CIELAB with chroma scaled by lightness: colour counts less in the dark (Hunt's effect),
/// Sec. 4.1.
Colour toHuntLab(const Colour& rgb) {
  const auto f = [](double t) {
    constexpr double d = 6.0 / 29;
    return t > d * d * d ? std::cbrt(t) : t / (3 * d * d) + 4.0 / 29;
  };
  const Colour xyz = times(kToXyz, rgb);
  const double x = f(xyz[0] / kWhite[0]), y = f(xyz[1] / kWhite[1]), z = f(xyz[2] / kWhite[2]);
  const double lightness = 116 * y - 16, hunt = 0.01 * lightness;
  return {lightness, hunt * 500 * (x - y), hunt * 200 * (y - z)};
}

/// City block in lightness, Euclidean in chroma.
double hyab(const Colour& a, const Colour& b) {
  return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

// ---------------------------------------------------------------- filters
using Kernel = std::vector<double>;  ///< 2 r + 1 weights

/// Across with one kernel, down with the other; the picture's edge goes on outside.
Plane filter(const Plane& in, Size size, const Kernel& across, const Kernel& down) {
  const int rx = int(across.size() / 2), ry = int(down.size() / 2);
  Plane middle(in.size()), out(in.size());
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      double sum = 0;
      for (int k = -rx; k <= rx; ++k) sum += across[k + rx] * in[size.at(x + k, y)];
      middle[size.at(x, y)] = float(sum);
    }
  std::vector<double> row(size.width);
  for (int y = 0; y < size.height; ++y) {
    std::fill(row.begin(), row.end(), 0.0);
    for (int k = -ry; k <= ry; ++k) {
      const float* from = &middle[size.at(0, y + k)];
      for (int x = 0; x < size.width; ++x) row[x] += down[k + ry] * from[x];
    }
    for (int x = 0; x < size.width; ++x) out[size.at(x, y)] = float(row[x]);
  }
  return out;
}

/// One term a sqrt(pi / b) exp(-pi^2 d^2 / b) of a contrast sensitivity, d in degrees [And20, Table
/// 1].
struct Sensitivity {
  double a, b;
};

/// Eq. 2: the eye's blur in one channel; each term is separable, their sum is not.
Plane blur(const Plane& in, Size size, std::initializer_list<Sensitivity> terms) {
  const int radius = int(std::ceil(3 * std::sqrt(0.04 / (2 * kPiD * kPiD)) * kPixelsPerDegree));
  Plane sum(in.size(), 0.f);
  double total = 0;
  for (const Sensitivity s : terms) {
    Kernel g;
    double area = 0;
    for (int k = -radius; k <= radius; ++k)
      area += g.emplace_back(std::exp(-kPiD * kPiD * std::pow(k / kPixelsPerDegree, 2) / s.b));
    const double weight = s.a * std::sqrt(kPiD / s.b);
    total += weight * area * area;
    const Plane part = filter(in, size, g, g);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += float(weight * part[i]);
  }
  for (float& x : sum) x = float(x / total);
  return sum;
}

// ---------------------------------------------------------------- the two pipelines
struct Seen {
  std::vector<Colour> colours;  ///< filtered, Hunt-adjusted CIELAB
  Plane edges, points;          ///< magnitudes of the feature detectors
};

std::vector<Colour> filteredColours(const std::array<Plane, 3>& planes, Size size) {
  const Plane y = blur(planes[0], size, {{1, 0.0047}});
  const Plane x = blur(planes[1], size, {{1, 0.0053}});
  const Plane z = blur(planes[2], size, {{34.1, 0.04}, {13.5, 0.025}});
  std::vector<Colour> colours(y.size());
  for (std::size_t i = 0; i < colours.size(); ++i) {
    Colour rgb = fromYCxCz({y[i], x[i], z[i]});
    for (double& c : rgb) c = std::clamp(c, 0.0, 1.0);
    colours[i] = toHuntLab(rgb);
  }
  return colours;
}

/// Positive and negative weights sum to 1 and -1 each (Sec. 4.2); those of a plain Gaussian to 1.
Kernel normalised(Kernel k) {
  double positive = 0, negative = 0;
  for (const double w : k) (w > 0 ? positive : negative) += std::abs(w);
  for (double& w : k) w /= w > 0 ? positive : negative > 0 ? negative : 1;
  return k;
}

/// First (edges) and second (points) derivatives of a Gaussian, as wide as an edge is seen.
void findFeatures(const Plane& grey, Size size, Seen& seen) {
  constexpr double kFeatureWidth = 0.082;  // degrees
  const double sd = 0.5 * kFeatureWidth * kPixelsPerDegree;
  const int radius = int(std::ceil(3 * sd));
  Kernel g, edge, point;
  for (int k = -radius; k <= radius; ++k) {
    const double w = std::exp(-k * k / (2 * sd * sd));
    g.push_back(w), edge.push_back(-k * w), point.push_back((k * k / (sd * sd) - 1) * w);
  }
  g = normalised(g), edge = normalised(edge), point = normalised(point);
  const auto magnitude = [&](const Kernel& k) {
    Plane x = filter(grey, size, k, g);
    const Plane y = filter(grey, size, g, k);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = std::hypot(x[i], y[i]);
    return x;
  };
  seen.edges = magnitude(edge), seen.points = magnitude(point);
}

Seen see(const std::vector<float>& rgb, Size size) {
  Plane grey(rgb.size() / 3);
  std::array<Plane, 3> planes = {grey, grey, grey};
  for (std::size_t i = 0; i < grey.size(); ++i) {
    const Colour c = toYCxCz({rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2]});
    for (int k = 0; k < 3; ++k) planes[k][i] = float(c[k]);
    grey[i] = float((c[0] + 16) / 116);
  }
  Seen seen;
  seen.colours = filteredColours(planes, size);
  findFeatures(grey, size, seen);
  return seen;
}

/// Eq. 5: most of the range for differences that are not extreme.
double colourDifference(const Colour& a, const Colour& b) {
  constexpr double kPower = 0.7, kKnee = 0.4, kKneeValue = 0.95;
  static const double largest = std::pow(hyab(toHuntLab({0, 1, 0}), toHuntLab({0, 0, 1})), kPower);
  const double d = std::pow(hyab(a, b), kPower), knee = kKnee * largest;
  return d < knee ? kKneeValue / knee * d
                  : kKneeValue + (d - knee) / (largest - knee) * (1 - kKneeValue);
}

}  // namespace

std::vector<float> flipDifference(const std::vector<float>& reference,
                                  const std::vector<float>& test, int width, int height) {
  const Size size{width, height};
  const Seen a = see(reference, size), b = see(test, size);
  std::vector<float> result(a.colours.size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    const double feature =
        std::max(std::abs(a.edges[i] - b.edges[i]), std::abs(a.points[i] - b.points[i]));
    const double strength =
        std::sqrt(std::clamp(feature / std::numbers::sqrt2, 0.0, 1.0));  // Eq. 6
    const double colour = std::clamp(colourDifference(a.colours[i], b.colours[i]), 0.0, 1.0);
    result[i] = float(std::pow(colour, 1 - strength));  // Eq. 7
  }
  return result;
}

}  // namespace vestige
