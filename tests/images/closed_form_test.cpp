// SPDX-License-Identifier: Apache-2.0
// Whole renders of scenes whose radiance is known in closed form.
//
// [LW94] Lafortune, Willems. Using the modified Phong reflectance model. 1994.
// [Wal07] Walter et al. Microfacet models for refraction through rough surfaces. EGSR 2007.
// [Howell] Howell. A catalog of radiation heat transfer configuration factors.
#include <cmath>

#include "images/picture.h"

using namespace vestige;
using namespace vestige::test;

namespace {

const std::string kSmall = "--width 32 --height 32 --spp 256";

/// A small square of floor, reflectance 0.8, seen straight from above; direct light only.
std::string floorUnder(const std::string& light) {
  return "camera orthographic { location <0, 0.5, 0> look_at <0, 0, 0> sky z width 0.001 }\n"
         "integrator path { depth 2 }\n"
         "plane { y, 0 brdf lambert { diffuse rgb 0.8 } }\n" +
         light;
}

void checkGrey(const Image& picture, double expected, double tolerance) {
  for (int channel = 0; channel < 3; ++channel) {
    INFO("channel " << channel);
    CHECK(mean(picture, channel) == Approx(expected).epsilon(tolerance));
  }
}

/// Share of a parallel rectangle in the view of a point below one of its corners [Howell, C-4].
double cornerFormFactor(double a, double b, double h) {
  const double x = a / h, y = b / h, rx = std::hypot(1, x), ry = std::hypot(1, y);
  return (x / rx * std::atan(y / rx) + y / ry * std::atan(x / ry)) / (2 * kPi);
}

constexpr double kFurnaceWidth = 1.3;  // of the picture; the ball has radius 1

/// Nothing but a ball of some BRDF, everywhere in the picture, under a sky of radiance 1.
Image furnace(const std::string& brdf, const std::string& path = "depth 64") {
  return renderText("camera orthographic { location <0, 0, -3> look_at <0, 0, 0> width " +
                        std::to_string(kFurnaceWidth) +
                        " }\n"
                        "integrator path { " +
                        path +
                        " }\n"
                        "light environment { radiance rgb 1 }\n"
                        "sphere { <0, 0, 0>, 1 brdf " +
                        brdf + " }\n",
                    kSmall);
}

/// Mean of f over (i, k) in [0,1)^2, midpoint rule.
template <class F>
double squareMean(int n, F f) {
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) sum += f((i + 0.5) / n, (k + 0.5) / n);
  return sum / (n * n);
}

/// Mean over furnace()'s picture of a function of the cosine at which the ball is seen.
template <class F>
double meanOverBall(F f) {
  return squareMean(16, [&](double x, double y) {
    return f(std::sqrt(1 - (x * x + y * y) * kFurnaceWidth * kFurnaceWidth / 4));
  });
}

/// Reflected share of (n + 2) / (2 pi) cos^n around the mirror direction [LW94], for light that
/// comes at an angle with cosine c.
double phongAlbedo(double c, double n) {
  return (n + 2) / (n + 1) * squareMean(96, [=](double u, double v) {
           const double z = std::pow(u, 1 / (n + 1)), around = std::cos(2 * kPi * v);
           return std::max(0.0, z * c + std::sqrt((1 - z * z) * (1 - c * c)) * around);
         });
}

/// Reflected share of a GGX mirror without loss, one scattering, masked by G1 G1 [Wal07 Eq. 20, 33
/// to 35, 41]: the mean of G1 G1 (o.m) / (o.n m.n) over microfacet normals m.
double ggxAlbedo(double c, double alpha) {
  const auto g1 = [=](double z) {
    return 2 / (1 + std::sqrt(1 + alpha * alpha * (1 / (z * z) - 1)));
  };
  return squareMean(96, [&](double u, double v) {
    const double mz = 1 / std::sqrt(1 + alpha * alpha * u / (1 - u));
    const double om = c * mz + std::sqrt((1 - c * c) * (1 - mz * mz)) * std::cos(2 * kPi * v);
    const double iz = 2 * om * mz - c;
    return om > 0 && iz > 0 ? g1(c) * g1(iz) * om / (c * mz) : 0;
  });
}

}  // namespace

TEST_CASE("a ball that absorbs nothing vanishes in a white furnace", "[images]") {
  for (const char* brdf : {"lambert { diffuse rgb 1 }", "mirror { specular rgb 1 }",
                           "glass { ior 1.5 }", "glass { ior 1 }"}) {
    INFO(brdf);
    checkGrey(furnace(brdf), 1, 0.005);
    checkGrey(furnace(brdf, "depth 64 split 3"), 1, 0.005);
  }
}

TEST_CASE("a glossy ball loses in a white furnace what its lobe sends below the surface",
          "[images]") {
  for (const double exponent : {20.0, 2000.0})
    checkGrey(furnace("phong { specular rgb 1 exponent " + std::to_string(exponent) + " }"),
              meanOverBall([=](double c) { return phongAlbedo(c, exponent); }), 0.004);
  for (const double alpha : {0.05, 0.6})
    checkGrey(furnace("rough_conductor { specular rgb 1 alpha " + std::to_string(alpha) + " }"),
              meanOverBall([=](double c) { return ggxAlbedo(c, alpha); }), 0.004);
}

TEST_CASE("no ball shines in a white furnace", "[images]") {
  struct Case {
    const char* brdf;
    double least;  ///< what a smooth one must give back, nearly all; of a rough one not known
  };
  for (const Case& c :
       {Case{"rough_dielectric { ior 1.5 alpha 0.05 }", 0.98},
        Case{"rough_dielectric { ior 1.5 alpha 0.5 }", 0},
        Case{"principled { base_color rgb 1 metallic 1 roughness 0.2 }", 0.98},
        Case{"principled { base_color rgb 1 roughness 0.5 }", 0},
        Case{"principled { base_color rgb 1 transmission 1 roughness 0.2 }", 0.97}}) {
    INFO(c.brdf);
    const Image picture = furnace(c.brdf);
    for (int channel = 0; channel < 3; ++channel) {
      CHECK(mean(picture, channel) <= 1.005);
      CHECK(mean(picture, channel) >= c.least);
    }
  }
}

TEST_CASE("light goes round inside a diffuse ball for as many edges as asked", "[images]") {
  // Point light of intensity pi at the centre, reflectance r = 1/2: each bounce adds half of the
  // one before, r + r^2 + ... in all.
  const auto inside = [](const std::string& path) {
    return "camera pinhole { location <0.3, 0.1, 0.2> look_at <0, 0, 1> angle 60 }\n"
           "integrator path { " +
           path +
           " }\n"
           "light point { location <0, 0, 0> intensity rgb pi }\n"
           "sphere { <0, 0, 0>, 1 brdf lambert { diffuse rgb 0.5 } }\n";
  };
  checkGrey(renderText(inside("depth 2"), kSmall), 0.5, 0.002);
  checkGrey(renderText(inside("depth 3"), kSmall), 0.75, 0.005);
  checkGrey(renderText(inside("depth 5"), kSmall), 0.9375, 0.005);
  checkGrey(renderText(inside("depth 64"), kSmall), 1, 0.005);
  checkGrey(renderText(inside("depth 64 rough_depth 1"), kSmall), 0.5, 0.002);
  checkGrey(renderText(inside("depth 64 rough_depth 2"), kSmall), 0.75, 0.005);
  checkGrey(renderText(inside("depth 64 split 3"), kSmall), 1, 0.005);
}

TEST_CASE("specular scatterings have a limit of their own", "[images]") {
  const auto mirror = [](const std::string& path) {
    return renderText(
        "camera orthographic { location <0, 0, -3> look_at <0, 0, 0> width 1 }\n"
        "light environment { radiance rgb 1 }\n"
        "sphere { <0, 0, 0>, 1 brdf mirror { specular rgb 0.5 } }\n"
        "integrator path { " +
            path + " }\n",
        kSmall);
  };
  checkGrey(mirror("specular_depth 0"), 0, 0);
  checkGrey(mirror("specular_depth 1 rough_depth 0"), 0.5, 1e-3);
}

TEST_CASE("each light gives the floor what its formula says", "[images]") {
  SECTION("area") {
    const double factor = 4 * cornerFormFactor(1, 0.5, 2);
    checkGrey(renderText(floorUnder("light area { <-1, 2, -0.5>, <2, 0, 0>, <0, 0, 1> "
                                    "radiance rgb 10 }"),
                         kSmall),
              0.8 * 10 * factor, 0.003);
  }
  SECTION("area, from its dark side") {
    checkGrey(renderText(floorUnder("light area { <-1, 2, -0.5>, <0, 0, 1>, <2, 0, 0> "
                                    "radiance rgb 10 }"),
                         kSmall),
              0, 0.003);
  }
  SECTION("shining ball") {
    checkGrey(renderText(floorUnder("sphere { <0, 3, 0>, 1.2 emission rgb 5 }"), kSmall),
              0.8 * 5 * std::pow(1.2 / 3, 2), 0.003);
  }
  SECTION("shining ellipsoid, scaled from a ball") {
    // From a point straight below, the outline of the spheroid is a cone of half-angle t with
    // sin^2 t = a^2 / (a^2 - b^2 + h^2).
    const double a = 1.5, b = 0.5, h = 2;
    checkGrey(renderText(floorUnder("sphere { <0, 0, 0>, 1 emission rgb 5 "
                                    "scale <1.5, 0.5, 1.5> translate <0, 2, 0> }"),
                         kSmall),
              0.8 * 5 * a * a / (a * a - b * b + h * h), 0.003);
  }
  SECTION("shining disc") {
    checkGrey(renderText(floorUnder("disc { <0, 2, 0>, <0, -1, 0>, 1 emission rgb 5 }"), kSmall),
              0.8 * 5 * 1.0 / (1 + 4), 0.003);
  }
  SECTION("point") {
    checkGrey(
        renderText(floorUnder("light point { location <1.5, 2, 0> intensity rgb 10 }"), kSmall),
        0.8 / kPi * 10 * (2 / 2.5) / (2.5 * 2.5), 0.002);
  }
  SECTION("spot, on its axis") {
    checkGrey(renderText(floorUnder("light spot { location <1.5, 2, 0> intensity rgb 10 "
                                    "point_at <0, 0, 0> radius 20 falloff 30 }"),
                         kSmall),
              0.8 / kPi * 10 * (2 / 2.5) / (2.5 * 2.5), 0.002);
  }
  SECTION("spot, past its edge") {
    checkGrey(renderText(floorUnder("light spot { location <1.5, 2, 0> intensity rgb 10 "
                                    "point_at <1.5, 0, 0> radius 20 falloff 30 }"),
                         kSmall),
              0, 0.002);
  }
  SECTION("distant") {
    checkGrey(
        renderText(floorUnder("light distant { direction <3, -4, 0> irradiance rgb 2 }"), kSmall),
        0.8 / kPi * 2 * 0.8, 0.002);
  }
  SECTION("environment") {
    checkGrey(renderText(floorUnder("light environment { radiance rgb 0.5 }"), kSmall), 0.8 * 0.5,
              0.005);
  }
}

TEST_CASE("a picture is the same for any number of threads", "[images]") {
  for (const char* scene : {"examples/hello.scene", "examples/pieces.scene"}) {
    const std::string small = "--width 96 --height 72 --spp 5";
    const Image one = renderFile(source(scene), small + " --threads 1");
    const Image two = renderFile(source(scene), small + " --threads 2");
    CHECK(one.pixels == two.pixels);
    const Image other = renderFile(source(scene), small + " --seed 7");
    CHECK(one.pixels != other.pixels);
  }
}
