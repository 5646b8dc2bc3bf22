// SPDX-License-Identifier: Apache-2.0
// Nested and touching solids that refract, and what they absorb. Expectations are the laws of
// Snell, Fresnel and Beer, in double.
#include <optional>

#include "engine/scene/scene.h"
#include "images/picture.h"
#include "support/text_scene.h"

using namespace vestige;
using namespace vestige::test;

namespace {

const std::string kCamera = "camera pinhole { location <0, 0, -50> look_at <0, 0, 0> }\n";

std::string glass(double ior, const std::string& more = "") {
  return " brdf glass { ior " + std::to_string(ior) + " " + more + " } }\n";
}

struct Vector {
  double x, y, z;
  explicit Vector(Vec3 v) : x(v.x), y(v.y), z(v.z) {}
  Vector(double a, double b, double c) : x(a), y(b), z(c) {}
};
Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vector operator*(double s, Vector a) { return {s * a.x, s * a.y, s * a.z}; }
double inner(Vector a, Vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// Snell's law in vectors; `normal` against the direction.
Vector refracted(Vector d, Vector normal, double from, double to) {
  const double eta = from / to, c = -inner(d, normal);
  const double t = std::sqrt(1 - eta * eta * (1 - c * c));
  return eta * d + (eta * c - t) * normal;
}

/// Fresnel's share that passes, unpolarised; by cosine of incidence.
double passing(double c, double from, double to) {
  const double t = std::sqrt(1 - (from / to) * (from / to) * (1 - c * c));
  const double s = (from * c - to * t) / (from * c + to * t);
  const double p = (to * c - from * t) / (to * c + from * t);
  return 1 - (s * s + p * p) / 2;
}

/// An interface where a beam was refracted.
struct Bend {
  Vector position, direction;  ///< where, and where to
  double passed;               ///< share of the flux
  double from, to;             ///< refractive indices
};

/// Follows what is refracted, until it leaves the scene or hits what does not refract.
std::vector<Bend> beam(const Scene& scene, Vec3 origin, Vec3 direction) {
  const SceneView& view = scene.view();
  Ray ray{origin, normalize(direction)};
  ray.media = view.mediaAt(origin);
  std::vector<Bend> bends;
  Surface s;
  InputBuffer inputs;
  Interaction x;
  while (view.intersect(ray, s) && bends.size() < 100) {
    view.shade(s, -ray.direction, {}, inputs, x);
    const auto next = drawScatter(x, {Real(0.99999), {}});
    if (!next || next->local.toNext.z > 0) break;
    bends.push_back({Vector(s.position + view.middle), Vector(next->toNext),
                     double(next->local.lobeChance), double(x.point.etaPrev),
                     double(x.point.etaNext)});
    ray = spawnRay(s, next->toNext);
  }
  return bends;
}

void checkNear(Vector a, Vector b) {
  CHECK(a.x == Approx(b.x).margin(1e-3));
  CHECK(a.y == Approx(b.y).margin(1e-3));
  CHECK(a.z == Approx(b.z).margin(1e-3));
}

/// A beam through parallel layers, z = places[k] between indices[k] and indices[k + 1].
void checkLayers(const Scene& scene, const std::vector<double>& places,
                 const std::vector<double>& indices, double degrees, bool isReversed) {
  INFO("incidence " << degrees << ", reversed " << isReversed);
  const double side = isReversed ? -1 : 1, radians = degrees * 3.14159265358979 / 180;
  const int n = int(places.size());
  Vector d{std::sin(radians), 0, side * std::cos(radians)};
  Vector at{0.1, 0.2, isReversed ? places.back() + 1 : places.front() - 1};
  const auto bends =
      beam(scene, {Real(at.x), Real(at.y), Real(at.z)}, {Real(d.x), Real(d.y), Real(d.z)});
  REQUIRE(bends.size() == places.size());
  for (int k = 0; k < n; ++k) {
    const int i = isReversed ? n - 1 - k : k;
    const double from = indices[std::size_t(isReversed ? i + 1 : i)];
    const double to = indices[std::size_t(isReversed ? i : i + 1)];
    const Bend& bend = bends[std::size_t(k)];
    at = at + (places[std::size_t(i)] - at.z) / d.z * d;
    CHECK(bend.from == Approx(from));
    CHECK(bend.to == Approx(to));
    CHECK(bend.passed == Approx(passing(std::abs(d.z), from, to)).epsilon(1e-3));
    checkNear(bend.position, at);
    d = refracted(d, {0, 0, -side}, from, to);
    checkNear(bend.direction, d);
  }
}

void checkLayers(const std::string& solids, const std::vector<double>& places,
                 const std::vector<double>& indices) {
  INFO(solids);
  const auto scene = sceneOf(kCamera + solids);
  for (const double degrees : {0.0, 20.0, 40.0, 60.0, 80.0})
    for (const bool isReversed : {false, true})
      checkLayers(*scene, places, indices, degrees, isReversed);
}

std::string slab(double from, double to, double ior, const std::string& more = "") {
  return "box { <-90, -90, " + std::to_string(from) + ">, <90, 90, " + std::to_string(to) + ">" +
         glass(ior, more);
}

/// A box as a file of triangles; `faces`: how many of the twelve.
std::string boxFile(double from, double to, int faces) {
  const auto file = scratch() / ("box" + std::to_string(faces) + ".obj");
  std::ofstream out(file);
  for (const double z : {from, to})
    for (const double y : {-90, 90})
      for (const double x : {-90, 90}) out << "v " << x << ' ' << y << ' ' << z << '\n';
  const int quads[6][4] = {{1, 3, 4, 2}, {5, 6, 8, 7}, {1, 2, 6, 5},
                           {3, 7, 8, 4}, {1, 5, 7, 3}, {2, 4, 8, 6}};
  for (int k = 0; k < faces; ++k) {
    const int* q = quads[k / 2];
    out << "f " << q[0] << ' ' << q[1 + k % 2] << ' ' << q[2 + k % 2] << '\n';
  }
  return "mesh { \"" + file.string() + "\" handedness \"left\"";
}

std::string looksAt(const std::string& integrator) {
  return "camera orthographic { location <0, 0, -5> look_at <0, 0, 0> width 1 }\n"
         "film { resolution <8, 8> }\nintegrator " +
         integrator + "\n";
}

const char* const kIntegrators[] = {"path { }", "simple { }", "distributed { split 1 }",
                                    "particle { particles 1000 }"};

}  // namespace

TEST_CASE("water in a glass refracts as three media", "[images][dielectrics]") {
  const std::vector<double> indices = {1, 1.5, 1.33, 1};
  // The water reaches into the glass, touches it, or starts where it starts.
  checkLayers(slab(0, 1, 1.5, "priority 1") + slab(0.95, 3, 1.33), {0, 1, 3}, indices);
  checkLayers(slab(0.95, 3, 1.33) + slab(0, 1, 1.5, "priority 1"), {0, 1, 3}, indices);
  checkLayers(slab(0, 1, 1.5) + slab(1, 3, 1.33), {0, 1, 3}, indices);
  checkLayers(slab(1, 3, 1.33) + slab(0, 1, 1.5), {0, 1, 3}, indices);
  checkLayers(slab(0, 3, 1.33) + slab(0, 1, 1.5, "priority 1"), {0, 1, 3}, indices);
  checkLayers(slab(0, 1, 1.5, "priority 2") + slab(0.5, 3, 1.33, "priority 1"), {0, 1, 3}, indices);
  checkLayers(slab(0, 1, 1.5, "priority 1") + slab(0.5, 3, 1.33, "priority 2"), {0, 0.5, 3},
              indices);
}

TEST_CASE("a shared face at a place that floats do not have", "[images][dielectrics]") {
  // 0.1 + 0.2 and the like round differently on both sides, and the scene stands far away.
  for (const double z : {0.3, 0.7, 1.1})
    for (const char* where : {"", "translate <3, 5, 1000>"}) {
      const std::string open = slab(0, z, 1.5), other = slab(z, 3, 1.33);
      const auto moved = [&](std::string s) { return s.insert(s.rfind('}'), where); };
      INFO("face " << z << " " << where);
      const auto scene = sceneOf(kCamera + moved(open) + moved(other));
      const Real far = *where ? Real(1000) : Real(0);
      const Vec3 from = Vec3{Real(0.1), Real(0.2), far - 1} - scene->view().middle;
      for (const double slope : {0.0, 0.3, 1.0, 3.0}) {
        const auto bends = beam(*scene, from, {Real(slope), 0, 1});
        REQUIRE(bends.size() == 3);
        CHECK(bends[1].from == Approx(1.5));
        CHECK(bends[1].to == Approx(1.33));
      }
    }
}

TEST_CASE("a cemented doublet refracts at its shared surface", "[images][dielectrics]") {
  constexpr double kCrown = 1.517, kFlint = 1.649;
  const auto scene = sceneOf(kCamera + "sphere { <0, 0, 0>, 1" + glass(kCrown, "priority 1") +
                             "box { <-5, -5, 0>, <5, 5, 3>" + glass(kFlint));
  for (const double height : {0.0, 0.1, 0.3, 0.5, 0.7}) {
    INFO("height " << height);
    const auto bends = beam(*scene, {Real(height), Real(height / 3), -4}, {0, 0, 1});
    REQUIRE(bends.size() == 3);
    Vector d{0, 0, 1}, at{height, height / 3, -4};
    const auto check = [&](const Bend& bend, Vector normal, double from, double to) {
      CHECK(bend.passed == Approx(passing(-inner(d, normal), from, to)).epsilon(1e-3));
      d = refracted(d, normal, from, to);
      checkNear(bend.position, at);
      checkNear(bend.direction, d);
    };
    const auto reachSphere = [&](double side) {
      const double b = inner(at, d);
      at = at + (-b + side * std::sqrt(b * b - inner(at, at) + 1)) * d;
    };
    reachSphere(-1);
    check(bends[0], at, 1, kCrown);
    reachSphere(1);
    check(bends[1], -1 * at, kCrown, kFlint);
    at = at + (3 - at.z) / d.z * d;
    check(bends[2], {0, 0, -1}, kFlint, 1);
  }
}

TEST_CASE("of equal priorities the smaller solid fills the place", "[images][dielectrics]") {
  const std::string ball = "sphere { 0, 2" + glass(1.5), bubble = "sphere { 0, 1" + glass(1);
  for (const bool isFirst : {false, true}) {
    const auto scene = sceneOf(kCamera + (isFirst ? bubble + ball : ball + bubble));
    const auto bends = beam(*scene, {Real(0.3), 0, -9}, {0, 0, 1});
    REQUIRE(bends.size() == 4);
    CHECK(bends[1].from == Approx(1.5));
    CHECK(bends[1].to == Approx(1));
    CHECK(bends[2].from == Approx(1));
    CHECK(bends[2].to == Approx(1.5));
  }
  const auto solid = sceneOf(kCamera + "sphere { 0, 2" + glass(1.5, "priority 1") + bubble);
  CHECK(beam(*solid, {Real(0.3), 0, -9}, {0, 0, 1}).size() == 2);
}

TEST_CASE("a glass ball half in water, from above, below and inside", "[images][dielectrics]") {
  const auto scene = sceneOf(kCamera + "sphere { 0, 1" + glass(1.5) + "plane { y, 0" + glass(1.33));
  /// The first indices on a beam's way.
  const auto check = [&](Vec3 from, Vec3 to, std::vector<double> indices) {
    const auto bends = beam(*scene, from, to);
    REQUIRE(bends.size() + 1 >= indices.size());
    for (std::size_t k = 0; k + 1 < indices.size(); ++k) {
      CHECK(bends[k].from == Approx(indices[k]));
      CHECK(bends[k].to == Approx(indices[k + 1]));
    }
  };
  check({Real(0.2), 5, 0}, {0, -1, 0}, {1, 1.5, 1.33});
  check({Real(0.2), -5, 0}, {0, 1, 0}, {1.33, 1.5, 1});
  check({-3, Real(0.5), 0}, {1, 0, 0}, {1, 1.5, 1});
  check({-3, Real(-0.5), 0}, {1, 0, 0}, {1.33, 1.5, 1.33});
  check({0, Real(-0.5), 0}, {1, 0, 0}, {1.5, 1.33});
  check({3, -2, 0}, {0, 1, 0}, {1.33, 1});
}

TEST_CASE("a watertight mesh is a solid, an open one is not", "[images][dielectrics]") {
  checkLayers(boxFile(0, 1, 12) + glass(1.5, "priority 1") + slab(0.5, 3, 1.33), {0, 1, 3},
              {1, 1.5, 1.33, 1});
  const auto solidAt = [](const std::string& shape) {
    const auto scene = sceneOf(kCamera + shape);
    Surface s;
    REQUIRE(scene->view().intersect({{1, 2, -4}, {0, 0, 1}}, s));
    return s.solid;
  };
  CHECK(solidAt(boxFile(0, 1, 12) + glass(1.5)) == 1);
  CHECK(solidAt(boxFile(0, 1, 11) + glass(1.5)) == 0);
  CHECK(solidAt(boxFile(0, 1, 12) + " scale <1, -2, 1>" + glass(1.5)) == 1);
  CHECK(solidAt(boxFile(0, 1, 12) + " brdf lambert { } }\n") == 0);
}

TEST_CASE("an open surface has its index behind it, the surrounding one in front",
          "[images][dielectrics]") {
  // The normal of this quad looks along -z.
  const std::string quad = "quad { <-1, -1, 0>, 2*y, 2*x" + glass(1.5);
  const std::string water = "box { <-9, -9, -9>, <9, 9, 9>" + glass(1.33);
  for (const bool isWet : {false, true}) {
    const auto scene = sceneOf(kCamera + quad + (isWet ? water : ""));
    const double outside = isWet ? 1.33 : 1;
    const auto front = beam(*scene, {0, 0, -4}, {0, 0, 1}),
               back = beam(*scene, {0, 0, 4}, {0, 0, -1});
    REQUIRE(!front.empty());
    REQUIRE(!back.empty());
    CHECK(front[0].from == Approx(outside));
    CHECK(front[0].to == Approx(1.5));
    CHECK(back[0].from == Approx(1.5));
    CHECK(back[0].to == Approx(outside));
  }
}

TEST_CASE("what lies in a solid of higher priority blocks no light", "[images][dielectrics]") {
  const auto lit = [](const std::string& glassMore, const std::string& waterMore) {
    const auto scene = sceneOf(kCamera + "box { <-9, -9, -9>, <9, 9, 9>" + glass(1.5, glassMore) +
                               "sphere { 0, 1" + glass(1.33, waterMore));
    Ray ray{{0, Real(0.1), -3}, {0, 0, 1}, 0, 6};
    ray.media = scene->view().mediaAt(ray.origin);
    return scene->view().transmittance(ray);
  };
  CHECK(lit("priority 1", "") == grey(1));
  CHECK(lit("", "") == grey(0));
  const Rgb dim = lit("priority 1 absorption rgb <0.1, 0.2, 0>", "absorption rgb 9");
  CHECK(dim.r == Approx(std::exp(-0.6)).epsilon(1e-4));
  CHECK(dim.g == Approx(std::exp(-1.2)).epsilon(1e-4));
  CHECK(dim.b == 1);
  // Through water that lets shadow rays through, 1.98997 long there.
  const Rgb wet = lit("absorption rgb 0.1", "opacity 0 absorption rgb 0.5");
  const double length = 2 * std::sqrt(0.99);
  CHECK(wet.g == Approx(std::exp(-0.1 * (6 - length) - 0.5 * length)).epsilon(1e-4));
}

TEST_CASE("a slab absorbs by Beer's law", "[images][dielectrics]") {
  for (const char* integrator : kIntegrators) {
    INFO(integrator);
    const Image picture = renderText(
        looksAt(integrator) +
            "box { <-9, -9, -1>, <9, 9, 0.7> brdf glass { ior 1 absorption rgb <0.1, 1, 3> } }\n"
            "quad { <-9, -9, 2>, 18*y, 18*x emission rgb 2 brdf lambert { diffuse 0 } }\n",
        "--spp 4");
    for (const auto& [channel, a] : {std::pair(0, 0.1), std::pair(1, 1.0), std::pair(2, 3.0)})
      CHECK(mean(picture, channel) == Approx(2 * std::exp(-1.7 * a)).epsilon(1e-3));
  }
}

TEST_CASE("a lamp, a floor and a camera in water", "[images][dielectrics]") {
  // Light goes down 2 units to the floor and 3 from there to the camera, through a sheet that is
  // not there: of lower priority than the water.
  const auto render = [](const std::string& camera, const std::string& integrator) {
    return renderText(
        "camera " + camera + "\nfilm { resolution <4, 4> }\nintegrator " + integrator +
            "\nbox { <-9, -1, -9>, <9, 9, 9>" + glass(1.33, "absorption rgb <0.1, 0.3, 0>") +
            "box { <-5, 0.5, -5>, <5, 1, 5>" + glass(1.6, "priority -1 absorption rgb 5") +
            "light point { <0, 2, 0> intensity rgb 1 }\n"
            "quad { <-4, 0, -4>, 8*z, 8*x brdf lambert { diffuse rgb 0.5 } }\n",
        "--spp 1");
  };
  const std::string at = " location <0, 3, 0> look_at <0, 0, 0> sky z ";
  for (const std::string& camera :
       {"orthographic {" + at + "width 0.001 }", "pinhole {" + at + "angle 0.01 }",
        "thin_lens {" + at + "angle 0.01 aperture 0.001 }"})
    for (const char* integrator :
         {"path { depth 2 }", "simple { depth 2 }", "distributed { depth 2 split 1 }"}) {
      INFO(camera << " " << integrator);
      const Image picture = render(camera, integrator);
      const double vacuum = 0.5 / 3.14159265358979 / 4;
      CHECK(mean(picture, 0) == Approx(vacuum * std::exp(-0.1 * 5)).epsilon(1e-3));
      CHECK(mean(picture, 1) == Approx(vacuum * std::exp(-0.3 * 5)).epsilon(1e-3));
      CHECK(mean(picture, 2) == Approx(vacuum).epsilon(1e-3));
    }
}

namespace {

/// A drink with a bubble and an ice cube, in a thick glass that stands in oil.
const char* const kDrink =
    "cylinder { <0, -1, 0>, <0, 1, 0>, 1 brdf glass { ior 1.5 priority 2 } }\n"
    "cylinder { <0, -0.8, 0>, <0, 0.5, 0>, 0.8 brdf glass { ior 1.33 priority 3 } }\n"
    "box { -0.3, 0.3 rotate <20, 30, 40> brdf glass { ior 1.31 priority 4 } }\n"
    "sphere { <0.1, -0.1, 0>, 0.1 brdf glass { ior 1 priority 5 } }\n"
    "box { <-2, -2, -2>, <2, 0, 2> brdf glass { ior 1.47 } }\n";

}  // namespace

TEST_CASE("nested solids are white in a white furnace", "[images][dielectrics]") {
  for (const char* integrator : {"path { depth 200 }", "simple { depth 200 }"}) {
    const Image picture = renderText(
        std::string("camera pinhole { location <1, 2, -6> look_at 0 angle 25 }\n"
                    "film { resolution <32, 32> }\nlight environment { radiance rgb 1 }\n"
                    "integrator ") +
            integrator + "\n" + kDrink,
        "--spp 64");
    CHECK(mean(picture, 1) == Approx(1).epsilon(3e-3));
  }
}

TEST_CASE("one and two threads render the same nested solids", "[images][dielectrics]") {
  const std::string text =
      std::string(
          "camera thin_lens { location <1, 0.5, -1.9> look_at 0 angle 70 aperture 0.4 }\n"
          "film { resolution <32, 32> }\nlight environment { radiance rgb 0.3 }\n"
          "light area { <-1, 5, -1>, 2*x, 2*z radiance rgb 9 }\nplane { y, -1.5 }\n") +
      kDrink;
  const Image one = renderText(text, "--spp 8 --threads 1");
  const Image two = renderText(text, "--spp 8 --threads 2");
  int different = 0;
  for (int y = 0; y < one.height; ++y)
    for (int x = 0; x < one.width; ++x)
      for (int c = 0; c < 3; ++c) different += one.at(x, y)[c] != two.at(x, y)[c];
  CHECK(different == 0);
  CHECK(mean(one, 1) > 0.01);
}

TEST_CASE("ten solids in one another are white in a white furnace", "[images][dielectrics]") {
  std::string text =
      "camera pinhole { location <0, 0, -6> look_at 0 angle 20 }\nfilm { resolution <16, 16> }\n"
      "light environment { radiance rgb 1 }\nintegrator path { depth 400 }\n";
  for (int k = 1; k <= 10; ++k)
    text += "sphere { 0, " + std::to_string(k / 10.0) + " brdf glass { ior " +
            std::to_string(1.2 + 0.05 * k) + " } }\n";
  CHECK(mean(renderText(text, "--spp 64"), 1) == Approx(1).epsilon(5e-3));
}

TEST_CASE("a solid that shadow rays do not meet absorbs none of them", "[images][dielectrics]") {
  const auto scene = [](const std::string& hidden) {
    return "camera orthographic { location <0, 0.5, 0> look_at 0 sky z width 0.1 }\n"
           "film { resolution <4, 4> }\nintegrator path { depth 2 }\n"
           "light distant { direction <0, -1, 0> irradiance rgb pi }\n"
           "plane { y, 0 brdf lambert { diffuse rgb 1 } }\n" +
           hidden;
  };
  const std::string box =
      "box { <-5, -1, -5>, <5, 1, 5> brdf glass { ior 1.0001 absorption rgb 0.2 ";
  // The camera is inside, half a unit above the floor: absorption once, of what the eye sees.
  const double seen = mean(renderText(scene(box + "} no_shadow }\n"), "--spp 1"), 1);
  CHECK(seen == Approx(std::exp(-0.2 * 0.5)).epsilon(2e-3));
}
