// SPDX-License-Identifier: Apache-2.0
#include <vestige/sampler.h>
#include <vestige/tools/sampling.h>

#include <vector>

#include "support/catch.h"

using namespace vestige;

namespace {

/// 5-point central difference of a map from the square.
template <class Map>
auto difference(const Map& map, Vec2 u, int axis, double h) {
  const auto at = [&](double k) {
    Vec2 v = u;
    (axis == 0 ? v.x : v.y) += Real(k * h);
    return map(v);
  };
  return Real(1 / (12 * h)) * (at(-2) - at(2) + Real(8) * (at(1) - at(-1)));
}

/// Points away from the seams of the concentric map.
std::vector<Vec2> points() {
  std::vector<Vec2> list;
  const Sampler s(1, 2, 0, 3);
  for (std::uint32_t i = 0; list.size() < 500; ++i) {
    const Vec2 u = s.pair(0, i);
    const Real a = std::abs(2 * u.x - 1), b = std::abs(2 * u.y - 1);
    if (std::abs(a - b) > Real(0.1) && a < Real(0.8) && b < Real(0.8)) list.push_back(u);
  }
  return list;
}

constexpr double kStep = sizeof(Real) == 8 ? 1e-3 : 3e-3;
constexpr double kTolerance = sizeof(Real) == 8 ? 1e-8 : 2e-4;

}  // namespace

TEST_CASE("directions carry the derivative of their own map", "[sampling]") {
  for (const Vec2 u : points())
    for (const Real cosMax : {Real(-1), Real(0), Real(0.9)}) {
      const auto map = [&](Vec2 v) { return uniformCap(v, cosMax).d; };
      const Direction d = uniformCap(u, cosMax);
      for (const int axis : {0, 1})
        CHECK(length(difference(map, u, axis, kStep) - d.du.c[axis]) < 20 * kTolerance);
      const Real pdf = 1 / (2 * kPi * (1 - cosMax));
      CHECK(length(cross(d.du.c[0], d.du.c[1])) * pdf == Approx(1).epsilon(1e-4));
      CHECK(length(d.d) == Approx(1).epsilon(1e-5));
    }
  for (const Vec2 u : points()) {
    const Direction d = cosineHemisphere(u);
    const auto map = [](Vec2 v) { return cosineHemisphere(v).d; };
    for (const int axis : {0, 1})
      if (d.d.z > Real(0.3))
        CHECK(length(difference(map, u, axis, kStep) - d.du.c[axis]) < 50 * kTolerance);
    CHECK(length(cross(d.du.c[0], d.du.c[1])) * d.d.z / kPi == Approx(1).epsilon(1e-4));
  }
}

TEST_CASE("the triangle map is uniform and piecewise linear", "[sampling]") {
  const Sampler s(0, 0, 0, 0);
  Vec2 mean;
  const int n = 4096;
  for (int i = 0; i < n; ++i) {
    const TrianglePoint p = uniformTriangle(s.pair(0, std::uint32_t(i)));
    CHECK(p.b.x >= 0);
    CHECK(p.b.y >= 0);
    CHECK(p.b.x + p.b.y <= 1);
    CHECK(std::abs(cross(p.du[0], p.du[1])) == Approx(0.5));
    mean = mean + (Real(1) / n) * p.b;
  }
  CHECK(mean.x == Approx(1.0 / 3).margin(1e-3));
  CHECK(mean.y == Approx(1.0 / 3).margin(1e-3));
}

TEST_CASE("the second Sobol' dimension equals its direction numbers", "[sampler]") {
  for (std::uint32_t i = 0; i < 100000; i += 7) {
    std::uint32_t expected = 0;
    for (std::uint32_t j = i, v = 1u << 31; j; j >>= 1, v ^= v >> 1)
      if (j & 1) expected ^= v;
    REQUIRE(detail::reverseBits(detail::sobol1Reversed(i)) == expected);
  }
}

TEST_CASE("every aligned power of two of samples is a (0,2)-net", "[sampler]") {
  for (const std::uint32_t first : {0u, 64u, 192u})
    for (std::uint32_t dim : {0u, 5u, 29u}) {
      for (int bits = 0; bits <= 6; ++bits) {  // 2^bits x 2^(6-bits) boxes hold one sample each
        std::vector<int> count(64);
        for (std::uint32_t i = first; i < first + 64; ++i) {
          const Vec2 p = Sampler(7, 9, i, 42).pair(dim);
          const int x = int(p.x * (1 << bits)), y = int(p.y * (1 << (6 - bits)));
          ++count[x * (1 << (6 - bits)) + y];
        }
        for (const int c : count) REQUIRE(c == 1);
      }
    }
}

TEST_CASE("pixels, dimensions and seeds are independent", "[sampler]") {
  // Correlation of pairs of 4096 numbers: standard deviation 1/64 if independent.
  const auto correlation = [](auto a, auto b) {
    double sum = 0;
    const int n = 4096;
    for (int i = 0; i < n; ++i) sum += (a(i) - 0.5) * (b(i) - 0.5);
    return std::abs(12 * sum / n);
  };
  const auto stream = [](std::uint32_t x, std::uint32_t dim, std::uint32_t seed) {
    return [=](int i) { return double(Sampler(x, 0, std::uint32_t(i), seed).number(dim)); };
  };
  CHECK(correlation(stream(0, 0, 0), stream(1, 0, 0)) < 0.08);
  CHECK(correlation(stream(0, 0, 0), stream(0, 1, 0)) < 0.08);
  CHECK(correlation(stream(0, 7, 0), stream(0, 15, 0)) < 0.08);
  CHECK(correlation(stream(0, 0, 0), stream(0, 0, 1)) < 0.08);
}
