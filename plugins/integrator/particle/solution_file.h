// SPDX-License-Identifier: Apache-2.0
// A solution on disk: which scene it belongs to, how many particles made it, and what each element
// got. Parts of one declared total add up to the bit.
#pragma once
#include <string>

#include "shooting.h"

namespace vestige::particle {

/// What a solution has to agree with to be added to another.
struct SolutionKey {
  std::uint64_t surfaces = 0;   ///< fingerprint of all patches
  std::uint64_t particles = 0;  ///< declared
  double power = 0;             ///< W
};

/// Of the places and areas of all patches, and how they were gathered: what makes an element's
/// number mean the same.
std::uint64_t fingerprint(const SceneView& scene, const Hierarchy& hierarchy) noexcept;

/// Throws std::runtime_error with a sentence for the user. Nothing is left behind but the whole
/// file, under its name.
void saveSolution(const std::string& file, const SolutionKey& key, const Booking& booking,
                  const Hierarchy& hierarchy);

/// Adds what the file holds. The declared number of particles and the power are taken from the
/// first file; the others have to agree. Throws likewise.
void addSolution(const std::string& file, SolutionKey& key, Booking& booking, Hierarchy& hierarchy);

/// Throws if a solution could not be written there, before hours have gone into it.
void checkSolutionFile(const std::string& file);

}  // namespace vestige::particle
