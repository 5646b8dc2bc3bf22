// SPDX-License-Identifier: Apache-2.0
// --checkpoint: a render is kept in a file while it is made, and goes on from there.
#pragma once
#include <functional>
#include <string>

#include "app/scene_input.h"
#include "engine/film/checkpoint.h"
#include "engine/render/session.h"

namespace vestige::app {

/// Whether paths look at how many samples a pixel were asked for: then a picture of more of them is
/// another one from the first.
bool goesByDeclaredSamples(const SceneDesc& text, const BuildOptions& build);

/// All that a render has to have in common with the one that it continues: what the text means but
/// the number of samples, contents of the files and plugins, seed, ... `build.files` has to hold
/// what the builder looked for, and nothing else. Reads those files.
CheckpointLabel checkpointLabel(const SceneDesc& text, Scene& scene, const Registry& registry,
                                const BuildOptions& build, const RenderOptions& render);

/// The file of one render.
class CheckpointFile {
 public:
  CheckpointFile(std::string file, CheckpointLabel label)
      : file_(std::move(file)), label_(std::move(label)) {}

  /// Fills the film if the file is there. Failure if it cannot be continued, or if a pixel has more
  /// than `wanted` samples (0: any number is fine) already.
  void load(Film& film, int wanted);
  /// Keeps the film, to which this run has added `soFar`. False, and `warn` is told the first time,
  /// if it could not be written, or shows mean colours in place of a texture that cannot be read.
  bool save(const Film& film, const Scene& scene, const RenderResult& soFar,
            const std::function<void(const std::string&)>& warn);
  /// With what earlier runs took.
  RenderResult whole(RenderResult result) const;
  const Effort& earlier() const noexcept { return earlier_; }

 private:
  std::string file_;
  CheckpointLabel label_;
  Effort earlier_;
  bool hasWarned_ = false;
};

}  // namespace vestige::app
