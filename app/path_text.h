// SPDX-License-Identifier: Apache-2.0
// A recorded path, vertex by vertex, for people and for programs.
#pragma once
#include <string>
#include <vector>

#include "app/scene_input.h"

namespace vestige::app {

/// Keeps what an integrator tells about one path.
class RecordedPath final : public PathRecord {
 public:
  struct Seen {
    std::size_t vertex;  ///< at which
    SeenElement element;
  };
  void add(const PathVertex& vertex) override { vertices.push_back(vertex); }
  void saw(const SeenElement& element) override { seen.push_back({vertices.size(), element}); }
  std::vector<PathVertex> vertices;
  std::vector<Seen> seen;
};

/// "flux <0.1, 0.1, 0.1> W on 0.02, 134 particles".
std::string elementText(const SeenElement& element);

/// Which random number a differential is taken by, on arrival at each vertex: "film x", "vertex 2
/// v", ... A path that was reduced on the way has "mixed 1" and so on.
std::vector<std::vector<std::string>> numberNames(const std::vector<PathVertex>& vertices);

/// The whole story. Several lines a vertex.
std::string pathText(const RecordedPath& path, const LoadedScene& loaded);
/// The same as JSON: vectors as arrays, one object a vertex.
std::string pathJson(const RecordedPath& path, const LoadedScene& loaded, Rgb radiance);

}  // namespace vestige::app
