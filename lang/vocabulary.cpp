// SPDX-License-Identifier: Apache-2.0
#include "lang/vocabulary.h"

#include <algorithm>
#include <map>

#include "lang/builtins.h"

namespace vestige::lang {

Vocabulary::Vocabulary(const SchemaSource& schemas) : schemas_(schemas) {
  for (const std::string& kind : schemas.kinds()) kinds_.insert(kind);
}

bool Vocabulary::opensBlock(const std::string& word) const {
  return word == "object" || isKind(word) || isShape(word);
}

bool Vocabulary::opensBlock(const Name& name) const {
  if (name.id >= opens_.size()) opens_.resize(std::size_t(name.id) + 1);
  Opens& known = opens_[name.id];
  if (known == Opens::unknown)
    known = opensBlock(static_cast<const std::string&>(name)) ? Opens::yes : Opens::no;
  return known == Opens::yes;
}

bool Vocabulary::standsAlone(const std::string& kind) const {
  return isAnyOf(kind, [](const Schema& s) { return s.standsAlone; });
}

std::vector<std::string> Vocabulary::holders(const std::string& kind) const {
  std::vector<std::string> found;
  for (const std::string& outer : kinds_)
    if (isAnyOf(outer, [&](const Schema& s) {
          return std::find(s.children.begin(), s.children.end(), kind) != s.children.end();
        }))
      found.push_back(outer);
  return found;
}

bool Vocabulary::isAnyOf(const std::string& kind,
                         const std::function<bool(const Schema&)>& is) const {
  for (const std::string& plugin : isKind(kind) ? plugins(kind) : std::vector<std::string>())
    if (const Schema* s = find(kind, plugin); s && is(*s)) return true;
  return false;
}

std::vector<std::string> Vocabulary::blockWords() const {
  std::vector<std::string> words = plugins("shape");
  words.push_back("object");
  for (const std::string& kind : kinds_)
    if (kind != "shape") words.push_back(kind);
  return words;
}

void Vocabulary::explain(Diagnostic& d, const std::string& kind, const std::string& plugin) const {
  if (const std::string why = schemas_.whyMissing(kind, plugin); !why.empty())
    d.notes.push_back({{}, why});
}

namespace {

const std::map<std::string, const char*>& replacements() {
  static const char* const brdf = "write 'brdf NAME { ... }', as in 'brdf lambert { diffuse Red }'";
  static const char* const glow = "write 'emission rgb 1' in the shape to make it shine";
  static const char* const glass = "write 'brdf glass { ior 1.5 }' in the shape";
  static const char* const sky = "write 'light environment { radiance rgb 1 }'";
  static const char* const lens = "write 'camera thin_lens { aperture 0.1 focal_point <0, 0, 0> }'";
  static const char* const light =
      "write 'light point { location <0, 5, 0> intensity rgb 10 }' "
      "or 'light area { corner, edge, edge radiance rgb 10 }'";
  static const char* const rough =
      "write 'brdf rough_conductor { alpha 0.1 }' or 'brdf phong { "
      "specular rgb 0.5 exponent 50 }'";
  static const char* const none = "it has no counterpart here; light is computed, not set";
  static const char* const objects = "Vestige cannot measure objects while it reads the text";
  static const char* const notYet = "Vestige does not have it yet";
  static const std::map<std::string, const char*> words = {
      {"texture", brdf},
      {"finish", brdf},
      {"material", brdf},
      {"phong_size", rough},
      {"normal", "write 'normal_map pigment image { \"file\" }' in a brdf"},
      {"interior", glass},
      {"interior_texture", glass},
      {"media", notYet},
      {"density", notYet},
      {"light_source", light},
      {"spotlight", "write 'light spot { ... }'"},
      {"area_light", light},
      {"light_group", notYet},
      {"looks_like", glow},
      {"ambient", glow},
      {"emission_map", glow},
      {"ambient_light", sky},
      {"background", sky},
      {"sky_sphere", sky},
      {"fog", notYet},
      {"rainbow", notYet},
      {"global_settings", "write 'integrator path { samples 64 depth 8 }' and 'film { ... }'"},
      {"radiosity", none},
      {"photons", none},
      {"hollow", none},
      {"double_illuminate", none},
      {"assumed_gamma", none},
      {"max_trace_level", "write 'depth' in the integrator"},
      {"focal_blur", lens},
      {"blur_samples", lens},
      {"perspective", "write 'camera pinhole'"},
      {"color_map", notYet},
      {"colour_map", notYet},
      {"pigment_map", notYet},
      {"texture_map", notYet},
      {"image_map", "write 'pigment image { \"file\" }'"},
      {"bump_map", "write 'normal_map' in a brdf"},
      {"uv_mapping", "an image is looked up by uv unless 'mapping' says otherwise"},
      {"mesh2", "write 'mesh { \"file\" }'"},
      {"smooth_triangle", "write 'mesh { \"file\" }'"},
      {"blob", notYet},
      {"isosurface", notYet},
      {"julia_fractal", notYet},
      {"lathe", notYet},
      {"ovus", notYet},
      {"parametric", notYet},
      {"prism", notYet},
      {"sphere_sweep", notYet},
      {"superellipsoid", notYet},
      {"sor", notYet},
      {"bicubic_patch", notYet},
      {"polygon", notYet},
      {"poly", notYet},
      {"cubic", notYet},
      {"quartic", notYet},
      {"quadric", notYet},
      {"polynomial", notYet},
      {"difference", notYet},
      {"intersection", notYet},
      {"merge", notYet},
      {"clipped_by", notYet},
      {"bounded_by", "bounds are found by themselves: leave it out"},
      {"#default", notYet},
      {"min_extent", objects},
      {"max_extent", objects},
      {"inside", objects},
      {"trace", objects},
      {"parallel", "write 'light distant { ... }'"}};
  return words;
}

}  // namespace

const char* insteadOf(const std::string& word) {
  const auto found = replacements().find(word);
  return found == replacements().end() ? nullptr : found->second;
}

std::vector<std::string> replacedWords() {
  std::vector<std::string> all;
  for (const auto& [word, instead] : replacements()) all.push_back(word);
  return all;
}

bool isTransformWord(const std::string& word) { return isTransform(wordOf(word)); }

bool isExpressionWord(const std::string& word) {
  const Word w = wordOf(word);
  return findBuiltin(word) || (w >= Word::rgb && w <= Word::function && w != Word::grey);
}

std::string orList(const std::vector<std::string>& words) {
  std::string s;
  for (std::size_t i = 0; i < words.size(); ++i)
    s += (i == 0 ? "" : i + 1 < words.size() ? ", " : " or ") + words[i];
  return s;
}

}  // namespace vestige::lang
