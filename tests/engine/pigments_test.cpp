// SPDX-License-Identifier: Apache-2.0
#include <vestige/pigment.h>

#include "support/catch.h"
#include "support/plugins.h"

using namespace vestige;
using namespace vestige::test;

namespace {

const Value kRed = colourValue(1, 0, 0), kBlue = colourValue(0, 0, 1);

/// Red part: 1 where the pigment of red and blue shows red.
Real redAt(const Pigment& p, Vec3 position, Vec2 uv = {}) {
  return p.eval({position, uv, {}}).colour.r;
}

/// What was looked up last is what it shows.
class EchoTexture final : public Texture {
 public:
  Rgba lookup(Vec2 uv, const Vec2 d[2]) const noexcept override {
    dUv[0] = d[0], dUv[1] = d[1];
    return {{uv.x, uv.y, Real(0.5)}, Real(0.25)};
  }
  Rgba texel(int, int) const noexcept override { return {}; }
  int width() const noexcept override { return 20; }
  int height() const noexcept override { return 10; }
  bool hasAlpha() const noexcept override { return true; }
  Rgba mean() const noexcept override { return {{Real(0.1), Real(0.2), Real(0.3)}, 1}; }
  mutable Vec2 dUv[2];
};

class EchoHost final : public Host {
 public:
  std::string find(const std::string& file, Span, std::string&) override { return file; }
  std::shared_ptr<const Texture> texture(const TextureRequest& r, std::string& error) override {
    request = r;
    if (r.file == "missing.png") return error = "there is no file 'missing.png'", nullptr;
    return echo;
  }
  void warn(Span, const std::string&) override {}
  std::shared_ptr<EchoTexture> echo = std::make_shared<EchoTexture>();
  TextureRequest request;
};

std::shared_ptr<Pigment> imagePigment(Host& host, Settings settings) {
  settings.insert({"file", textValue("a.png")});
  return make<Pigment>(pluginNamed("pigment", "image"), settings, host);
}

}  // namespace

TEST_CASE("checker: cells of one, the first colour at the origin", "[pigment][checker]") {
  const LoadedPlugin plugin = pluginNamed("pigment", "checker");
  const Settings colours = {{"first", kRed}, {"second", kBlue}};
  const auto solid = make<Pigment>(plugin, colours);
  const Real h = Real(0.5);
  CHECK(redAt(*solid, {h, h, h}) == 1);
  CHECK(redAt(*solid, {h + 1, h, h}) == 0);
  CHECK(redAt(*solid, {h + 1, h - 1, h}) == 1);
  CHECK(redAt(*solid, {h - 1, h - 1, h - 1}) == 0);
  CHECK(redAt(*solid, {h - 7, h, h + 101}) == 1);
  CHECK(solid->mean().colour == Rgb{Real(0.5), 0, Real(0.5)});
  // A floor at y = 0, above and below it by rounding, is one board, not noise.
  for (const Real y : {Real(1e-5), Real(0), Real(-1e-5)}) {
    CHECK(redAt(*solid, {h, y, h}) == 1);
    CHECK(redAt(*solid, {h, y, h + 1}) == 0);
  }
  for (const Real far : {Real(1e20), kInfinity, Real(-1e30)})
    CHECK(std::isfinite(redAt(*solid, {far, h, h})));

  Settings byUv = colours;
  byUv["mapping"] = textValue("uv");
  const auto flat = make<Pigment>(plugin, byUv);
  CHECK(redAt(*flat, {h, h, h + 1}, {h, h}) == 1);
  CHECK(redAt(*flat, {h, h, h}, {h - 1, h}) == 0);
}

TEST_CASE("gradient: a saw-tooth along its direction", "[pigment][gradient]") {
  const LoadedPlugin plugin = pluginNamed("pigment", "gradient");
  const auto up = make<Pigment>(plugin, {{"first", kBlue}, {"second", kRed}});
  CHECK(redAt(*up, {5, Real(0.25), 9}) == Approx(0.25));
  CHECK(redAt(*up, {0, Real(3.75), 0}) == Approx(0.75));
  CHECK(redAt(*up, {0, Real(-0.25), 0}) == Approx(0.75));
  CHECK(up->eval({{0, Real(0.25), 0}, {}, {}}).colour.b == Approx(0.75));
  CHECK(redAt(*up, {0, Real(-1e-12), 0}) <= 1);
  const auto slanted =
      make<Pigment>(plugin, {{"second", kRed}, {"direction", vectorValue({2, 0, 1})}});
  CHECK(redAt(*slanted, {Real(0.1), 7, Real(0.3)}) == Approx(0.5));
  CHECK_THROWS_WITH(make<Pigment>(plugin, {{"direction", vectorValue({0, 0, 0})}}),
                    containsText("direction"));
}

TEST_CASE("noise: smooth, centred, within its range", "[pigment][noise]") {
  const LoadedPlugin plugin = pluginNamed("pigment", "noise");
  const Settings colours = {{"first", colourValue(0, 0, 0)}, {"second", colourValue(1, 1, 1)}};
  const auto fbm = make<Pigment>(plugin, colours);
  Settings one = colours;
  one["octaves"] = numberValue(1);
  const auto smooth = make<Pigment>(plugin, one);
  double sum = 0, squares = 0, steepest = 0;
  constexpr int kN = 40000;
  for (int i = 0; i < kN; ++i) {
    const Vec3 p{Real(0.618034 * i - 9000), Real(0.754878 * i), Real(0.569840 * i - 300)};
    const Real t = redAt(*smooth, p), all = redAt(*fbm, p);
    CHECK((t >= 0 && t <= 1 && all >= 0 && all <= 1));
    sum += t, squares += sqr(t - Real(0.5));
    const Real step = Real(1.0 / 64);  // exact in float at these positions
    const Real dx = redAt(*smooth, p + Vec3{step, 0, 0}) - t;
    steepest = std::max(steepest, std::abs(double(dx) / step));
  }
  CHECK(sum / kN == Approx(0.5).margin(0.005));  // s.d. of one is 0.13
  const double deviation = std::sqrt(squares / kN);
  CHECK((deviation > 0.08 && deviation < 0.25));  // neither flat nor white
  CHECK(steepest < 2.5);  // 1/2 (1 + 1.875 * 2 at most) for slopes of 1 and the fade's 15/8
  CHECK(redAt(*smooth, {0, 0, 0}) == Approx(0.5));  // lattice points

  Settings other = one;
  other["seed"] = numberValue(1);
  const auto reseeded = make<Pigment>(plugin, other);
  CHECK(redAt(*reseeded, {Real(0.4), Real(0.3), Real(0.2)}) !=
        redAt(*smooth, {Real(0.4), Real(0.3), Real(0.2)}));
  for (const Real far : {Real(1e20), kInfinity, Real(std::nan(""))})
    CHECK(redAt(*fbm, {far, 0, 0}) == Approx(0.5));
}

TEST_CASE("noise has no step where cells meet", "[pigment][noise]") {
  const auto noise = make<Pigment>(pluginNamed("pigment", "noise"), {{"octaves", numberValue(3)}});
  for (int i = 0; i < 200; ++i) {
    const Vec3 p{Real(i - 100), Real(0.37 * i), Real(-0.21 * i)};
    const Vec3 step{Real(1e-4), 0, 0};
    CHECK(std::abs(redAt(*noise, p + step) - redAt(*noise, p - step)) < 2e-3);
  }
}

TEST_CASE("patterns at points: what POV-Ray shows there", "[pigment][pattern]") {
  // From POV-Ray 3.7's eval_pigment at random points; colours black and white, or red, green, blue.
  struct Row {
    Vec3 p;
    int brick, smallBrick, hexagon;
    double marble, wood, agate;
  };
  const Row rows[] = {
      {{3.2468, -4.4878, -2.1220}, 1, 1, 2, 0.4936, 0.9217, 0.1268},
      {{-2.6009, 9.6514, 11.9154}, 1, 1, 1, 0.7982, 0.0088, 0.8511},
      {{14.1799, -17.6478, 17.3418}, 1, 1, 1, 0.3595, 0.7229, 0.7847},
      {{15.6544, 12.3917, 11.4195}, 0, 1, 2, 0.6915, 0.0697, 0.4075},
      {{-9.5095, 6.5126, -2.5462}, 0, 1, 2, 0.9813, 0.9486, 0.9805},
      {{-8.2377, 7.5280, 19.6313}, 0, 1, 1, 0.4753, 0.3184, 0.3123},
      {{-3.5655, -2.1045, -6.4806}, 1, 0, 2, 0.8690, 0.2805, 0.2182},
      {{-0.2263, -4.2422, 19.4921}, 0, 0, 2, 0.4526, 0.4965, 0.7434},
      {{1.9029, 12.4632, 7.9846}, 1, 1, 0, 0.1942, 0.7849, 0.0305},
      {{-11.7154, -19.9793, -10.3370}, 1, 1, 0, 0.5695, 0.3212, 0.2165},
      {{-12.3215, -6.2287, 6.9577}, 0, 0, 1, 0.6429, 0.3874, 0.1555},
      {{19.6860, -5.1308, -7.0919}, 0, 1, 0, 0.6284, 0.6869, 0.9803},
  };
  const Settings grey = {{"first", colourValue(0, 0, 0)}, {"second", colourValue(1, 1, 1)}};
  const auto with = [&](const char* name, Settings s = {}) {
    s.insert(grey.begin(), grey.end());
    return make<Pigment>(pluginNamed("pigment", name), s);
  };
  const auto brick = with("brick"), marble = with("marble"), wood = with("wood");
  const auto small =
      with("brick", {{"brick_size", vectorValue({4, 2, 3})}, {"mortar", numberValue(0.3)}});
  const auto agate = with("agate", {{"agate_turb", numberValue(0)}});
  const auto hexagon = with("hexagon", {{"first", colourValue(0, 0, 0)},
                                        {"second", colourValue(1, 1, 1)},
                                        {"third", colourValue(2, 2, 2)}});
  for (const Row& r : rows) {
    CAPTURE(r.p.x, r.p.y, r.p.z);
    CHECK(redAt(*brick, r.p) == r.brick);
    CHECK(redAt(*small, r.p) == r.smallBrick);
    CHECK(redAt(*hexagon, r.p) == r.hexagon);
    CHECK(redAt(*marble, r.p) == Approx(r.marble).margin(6e-4));
    CHECK(redAt(*wood, r.p) == Approx(r.wood).margin(6e-4));
    CHECK(redAt(*agate, r.p) == Approx(r.agate).margin(6e-4));
  }
}

TEST_CASE("noise patterns spread as POV-Ray's do", "[pigment][pattern]") {
  // Mean and standard deviation of POV-Ray 3.7's patterns over 20000 random places.
  struct Row {
    const char* name;
    double mean, deviation;
  };
  for (const Row& r : {Row{"bozo", 0.506, 0.126}, Row{"granite", 0.395, 0.161},
                       Row{"wrinkles", 0.510, 0.142}, Row{"agate", 0.551, 0.340}}) {
    CAPTURE(r.name);
    const auto pigment =
        make<Pigment>(pluginNamed("pigment", r.name),
                      {{"first", colourValue(0, 0, 0)}, {"second", colourValue(1, 1, 1)}});
    double sum = 0, squares = 0;
    constexpr int kN = 20000;
    for (int i = 0; i < kN; ++i) {
      const Real t =
          redAt(*pigment, {Real(0.618034 * i - 9000), Real(0.754878 * i), Real(0.569840 * i)});
      sum += t, squares += t * t;
    }
    CHECK(sum / kN == Approx(r.mean).margin(0.05));
    CHECK(std::sqrt(squares / kN - sqr(sum / kN)) == Approx(r.deviation).epsilon(0.2));
  }
}

TEST_CASE("patterns refuse what has no size", "[pigment][pattern]") {
  CHECK_THROWS_WITH(
      make<Pigment>(pluginNamed("pigment", "stripes"), {{"direction", vectorValue({0, 0, 0})}}),
      containsText("direction"));
  CHECK_THROWS_WITH(
      make<Pigment>(pluginNamed("pigment", "brick"), {{"brick_size", vectorValue({8, 0.5, 4})}}),
      containsText("larger than the mortar"));
}

TEST_CASE("image: mappings", "[pigment][image]") {
  EchoHost host;
  const Lookup at{{Real(0.3), Real(-0.2), 5}, {Real(0.7), Real(0.8)}, {}};
  const auto uv = imagePigment(host, {});
  CHECK(uv->eval(at).colour == Rgb{Real(0.7), Real(0.8), Real(0.5)});
  CHECK(uv->eval(at).alpha == Real(0.25));
  CHECK(uv->texels() == Vec2{20, 10});
  const auto planar = imagePigment(host, {{"mapping", textValue("planar")}});
  CHECK(planar->eval(at).colour == Rgb{Real(0.3), Real(-0.2), Real(0.5)});
  CHECK(planar->texels() == Vec2{0, 0});

  const auto sphere = imagePigment(host, {{"mapping", textValue("spherical")}});
  const auto direction = [&](Vec3 p) { return sphere->eval({p, {}, {}}).colour; };
  const auto check = [&](Vec3 p, double u, double v) {
    CHECK(direction(p).r == Approx(u).margin(1e-6));
    CHECK(direction(p).g == Approx(v).margin(1e-6));
  };
  check({2, 0, 0}, 0, 0.5);
  check({0, 0, 3}, 0.25, 0.5);
  check({-1, 0, 0}, 0.5, 0.5);
  check({0, 0, -1}, 0.75, 0.5);
  check({0, 4, 1e-6}, 0.25, 1);
  check({1, -1, 0}, 0, 0.25);
  CHECK(std::isfinite(direction({0, 0, 0}).r));
}

TEST_CASE("image: the footprint follows the mapping", "[pigment][image]") {
  EchoHost host;
  const Vec3 p{Real(0.8), Real(0.5), Real(-0.6)}, d{Real(0.1), Real(-0.2), Real(0.3)};
  Lookup at{p, {}, {}};
  at.footprint.dP[0] = d, at.footprint.dUv[1] = {3, 4};
  imagePigment(host, {})->eval(at);
  CHECK(host.echo->dUv[1] == Vec2{3, 4});
  for (const char* mapping : {"planar", "spherical"}) {
    const auto pigment = imagePigment(host, {{"mapping", textValue(mapping)}});
    const Real h = sizeof(Real) == 8 ? Real(1e-5) : Real(2e-3);
    const Rgb ahead = pigment->eval({p + h * d, {}, {}}).colour;
    const Rgb behind = pigment->eval({p - h * d, {}, {}}).colour;
    pigment->eval(at);
    CHECK(host.echo->dUv[0].x == Approx((ahead.r - behind.r) / (2 * h)).margin(1e-4));
    CHECK(host.echo->dUv[0].y == Approx((ahead.g - behind.g) / (2 * h)).margin(1e-4));
    CHECK(host.echo->dUv[1] == Vec2{0, 0});
  }
}

TEST_CASE("image: channels, scale and request", "[pigment][image]") {
  EchoHost host;
  const Lookup at{{}, {Real(0.2), Real(0.4)}, {}};  // shows <0.2, 0.4, 0.5>, alpha 0.25
  const auto shows = [&](const char* channel) {
    const auto p = imagePigment(host, {{"channel", textValue(channel)}});
    const Rgba c = p->eval(at);
    CHECK(c.colour.r == c.colour.b);
    CHECK(c.alpha == 1);
    return double(c.colour.g);
  };
  CHECK(shows("r") == Approx(0.2));
  CHECK(shows("g") == Approx(0.4));
  CHECK(shows("b") == Approx(0.5));
  CHECK(shows("a") == Approx(0.25));
  CHECK(shows("luminance") == Approx(0.2126 * 0.2 + 0.7152 * 0.4 + 0.0722 * 0.5));

  const auto scaled = imagePigment(host, {{"scale_value", colourValue(2, 3, 4)},
                                          {"wrap", textValue("mirror")},
                                          {"color_space", textValue("raw")}});
  CHECK(scaled->eval(at).colour.g == Approx(1.2));
  CHECK(scaled->mean().colour.b == Approx(1.2));
  CHECK(host.request.file == "a.png");
  CHECK(host.request.colourSpace == "raw");
  CHECK((host.request.wrapU == Wrap::mirror && host.request.wrapV == Wrap::mirror));
  CHECK_THROWS_WITH(imagePigment(host, {{"file", textValue("missing.png")}}),
                    containsText("no file 'missing.png'"));
}
