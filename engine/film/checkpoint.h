// SPDX-License-Identifier: Apache-2.0
// A film in a file. A render continued from it gives the same bits as one in a single run.
#pragma once
#include <string>
#include <vector>

#include "engine/film/film.h"

namespace vestige {

/// One thing that two renders must have in common for one to continue the other.
struct CheckpointFact {
  std::string what;            ///< for people: "the seed", "'cat.png'"
  std::string value;           ///< "7", or a fingerprint
  bool isFingerprint = false;  ///< the value is meaningless to people
};
/// Everything but the size, crop window and AOVs, which the film itself has.
using CheckpointLabel = std::vector<CheckpointFact>;

/// The cost of the film's samples, summed over all runs.
struct Effort {
  double seconds = 0;
  Counters counters = {};
};

/// Nothing may add to the film meanwhile. The old file stays until the new one is complete on the
/// disk, and is then replaced in one step. Both functions throw std::runtime_error with a sentence
/// for the user.
void saveCheckpoint(const Film& film, const CheckpointLabel& label, const Effort& effort,
                    const std::string& path);
/// Fills a film of the same size, crop window and AOVs. If the file is damaged or belongs to
/// another render the film is unchanged, and the sentence names the first difference.
Effort loadCheckpoint(Film& film, const CheckpointLabel& label, const std::string& path);

}  // namespace vestige
