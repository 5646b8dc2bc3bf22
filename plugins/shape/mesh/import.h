// SPDX-License-Identifier: Apache-2.0
// From a file to triangles, by Assimp.
#pragma once
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include <vestige/host.h>
#include <vestige/shape.h>

struct aiScene;

namespace vestige::mesh {

struct Options {
  bool mirror = true;     ///< right-handed file: z changes sign, and the winding with it
  bool smooth = false;    ///< makes normals where the file has none
  Real smoothAngle = 80;  ///< degrees: edges sharper than this stay sharp
};

/// Why a file could not be read, in the user's words.
struct ReadError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What came out, and what was left out of it.
struct Imported {
  std::vector<MeshPart> parts;
  std::size_t dropped = 0;            ///< triangles with a corner that is no number
  std::vector<std::string> warnings;  ///< about materials
};

/// Told of every file before it is looked for.
using Witness = std::function<void(const std::string& file)>;

/// Throws ReadError.
Imported import(const std::string& path, const Options& options, const Witness& witness);

/// Lower case, without the dot.
std::string extensionOf(const std::string& path);

}  // namespace vestige::mesh
