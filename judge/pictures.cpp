// SPDX-License-Identifier: Apache-2.0
#include "judge/pictures.h"

#include "judge/harsh.h"
#include "judge/plain.h"

namespace vestige::judge {
namespace {

/// The first parameters that the plugin takes, as plain as can be.
template <class Interface>
std::shared_ptr<Interface> shown(const Plugin& plugin, unsigned seed, Settings& s) {
  Random r(seed);
  for (int tried = 0; tried < 50; ++tried) try {
      s = shownSettings(*plugin.schema, r);
      return make<Interface>(plugin, s);
    } catch (const std::runtime_error&) {
      continue;  // settings that contradict each other
    }
  return nullptr;
}

}  // namespace

std::vector<Picture> picturesOf(const Plugin& plugin, const Effort& effort) {
  Settings s;
  const auto title = [&] {
    return plugin.kind + " " + plugin.name + " {" + textOfSettings(s) + " }";
  };
  if (plugin.kind == "brdf") return brdfPictures(brdfCase(plugin, {}), effort);
  if (plugin.kind == "light") {
    const auto light = shown<Light>(plugin, effort.seed, s);
    if (light) light->setScene(kLightScene);
    return light ? lightPictures({title(), light}, effort) : std::vector<Picture>{};
  }
  if (plugin.kind == "camera") {
    const auto camera = shown<Camera>(plugin, effort.seed, s);
    return camera ? cameraPictures({title(), camera}, effort) : std::vector<Picture>{};
  }
  return {};
}

bool writePictures(const std::vector<Picture>& pictures, const std::string& folder,
                   std::string& error) {
  for (const Picture& p : pictures)
    if (!writeImage(folder + "/" + p.file, p.image, {}, error)) return false;
  return true;
}

}  // namespace vestige::judge
