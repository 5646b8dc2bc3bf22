// SPDX-License-Identifier: Apache-2.0
// Procedural pigments over a footprint against brute force: the mean of 4096 point lookups over the
// parallelogram.
#include <vestige/pigment.h>

#include <random>

#include "support/catch.h"
#include "support/plugins.h"

using namespace vestige;
using namespace vestige::test;

namespace {

const Value kBlack = colourValue(0, 0, 0), kWhite = colourValue(1, 1, 1);

/// A pattern in black and white: its contrast is 1.
struct Case {
  std::string name;
  Settings settings;
  double cell;            ///< the size of what it shows, in units
  double along, slanted;  ///< largest mean absolute error, by how the footprint lies
  double least = 0.9;     ///< of the spread over places that brute force sees
  bool isRandom = false;
  double most = 1.15;  ///< standard deviation over places, in units of the true one
  std::shared_ptr<Pigment> make() const {
    Settings s = settings;
    s["first"] = kBlack, s[name == "hexagon" ? "third" : "second"] = kWhite;
    return vestige::test::make<Pigment>(pluginNamed("pigment", name), s);
  }
};

std::vector<Case> cases() {
  const Value stir = vectorValue({0.7, 0.7, 0.7});
  return {{"checker", {}, 1, 0.01, 0.07},
          {"gradient", {{"direction", vectorValue({1, 0.5, 0.2})}}, 1, 0.01, 0.01},
          {"stripes", {{"width", numberValue(0.3)}}, 1, 0.01, 0.01},
          {"brick", {}, 4, 0.01, 0.035},
          {"hexagon", {}, 1, 0.025, 0.025},
          {"marble", {}, 1, 0.01, 0.01},
          {"wood", {}, 1, 0.02, 0.02},
          {"noise", {}, 1, 0.02, 0.02, 0.6, true},
          {"bozo", {}, 1, 0.03, 0.03, 0.6, true},
          {"granite", {}, 0.25, 0.065, 0.065, 0.6, true, 1.35},  // six points an octave leave noise
          {"wrinkles", {}, 1, 0.035, 0.035, 0.6, true},
          {"marble", {{"turbulence", stir}}, 1, 0.08, 0.08, 0.4, true},
          {"wood", {{"turbulence", stir}}, 1, 0.08, 0.08, 0.4, true},
          {"agate", {}, 1, 0.1, 0.1, 0.4, true}};
}

double shown(const Pigment& p, const Lookup& at) { return double(p.eval(at).colour.g); }

class Places {
 public:
  double number() { return std::uniform_real_distribution<double>(0, 1)(random_); }
  Vec3 point(double size) {
    return {Real(size * (number() - 0.5)), Real(size * (number() - 0.5)),
            Real(size * (number() - 0.5))};
  }
  /// Anywhere, with a rectangle of these sides along two axes or turned at will.
  Lookup lookup(double a, double b, bool isSlanted) {
    Vec3 along, across;
    if (isSlanted) {
      const Frame f = Frame::around(normalize(point(1)));
      const double turn = 6.2831853 * number();
      along = Real(std::cos(turn)) * f.s + Real(std::sin(turn)) * f.t;
      across = cross(f.n, along);
    } else {
      const int axis = int(3 * number());
      along[axis] = 1, across[(axis + 1 + int(2 * number())) % 3] = 1;
    }
    return {point(40), {}, {{Real(a) * along, Real(b) * across}, {}}};
  }
  /// Stratified, so that its own error is small beside the bounds.
  double bruteForce(const Pigment& p, const Lookup& at) {
    constexpr int kSide = 64;
    double sum = 0;
    for (int i = 0; i < kSide * kSide; ++i) {
      const Real u = Real((i % kSide + number()) / kSide - 0.5);
      const Real v = Real((i / kSide + number()) / kSide - 0.5);
      const Vec3* d = at.footprint.dP;
      sum += shown(p, {at.position + u * d[0] + v * d[1], {}, {}});
    }
    return sum / (kSide * kSide);
  }

 private:
  std::mt19937_64 random_{20010625};
};

/// What lookups and brute force say over many places with footprints of one kind.
struct Comparison {
  double error = 0;                   ///< mean absolute
  double spread = 0, trueSpread = 0;  ///< standard deviations
};

Comparison compare(const Pigment& p, double size, double aspect, bool isSlanted, int places) {
  Places random;
  Comparison c;
  double sum = 0, squares = 0, trueSum = 0, trueSquares = 0;
  for (int i = 0; i < places; ++i) {
    const Lookup at = random.lookup(size * std::sqrt(aspect), size / std::sqrt(aspect), isSlanted);
    const double x = shown(p, at), truth = random.bruteForce(p, at);
    c.error += std::abs(x - truth) / places;
    sum += x / places, squares += x * x / places;
    trueSum += truth / places, trueSquares += truth * truth / places;
  }
  c.spread = std::sqrt(std::max(0.0, squares - sum * sum));
  c.trueSpread = std::sqrt(std::max(0.0, trueSquares - trueSum * trueSum));
  return c;
}

void checkErrors(const Case& c, int places) {
  const auto pigment = c.make();
  for (const double size : {0.01, 0.1, 0.5, 2.0, 10.0, 100.0})
    for (const double aspect : {1.0, 10.0})
      for (const bool isSlanted : {false, true}) {
        CAPTURE(c.name, c.settings.size(), size, aspect, isSlanted);
        const Comparison k = compare(*pigment, size * c.cell, aspect, isSlanted, places);
        CHECK(k.error < (isSlanted ? c.slanted : c.along));
      }
}

}  // namespace

TEST_CASE("patterns over a footprint: what brute force says", "[pigment][pattern]") {
  for (const Case& c : cases()) checkErrors(c, c.isRandom ? 6 : 12);
}

TEST_CASE("patterns over a footprint: many places", "[pigment][pattern][slow]") {
  for (const Case& c : cases()) checkErrors(c, 200);
}

TEST_CASE("patterns over a footprint vary over places as they should", "[pigment][pattern]") {
  for (const Case& c : cases())
    for (const double size : {0.1, 0.3, 0.7}) {
      CAPTURE(c.name, c.settings.size(), size);
      const Comparison k = compare(*c.make(), size * c.cell, 2, true, 36);
      CHECK(k.spread > c.least * k.trueSpread);
      CHECK(k.spread < c.most * k.trueSpread);
    }
}

TEST_CASE("patterns: the mean over all space is mean()", "[pigment][pattern]") {
  for (const Case& c : cases()) {
    CAPTURE(c.name);
    const auto pigment = c.make();
    Places random;
    double sum = 0;
    constexpr int kN = 40000;  // s.d. of one is at most 1/2: of the mean 0.0025
    for (int i = 0; i < kN; ++i) sum += shown(*pigment, {random.point(1000), {}, {}});
    CHECK(sum / kN == Approx(double(pigment->mean().colour.g)).margin(0.01));
  }
}

TEST_CASE("patterns: huge and broken footprints see the mean", "[pigment][pattern]") {
  const Real nan = Real(std::nan(""));
  for (const Case& c : cases()) {
    CAPTURE(c.name, c.settings.size());
    const auto pigment = c.make();
    const double mean = double(pigment->mean().colour.g);
    for (const Real x : {nan, kInfinity, Real(-1e30), Real(1e12)})
      for (const Vec3 b : {Vec3{1, 2, 3}, Vec3{}, Vec3{x, x, x}}) {
        const Lookup at{{Real(0.3), Real(0.4), Real(0.2)}, {}, {{{x, x, x}, b}, {}}};
        CHECK(shown(*pigment, at) == Approx(mean).margin(1e-4));
      }
    // Nor may a place that is no number make a colour that is none.
    for (const Real x : {nan, kInfinity, Real(1e20)})
      for (const Real w : {Real(0.1), Real(5)})
        CHECK(std::isfinite(shown(*pigment, {{x, x, x}, {}, {{{w, 0, w}, {0, w, 0}}, {}}})));
  }
}

TEST_CASE("patterns: a footprint of uv does not blur what is solid", "[pigment][pattern]") {
  for (const Case& c : cases()) {
    CAPTURE(c.name);
    const auto pigment = c.make();
    Places random;
    for (int i = 0; i < 50; ++i) {
      const Vec3 p = random.point(20);
      CHECK(shown(*pigment, {p, {}, {{}, {{3, 1}, {1, 2}}}}) == shown(*pigment, {p, {}, {}}));
    }
  }
  const auto flat =
      make<Pigment>(pluginNamed("pigment", "checker"),
                    {{"first", kBlack}, {"second", kWhite}, {"mapping", textValue("uv")}});
  // Half a cell across the edge at u = 1, of which 3/4 lie beyond.
  const Lookup edge{{}, {Real(1.125), Real(0.5)}, {{}, {{Real(0.5), 0}, {0, Real(0.25)}}}};
  CHECK(shown(*flat, edge) == Approx(0.75));
}

TEST_CASE("patterns: closed forms by hand", "[pigment][pattern]") {
  const auto by = [](const char* name, Settings s = {}) {
    s["first"] = kBlack, s["second"] = kWhite;
    return make<Pigment>(pluginNamed("pigment", name), s);
  };
  const auto over = [](const Pigment& p, Vec3 at, Vec3 a, Vec3 b = {}) {
    return shown(p, {at, {}, {{a, b}, {}}});
  };
  // A saw-tooth: 1/4 of a period below the fall (mean 7/8), 1/4 above (1/8).
  CHECK(over(*by("gradient"), {0, 1, 0}, {0, Real(0.5), 0}) == Approx(0.5));
  CHECK(over(*by("gradient"), {0, Real(0.25), 0}, {0, Real(0.5), 0}) == Approx(0.25));
  // Two equal boxes make a triangle: 1/8 of it lies beyond half of its half-width.
  CHECK(over(*by("stripes"), {Real(0.45), 0, 0}, {Real(0.1), 0, 0}, {Real(0.1), 0, 0}) ==
        Approx(0.125));
  CHECK(over(*by("stripes"), {Real(0.45), 0, 0}, {Real(0.2), 0, 0}) == Approx(0.25));
  // The triangle wave's foot: the mean of |2 x| over [-1/10, 1/10].
  CHECK(over(*by("marble"), {}, {Real(0.2), 0, 0}) == Approx(0.1));
  CHECK(over(*by("wood"), {Real(3.5), 0, 0}, {Real(0.2), 0, 0}) == Approx(0.9));
  // Three quarters of a brick's row in y, mortar left in the rest; x and z amid the brick.
  CHECK(over(*by("brick"), {2, Real(2.375), 1}, {0, Real(0.5), 0}) == Approx(0.75));
}
