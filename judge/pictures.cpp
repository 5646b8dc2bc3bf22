// SPDX-License-Identifier: Apache-2.0
#include "judge/pictures.h"

#include <algorithm>

#include "judge/harsh.h"
#include "judge/plain.h"

namespace vestige::judge {
namespace {

/// The first parameters that the plugin accepts, with plain values preferred.
template <class Interface>
std::shared_ptr<Interface> shown(const Plugin& plugin, unsigned seed, Settings& s) {
  Random r(seed);
  for (int tried = 0; tried < 50; ++tried) try {
      s = shownSettings(*plugin.schema, r, tried < 25);  // not every file is a picture
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
    if (!light) return {};
    return lightPictures({title(), light, !(plugin.entry->lacks & kLacksEmission)}, effort);
  }
  if (plugin.kind == "camera") {
    const auto camera = shown<Camera>(plugin, effort.seed, s);
    return camera ? cameraPictures({title(), camera}, effort) : std::vector<Picture>{};
  }
  return {};
}

std::string leftOutPictures(const Plugin& plugin, const std::vector<Picture>& pictures) {
  const auto has = [&](const std::string& file) {
    return std::any_of(pictures.begin(), pictures.end(),
                       [&](const Picture& p) { return p.file == file; });
  };
  const bool isTried = plugin.kind == "brdf" || plugin.kind == "light" || plugin.kind == "camera";
  if (!isTried) return "no pictures exist for a " + plugin.kind;
  if (pictures.empty())
    return "no pictures: the plugin refused all parameters that were tried, or all samples are "
           "empty";
  if (plugin.kind != "light") return "";
  std::string text;
  if (!has("density.png"))
    text = "no density.png, derivative.png: no ray meets a delta light by chance";
  if (!has("flux.png"))
    text += std::string(text.empty() ? "" : "\n") +
            "no flux.png, emission.png: the light sends no particles";
  return text;
}

bool writePictures(const std::vector<Picture>& pictures, const std::string& folder,
                   std::string& error) {
  for (const Picture& p : pictures)
    if (!writeImage(folder + "/" + p.file, p.image, {}, error)) return false;
  return true;
}

}  // namespace vestige::judge
