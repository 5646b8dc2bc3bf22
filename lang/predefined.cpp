// SPDX-License-Identifier: Apache-2.0
#include "lang/predefined.h"

#include <chrono>
#include <cmath>
#include <filesystem>

namespace vestige::lang {
namespace {

/// A side of the picture that is not given keeps its shape; the engine's rule.
double side(int given, int other, double film, double otherFilm) {
  if (given > 0) return given;
  return other > 0 ? std::max(1.0, std::round(film * other / otherFilm)) : film;
}

/// Without a place: still the value from before the text, which a film block may replace.
void set(Context& context, const char* name, Datum value) {
  *context.symbols.in(0, context.names.intern(name)) = {std::move(value), {}};
}

bool isUntouched(Context& context, const char* name) {
  const Cell cell = context.symbols.find(context.names.intern(name));
  return cell && cell->declared.file < 0;
}

void setImageSize(Context& context, const Value& resolution) {
  const int width = context.options.imageWidth, height = context.options.imageHeight;
  const double w = resolution.v[0], h = resolution.v[1];
  if (isUntouched(context, "image_width"))
    set(context, "image_width", Numbers(side(width, height, w, h)));
  if (isUntouched(context, "image_height"))
    set(context, "image_height", Numbers(side(height, width, h, w)));
}

/// Days since the beginning of 2000, UTC.
double now() {
  constexpr double kSecondsADay = 86400, kDaysFrom1970To2000 = 10957;
  const auto since = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration<double>(since).count() / kSecondsADay - kDaysFrom1970To2000;
}

bool isClockGiven(const Options& options) {
  return std::any_of(options.definitions.begin(), options.definitions.end(),
                     [](const auto& d) { return d.first == "clock"; });
}

}  // namespace

void predefine(Context& context, const Vocabulary& words, const std::string& sceneFile) {
  for (const char* name : {"clock_delta", "frame_number", "initial_frame", "final_frame",
                           "initial_clock", "final_clock", "image_width", "image_height"})
    set(context, name, Numbers(0.0));
  set(context, "input_file_name", textDatum(std::filesystem::path(sceneFile).filename().string()));
  const Schema* film = words.find("film", "");
  const Parameter* row = film ? film->find("resolution") : nullptr;
  if (row && row->initial.kind == Value::Kind::vector) setImageSize(context, row->initial);
}

void noteFilm(Context& context, const Block& film) {
  if (const Value* resolution = film.find("resolution")) setImageSize(context, *resolution);
}

Datum settingOf(const Context& context, Word word) {
  if (word == Word::now) return Numbers(now());
  return Numbers(word == Word::clockOn && isClockGiven(context.options) ? 1 : 0);
}

}  // namespace vestige::lang
