// SPDX-License-Identifier: Apache-2.0
// What rays pass and what they do not meet: transparent layers, cut-outs, objects hidden from some
// kinds of rays. All expectations are closed forms.
#include <cmath>

#include "engine/render/session.h"
#include "images/picture.h"
#include "support/text_scene.h"

using namespace vestige;
using namespace vestige::test;

namespace {

struct Quality {
  int side;     ///< pixels
  int samples;  ///< a pixel
  int threads = 2;
  BuildOptions build = {};
};
const Quality kFew{8, 4};
const Quality kMany{16, 256};

/// In this process: starting the program would take far longer than these pictures.
Image renderText(const std::string& text, const Quality& q) {
  INFO(text);
  const auto scene = sceneOf(text, registry(), q.build);
  Film film = makeFilm(*scene, q.side, q.side, nullptr, {});
  render(*scene, film, {.samples = q.samples, .threads = q.threads});
  Film::Means means = film.means();
  return {means.width, means.height, std::move(means.channels), std::move(means.pixels), {}};
}

void checkColour(const Image& picture, Rgb expected, double tolerance) {
  CHECK(mean(picture, 0) == Approx(expected.r).epsilon(tolerance).margin(1e-9));
  CHECK(mean(picture, 1) == Approx(expected.g).epsilon(tolerance).margin(1e-9));
  CHECK(mean(picture, 2) == Approx(expected.b).epsilon(tolerance).margin(1e-9));
}

std::string layers(int n, const std::string& opacity) {
  return "#for (I, 1, " + std::to_string(n) + ")\n quad { <-1, -1, 0.001*I>, 2*x, 2*y " +
         "brdf lambert { diffuse 0 opacity " + opacity + " } }\n#end\n";
}

/// A picture of the sky behind what stands before it.
std::string before(const std::string& what, const std::string& integrator = "path { }") {
  return "camera orthographic { location <0, 0, -5> look_at 0 width 1 }\n"
         "integrator " +
         integrator + "\nlight environment { radiance rgb 1 }\n" + what;
}

/// A wall of reflectance 1 behind the same, lit through it from the front by irradiance pi: 1.
std::string litThrough(const std::string& what) {
  return "camera orthographic { location <0, 0, 2> look_at <0, 0, 3> width 1 }\n"
         "integrator path { depth 2 }\nlight distant { direction z irradiance rgb pi }\n"
         "quad { <-1, -1, 3>, 2*x, 2*y brdf lambert { diffuse 1 } }\n" +
         what;
}

/// A floor of reflectance 1 seen straight from above, and a lamp of radiance 1 above it.
std::string floor(const std::string& lamp, const std::string& between,
                  const std::string& integrator = "path { depth 2 }") {
  return "camera orthographic { location <0, 0.5, 0> look_at 0 sky z width 0.02 }\n"
         "integrator " +
         integrator + "\nplane { y, 0 brdf lambert { diffuse 1 } }\n" + lamp + between;
}
/// Share of the view of the origin that a square of side 2 at height h fills, by cosine
/// [Howell, C-4].
double squareAbove(double h) {
  const double x = 1 / h, r = std::hypot(1, x);
  return 4 * 2 * (x / r * std::atan(x / r)) / (2 * kPi);
}
const std::string kLamp =
    "quad { <-1, 1, -1>, 2*x, 2*z brdf lambert { diffuse 0 } emission 1 emission_sides \"both\" ";

}  // namespace

TEST_CASE("any number of clear layers changes nothing", "[images][visibility]") {
  for (const int n : {63, 64, 200}) {
    INFO(n << " layers");
    checkColour(renderText(before(layers(n, "0")), kFew), grey(1), 1e-6);
    checkColour(renderText(litThrough(layers(n, "0")), kFew), grey(1), 1e-4);
  }
}

TEST_CASE("a thousand coloured layers dim light by their powers", "[images][visibility]") {
  const std::string colour = "rgb <0.001, 0.0005, 0>";
  const Rgb expected{Real(std::pow(1 - 0.001, 1000)), Real(std::pow(1 - 0.0005, 1000)), 1};
  checkColour(renderText(litThrough(layers(1000, colour)), kFew), expected, 1e-4);
  // Paths decide at each layer: 4 sigma of 4096 samples.
  checkColour(renderText(before(layers(1000, colour)), Quality{8, 64}), expected, 0.08);
}

TEST_CASE("all integrators see colours through layers", "[images][visibility]") {
  for (const char* integrator :
       {"path { }", "distributed { split 1 }", "particle { particles 1000 }"}) {
    INFO(integrator);
    const Rgb expected{Real(std::pow(0.99, 40)), Real(std::pow(0.98, 40)), 1};
    checkColour(renderText(before(layers(40, "rgb <0.01, 0.02, 0>"), integrator), kMany), expected,
                0.02);
  }
}

TEST_CASE("panes of one primary colour leave it whole", "[images][visibility]") {
  // A chance of passing that is blind to the path's colour would weigh red paths by 3^40.
  checkColour(renderText(before(layers(40, "rgb <0, 1, 1>")), kMany), {1, 0, 0}, 0.02);
}

TEST_CASE("the picture of many layers is the same for any number of threads",
          "[images][visibility]") {
  const std::string text = litThrough(layers(300, "rgb <0.001, 0.002, 0.003>")) +
                           "light area { <0.1, 0.1, 1>, 0.2*x, 0.2*y radiance 3 }\n";
  const Image one = renderText(text, Quality{8, 4, 1});
  const Image two = renderText(text, Quality{8, 4, 3});
  CHECK(one.pixels == two.pixels);
}

TEST_CASE("a lamp that a cut-out hides stays hidden, whatever the footprint",
          "[images][visibility]") {
  // Opaque from x = -0.6 to 0.6: all of the lamp as seen from the floor around the origin.
  const std::string cut =
      "quad { <-12, 1, -12>, 24*x, 24*z brdf lambert { diffuse 0 opacity pigment stripes { rgb 1, "
      "rgb 0 direction x/2.4 width 0.5 translate <-0.6, 0, 0> } } }\n";
  const std::string lamp = "light area { <-1, 2, -1>, 2*x, 2*z radiance 10 }\n";
  for (const char* footprint : {"safe", "none"}) {
    INFO(footprint);
    const Image p = renderText(floor(lamp, cut, "path { depth 4 }"),
                               Quality{8, 4, 2, {.footprint = footprint}});
    checkColour(p, {}, 0);
  }
}

TEST_CASE("opacity_cutoff makes a cut-out of a veil", "[images][visibility]") {
  const auto veil = [](const std::string& more) {
    return before(
        "quad { <-1, -1, 0>, 2*x, 2*y brdf lambert { diffuse 0 opacity rgb <0.3, 0.5, "
        "0.7> " +
        more + " } }\n");
  };
  checkColour(renderText(veil("opacity_cutoff 0.5"), kMany), {1, 0, 0}, 0.02);
  checkColour(renderText(veil("opacity_cutoff 0.2"), kFew), {}, 0);
  const std::string thin = before(
      "quad { <-1, -1, 0>, 2*x, 2*y brdf lambert { diffuse 0 opacity 0.3 opacity_cutoff 0.5 } }\n");
  checkColour(renderText(thin, kFew), grey(1), 0);
  checkColour(renderText(veil(""), kMany), {Real(0.7), Real(0.5), Real(0.3)}, 0.02);
}

TEST_CASE("what is cut away does not shine, and of a veil its share", "[images][visibility]") {
  const double whole = squareAbove(1);
  const auto lamp = [](const std::string& opacity) {
    return "quad { <-1, 1, -1>, 2*x, 2*z brdf lambert { diffuse 0 opacity " + opacity +
           " } emission 1 emission_sides \"both\" }\n";
  };
  const auto light = [&](const std::string& opacity) {
    return mean(renderText(floor(lamp(opacity), ""), kMany), 0);
  };
  CHECK(light("1") == Approx(whole).epsilon(0.01));
  CHECK(light("0.25") == Approx(whole / 4).epsilon(0.01));
  CHECK(light("0.25 opacity_cutoff 0.5") == 0);
  // Seen directly: emission times opacity, and nothing behind.
  const std::string seen =
      "camera orthographic { location <0, 0, -5> look_at 0 width 1 }\nintegrator path { }\n"
      "quad { <-1, -1, 0>, 2*x, 2*y brdf lambert { diffuse 0 opacity 0.25 } emission 4 "
      "emission_sides \"both\" }\n";
  checkColour(renderText(seen, kFew), grey(1), 1e-5);
}

TEST_CASE("a lamp is hidden from some rays and lights all the same", "[images][visibility]") {
  const double share = squareAbove(1);
  const auto lit = [](const std::string& visibility) {
    return mean(renderText(floor(kLamp + visibility + " }\n", ""), kMany), 0);
  };
  for (const char* visibility :
       {"", "no_image", "no_reflection", "no_shadow", "visible_to \"indirect\"",
        "visible_to \"shadow indirect\"", "no_image no_reflection"}) {
    INFO(visibility);
    CHECK(lit(visibility) == Approx(share).epsilon(0.01));
  }
  CHECK(lit("visible_to \"camera shadow reflection refraction\"") == 0);
}

TEST_CASE("a light area is hidden from the camera and lights all the same",
          "[images][visibility]") {
  const auto lamp = [](const std::string& visibility) {
    return "light area { <-1, 1, -1>, 2*x, 2*z radiance 1 two_sided true " + visibility + " }\n";
  };
  const auto lit = [&](const std::string& visibility) {
    return mean(renderText(floor(lamp(visibility), ""), kMany), 0);
  };
  CHECK(lit("") == Approx(squareAbove(1)).epsilon(0.01));
  CHECK(lit("no_image") == Approx(squareAbove(1)).epsilon(0.01));
  const auto seen = [&](const std::string& visibility) {
    return mean(renderText("camera orthographic { location <0, 3, 0> look_at 0 sky z width 1 }\n"
                           "integrator path { }\n" +
                               lamp(visibility),
                           kFew),
                0);
  };
  CHECK(seen("") == Approx(1));
  CHECK(seen("no_image") == 0);
}

TEST_CASE("emission is masked by a picture of opacity", "[images][visibility]") {
  // Stripes of opacity 0.4 and 0.2, cut at 0.3: half of the square shines.
  const std::string text =
      "camera orthographic { location <0, 0, -5> look_at 0 width 1 }\n"
      "quad { <-1, -1, 0>, 2*x, 2*y brdf lambert { diffuse 0 opacity pigment stripes { rgb 0.2, "
      "rgb "
      "0.4 direction 8*x width 0.5 } opacity_cutoff 0.3 } emission 2 emission_sides \"both\" }\n";
  for (const char* integrator : {"path", "particle"}) {
    INFO(integrator);
    checkColour(renderText(text, Quality{16, 256, 2, {.integrator = integrator}}), grey(1), 0.02);
  }
}

TEST_CASE("camera, mirror and glass see what is visible to them", "[images][visibility]") {
  const auto seen = [](const std::string& through, const std::string& visibility) {
    return mean(renderText("camera orthographic { location <0, 0, -5> look_at 0 width 0.5 }\n"
                           "integrator path { }\n" +
                               through +
                               "quad { <-1, -1, 2>, 2*x, 2*y brdf lambert { diffuse 0 } "
                               "emission 1 emission_sides \"both\" " +
                               visibility + " }\n",
                           Quality{8, 64}),
                0);
  };
  const std::string mirror =
      "quad { <-1, -1, 0>, 2*x, 2*y brdf mirror { specular 1 } "
      "rotate 45*y translate <0, 0, -1> }\n";
  CHECK(seen("", "") == Approx(1));
  CHECK(seen("", "no_image") == 0);
  CHECK(seen("", "no_reflection no_shadow") == Approx(1));
  CHECK(seen("", "visible_to \"camera\"") == Approx(1));
  CHECK(seen("", "visible_to \"reflection refraction shadow indirect\"") == 0);
  const std::string pane = "box { <-1, -1, 0>, <1, 1, 0.5> brdf glass { ior 1 } }\n";
  CHECK(seen(pane, "") == Approx(1));
  CHECK(seen(pane, "no_image") == 0);
  CHECK(seen(pane, "visible_to \"refraction\"") == Approx(1));
  CHECK(seen(pane, "visible_to \"camera\"") == 0);
}

TEST_CASE("a mirror shows what is visible to reflection", "[images][visibility]") {
  // The camera looks at a mirror; the lamp stands behind the camera.
  const auto seen = [](const std::string& visibility) {
    return mean(renderText("camera orthographic { location <0, 0, -2> look_at 0 width 0.5 }\n"
                           "integrator path { }\n"
                           "quad { <-1, -1, 0>, 2*x, 2*y brdf mirror { specular 1 } }\n"
                           "quad { <-1, -1, -4>, 2*x, 2*y brdf lambert { diffuse 0 } emission 1 "
                           "emission_sides \"both\" " +
                               visibility + " }\n",
                           Quality{8, 16}),
                0);
  };
  CHECK(seen("") == Approx(1));
  CHECK(seen("no_reflection") == 0);
  CHECK(seen("no_image no_shadow") == Approx(1));
  CHECK(seen("visible_to \"reflection\"") == Approx(1));
}

TEST_CASE("an object that casts no shadow hides no lamp", "[images][visibility]") {
  const std::string lamp = kLamp + "}\n";
  const double share = squareAbove(1);
  const auto lit = [&](const std::string& visibility) {
    const std::string board =
        "quad { <-3, 0.7, -3>, 6*x, 6*z brdf lambert { diffuse 0 } " + visibility + " }\n";
    return mean(renderText(floor(lamp, board), kMany), 0);
  };
  CHECK(lit("") == 0);
  CHECK(lit("no_shadow") == Approx(share).epsilon(0.01));
  CHECK(lit("visible_to \"camera indirect\"") == Approx(share).epsilon(0.01));
  CHECK(lit("visible_to \"camera shadow\"") == 0);
  CHECK(lit("visible_to \"camera\"") == Approx(share).epsilon(0.01));
  // A union hands its word on; a part overrides it.
  const std::string parts = "quad { <-3, 0.7, -3>, 6*x, 6*z brdf lambert { diffuse 0 } ";
  const auto inUnion = [&](const std::string& part, const std::string& whole) {
    return mean(renderText(floor(lamp, "union { " + parts + part + " } " + whole + " }\n"), kMany),
                0);
  };
  CHECK(inUnion("", "no_shadow") == Approx(share).epsilon(0.01));
  CHECK(inUnion("visible_to \"shadow indirect\"", "no_shadow") == 0);
}
