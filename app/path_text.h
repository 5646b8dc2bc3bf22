// SPDX-License-Identifier: Apache-2.0
// A recorded path, vertex by vertex, for people and for programs.
#pragma once
#include <string>
#include <vector>

#include "app/scene_input.h"

namespace vestige::app {

/// Keeps everything that an integrator reports about one path.
class RecordedPath final : public PathRecord {
 public:
  struct Note {
    std::size_t vertex;  ///< index into `vertices`
    PathNote note;
  };
  void add(const PathVertex& vertex) override { vertices.push_back(vertex); }
  void note(const PathNote& note) override { notes.push_back({vertices.size(), note}); }
  std::vector<PathVertex> vertices;
  std::vector<Note> notes;
};

/// "element.flux <0.1, 0.1, 0.1> W".
std::string noteText(const PathNote& note);
/// The notes of a vertex, with commas between them; "" if there are none.
std::string notesText(const RecordedPath& path, std::size_t vertex);

/// Which random number a differential is taken by, on arrival at each vertex: "film x", "vertex 2
/// v", ... A path that was reduced on the way has "mixed 1" and so on.
std::vector<std::vector<std::string>> numberNames(const std::vector<PathVertex>& vertices);

/// The whole story. Several lines a vertex.
std::string pathText(const RecordedPath& path, const LoadedScene& loaded);
/// The same as JSON: vectors as arrays, one object a vertex.
std::string pathJson(const RecordedPath& path, const LoadedScene& loaded, Rgb radiance);

}  // namespace vestige::app
