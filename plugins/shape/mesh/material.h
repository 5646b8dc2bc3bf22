// SPDX-License-Identifier: Apache-2.0
// A file's materials as blocks of the scene language.
#pragma once
#include "import.h"

struct aiMaterial;

namespace vestige::mesh {

/// Fills brdf, emission and name of the part; `warnings` receives what could not be taken over.
void convertMaterial(const aiScene& scene, const aiMaterial& from, const std::string& meshPath,
                     const Witness& witness, MeshPart& part, std::vector<std::string>& warnings);

}  // namespace vestige::mesh
