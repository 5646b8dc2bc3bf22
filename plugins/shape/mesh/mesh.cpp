// SPDX-License-Identifier: Apache-2.0
// Triangles from a file: OBJ, PLY, STL, glTF and what else Assimp reads.
#include <algorithm>

#include <vestige/plugin.h>

#include "import.h"

namespace vestige {
namespace {

class Mesh final : public MeshShape {
 public:
  enum Row { kFile, kHandedness, kSmooth, kSmoothAngle };

  static Schema schema() {
    return {.kind = "shape",
            .name = "mesh",
            .summary = "triangles from a file, with its materials",
            .params = {file("file").need().place().doc("OBJ, PLY, STL, glTF, GLB"),
                       choice("handedness", {"right", "left"})
                           .doc("of the file; a right-handed one is mirrored in z"),
                       boolean("smooth", false).doc("makes normals where the file has none"),
                       real("smooth_angle", 80)
                           .range(0, 180)
                           .in("degrees")
                           .doc("edges sharper than this stay sharp")}};
  }

  Mesh(const Values& v, Host& host) {
    std::string error;
    const std::string path = host.find(v.text(kFile), v.span(kFile), error);
    if (path.empty()) throw PluginError(kFile, error);
    const mesh::Options options{v.text(kHandedness) != "left", v.flag(kSmooth),
                                v.real(kSmoothAngle)};
    const auto witness = [&](const std::string& other) {
      std::string ignored;
      host.find(other, v.span(kFile), ignored);
    };
    try {
      mesh::Imported made = mesh::import(path, options, witness);
      parts_ = std::move(made.parts);
      if (made.dropped > 0)
        host.warn(v.span(kFile), std::to_string(made.dropped) +
                                     " triangles of the mesh have a corner that is not a finite "
                                     "number; they are left out");
      for (const std::string& w : made.warnings) host.warn(v.span(kFile), w);
    } catch (const mesh::ReadError& e) {
      throw PluginError(kFile, "\"" + v.text(kFile) + "\" " + e.what());
    }
  }
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Shape, vestige::Mesh)
