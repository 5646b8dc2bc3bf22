// SPDX-License-Identifier: Apache-2.0
// Light by particles is light by paths: irradiance of a whole floor, above it glass. Paths carry
// radiance, which glass scales; particles carry flux, which it does not.
#include "engine/render/session.h"
#include "particle/solve.h"

using namespace vestige;
using namespace vestige::particle;

namespace {

constexpr double kReflectance = 0.6;

/// A closed room with a lamp in its ceiling; the camera hovers over the floor and sees just that.
std::string room(const std::string& inside) {
  std::string walls = box("brdf lambert { diffuse rgb 0.6 }");
  walls.erase(0, walls.find('\n') + 1);  // its camera
  return "camera orthographic { location <1, 0.2, 1> look_at <1, 0, 1> sky z width 2 }\n"
         "film { resolution <32, 32> }\nintegrator path { depth 100 }\n" +
         walls + "light area { <0.5, 1.99, 0.5>, <1, 0, 0>, <0, 0, 1> radiance rgb 10 }\n" + inside;
}

/// W/m^2 on the floor, by paths from the eye.
double byPaths(const std::string& text, int samples) {
  const auto scene = test::sceneOf(text);
  Film film = makeFilm(*scene, 0, 0, nullptr, {});
  RenderOptions options;
  options.samples = samples, options.threads = 2;
  render(*scene, film, options);
  const Film::Means m = film.means();
  double sum = 0;
  for (std::size_t i = 0; i < m.pixels.size(); i += m.channels.size()) sum += double(m.pixels[i]);
  return sum / (32 * 32) * double(kPi) / kReflectance;
}

const std::pair<const char*, const char*> kInside[] = {
    {"nothing", ""},
    {"a glass plate", "box { <0.1, 1, 0.1>, <1.9, 1.2, 1.9> brdf glass { ior 1.5 } }\n"},
    {"a ground plate",
     "box { <0.1, 1, 0.1>, <1.9, 1.2, 1.9> brdf rough_dielectric { alpha 0.3 ior 1.5 } }\n"},
    {"glass up to the middle", "box { <-1, -1, -1>, <3, 1, 3> brdf glass { ior 1.5 } }\n"},
    {"paint", "box { <0.1, 1, 0.1>, <1.9, 1.2, 1.9> brdf principled { base_color rgb 0.7 } }\n"},
    {"a screen",
     "quad { <0, 1, 0>, <2, 0, 0>, <0, 0, 2> brdf lambert { diffuse rgb 0.5 opacity 0.4 } }\n"}};

void compare(const std::string& name, const std::string& inside, std::uint64_t particles,
             int samples, double tolerance) {
  const Solution s = solve(room(inside), particles, settings(Oracle::footprint));
  const double paths = byPaths(room(inside), samples);
  std::printf("floor under;%s;particles over paths;%.4f\n", name.c_str(), s.irradiance(0) / paths);
  INFO(name);
  CHECK(s.irradiance(0) == Approx(paths).epsilon(tolerance));
}

}  // namespace

TEST_CASE("particles bring a floor the light that paths find there", "[particle]") {
  for (const auto& [name, inside] : kInside) compare(name, inside, 60000, 64, 0.05);
}

TEST_CASE("... to half a percent", "[particle][slow]") {
  for (const auto& [name, inside] : kInside) compare(name, inside, 4'000'000, 4096, 0.005);
}
