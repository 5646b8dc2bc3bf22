// SPDX-License-Identifier: Apache-2.0
// Derivatives of rays, of particles and of cameras, against differences.
#pragma once
#include <array>

#include "judge/trusted_difference.h"
#include "judge/verdict.h"

namespace vestige::judge {

inline constexpr double kRayStep = kDouble ? 1e-3 : 1e-2, kRayTolerance = kDouble ? 1e-6 : 4e-3;

inline std::string toldVectors(const std::string& what, Vec3 found, Vec3 expected) {
  std::ostringstream text;
  text.precision(9);
  text << what << " is " << found << ", expected " << expected;
  return text.str();
}

/// `found` against differences of a map from a Real to an optional Vec3 of size `noise`.
template <class Map, class Describe>
void seeDifference(Finding& f, const Map& map, Vec3 found, double noise, const std::string& what,
                   const Describe& describe) {
  if (!isFinite(found)) {  // else no difference could be told from it
    f.worst.see(HUGE_VAL, [&] { return describe(what + " is not finite"); });
    return;
  }
  ++f.asked;
  const double rough = std::max({1.0, noise, sizeOf(found)});
  const auto seen = trustedDifference(map, kRayStep, kRayTolerance * rough, std::max(noise, 0.1));
  if (!seen) return;
  ++f.judged;
  f.worst.see(sizeOf(found - *seen) / (kRayTolerance * rough),
              [&] { return describe(toldVectors(what, found, *seen)); });
}

}  // namespace vestige::judge
