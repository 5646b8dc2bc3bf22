// SPDX-License-Identifier: Apache-2.0
// What a render took, as JSON for programs and as one line for peers' harnesses.
#pragma once
#include <string>
#include <vector>

#include "app/progress.h"
#include "engine/render/session.h"

namespace vestige::app {

struct Statistics {
  double importSeconds = 0;  ///< finding plugin libraries
  double loadSeconds = 0;    ///< reading the text, loading the plugins that it names
  double buildSeconds = 0;   ///< files, textures, acceleration structure
  RenderResult render{};
  TextureUse textures;  ///< after rendering
  std::size_t triangles = 0;
  int width = 0, height = 0;  ///< pixels that were rendered
  std::uint32_t seed = 0;
  std::uint64_t cutAovs = 0;  ///< samples of AOVs that were not finite or too large
  double noise = 0;           ///< that was wanted; 0: none
  bool isAdaptive = false;    ///< not the same number of samples everywhere
  /// Of `render.seconds`, what earlier runs took; negative: no checkpoint is kept.
  double earlierSeconds = -1;
};

/// "finished", "time is up", "interrupted".
const char* endText(RenderEnd end);

/// The object of --stats.
std::string statisticsJson(const Statistics& s);
/// `RESULT {"import_s": .., "load_s": .., "render_s": .., "spp_actual": ..}`; after --noise and
/// --adaptive also "spp_mean" and "spp_most", after --noise "quiet_pixels".
std::string resultLine(const Statistics& s);
/// The last line of --progress json.
std::string doneLine(const Statistics& s, const std::vector<std::string>& files);

}  // namespace vestige::app
