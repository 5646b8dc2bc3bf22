// SPDX-License-Identifier: Apache-2.0
// Lights: what the judge asks of each (judge/light_tests.h), of lights that are seen well; and what
// it cannot know: closed forms, pictures, refusals.
#include <vestige/light.h>

#include <functional>

#include "judge/light_tests.h"
#include "support/findings.h"
#include "support/lights.h"

namespace vestige::test {
namespace {

constexpr judge::Effort kEffort = {.samples = 1 << 16, .falseAlarm = 1e-3};

/// The lights of this suite for the judge.
judge::LightCases judgedCases() {
  judge::LightCases list;
  for (const LightCase& c : lightCases()) list.push_back({c.name, c.light});
  return list;
}

/// Mean and its standard error.
struct Estimate {
  double sum = 0, squares = 0;
  int n = 0;
  void add(double x) { sum += x, squares += x * x, ++n; }
  double mean() const { return sum / n; }
  double error() const { return std::sqrt(std::max(0.0, squares / n - mean() * mean()) / n); }
};

void checkWithin(const Estimate& e, double expected, double relative) {
  INFO("mean " << e.mean() << " +- " << e.error() << ", expected " << expected);
  CHECK(e.error() <= relative * expected);  // else the check below says nothing
  CHECK(std::abs(e.mean() - expected) <= 5 * e.error() + 1e-5 * expected);
}

/// Irradiance at a point by sample(), luminance.
Estimate irradiance(const Light& light, Vec3 from, Vec3 normal, int n) {
  Random random(5);
  Estimate e;
  for (int i = 0; i < n; ++i) {
    const std::optional<LightSample> s = light.sample({from}, random.pair());
    e.add(
        s ? double(luminance(s->radiance) * std::max(Real(0), dot(s->hit.toLight, normal)) / s->pdf)
          : 0);
  }
  return e;
}

}  // namespace

TEST_CASE("light: what the judge asks of all", "[light]") {
  const judge::LightCases cases = judgedCases();
  const judge::LightDensityFindings density = judge::lightSamplesFollowPdf(cases, kEffort);
  check(density.distribution);
  check(density.mass);
  check(density.ownPdf);
  check(density.ownRadiance);
  check(judge::lightAreaIsInverseDensity(cases, kEffort));
  check(judge::lightDuIsTheDerivative(cases, kEffort));
  check(judge::lightFromIsTheDerivative(cases, kEffort));
  check(judge::lightLogGradientIsTheDerivative(cases, kEffort));
  check(judge::emissionIsTheDerivative(cases, kEffort));
  const judge::FluxFindings flux = judge::fluxAgrees(cases, kEffort);
  check(flux.power);
  check(flux.arriving);
  check(judge::lightIsNeverNan(cases, kEffort));
  check(judge::lightAnswersStayTheSame(cases, kEffort));
}

TEST_CASE("light sample: where a light is seen well, all numbers find it", "[light]") {
  Random random(6);
  for (const LightCase& c : lightCases()) {
    INFO(c.name);
    int found = 0;
    for (int i = 0; i < 10000; ++i) found += c.light->sample({c.from}, random.pair()).has_value();
    CHECK(found == 10000);
  }
}

TEST_CASE("light irradiance: closed forms", "[light]") {
  SECTION("area: one corner above the point, parallel") {
    // [Siegel, Howell. Thermal radiation heat transfer, configuration 11]
    const double a = 2, b = 3, h = 1.5, p = std::hypot(a, h), q = std::hypot(b, h);
    const double factor = (a / p * std::atan(b / p) + b / q * std::atan(a / q)) / (2 * M_PI);
    const auto light =
        make<Light>(pluginNamed("light", "area"), {{"corner", at({0, Real(h), 0})},
                                                   {"edge1", at({Real(a), 0, 0})},
                                                   {"edge2", at({0, 0, Real(b)})},
                                                   {"radiance", colourValue(7, 7, 7)}});
    checkWithin(irradiance(*light, {0, 0, 0}, {0, 1, 0}, 400000), M_PI * 7 * factor, 2e-3);
    CHECK(irradiance(*light, {0, 3, 0}, {0, -1, 0}, 100).mean() == 0);  // from behind
  }
  SECTION("point and spot: intensity over distance squared") {
    const auto point =
        make<Light>(pluginNamed("light", "point"),
                    {{"location", at({1, 2, 3})}, {"intensity", colourValue(10, 10, 10)}});
    CHECK(irradiance(*point, {1, 0, 3}, {0, 1, 0}, 1).mean() == Approx(2.5));
    CHECK(irradiance(*point, {1, 0, 3}, {1, 0, 0}, 1).mean() == Approx(0).margin(1e-6));
    const auto spot =
        make<Light>(pluginNamed("light", "spot"), {{"location", at({0, 2, 0})},
                                                   {"point_at", at({0, 0, 0})},
                                                   {"intensity", colourValue(10, 10, 10)},
                                                   {"radius", numberValue(20)},
                                                   {"falloff", numberValue(40)}});
    const auto aside = [&](double degrees) {  // irradiance across the ray, 2 units away
      const double a = degrees * M_PI / 180;
      const Vec3 from = {Real(2 * std::sin(a)), Real(2 - 2 * std::cos(a)), 0};
      const auto s = spot->sample({from}, {});
      return s ? double(s->radiance.g) : 0;
    };
    CHECK(aside(0) == Approx(2.5));
    CHECK(aside(19.9) == Approx(2.5));
    CHECK(aside(40.1) == 0);
    CHECK(aside(90) == 0);
    const double middle = std::acos((std::cos(M_PI / 9) + std::cos(2 * M_PI / 9)) / 2);
    CHECK(aside(middle * 180 / M_PI) == Approx(1.25).epsilon(1e-4));
    const double quarter = std::acos(0.75 * std::cos(M_PI / 9) + 0.25 * std::cos(2 * M_PI / 9));
    CHECK(aside(quarter * 180 / M_PI) == Approx(2.5 * 27 / 32).epsilon(1e-4));
  }
  SECTION("distant: the irradiance itself, across its direction") {
    const auto sun =
        make<Light>(pluginNamed("light", "distant"),
                    {{"direction", at({3, -4, 0})}, {"irradiance", colourValue(5, 5, 5)}});
    CHECK(irradiance(*sun, {7, 7, 7}, {0, 1, 0}, 1).mean() == Approx(4));
    const auto s = sun->sample({}, {});
    CHECK(s->hit.toLight.x == Approx(-0.6));
    CHECK(std::isinf(s->hit.distance));
    CHECK(sun->traits().isInfinite);
  }
  SECTION("environment: pi times its radiance") {
    const auto sky =
        make<Light>(pluginNamed("light", "environment"), {{"radiance", colourValue(2, 2, 2)}});
    checkWithin(irradiance(*sky, {}, {0, 0, 1}, 400000), 2 * M_PI, 3e-3);
    const LightHit anywhere = {{}, {0, 1, 0}, kInfinity, {}, {}, {}};
    CHECK(sky->eval(anywhere) == Rgb{2, 2, 2});
    CHECK(sky->pdf({}, anywhere) == Approx(1 / (4 * M_PI)));
    CHECK(sky->traits().isInfinite);
  }
  SECTION("environment: radiance that grows evenly from the nadir to the zenith") {
    // integral of (1 - theta/pi) cos sin 2 pi over the upper hemisphere
    const auto sky = environment(Picture(16, 256, [](Real, Real v) { return v; }));
    checkWithin(irradiance(*sky, {}, {0, 1, 0}, 400000), 3 * M_PI / 4, 3e-3);
  }
  SECTION("environment: a sun of 72,000 in a texel") {
    const Picture picture = sunny();
    const auto sky = environment(picture);
    const Vec3 normal = normalize(Vec3{1, 2, 1});
    double expected = 0;
    for (const double part : SphereGrid{64, 32}.integrate(
             [&](Vec3 d) {
               const double side = 0.5 + std::atan2(d.x, d.z) / (2 * M_PI);
               const double up = 0.5 + std::asin(std::clamp<double>(d.y, -1, 1)) / M_PI;
               const Vec2 none[2] = {};
               return std::max(Real(0), dot(d, normal)) *
                      picture.lookup({Real(side), Real(up)}, none).colour.g;
             },
             32))
      expected += part;
    checkWithin(irradiance(*sky, {}, normal, 400000), expected, 3e-3);
  }
}

TEST_CASE("light environment: the picture is not mirrored", "[light][environment]") {
  // A bright texel a quarter to the right of the middle is seen towards +x, one high up towards +y.
  const auto brightAt = [](int x, int y) {
    return environment(Picture(64, 32, [=](Real u, Real v) {
      return int(u * 64) == x && int(v * 32) == y ? Real(1000) : Real(1);
    }));
  };
  const auto towards = [](const Light& l, Vec3 d) {
    return double(l.eval({{}, normalize(d), kInfinity, {}, {}, {}}).g);
  };
  const Real t = kPi / 64;  // the middle of a texel beside the axis: 1/64 of a turn, halved
  const auto right = brightAt(48, 16), front = brightAt(32, 16), up = brightAt(32, 31);
  CHECK(towards(*right, {std::cos(t), std::tan(t), -std::sin(t)}) == Approx(1000).epsilon(0.02));
  CHECK(towards(*right, {-1, 0, 0}) == Approx(1));
  CHECK(towards(*front, {std::sin(t), std::tan(t), std::cos(t)}) == Approx(1000).epsilon(0.02));
  CHECK(towards(*up, {std::sin(t) * std::sin(t), std::cos(t), std::sin(t) * std::cos(t)}) ==
        Approx(1000).epsilon(0.02));

  SECTION("a camera that looks along +z shows the picture itself") {
    const Picture picture = sunny();
    const auto sky = environment(picture);
    const auto camera = make<Camera>(pluginNamed("camera", "panorama"));
    Random random(8);
    Worst worst;
    for (int i = 0; i < 500; ++i) {
      const Vec2 film = random.pair(), none[2] = {};
      const auto s = camera->sample({film, {}, 2});
      worst.add(luminance(sky->eval({{}, s->direction, kInfinity, {}, {}, {}})),
                luminance(picture.lookup({film.x, 1 - film.y}, none).colour));
    }
    CHECK(worst.value < (sizeof(Real) == 8 ? 1e-9 : 2e-2));  // the sun is steep
  }
  SECTION("rotate turns it") {
    const Affine quarter = rotation({0, 1, 0}, 90);
    const auto turned = environment(Picture(64, 32, [](Real u, Real) { return u; }), {}, quarter);
    const Vec3 d = quarter.vector({0, 0, 1});
    CHECK(towards(*turned, d) == Approx(0.5));
    CHECK(towards(*turned, {0, 0, 1}) != Approx(0.5));
  }
}

TEST_CASE("light environment: how it asks for its image", "[light][environment]") {
  PictureHost host(Picture(8, 4, [](Real, Real) { return Real(1); }));
  const LoadedPlugin plugin = pluginNamed("light", "environment");
  make<Light>(plugin, {{"map", textValue("a.hdr")}}, host);
  CHECK(host.last.file == "a.hdr");
  CHECK(host.last.wrapU == Wrap::repeat);
  CHECK(host.last.wrapV == Wrap::clamp);
  make<Light>(plugin, {{"image", imageBlock("image", "b.hdr")}}, host);
  CHECK(host.last.file == "b.hdr");
  CHECK(host.last.colourSpace == "raw");
  CHECK(host.warnings.empty());
}

TEST_CASE("light environment: images that are no radiance", "[light][environment]") {
  SECTION("NaN, infinite and negative texels are black, and said so") {
    PictureHost host(Picture(8, 4, [](Real u, Real v) {
      if (u < Real(0.125)) return std::numeric_limits<Real>::quiet_NaN();
      if (v < Real(0.25)) return Real(-5);
      return u > Real(0.875) ? kInfinity : Real(1);
    }));
    const auto sky =
        make<Light>(pluginNamed("light", "environment"), {{"map", textValue("sky.hdr")}}, host);
    REQUIRE(host.warnings.size() == 1);
    CHECK_THAT(host.warnings[0], containsText("14 texels that are negative or not finite"));
    Random random(9);
    bool sane = isFinite(sky->power());
    for (int i = 0; i < 5000; ++i) {
      const auto s = sky->sample({}, random.pair());
      sane = sane && (!s || (isFinite(s->radiance) && s->pdf > 0 && s->radiance.g >= 0));
    }
    CHECK(sane);
  }
  SECTION("a black one sends nothing") {
    const auto sky = environment(Picture(8, 4, [](Real, Real) { return Real(0); }));
    CHECK(!sky->sample({}, {Real(0.3), Real(0.4)}));
    CHECK(!sky->emit({{Real(0.3), Real(0.4)}, {Real(0.3), Real(0.4)}}));
    CHECK(sky->pdf({}, {{}, {0, 1, 0}, kInfinity, {}, {}, {}}) == 0);
    CHECK(isBlack(sky->power()));
  }
  SECTION("whatever shines has a density, and whatever is black has none") {
    const auto sky = environment(Picture(32, 16, [](Real u, Real v) {
      return int(u * 32) == 7 && int(v * 16) == 9 ? Real(100) : Real(0);
    }));
    Random random(10);
    int bright = 0;
    bool both = true;
    for (int i = 0; i < 200000; ++i) {
      const Vec2 u = random.pair();
      const LightHit hit = {{}, uniformCap(u, -1).d, kInfinity, {}, {}, {}};
      const bool shines = sky->eval(hit).g > 0;
      bright += shines, both = both && (!shines || sky->pdf({}, hit) > 0);
    }
    CHECK(both);
    CHECK(bright > 100);
  }
}

TEST_CASE("light emit: what arrives at a small square", "[light][emission]") {
  for (const LightCase& c : lightCases()) {
    INFO(c.name);
    Random random(11);
    Estimate arriving;
    // A square of 0.5 x 0.5 around `from`, facing the light.
    const Frame f = Frame::around(c.receiver);
    Estimate expected;
    for (int i = 0; i < 100000; ++i) {
      const Vec2 u = random.pair();
      const Vec3 on = c.from + (u.x - Real(0.5)) / 2 * f.s + (u.y - Real(0.5)) / 2 * f.t;
      const auto s = c.light->sample({on}, random.pair());
      expected.add(s ? double(luminance(s->radiance) * Real(0.25) / s->pdf *
                              std::max(Real(0), dot(s->hit.toLight, f.n)))
                     : 0);
    }
    const int n = 400000;
    for (int i = 0; i < n; ++i) {
      const auto p = c.light->emit({random.pair(), random.pair()});
      const Real down = p ? -dot(p->direction, f.n) : 0;
      const Real t = p ? dot(p->origin - c.from, f.n) / down : -1;
      const Vec3 at =
          p && down > 0 && t > 0 ? f.toLocal(p->origin + t * p->direction - c.from) : Vec3{9, 9, 9};
      const bool met = std::abs(at.x) < Real(0.25) && std::abs(at.y) < Real(0.25);
      arriving.add(met ? double(luminance(p->power)) : 0);
    }
    const double error = std::hypot(arriving.error(), expected.error());
    INFO("arriving " << arriving.mean() << ", expected " << expected.mean() << " +- " << error);
    CHECK(error < 0.05 * expected.mean());
    CHECK(std::abs(arriving.mean() - expected.mean()) < 5 * error);
  }
}

TEST_CASE("light power: closed forms", "[light][emission]") {
  const Bounds scene = {{-1, -2, -2}, {1, 2, 2}};  // half the diagonal is 3
  const auto power = [&](const std::string& name, const Settings& settings) {
    const auto light = make<Light>(pluginNamed("light", name), settings);
    light->setScene(scene);
    return double(light->power().g);
  };
  const Settings quad = {{"corner", at({0, 0, 0})},
                         {"edge1", at({2, 0, 0})},
                         {"edge2", at({1, 0, 3})},
                         {"radiance", colourValue(5, 5, 5)}};
  CHECK(power("area", quad) == Approx(M_PI * 6 * 5));
  Settings both = quad;
  both["two_sided"] = numberValue(1);
  CHECK(power("area", both) == Approx(2 * M_PI * 6 * 5));
  CHECK(power("point", {{"intensity", colourValue(3, 3, 3)}}) == Approx(12 * M_PI));
  CHECK(power("distant", {{"irradiance", colourValue(2, 2, 2)}}) == Approx(M_PI * 9 * 2));
  CHECK(power("environment", {{"radiance", colourValue(2, 2, 2)}}) ==
        Approx(4 * M_PI * 2 * M_PI * 9));
  double spot = 0;  // integral of the cubic over the cone
  const double inner = std::cos(M_PI / 9), outer = std::cos(M_PI / 4);
  for (int i = 0; i < 10000; ++i) {
    const double c = outer + (1 - outer) * (i + 0.5) / 10000;
    const double t = std::min(1.0, (c - outer) / (inner - outer));
    spot += 2 * M_PI * (1 - outer) / 10000 * t * t * (3 - 2 * t);
  }
  CHECK(power("spot", {{"radius", numberValue(20)}, {"falloff", numberValue(45)}}) ==
        Approx(spot).epsilon(1e-5));
}

TEST_CASE("light emission of an area: cosine about its normal, from its own side",
          "[light][area][emission]") {
  const auto light = make<Light>(pluginNamed("light", "area"), downLight());
  Random random(12);
  Estimate cosine, square;
  bool down = true;
  for (int i = 0; i < 200000; ++i) {
    const auto p = light->emit({random.pair(), random.pair()});
    down = down && p->normal == Vec3{0, -1, 0} && p->origin.y == 5;
    const double c = -double(p->direction.y);
    cosine.add(c), square.add(c * c);
  }
  CHECK(down);
  checkWithin(cosine, 2.0 / 3, 1e-3);
  checkWithin(square, 0.5, 2e-3);
}

TEST_CASE("light area: its surface", "[light][area]") {
  const auto check = [](const Affine& toWorld, Vec3 shines) {
    const auto light = make<Light>(pluginNamed("light", "area"), downLight(), toWorld);
    REQUIRE(light->geometry());
    const TriangleMesh& m = *light->geometry();
    REQUIRE(m.triangles.size() == 2);
    double area = 0;
    for (const auto& t : m.triangles) {
      const Vec3 across =
          cross(m.positions[t[1]] - m.positions[t[0]], m.positions[t[2]] - m.positions[t[0]]);
      area += double(length(across)) / 2;
      CHECK(length(normalize(across) - shines) < Real(1e-5));
    }
    CHECK(area * M_PI == Approx(double(light->power().g)));
    for (std::size_t i = 0; i < m.positions.size(); ++i) {  // uv = <u.x, u.y> of sample()
      const Vec3 p = toWorld.point({-1 + 2 * m.uvs[i].x, 5, -1 + 2 * m.uvs[i].y});
      CHECK(length(p - m.positions[i]) < Real(1e-5));
    }
    // Lit from the shining side only.
    const Vec3 middle = toWorld.point({0, 5, 0});
    CHECK(light->sample({middle + shines}, {Real(0.5), Real(0.5)}));
    CHECK(!light->sample({middle - shines}, {Real(0.5), Real(0.5)}));
    CHECK(light->eval({middle - shines, shines, 1, middle, shines, {}}) == Rgb{});
    CHECK(light->pdf({middle - shines}, {middle - shines, shines, 1, middle, shines, {}}) == 0);
  };
  check({}, {0, -1, 0});
  check(rotation({0, 0, 1}, 90), {1, 0, 0});
  Affine mirror;
  mirror.m[1][1] = -1;
  check(mirror, {0, 1, 0});
}

TEST_CASE("light parameters that make no sense are refused", "[light][errors]") {
  const auto refused = [](const std::string& name, const Settings& settings,
                          const std::string& words) {
    INFO(name << ": " << words);
    CHECK_THROWS_WITH(make<Light>(pluginNamed("light", name), settings), containsText(words));
  };
  Settings quad = downLight();
  quad["edge2"] = at({-4, 0, 0});
  refused("area", quad, "edge2 <-4, 0, 0> is parallel to edge1 <2, 0, 0>");
  quad["edge2"] = at({0, 0, 0});
  refused("area", quad, "has no length");
  refused("distant", {{"direction", at({0, 0, 0})}}, "direction has no length");
  refused("spot", {{"location", at({1, 1, 1})}, {"point_at", at({1, 1, 1})}},
          "the light's own location");
  refused("spot", {{"radius", numberValue(30)}, {"falloff", numberValue(20)}},
          "radius is 30 and falloff 20 degrees");
  refused("spot", {{"falloff", numberValue(0)}}, "falloff is 0: expected more than 0");
  CHECK_NOTHROW(make<Light>(pluginNamed("light", "spot"), {{"falloff", numberValue(20)}}));
  CHECK_NOTHROW(make<Light>(pluginNamed("light", "spot"), {{"radius", numberValue(60)}}));

  refused("environment", {{"image", imageBlock("checker", "a.png")}}, "expected an image");
  refused("environment", {{"image", imageBlock("image", "a.png")}, {"map", textValue("b.png")}},
          "expected one of them");
  PictureHost nothing;
  CHECK_THROWS_WITH(make<Light>(pluginNamed("light", "environment"),
                                {{"image", imageBlock("image", "gone.hdr")}}, nothing),
                    containsText("no file gone.hdr"));
}

}  // namespace vestige::test
