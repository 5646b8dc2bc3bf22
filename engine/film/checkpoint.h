// SPDX-License-Identifier: Apache-2.0
// A film in a file, from which the same render goes on to the bit.
#pragma once
#include <string>
#include <vector>

#include "engine/film/film.h"

namespace vestige {

/// One thing that two renders must have in common for one to continue the other.
struct CheckpointFact {
  std::string what;            ///< for people: "the seed", "'cat.png'"
  std::string value;           ///< "7", or a fingerprint
  bool isFingerprint = false;  ///< then the value tells nobody anything
};
/// All but what the film itself knows: its size, crop window and AOVs.
using CheckpointLabel = std::vector<CheckpointFact>;

/// What the film's samples took, summed over all runs.
struct Effort {
  double seconds = 0;
  Counters counters = {};
};

/// The film must stand still. The file is replaced at once when the new one is safe on the disk;
/// until then, and whatever goes wrong, the old one stays. Both throw std::runtime_error with a
/// sentence for the user.
void saveCheckpoint(const Film& film, const CheckpointLabel& label, const Effort& effort,
                    const std::string& path);
/// Fills a film of the same size, crop window and AOVs; untouched if the file is damaged, or is of
/// another render: the sentence names the first difference.
Effort loadCheckpoint(Film& film, const CheckpointLabel& label, const std::string& path);

}  // namespace vestige
