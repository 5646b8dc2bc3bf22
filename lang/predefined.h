// SPDX-License-Identifier: Apache-2.0
// Names that have a value before the text is read, POV-Ray's: of the animation, the picture and the
// scene's file.
#pragma once
#include "lang/context.h"
#include "lang/vocabulary.h"

namespace vestige::lang {

/// Declares frame_number, image_width, input_file_name, ... as for a still picture.
void predefine(Context& context, const Vocabulary& words, const std::string& sceneFile);
/// A film block of the scene sets image_width and image_height, as far as neither the program nor
/// the scene did.
void noteFilm(Context& context, const Block& film);

/// The value of clock, clock_on or now at this moment.
Datum settingOf(const Context& context, Word word);

}  // namespace vestige::lang
