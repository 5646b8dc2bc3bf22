// SPDX-License-Identifier: Apache-2.0
#include "app/statistics.h"

#include <sys/resource.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace vestige::app {
namespace {

using Json = nlohmann::ordered_json;

std::uint64_t peakMemoryBytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return std::uint64_t(usage.ru_maxrss) * 1024;  // Linux counts in KiB
}

/// After --noise and --adaptive: what it came to.
void addNoise(Json& json, const Statistics& s, const char* mean, const char* most) {
  if (!s.isAdaptive) return;
  json[mean] = s.render.meanSamples, json[most] = s.render.mostSamples;
  if (s.noise > 0) json["quiet_pixels"] = std::llround(s.render.quiet * s.width * s.height);
}

}  // namespace

const char* endText(RenderEnd end) {
  switch (end) {
    case RenderEnd::timeUp:
      return "time is up";
    case RenderEnd::cancelled:
      return "interrupted";
    default:
      return "finished";
  }
}

std::string statisticsJson(const Statistics& s) {
  const Counters& c = s.render.counters;
  Json json = {{"version", VESTIGE_VERSION},
               {"end", endText(s.render.end)},
               {"width", s.width},
               {"height", s.height},
               {"samples", s.render.samples},
               {"seed", s.seed},
               {"threads", s.render.threads},
               {"import_s", s.importSeconds},
               {"load_s", s.loadSeconds},
               {"build_s", s.buildSeconds},
               {"render_s", s.render.seconds},
               {"paths", c.paths},
               {"rays", c.rays},
               {"shadow_rays", c.shadowRays},
               {"nonfinite", c.nonFinite},
               {"clamped", c.clamped},
               {"clamped_indirect", c.clampedIndirect},
               {"cut_aovs", s.cutAovs},
               {"triangles", s.triangles},
               {"texture_bytes", s.textures.held},
               {"textures_paged", s.textures.paged},
               {"texture_cache_bytes", s.textures.pagedLimit},
               {"texture_cache_used_bytes", s.textures.pagedUsed},
               {"texture_read_errors", s.textures.readErrors},
               {"peak_memory_bytes", peakMemoryBytes()}};
  if (s.earlierSeconds >= 0) json["earlier_render_s"] = s.earlierSeconds;
  if (s.noise > 0) json["noise"] = s.noise;
  addNoise(json, s, "samples_mean", "samples_most");
  return json.dump(2);
}

std::string resultLine(const Statistics& s) {
  Json json = {{"import_s", s.importSeconds},
               {"load_s", s.loadSeconds + s.buildSeconds},
               {"render_s", s.render.seconds},
               {"spp_actual", s.render.samples}};
  addNoise(json, s, "spp_mean", "spp_most");
  return "RESULT " + json.dump();
}

std::string doneLine(const Statistics& s, const std::vector<std::string>& files) {
  const Json json = {{"phase", "done"},
                     {"end", endText(s.render.end)},
                     {"elapsed", s.render.seconds},
                     {"samples", s.render.samples},
                     {"files", files}};
  // File names are bytes; those that are not UTF-8 must not stop the program.
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace vestige::app
