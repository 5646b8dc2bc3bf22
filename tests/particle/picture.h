// SPDX-License-Identifier: Apache-2.0
// Pictures of 32 x 32 pixels, by any integrator, of a lit room and of what a test puts into it.
#pragma once
#include "engine/render/session.h"
#include "particle/solve.h"

namespace vestige::particle {

struct Picture {
  std::vector<double> grey;
  double mean = 0;
  std::vector<double> albedo;
  std::vector<double> level;  ///< of elements; empty but for integrator particle
};

inline Picture pictureOf(const std::string& text, const std::string& integrator, int samples,
                         int threads = 2, const Registry& plugins = test::registry()) {
  const auto scene =
      test::sceneOf(text + "film { resolution <32, 32> }\nintegrator " + integrator, plugins);
  const bool hasElements = scene->integratorName() == "particle";
  std::vector<std::string> aovs = {"albedo"};
  if (hasElements) aovs.push_back("element.level");
  Film film = makeFilm(*scene, 0, 0, nullptr, aovs);
  RenderOptions options;
  options.samples = samples, options.threads = threads;
  render(*scene, film, options);
  const Film::Means m = film.means();
  Picture p;
  for (std::size_t i = 0; i < m.pixels.size(); i += m.channels.size()) {
    p.grey.push_back((double(m.pixels[i]) + double(m.pixels[i + 1]) + double(m.pixels[i + 2])) / 3);
    p.albedo.push_back(double(m.pixels[i + 3]));
    if (hasElements) p.level.push_back(double(m.pixels[i + 6]));
    p.mean += p.grey.back() / (32 * 32);
  }
  return p;
}

inline const std::string kLamp =
    "light area { <0.5, 1.99, 0.5>, <1, 0, 0>, <0, 0, 1> radiance rgb <10, 9, 7> }\n";
inline const std::string kWalls = box("brdf lambert { diffuse rgb <0.6, 0.5, 0.4> }") + kLamp;

}  // namespace vestige::particle
