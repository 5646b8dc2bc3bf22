// SPDX-License-Identifier: Apache-2.0
// Filtering a texture may blur, and a blur does not go away by itself. So the default bound must
// never lose against no footprints, at any number of samples, and must converge.
//
// One render tells all numbers of samples: Sobol' points and `safe` deltas depend on a sample's own
// index only, so the first n samples of a longer render are the render of n.
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "engine/render/session.h"
#include "support/catch.h"
#include "support/text_scene.h"

using namespace vestige;
using namespace vestige::test;

namespace {

constexpr int kWidth = 32, kHeight = 24;
using Pixels = std::vector<float>;  ///< RGB

/// One light that is neither chosen among others nor sampled.
const char* const kSun = "light distant { direction <0.3, -1, 0.4> irradiance rgb 2 }\n";

/// Balls of all kinds of lobes over a floor that shows them a pattern: under the sun what noise
/// there is is that of the pattern.
std::string balls(const std::string& pigment, const std::string& integrator,
                  const std::string& light = kSun) {
  return "camera pinhole { location <0, 1.6, -5> look_at <0, 0.9, 0> angle 40 }\n"
         "film { resolution <32, 24> }\n"
         "integrator " +
         integrator + "\n" + light + "plane { y, 0 brdf lambert { diffuse pigment " + pigment +
         " } }\n"
         "sphere { <-1.3, 0.9, 0>, 0.8 brdf phong { specular rgb 0.8 exponent 40 } }\n"
         "sphere { <0.4, 0.7, -0.6>, 0.6 brdf glass { ior 1.5 } }\n"
         "sphere { <1.6, 0.9, 0.6>, 0.8 brdf rough_conductor { alpha 0.2 } }\n";
}

/// The picture after each number of samples.
std::vector<Pixels> progress(Scene& scene, std::uint32_t seed, const std::vector<int>& samples) {
  Film film(kWidth, kHeight, {0, 0, kWidth, kHeight}, {});
  std::vector<Pixels> all;
  RenderOptions options;
  options.seed = seed;
  for (const int n : samples) {
    options.samples = n;
    render(scene, film, options);
    all.push_back(film.means().pixels);
  }
  return all;
}

double meanSquare(const Pixels& a, const Pixels& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::pow(double(a[i]) - double(b[i]), 2);
  return sum / double(a.size());
}
double mean(const Pixels& a) {
  double sum = 0;
  for (const float x : a) sum += double(x);
  return sum / double(a.size());
}

/// Mean square error over seeds, by the number of samples.
std::vector<double> errors(const std::string& pigment, const std::string& integrator,
                           const std::string& footprint, const Pixels& reference, int seeds,
                           const std::vector<int>& samples, const std::string& light = kSun) {
  const auto scene = sceneOf(balls(pigment, integrator + " footprint " + footprint + " }", light));
  std::vector<double> sum(samples.size());
  for (int seed = 1; seed <= seeds; ++seed) {
    const auto pictures = progress(*scene, std::uint32_t(seed), samples);
    for (std::size_t i = 0; i < samples.size(); ++i)
      sum[i] += meanSquare(pictures[i], reference) / seeds;
  }
  return sum;
}

/// By their size on the floor, where a lobe of the balls covers about 0.5.
const std::map<std::string, std::string> kTextures = {
    {"smooth, bent", "noise { octaves 1 scale 1.2 }"},
    {"smooth", "gradient { rgb 0.1, rgb 0.9 direction <0.3, 0, 0> }"},
    {"as fine as the lobe", "checker { rgb 0.1, rgb 0.9 scale 0.5 }"},
    {"finer", "checker { rgb 0.1, rgb 0.9 scale 0.2 }"},
    {"much finer", "checker { rgb 0.1, rgb 0.9 scale 0.03 }"},
    {"granite", "granite { rgb 0.1, rgb 0.9 scale 0.5 }"},
    {"photograph",
     "image { \"" VESTIGE_SOURCE_DIR "/examples/assets/gravel.png\" rotate 90*x scale 2 }"}};

Pixels reference(const std::string& pigment, const std::string& integrator, int samples,
                 const std::string& light = kSun) {
  const auto scene = sceneOf(balls(pigment, integrator + " footprint none }", light));
  return progress(*scene, 99, {samples}).back();
}

struct Integration {
  std::string name, text;
  int reference, seeds;
  std::vector<int> samples;  ///< to be better or as good
};

}  // namespace

TEST_CASE("the default is never worse than no footprints", "[slow][footprint]") {
  const Integration all[] = {
      {"path", "path { depth 4", 16384, 16, {1, 4, 16, 64, 256, 1024}},
      {"distributed", "distributed { split 4 depth 3", 4096, 16, {1, 4, 16, 64, 256}}};
  for (const Integration& with : all)
    for (const auto& [name, pigment] : kTextures) {
      const Pixels truth = reference(pigment, with.text, with.reference);
      const double grace = std::pow(0.005 * mean(truth), 2);
      const auto none = errors(pigment, with.text, "none", truth, with.seeds, with.samples);
      const auto safe = errors(pigment, with.text, "safe", truth, with.seeds, with.samples);
      for (std::size_t i = 0; i < with.samples.size(); ++i) {
        std::printf("never worse;%s;%s;%d;%.4g\n", with.name.c_str(), name.c_str(), with.samples[i],
                    none[i] / safe[i]);
        std::fflush(stdout);
        INFO(with.name << ", " << name << ", " << with.samples[i] << " samples: none " << none[i]
                       << ", safe " << safe[i]);
        CHECK(safe[i] <= none[i] + grace);
      }
    }
}

TEST_CASE("the default converges", "[slow][footprint]") {
  for (const auto& [name, pigment] : kTextures) {
    const std::string path = "path { depth 4";
    const Pixels truth = reference(pigment, path, 65536);
    // Four seeds are too few: of four groups of them the slope of one texture was -0.435 to -0.473.
    const auto error = errors(pigment, path, "safe", truth, 16, {64, 4096});
    const double slope = std::log(error[1] / error[0]) / 2 / std::log(4096. / 64);
    std::printf("slope;%s;%.3f\n", name.c_str(), slope);
    std::fflush(stdout);
    INFO(name << ": RMSE " << std::sqrt(error[0]) << " to " << std::sqrt(error[1]));
    CHECK(slope <= -0.45);
  }
}

// Which exponent: test_images "[.exponents]" prints what docs/adr/0006 shows.
TEST_CASE("exponents of safe", "[.exponents][slow]") {
  const std::vector<int> samples = {1, 4, 16, 64, 256, 1024};
  const std::string path = "path { depth 4";
  for (const auto& [name, pigment] : kTextures) DYNAMIC_SECTION(name) {
      const Pixels truth = reference(pigment, path, 16384);
      const auto none = errors(pigment, path, "none", truth, 8, samples);
      for (const char* exponent : {"0.5", "0.6667", "0.7083", "0.75", "0.8333"}) {
        const auto found = errors(pigment, path, std::string("safe { exponent ") + exponent + " }",
                                  truth, 8, samples);
        std::printf("| %s | %s |", name.c_str(), exponent);
        for (std::size_t i = 0; i < samples.size(); ++i) std::printf(" %.2f |", none[i] / found[i]);
        std::printf(" grace at 1024: %.2g of %.2g\n", std::pow(0.005 * mean(truth), 2),
                    none.back());
        std::fflush(stdout);
      }
    }
}

// Whether the light counts in a limit: test_images "[.light_term]" prints what docs/footprints.md
// shows.
TEST_CASE("the light in a limit, constant and exact", "[.light_term][slow]") {
  const std::vector<int> samples = {1, 4, 16, 64, 256};
  const std::map<std::string, std::string> lights = {
      {"spot",
       "light spot { location <0.5, 4, -2> point_at <0, 0, -0.5> radius 10 falloff 25 "
       "intensity rgb 30 }\n"},
      {"spot behind gloss",  // a glossy pane fills the view: it shows the floor where the spot
                             // fades
       "light spot { location <0, 4, -7.5> point_at <0, 0, -4.4> radius 1 falloff 8 "
       "intensity rgb 60 }\n"
       "quad { <-4, -0.5, -2.5>, <8, 0, 0>, <0, 5, -2.5> "
       "brdf phong { specular rgb 0.8 exponent 40 } }\n"},
      {"near lamp", "light area { <-0.4, 1.2, -1.6>, <0.8, 0, 0>, <0, 0, 0.8> radiance rgb 8 }\n"}};
  const std::pair<const char*, const char*> integrators[] = {
      {"path", "path { depth 4"}, {"distributed", "distributed { split 4 depth 3"}};
  for (const auto& [lamp, light] : lights)
    for (const auto& [name, integrator] : integrators)
      for (const char* texture : {"as fine as the lobe", "finer", "much finer", "smooth, bent"}) {
        const std::string& pigment = kTextures.at(texture);
        const Pixels truth = reference(pigment, integrator, 4096, light);
        const auto none = errors(pigment, integrator, "none", truth, 8, samples, light);
        for (const char* footprint : {"gradient { }", "gradient { light exact }",
                                      "safe { limit 0.7 }", "safe { limit 0.7 light exact }"}) {
          const auto found = errors(pigment, integrator, footprint, truth, 8, samples, light);
          std::printf("| %s | %s | %s | %s |", lamp.c_str(), name, texture, footprint);
          for (std::size_t i = 0; i < samples.size(); ++i)
            std::printf(" %.3f |", none[i] / found[i]);
          std::printf("\n"), std::fflush(stdout);
        }
      }
}
