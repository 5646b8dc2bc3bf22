// SPDX-License-Identifier: Apache-2.0
// Lookups with a footprint, against the average of point lookups that are worked out the long way.
#include <vestige/tools/texture_box.h>

#include <cmath>
#include <limits>
#include <random>

#include "engine/picture/image.h"
#include "engine/texture/texture_store.h"
#include "support/catch.h"
#include "support/small_png.h"
#include "support/temp_folder.h"

using namespace vestige;
using namespace vestige::test;

namespace {

constexpr Wrap kWraps[] = {Wrap::repeat, Wrap::clamp, Wrap::mirror};

/// The texel that an endless picture shows at i, said the long way.
int shown(int i, int n, Wrap wrap) {
  if (wrap == Wrap::clamp) return std::max(0, std::min(n - 1, i));
  if (wrap == Wrap::repeat) return (i % n + n) % n;
  const int j = (i % (2 * n) + 2 * n) % (2 * n);
  return j < n ? j : 2 * n - 1 - j;
}

/// A grey picture of 16 bits, row 0 at the bottom, that knows no code of ours.
struct Picture {
  int width, height;
  std::vector<int> codes;

  double at(int x, int y, Wrap wrap) const {
    return codes[std::size_t(shown(y, height, wrap) * width + shown(x, width, wrap))] / 65535.0;
  }
  double bilinear(double u, double v, Wrap wrap) const {
    const double x = u * width - 0.5, y = v * height - 0.5;
    const int i = int(std::floor(x)), j = int(std::floor(y));
    const double s = x - i, t = y - j;
    return (1 - t) * ((1 - s) * at(i, j, wrap) + s * at(i + 1, j, wrap)) +
           t * ((1 - s) * at(i, j + 1, wrap) + s * at(i + 1, j + 1, wrap));
  }
  double mean() const {
    double sum = 0;
    for (const int c : codes) sum += c / 65535.0;
    return sum / double(codes.size());
  }
  /// Standard deviation of its texels.
  double contrast() const {
    double sum = 0;
    const double centre = mean();
    for (const int c : codes) sum += std::pow(c / 65535.0 - centre, 2);
    return std::sqrt(sum / double(codes.size()));
  }
  std::shared_ptr<const Texture> load(TextureStore& store, const TempFolder& folder,
                                      Wrap wrap) const {
    std::vector<int> fromTop;
    for (int y = height; y-- > 0;)
      fromTop.insert(fromTop.end(), &codes[std::size_t(y) * width],
                     &codes[std::size_t(y) * width] + width);
    const std::string file = folder / (std::to_string(width) + "x" + std::to_string(height) + "_" +
                                       std::to_string(codes[0]) + ".png");
    writePng(file, width, height, 1, 16, fromTop);
    std::string error;
    auto texture = store.texture(file, {file, {}, "raw", wrap, wrap}, error);
    INFO(error);
    REQUIRE(texture);
    return texture;
  }
};

Picture checker(int width, int height, int side) {
  Picture p{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) p.codes.push_back((x / side + y / side) % 2 ? 65535 : 1);
  return p;
}

Picture noise(int width, int height) {
  Picture p{width, height, {}};
  std::mt19937 random(11);
  for (int i = 0; i < width * height; ++i) p.codes.push_back(int(random() % 65536));
  return p;
}

/// As in a photograph detail falls with frequency, and there are hard edges: waves of amplitude
/// 1 / frequency, and a disc.
Picture photograph(int width, int height) {
  Picture p{width, height, {}};
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<double> waves;
  for (int k = 0; k < 160; ++k) waves.push_back(unit(random));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double u = (x + 0.5) / width, v = (y + 0.5) / height;
      double sum = std::hypot(u - 0.4, v - 0.6) < 0.25 ? 0.5 : 0.3;
      for (int k = 0; k < 40; ++k) {
        const double f = 1 + k * 0.75, turn = 6.2832 * waves[std::size_t(4 * k)];
        const double phase =
            std::round(f * std::cos(turn)) * u + std::round(f * std::sin(turn)) * v;
        sum += 0.12 / f * std::sin(6.2832 * (phase + waves[std::size_t(4 * k + 1)]));
      }
      p.codes.push_back(int(65535 * std::min(std::max(sum, 0.0), 1.0)));
    }
  return p;
}

/// Two sides of a region: `length` texels long, `aspect` times less wide, turned.
struct Sides {
  Vec2 d[2];
  Sides(const Picture& p, double length, double aspect, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    d[0] = {Real(length * c / p.width), Real(length * s / p.height)};
    d[1] = {Real(-length / aspect * s / p.width), Real(length / aspect * c / p.height)};
  }
};

/// Average over the parallelogram, 64 x 64 jittered points, or over the Gaussian of its covariance.
double bruteForce(const Picture& p, Wrap wrap, double u, double v, const Vec2 d[2], bool gaussian,
                  std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  std::normal_distribution<double> normal(0, std::sqrt(1 / 12.0));
  double sum = 0;
  for (int k = 0; k < 4096; ++k) {
    double a = (k % 64 + unit(random)) / 64 - 0.5, b = (k / 64 + unit(random)) / 64 - 0.5;
    if (gaussian) a = normal(random), b = normal(random);
    sum += p.bilinear(u + a * double(d[0].x) + b * double(d[1].x),
                      v + a * double(d[0].y) + b * double(d[1].y), wrap);
  }
  return sum / 4096;
}

/// Mean of |lookup - brute force| over random places and turns, as a share of the contrast.
using LookUp = Rgba (*)(const Texture&, Vec2, const Vec2[2]);
Rgba itsOwn(const Texture& t, Vec2 uv, const Vec2 d[2]) { return t.lookup(uv, d); }

double meanError(const Picture& p, const Texture& t, Wrap wrap, double length, double aspect,
                 bool gaussian, LookUp lookUp = itsOwn) {
  std::mt19937 random(unsigned(length * 100 + aspect));
  std::uniform_real_distribution<double> unit(0, 1);
  constexpr int kPlaces = 16;
  double sum = 0;
  for (int i = 0; i < kPlaces; ++i) {
    const double u = 3 * unit(random) - 1, v = 3 * unit(random) - 1;
    const Sides s(p, length, aspect, 6.2832 * unit(random));
    const double found = double(lookUp(t, {Real(u), Real(v)}, s.d).colour.r);
    sum += std::abs(found - bruteForce(p, wrap, u, v, s.d, gaussian, random));
  }
  return sum / kPlaces / p.contrast();
}

const Vec2 kPoint[2] = {};

}  // namespace

TEST_CASE("a footprint averages the point lookups under it", "[texture]") {
  const TempFolder folder;
  TextureStore store;
  // Gaussian and box of one covariance differ themselves, most where contrast lies near the
  // footprint's own size, and random points have a noise of a hundredth or two. Below two texels
  // the lookup is on its way to a point.
  const auto check = [&](const Picture& p, double bound, double boundNearTexel) {
    for (const Wrap wrap : kWraps) {
      const auto t = p.load(store, folder, wrap);
      for (const double aspect : {1.0, 5.0, 32.0})
        for (const double length : {0.1, 0.9, 1.4, 2.0, 4.0, 9.0, 31.0, 110.0, 1000.0}) {
          INFO(p.width << " x " << p.height << " wrap " << int(wrap) << " aspect " << aspect
                       << " length " << length);
          const bool box = aspect == 5;
          const double most = length < 2 ? boundNearTexel : box ? 1.8 * bound : bound;
          CHECK(meanError(p, *t, wrap, length, aspect, !box) < most);
        }
    }
  };
  SECTION("photograph") { check(photograph(150, 100), 0.06, 0.02); }
  SECTION("odd sizes") { check(photograph(37, 111), 0.06, 0.03); }
  SECTION("fine checker") { check(checker(64, 64, 2), 0.1, 0.17); }
  SECTION("noise") { check(noise(96, 32), 0.1, 0.15); }
}

TEST_CASE("PD01's lookups along the longer axis average the same region", "[texture]") {
  const TempFolder folder;
  TextureStore store;
  for (const Picture& p : {photograph(150, 100), noise(96, 32)})
    for (const Wrap wrap : kWraps) {
      const auto t = p.load(store, folder, wrap);
      for (const double aspect : {1.0, 4.0, 16.0})
        for (const double length : {0.9, 4.0, 31.0, 110.0}) {
          INFO(p.width << " wrap " << int(wrap) << " aspect " << aspect << " length " << length);
          CHECK(meanError(p, *t, wrap, length, aspect, false, lookupAlongMajor) < 0.2);
        }
      // A needle, nothing, and what is not a number.
      const Vec2 needle[2] = {{Real(0.9), 0}, {}}, lost[2] = {{kInfinity, 0}, {0, NAN}};
      CHECK(std::isfinite(lookupAlongMajor(*t, {Real(0.3), Real(0.4)}, needle).colour.r));
      CHECK(std::isfinite(lookupAlongMajor(*t, {Real(0.3), Real(0.4)}, lost).colour.r));
      CHECK(lookupAlongMajor(*t, {Real(0.3), Real(0.4)}, kPoint).colour.r ==
            t->lookup({Real(0.3), Real(0.4)}, kPoint).colour.r);
    }
}

TEST_CASE("up to one texel a footprint is a point, bit for bit", "[texture]") {
  const TempFolder folder;
  TextureStore store;
  const Picture p = noise(33, 20);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const Wrap wrap : kWraps) {
    const auto t = p.load(store, folder, wrap);
    for (int i = 0; i < 500; ++i) {
      const Vec2 uv{Real(3 * unit(random) - 1), Real(3 * unit(random) - 1)};
      const Sides s(p, 0.9999 * unit(random), 1 + unit(random), 7 * unit(random));
      CHECK(t->lookup(uv, s.d).colour.r == t->lookup(uv, kPoint).colour.r);
      // Both sides 1 / sqrt(2) long and parallel: together one texel.
      const Sides half(p, 0.707, 1e9, 7 * unit(random));
      const Vec2 twice[2] = {half.d[0], half.d[0]};
      CHECK(t->lookup(uv, twice).colour.r == t->lookup(uv, kPoint).colour.r);
    }
  }
}

TEST_CASE("a growing footprint changes the colour without a jump", "[texture]") {
  const TempFolder folder;
  TextureStore store;
  const Picture p = checker(64, 64, 2);
  for (const Wrap wrap : kWraps) {
    const auto t = p.load(store, folder, wrap);
    for (const double aspect : {1.0, 6.0, 200.0}) {
      double last = -1, most = 0;
      for (double length = 0.8; length < 300; length *= 1.002) {
        const Sides s(p, length, aspect, 0.4);
        const double now = double(t->lookup({Real(0.43), Real(0.71)}, s.d).colour.r);
        if (last >= 0) most = std::max(most, std::abs(now - last));
        last = now;
      }
      INFO("wrap " << int(wrap) << " aspect " << aspect);
      CHECK(most < 0.004);  // of the 1 between black and white, while the length grows 0.2 %
    }
  }
}

TEST_CASE("a moving footprint changes the colour without a jump", "[texture]") {
  const TempFolder folder;
  TextureStore store;
  const Picture p = noise(50, 21);
  for (const Wrap wrap : kWraps) {
    const auto t = p.load(store, folder, wrap);
    for (const double length : {1.3, 3.0, 10.0, 40.0})
      for (const double aspect : {1.0, 10.0}) {
        const Sides s(p, length, aspect, 0.9);
        double last = -1, most = 0;
        for (int i = 0; i < 4000; ++i) {  // across both seams, a hundredth of a texel a step
          const double u = 0.6 + i * 0.01 / 50, v = -0.3 + i * 0.01 / 21;
          const double now = double(t->lookup({Real(u), Real(v)}, s.d).colour.r);
          if (last >= 0) most = std::max(most, std::abs(now - last));
          last = now;
        }
        INFO("wrap " << int(wrap) << " length " << length << " aspect " << aspect);
        CHECK(most < 0.02 / std::sqrt(length));
      }
  }
}

TEST_CASE("a constant texture stays constant under any footprint", "[texture]") {
  const TempFolder folder;
  TextureStore store;
  for (const Picture& p : {Picture{13, 40, std::vector<int>(520, 23456)}, Picture{1, 1, {50000}},
                           Picture{7, 1, std::vector<int>(7, 999)}})
    for (const Wrap wrap : kWraps) {
      const auto t = p.load(store, folder, wrap);
      std::mt19937 random(2);
      std::uniform_real_distribution<double> unit(0, 1);
      for (int i = 0; i < 300; ++i) {
        const Sides s(p, std::pow(10, 5 * unit(random) - 1), std::pow(10, 2 * unit(random)),
                      7 * unit(random));
        const Vec2 uv{Real(5 * unit(random) - 2), Real(5 * unit(random) - 2)};
        CHECK(t->lookup(uv, s.d).colour.r * 65535 == Approx(p.codes[0]).margin(0.6));
      }
    }
}

TEST_CASE("filtering keeps the mean and takes variance away", "[texture]") {
  const TempFolder folder;
  TextureStore store;
  for (const Picture& p : {noise(24, 24), noise(45, 19), photograph(51, 64)}) {
    const auto t = p.load(store, folder, Wrap::repeat);
    double before = p.contrast();
    for (const double length : {2.5, 6.0, 17.0}) {
      const Sides s(p, length, 3, 0.3);
      double sum = 0, squares = 0;
      constexpr int kSide = 90;
      for (int i = 0; i < kSide * kSide; ++i) {
        const Vec2 uv{Real((i % kSide + 0.5) / kSide), Real((i / kSide + 0.5) / kSide)};
        const double x = double(t->lookup(uv, s.d).colour.r);
        sum += x, squares += x * x;
      }
      const double mean = sum / (kSide * kSide);
      const double contrast = std::sqrt(squares / (kSide * kSide) - mean * mean);
      INFO(p.width << " x " << p.height << " length " << length);
      CHECK(mean == Approx(p.mean()).margin(0.01 * p.contrast()));
      CHECK(contrast < 0.97 * before);
      before = contrast;
    }
  }
}

TEST_CASE("a footprint without end sees the mean, or the edges where they go on", "[texture]") {
  const TempFolder folder;
  TextureStore store;
  const Picture p = noise(37, 52);
  const double corners = (p.at(0, 0, Wrap::clamp) + p.at(36, 0, Wrap::clamp) +
                          p.at(0, 51, Wrap::clamp) + p.at(36, 51, Wrap::clamp)) /
                         4;
  for (const double length : {1e4, 1e9, 1e30}) {
    const Sides s(p, length, 1, 0);
    const auto at = [&](Wrap wrap) {
      return double(p.load(store, folder, wrap)->lookup({Real(0.5), Real(0.5)}, s.d).colour.r);
    };
    CHECK(at(Wrap::repeat) == Approx(p.mean()).margin(0.002));
    CHECK(at(Wrap::mirror) == Approx(p.mean()).margin(0.002));
    CHECK(at(Wrap::clamp) == Approx(corners).margin(0.1 * p.contrast()));
  }
  // Far outside there is the corner alone, however wide the footprint is beside that distance.
  const auto clamped = p.load(store, folder, Wrap::clamp);
  const Sides wide(p, 100, 2, 1);
  CHECK(clamped->lookup({Real(12), Real(-14)}, wide.d).colour.r ==
        Approx(p.at(36, 0, Wrap::clamp)).margin(1e-4));
}

TEST_CASE("footprints that make no sense still give a colour of the picture", "[texture]") {
  const TempFolder folder;
  TextureStore store;
  const Real inf = std::numeric_limits<Real>::infinity();
  const Real nan = std::numeric_limits<Real>::quiet_NaN();
  const Real max = std::numeric_limits<Real>::max(),
             few[] = {0, inf, -inf, nan, max, -max, Real(1e-30), Real(0.3)};
  for (const Wrap wrap : kWraps) {
    for (const Picture& p : {noise(9, 5), noise(1, 30), noise(1, 1)}) {
      const auto t = p.load(store, folder, wrap);
      for (int i = 0; i < 8 * 8 * 8 * 8; ++i) {
        const Vec2 d[2] = {{few[i % 8], few[i / 8 % 8]}, {few[i / 64 % 8], few[i / 512]}};
        for (const Real u : {Real(0.2), nan, inf, Real(1e9)}) {
          const Real x = t->lookup({u, Real(0.7)}, d).colour.r;
          if (!(x >= 0 && x <= Real(1.0001))) FAIL_CHECK("footprint " << i << " gives " << x);
        }
      }
      const Vec2 line[2] = {{}, {Real(0.3), Real(0.2)}};  // one vector alone
      const double x = double(t->lookup({Real(0.2), Real(0.7)}, line).colour.r);
      std::mt19937 random(1);
      CHECK(x == Approx(bruteForce(p, wrap, 0.2, 0.7, line, true, random)).margin(0.04));
    }
  }
}

TEST_CASE("footprints are averaged in linear light, each channel by itself", "[texture]") {
  const TempFolder folder;
  TextureStore store;
  std::vector<int> codes;  // columns of opaque white and clear green
  for (int i = 0; i < 32 * 32; ++i)
    if (i % 2)
      codes.insert(codes.end(), {255, 255, 255, 255});
    else
      codes.insert(codes.end(), {0, 255, 0, 0});
  writePng(folder / "a.png", 32, 32, 4, 8, codes);
  std::string error;
  const auto t = store.texture(folder / "a.png", {"a.png", {}, "srgb"}, error);
  REQUIRE(t);
  for (const Real length : {Real(0.25), Real(1), Real(3)}) {
    const Vec2 d[2] = {{length, 0}, {0, length}};
    const Rgba found = t->lookup({Real(0.37), Real(0.5)}, d);
    CHECK(found.colour.r == Approx(0.5).margin(1e-3));  // not the 0.21 of the mean code
    CHECK(found.colour.g == Approx(1).margin(1e-4));
    CHECK(found.colour.b == Approx(0.5).margin(1e-3));
    CHECK(found.alpha == Approx(0.5).margin(1e-3));
  }
}

TEST_CASE("what exceeds 1 is averaged as it is", "[texture]") {
  const TempFolder folder;
  for (const bool half : {false, true}) {
    Image image{16, 16, {"R", "G", "B"}, {}, {}};
    for (int i = 0; i < 256; ++i)
      for (const float x : {i % 2 ? 1000.f : 0.f, -3.f, 1e-5f}) image.pixels.push_back(x);
    WriteOptions options;
    options.halfFloat = half;
    std::string error;
    const std::string file = folder / (half ? "h.exr" : "f.exr");
    REQUIRE(writeImage(file, image, options, error));
    TextureStore store;
    const auto t = store.texture(file, {file, {}, ""}, error);
    REQUIRE(t);
    for (const Real length : {Real(0.5), Real(2)}) {
      const Vec2 d[2] = {{length, 0}, {0, length}};
      const Rgb found = t->lookup({Real(0.4), Real(0.1)}, d).colour;
      CHECK(found.r == Approx(500).epsilon(1e-3));
      CHECK(found.g == Approx(-3));
      CHECK(found.b == Approx(1e-5).epsilon(1e-2));
    }
  }
}

TEST_CASE("a pyramid adds two thirds to a picture of 8 bits, a third to others", "[texture]") {
  const TempFolder folder;
  TextureStore eight, sixteen;
  std::string error;
  writePng(folder / "a.png", 160, 128, 3, 8, std::vector<int>(160 * 128 * 3, 128));
  REQUIRE(eight.texture(folder / "a.png", {"a.png", {}, ""}, error));
  CHECK(double(eight.bytes()) / (160 * 128 * 3) == Approx(1 + 2 / 3.0).epsilon(0.05));
  writePng(folder / "b.png", 160, 128, 1, 16, std::vector<int>(160 * 128, 128));
  REQUIRE(sixteen.texture(folder / "b.png", {"b.png", {}, ""}, error));
  CHECK(double(sixteen.bytes()) / (160 * 128 * 2) == Approx(1 + 1 / 3.0).epsilon(0.05));
}
