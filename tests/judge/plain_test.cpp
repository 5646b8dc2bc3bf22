// SPDX-License-Identifier: Apache-2.0
// Random parameters: what they reach, and what they leave alone.
#include "judge/plain.h"

#include "judge/harsh.h"
#include "judge/judge.h"
#include "judge/trusted_difference.h"
#include "support/catch.h"
#include "support/plugins.h"

using namespace vestige;
using namespace vestige::test;

namespace {

template <class Cases>
int titled(const Cases& cases, const std::string& words) {
  return int(std::count_if(cases.begin(), cases.end(), [&](const auto& c) {
    return c.title.find(words) != std::string::npos;
  }));
}

}  // namespace

TEST_CASE("judge: lights and cameras get files, blocks and a lens", "[judge]") {
  const auto skies = judge::lightCases(pluginNamed("light", "environment"), 20, 1);
  CHECK(titled(skies, "map \"picture.exr\"") > 0);
  CHECK(titled(skies, "image { file \"picture.exr\" }") > 0);
  CHECK(titled(skies, "map") < 20);
  const auto lenses = judge::cameraCases(pluginNamed("camera", "thin_lens"), 20, 1);
  CHECK(std::count_if(lenses.begin(), lenses.end(),
                      [](const auto& c) { return c.camera->variables() == 4; }) > 10);
}

TEST_CASE("judge: rows that no random value is known for are told", "[judge]") {
  CHECK(judge::rowsLeftAlone(*pluginNamed("light", "environment").schema) == "color_space (text)");
  CHECK(judge::rowsLeftAlone(*pluginNamed("camera", "thin_lens").schema).empty());
  Parameter policy;
  policy.name = "policy", policy.type = ValueType::block, policy.blockKind = "footprint";
  Schema schema;
  schema.params = {policy};
  CHECK(judge::rowsLeftAlone(schema) == "policy (footprint block)");
}

TEST_CASE("judge: the picture that it hands out is bilinear and wraps", "[judge]") {
  const judge::SmallTexture repeats, ends(Wrap::clamp, Wrap::clamp);
  const auto at = [](const judge::SmallTexture& t, double u, double v) {
    return double(t.lookup({Real(u), Real(v)}, nullptr).colour.r);
  };
  const auto texel = [&](int x, int y) { return double(ends.texel(x, y).colour.r); };
  CHECK(at(ends, 2.5 / 8, 1.5 / 4) == Approx(texel(2, 1)));
  CHECK(at(ends, 3.0 / 8, 1.5 / 4) == Approx((texel(2, 1) + texel(3, 1)) / 2));
  CHECK(at(ends, 2.5 / 8, 2.0 / 4) == Approx((texel(2, 1) + texel(2, 2)) / 2));
  CHECK(at(ends, 0, 1.5 / 4) == Approx(texel(0, 1)));
  CHECK(at(repeats, 0, 1.5 / 4) == Approx((texel(0, 1) + texel(7, 1)) / 2));
}

TEST_CASE("judge: differences say nothing on a bend", "[judge]") {
  const auto bent = [](double h) { return std::optional(Real(h < 0 ? h : 1.1 * h)); };
  const auto smooth = [](double h) { return std::optional(Real(std::sin(1 + h))); };
  CHECK(!judge::trustedDifference(bent, 1e-2, 4e-3));
  const auto seen = judge::trustedDifference(smooth, 1e-2, 4e-3);
  REQUIRE(seen);
  CHECK(double(*seen) == Approx(std::cos(1.0)).epsilon(1e-3));
}

TEST_CASE("judge: differences say nothing about a table with fine knots", "[judge]") {
  // Slopes 1.02 and 0.98 in turn, 1 over any of the wide steps.
  const auto table = [](double h) {
    const double knot = 2e-4, x = h / knot + 0.3, n = std::floor(x), share = x - n;
    const bool isSteep = std::fmod(std::abs(n), 2) < 0.5;
    return std::optional(Real(knot * (n + share + 0.02 * (isSteep ? share : 1 - share))));
  };
  const auto smooth = [](double h) { return std::optional(Real(std::sin(1 + h))); };
  const double step = 1e-2, tolerance = 4e-3, noise = 0.1;
  const auto mean = judge::trustedDifference(table, step, tolerance, noise);
  REQUIRE(mean);  // by itself it takes the mean for the slope
  CHECK(std::abs(double(*mean) - 1) < tolerance);
  CHECK(judge::hasFineBends(table, *mean, step, tolerance, noise));
  const auto slope = judge::trustedDifference(smooth, step, tolerance);
  REQUIRE(slope);
  CHECK_FALSE(judge::hasFineBends(smooth, *slope, step, tolerance, 1));
}

TEST_CASE("judge: a case can be pasted into a scene", "[judge]") {
  const Settings s = {{"location", vectorValue({-1.5, 0, 2})},
                      {"radiance", colourValue(1, 2, 3)},
                      {"show", textValue("smooth")},
                      {"map", textValue("picture.exr")},
                      {"angle", numberValue(40)}};
  CHECK(judge::textOfSettings(s) ==
        " angle 40 location <-1.5, 0, 2> map \"picture.exr\" radiance rgb <1, 2, 3> show smooth");
}

TEST_CASE("judge: rows whose values were all refused are told", "[judge]") {
  judge::TriedRows rows;
  rows.offer({{"file", textValue("a")}, {"angle", numberValue(1)}});
  rows.offer({{"angle", numberValue(2)}});
  rows.accept({{"angle", numberValue(2)}});
  rows.offer({{"other", textValue("b")}});
  Schema schema;
  for (const char* name : {"file", "other", "angle"}) {
    schema.params.emplace_back().name = name;
    schema.params.back().type = ValueType::file;
  }
  schema.params[1].type = ValueType::real;
  CHECK(rows.refused(schema) == "file (every value was refused)");
}
